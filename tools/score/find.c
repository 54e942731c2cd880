#include "find.h"

#include <math.h>
#include <stdlib.h>

#include "iris/draw.h"
#include "picture.h"

found find_line(const iris_image *frame, const iris_follow_config *config)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_FULL_SCRATCH_BYTES(640, 480));
    static iris_follow follow;
    iris_scratch scratch;
    iris_steer steer;
    iris_command command;
    found result = {0};
    if (iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) != IRIS_OK ||
        iris_follow_init_full(&follow, (iris_size){frame->w, frame->h}, config, &scratch) != IRIS_OK ||
        iris_follow_frame(&result.line, &follow, frame, 0) != IRIS_OK ||
        iris_steer_init(&steer, NULL) != IRIS_OK ||
        iris_steer_update(&command, &steer, &result.line, 0) != IRIS_OK) {
        fprintf(stderr, "iris-score: the library refuses a frame of %dx%d\n", (int)frame->w, (int)frame->h);
        return (found){0};
    }
    result.steer_deg = iris_steer_wheel_centideg(&steer, &command) / 100.0;
    return result;
}

double segment_distance(const iris_segment *segment, double x, double y)
{
    double dx = segment->x1 - segment->x0, dy = segment->y1 - segment->y0;
    double length = dx * dx + dy * dy;
    double at = length > 0 ? ((x - segment->x0) * dx + (y - segment->y0) * dy) / length : 0;
    at = at < 0 ? 0 : at > 1 ? 1 : at;
    return hypot(x - segment->x0 - at * dx, y - segment->y0 - at * dy);
}

double extended_distance(const iris_segment *segment, double x, double y)
{
    double dx = segment->x1 - segment->x0, dy = segment->y1 - segment->y0;
    double length = hypot(dx, dy);
    return length > 0 ? fabs((x - segment->x0) * dy - (y - segment->y0) * dx) / length
                      : segment_distance(segment, x, y);
}

void save_found(const score *s, const char *name, const iris_image *frame, const found *result,
                double (*at)[2], int points)
{
    static const char *const STATES[] = {"lost", "stale", "found"};
    const iris_color red = {255, 0, 0}, green = {0, 255, 0}, yellow = {255, 255, 0}, white = {255, 255, 255};
    const iris_follow_result *line = &result->line;
    char text[96];
    iris_image picture = picture_make(frame->w, frame->h, IRIS_RGB888);
    if (!s->pictures || !picture.data) {
        free(picture.data);
        return;
    }
    iris_color_convert(&picture, frame);
    for (int y = 0; line->rows && y < frame->h; y++) {
        if (line->rows[y].left <= line->rows[y].right) {
            iris_draw_rect(&picture, (iris_rect){line->rows[y].left, y, 1, 1}, red);
            iris_draw_rect(&picture, (iris_rect){line->rows[y].right, y, 1, 1}, red);
        }
    }
    for (int i = 0; i < line->segment_count; i++) {
        const iris_segment *part = &line->segments[i];
        iris_draw_line(&picture, part->x0, part->y0, part->x1, part->y1, i % 2 ? yellow : green);
        iris_draw_cross(&picture, part->x0, part->y0, 2, i % 2 ? yellow : green);
    }
    for (int i = 0; i < points; i++) {
        iris_draw_cross(&picture, (int32_t)lrint(at[i][0]), (int32_t)lrint(at[i][1]), 4, white);
    }
    snprintf(text, sizeof text, "%s angle %d offset %.2f %.2f\nwidth %d conf %d steer %.1f",
             STATES[line->state], (int)iris_angle_to_degrees(line->angle), line->offset_q16 / 65536.0,
             line->lookahead_offset_q16 / 65536.0, (int)line->width_px, (int)line->confidence_permil,
             result->steer_deg);
    iris_draw_text(&picture, 3, 3, text, 1, red);
    if (!picture_save(&picture, s->pictures, name)) {
        fprintf(stderr, "iris-score: %s/%s: cannot write this picture\n", s->pictures, name);
    }
    free(picture.data);
}
