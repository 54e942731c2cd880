#include "follow_overlay.h"

#include <math.h>
#include <stdio.h>

#include "canvas.h"
#include "complain.h"
#include "overlay_folder.h"

static const iris_color EDGE = {0, 255, 90};
static const iris_color SEGMENT = {255, 0, 200};
static const iris_color ARROW = {0, 220, 255};
static const iris_color OUTLINE = {0, 0, 0};
static const iris_color TEXT = {255, 255, 255};

/* The enlarged frame, kept for the next one. */
static picture_buffer enlarged;

/* In pixels of the canvas. */
static void draw_segment(const canvas *c, const iris_segment *s, int32_t reach, iris_color color)
{
    canvas_thick(&c->image, (const int32_t[4]){s->x0, s->y0, s->x1, s->y1}, reach, color);
}

/* The edges row by row, joined where the next row has the line too. */
static void draw_edges(const canvas *c, const follow_answer *answer)
{
    int32_t reach = canvas_stroke(c) / 2;
    iris_span above = {1, 0};
    for (int32_t y = 0; y < answer->size.h; y++) {
        iris_span span = follow_row(answer, y);
        iris_span from = above.left <= above.right ? above : span;
        if (span.left <= span.right) {
            int32_t y0 = canvas_at(c, above.left <= above.right ? y - 1 : y), y1 = canvas_at(c, y);
            iris_segment left = {canvas_at(c, from.left), y0, canvas_at(c, span.left), y1};
            iris_segment right = {canvas_at(c, from.right), y0, canvas_at(c, span.right), y1};
            draw_segment(c, &left, reach, EDGE);
            draw_segment(c, &right, reach, EDGE);
        }
        above = span;
    }
}

static void draw_segments(const canvas *c, const iris_follow_result *line)
{
    int32_t reach = canvas_stroke(c);
    for (int32_t i = 0; i < line->segment_count; i++) {
        const iris_segment *s = &line->segments[i];
        iris_segment drawn = {canvas_at(c, s->x0), canvas_at(c, s->y0), canvas_at(c, s->x1),
                              canvas_at(c, s->y1)};
        draw_segment(c, &drawn, reach, SEGMENT);
    }
    for (int32_t i = 0; i < line->segment_count; i++) {
        int32_t x = canvas_at(c, line->segments[i].x0), y = canvas_at(c, line->segments[i].y0),
                side = 2 * reach + 1;
        iris_draw_rect_filled(&c->image, (iris_rect){x - side, y - side, 2 * side + 1, 2 * side + 1},
                              OUTLINE);
        iris_draw_rect_filled(&c->image, (iris_rect){x - side + 1, y - side + 1, 2 * side - 1, 2 * side - 1},
                              SEGMENT);
    }
}

/* From where the line meets the bottom row (or a little above, to be seen as a whole), along its direction there. */
static void draw_arrow(const canvas *c, const follow_answer *answer)
{
    const iris_follow_result *line = &answer->line;
    const double turn = 6.283185307179586;
    double angle = line->angle / 65536.0 * turn;
    double length = c->image.h / 4.0;
    double column = (answer->size.w - 1) / 2.0 + line->offset_q16 / 65536.0 * answer->size.w / 2.0;
    int lies_across = cos(angle) < 0.35;
    column = column < 0 ? 0 : column > answer->size.w - 1 ? answer->size.w - 1 : column;
    int32_t x = canvas_at(c, (int32_t)lround(column)),
            y = c->image.h - 1 - (lies_across ? (int32_t)length / 4 : 0);
    int32_t tip_x = x + (int32_t)lround(length * sin(angle)),
            tip_y = y - (int32_t)lround(length * cos(angle));
    for (int32_t k = 0; k < 2; k++) { /* the outline, then the arrow */
        int32_t reach = canvas_stroke(c) + 1 - k;
        iris_color color = k == 0 ? OUTLINE : ARROW;
        draw_segment(c, &(iris_segment){x, y, tip_x, tip_y}, reach, color);
        for (int side = -1; side <= 1; side += 2) {
            double back = angle + side * turn * 0.42;
            iris_segment barb = {tip_x, tip_y, tip_x + (int32_t)lround(length / 3 * sin(back)),
                                 tip_y - (int32_t)lround(length / 3 * cos(back))};
            draw_segment(c, &barb, reach, color);
        }
    }
}

/* A quarter of the light stays: what is below the text can still be seen. */
static void darken(const iris_image *image, int32_t rows)
{
    for (int32_t y = 0; y < rows && y < image->h; y++) {
        uint8_t *row = iris_image_row(image, y);
        for (int32_t i = 0; i < 3 * image->w; i++) {
            row[i] = (uint8_t)(row[i] / 4);
        }
    }
}

static iris_color state_color(iris_line_state state)
{
    static const iris_color found = {90, 255, 120}, stale = {255, 220, 60}, lost = {255, 90, 80};
    return state == IRIS_LINE_FOUND ? found : state == IRIS_LINE_STALE ? stale : lost;
}

static void draw_numbers(const canvas *c, const follow_answer *answer)
{
    const iris_follow_result *line = &answer->line;
    int32_t scale = canvas_text_scale(c);
    int32_t cell_w = IRIS_TEXT_CELL_W * scale, cell_h = IRIS_TEXT_CELL_H * scale, edge = 3 * scale;
    char first[80], second[80], next[16] = "";
    if (line->has_next) {
        snprintf(next, sizeof next, "  next %+.0f", iris_angle_to_centidegrees(line->next_angle) / 100.0);
    }
    snprintf(first, sizeof first, "angle %+.1f%s  offset %+.2f",
             iris_angle_to_centidegrees(line->angle) / 100.0, next, line->offset_q16 / 65536.0);
    snprintf(second, sizeof second, "steer %+.2f (%+.1f deg)  speed %.2f",
             answer->command.steer_permil / 1000.0, answer->wheel_centideg / 100.0,
             answer->command.speed_permil / 1000.0);
    darken(&c->image, 3 * edge + 2 * cell_h);
    iris_draw_text(&c->image, edge, edge, follow_state_name(line->state), scale, state_color(line->state));
    if (line->state != IRIS_LINE_LOST) {
        iris_draw_text(&c->image, edge + 7 * cell_w, edge, first, scale, TEXT);
    }
    iris_draw_text(&c->image, edge + 7 * cell_w, 2 * edge + cell_h, second, scale, TEXT);
}

int follow_overlay_write(const char *folder, const iris_image *frame, const follow_answer *answer)
{
    canvas c;
    iris_status status = canvas_enlarge(&c, &enlarged, frame);
    if (status != IRIS_OK) {
        complain(answer->file, "%s", picture_problem(status, answer->size));
        return EXIT_BAD_DATA;
    }
    draw_edges(&c, answer);
    if (answer->line.state != IRIS_LINE_LOST) {
        draw_segments(&c, &answer->line);
        draw_arrow(&c, answer);
    }
    follow_junctions_draw(&c, &answer->junctions);
    draw_numbers(&c, answer);
    return overlay_folder_write(folder, answer->file, answer->frame, &c.image);
}

void follow_overlay_end(void)
{
    picture_free(&enlarged);
}
