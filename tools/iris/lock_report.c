#include "lock_report.h"

#include <stdio.h>
#include <string.h>

#include "complain.h"
#include "json.h"
#include "one_line.h"
#include "overlay_folder.h"

static const iris_color FOUND = {90, 255, 120}, COASTING = {255, 220, 60}, LOST = {255, 90, 80},
                        TRAIL = {0, 220, 255};

/* The enlarged frame, kept for the next one. */
static picture_buffer enlarged;

static double pixels(iris_q16 place)
{
    return place / 65536.0;
}

/* ---- in words ---- */

static void value(json_writer *json, const char *key, int exists, double number, int decimals)
{
    json_key(json, key);
    exists ? json_number(json, number, decimals) : json_null(json);
}

static void report_json(const iris_lock_result *result, const lock_frame *frame)
{
    json_writer json = json_to(stdout);
    const int is_found = result->state == IRIS_LOCK_FOUND, exists = result->id > 0;
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, frame->file);
    json_key(&json, "frame");
    json_integer(&json, frame->number);
    value(&json, "x", is_found, result->box.x, 0);
    value(&json, "y", is_found, result->box.y, 0);
    value(&json, "w", is_found, result->box.w, 0);
    value(&json, "h", is_found, result->box.h, 0);
    value(&json, "cx", is_found, pixels(result->x_q16), 2);
    value(&json, "cy", is_found, pixels(result->y_q16), 2);
    value(&json, "area", is_found, result->area, 0);
    value(&json, "id", exists, result->id, 0);
    value(&json, "age", exists, result->age, 0);
    json_key(&json, "state");
    json_string(&json, is_found ? "found" : "lost");
    value(&json, "score", is_found, result->score_permil / 1000.0, 3);
    json_close(&json, '}');
}

void lock_report(const iris_lock_result *result, const lock_frame *frame, int json)
{
    if (json) {
        report_json(result, frame);
        return;
    }
    one_line(stdout, frame->file);
    if (result->state == IRIS_LOCK_FOUND) {
        printf("  found  at %.1f,%.1f  box %d,%d,%d,%d  area %d  id %d  age %d  score %.2f\n",
               pixels(result->x_q16), pixels(result->y_q16), (int)result->box.x, (int)result->box.y,
               (int)result->box.w, (int)result->box.h, (int)result->area, (int)result->id, (int)result->age,
               result->score_permil / 1000.0);
    } else if (result->state == IRIS_LOCK_COASTING) {
        printf("  lost   near %.1f,%.1f for %d  id %d  age %d\n", pixels(result->x_q16),
               pixels(result->y_q16), (int)result->missed, (int)result->id, (int)result->age);
    } else if (result->id > 0) {
        printf("  lost   for %d  id %d  age %d\n", (int)result->missed, (int)result->id, (int)result->age);
    } else {
        printf("  lost   nothing yet\n");
    }
    fflush(stdout);
}

/* ---- as a picture ---- */

static void lengthen(lock_trail *trail, const iris_lock_result *result)
{
    if (trail->id != result->id) {
        trail->count = 0;
        trail->id = result->id;
    }
    if (trail->count == LOCK_TRAIL) {
        memmove(trail->places, trail->places + 1, sizeof trail->places - sizeof trail->places[0]);
        trail->count--;
    }
    trail->places[trail->count++] = (canvas_point){pixels(result->x_q16), pixels(result->y_q16)};
}

int lock_overlay_write(const char *folder, const lock_frame *frame, const iris_lock_result *result,
                       lock_trail *trail)
{
    canvas c;
    char text[80];
    const canvas_point center = {pixels(result->x_q16), pixels(result->y_q16)};
    iris_status status = canvas_enlarge(&c, &enlarged, frame->image);
    if (status != IRIS_OK) {
        complain(frame->file, "%s", picture_problem(status, (iris_size){frame->image->w, frame->image->h}));
        return EXIT_BAD_DATA;
    }
    const int is_found = result->state == IRIS_LOCK_FOUND, is_lost = result->state == IRIS_LOCK_LOST;
    const iris_color color = is_found ? FOUND : is_lost ? LOST : COASTING;
    if (is_found) {
        lengthen(trail, result);
    }
    canvas_polygon(&c, trail->places, trail->count, 0, TRAIL);
    if (!is_lost) {
        canvas_rect(&c, result->box, color);
        canvas_cross(&c, center, 3, color);
    }
    snprintf(text, sizeof text, "%s  id %d  age %d",
             is_found  ? "found"
             : is_lost ? "lost"
                       : "predicted",
             (int)result->id, (int)result->age);
    canvas_text(&c, (canvas_point){1, 1}, color, text);
    return overlay_folder_write(folder, frame->file, frame->number, &c.image);
}

void lock_overlay_end(void)
{
    picture_free(&enlarged);
}
