#include "follow_junctions.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "iris/color.h"
#include "iris/xt/line_mask.h"
#include "picture.h"
#include "system.h"

static const iris_color MARK = {255, 140, 0};

static const char *const type_names[] = {"end", "corner", "T", "Y", "crossing"};
static const char *const turn_names[] = {"straight", "left", "right"};
static const char *const latch_names[] = {"waiting", "approaching", "turning", "done", "missed"};

/* Kept from frame to frame. */
static picture_buffer gray, mask;
static void *memory;
static size_t memory_bytes;
static iris_junction_latch latch;

int follow_junctions_take(follow_junction_options *options, const char *text)
{
    for (const char *at = text;; at++) {
        size_t length = strcspn(at, ",");
        int turn = 0;
        while (turn < 3 &&
               (strlen(turn_names[turn]) != length || strncmp(at, turn_names[turn], length) != 0)) {
            turn++;
        }
        if (turn == 3) {
            complain("--take", "left, right, or straight, with commas between them, not '%s'", text);
            return 0;
        }
        if (options->turn_count == IRIS_JUNCTION_TURNS_MAX) {
            complain("--take", "at most %d turns", IRIS_JUNCTION_TURNS_MAX);
            return 0;
        }
        options->turns[options->turn_count++] = (iris_turn)turn;
        at += length;
        if (*at == '\0') {
            return 1;
        }
    }
}

static int reserve(const iris_image *frame)
{
    iris_size size = {frame->w, frame->h};
    size_t for_mask = IRIS_LINE_MASK_SCRATCH_BYTES(size.w, size.h);
    size_t bytes = IRIS_JUNCTION_SCRATCH_BYTES(size.w, size.h);
    bytes = bytes > for_mask ? bytes : for_mask;
    if (bytes > memory_bytes) {
        free(memory);
        memory = system_scratch(bytes);
        memory_bytes = memory ? bytes : 0;
    }
    return memory && picture_reserve(&gray, size, IRIS_GRAY8) == IRIS_OK &&
           picture_reserve(&mask, size, IRIS_MASK1) == IRIS_OK;
}

static void make_mask(const iris_image *frame, const iris_follow_config *config)
{
    iris_scratch scratch;
    if (config->kind == IRIS_FOLLOW_COLOR) {
        iris_hsl_range_mask(&mask.image, frame, &config->color);
        return;
    }
    const int32_t contrast = config->contrast_permil < 300 ? config->contrast_permil : 300;
    const iris_line_mask_config kind = {config->kind == IRIS_FOLLOW_BRIGHT, contrast};
    iris_scratch_init(&scratch, memory, memory_bytes);
    iris_color_gray(&gray.image, frame, IRIS_GRAY_LUMA);
    iris_line_mask(NULL, &mask.image, &gray.image, &kind, &scratch);
}

int follow_junctions_look(follow_junctions *junctions, iris_follow_result *line, const iris_image *frame,
                          const iris_follow_config *config, const follow_junction_options *options,
                          int32_t elapsed_ms)
{
    iris_scratch scratch;
    iris_size size = {frame->w, frame->h};
    if (!reserve(frame)) {
        complain(NULL, "not enough memory");
        return EXIT_BAD_DATA;
    }
    make_mask(frame, config);
    iris_scratch_init(&scratch, memory, memory_bytes);
    iris_junctions_find(junctions->found, IRIS_JUNCTIONS_MAX, &junctions->count, &mask.image, NULL, &scratch);
    if (elapsed_ms < 0 || latch.size.w != size.w || latch.size.h != size.h) {
        iris_junction_latch_init(&latch, size);
        iris_junction_latch_take(&latch, options->turns, options->turn_count);
    }
    iris_junction_latch_update(line, &latch, junctions->found, junctions->count,
                               elapsed_ms < 0 ? 0 : elapsed_ms);
    junctions->take = options->turn_count > 0 ? turn_names[latch.turn] : NULL;
    junctions->take_state = latch_names[latch.state];
    return EXIT_DONE;
}

static double degrees(iris_angle angle)
{
    return iris_angle_to_centidegrees(angle) / 100.0;
}

void follow_junctions_json(json_writer *json, const follow_junctions *junctions, const follow_floor *floor)
{
    if (junctions->count < 0) {
        return;
    }
    json_key(json, "junctions");
    json_open(json, '[');
    for (int32_t i = 0; i < junctions->count; i++) {
        const iris_junction *j = &junctions->found[i];
        json_open(json, '{');
        json_key(json, "type");
        json_string(json, type_names[j->type]);
        json_key(json, "x");
        json_number(json, j->x_q4 / 16.0, 1);
        json_key(json, "y");
        json_number(json, j->y_q4 / 16.0, 1);
        json_key(json, "branches_deg");
        json_open(json, '[');
        for (int32_t k = 0; k < j->branch_count; k++) {
            json_number(json, degrees(j->branches[k]), 1);
        }
        json_close(json, ']');
        json_key(json, "distance_rows");
        json_integer(json, j->distance_rows);
        json_key(json, "confidence");
        json_number(json, j->confidence_permil / 1000.0, 3);
        follow_floor_json_junction(json, j, floor);
        json_close(json, '}');
    }
    json_close(json, ']');
    if (junctions->take) {
        json_key(json, "take");
        json_open(json, '{');
        json_key(json, "turn");
        json_string(json, junctions->take);
        json_key(json, "state");
        json_string(json, junctions->take_state);
        json_close(json, '}');
    }
}

void follow_junctions_print(const follow_junctions *junctions, const follow_floor *floor)
{
    for (int32_t i = 0; i < junctions->count; i++) {
        const iris_junction *j = &junctions->found[i];
        printf("  %s %.0f,%.0f", type_names[j->type], j->x_q4 / 16.0, j->y_q4 / 16.0);
        for (int32_t k = 0; k < j->branch_count; k++) {
            printf("%s%+.0f", k == 0 ? " " : "/", degrees(j->branches[k]));
        }
        follow_floor_print_junction(j, floor);
    }
    if (junctions->count >= 0 && junctions->take) {
        printf("  take %s: %s", junctions->take, junctions->take_state);
    }
}

void follow_junctions_draw(const canvas *c, const follow_junctions *junctions)
{
    for (int32_t i = 0; i < junctions->count; i++) {
        const iris_junction *j = &junctions->found[i];
        canvas_point at = {j->x_q4 / 16.0, j->y_q4 / 16.0};
        double reach = 2.5 * j->width_px;
        for (int32_t k = 0; k < j->branch_count; k++) {
            double angle = j->branches[k] / 32768.0 * 3.14159265358979;
            canvas_line(c, at, (canvas_point){at.x + reach * sin(angle), at.y - reach * cos(angle)}, MARK);
        }
        canvas_circle(c, at, j->width_px / 2.0 + 1, MARK);
        canvas_text(c, (canvas_point){at.x + j->width_px, at.y + j->width_px / 2.0}, MARK,
                    type_names[j->type]);
    }
}

void follow_junctions_end(void)
{
    picture_free(&gray);
    picture_free(&mask);
    free(memory);
    memory = NULL;
    memory_bytes = 0;
}
