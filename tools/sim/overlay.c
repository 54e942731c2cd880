/* Camera frames with what the follower found in them and what the controller did about it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "picture.h"

static const iris_color PAPER = {24, 27, 33};
static const iris_color INK = {236, 238, 242};
static const iris_color FAINT = {150, 156, 168};
static const iris_color EDGE = {0, 220, 255};
static const iris_color NEAR = {255, 160, 0};
static const iris_color FAR = {255, 70, 160};
static const iris_color AHEAD = {120, 230, 80};

/* An enlarged frame: a view of the picture that ends at the frame's sides. */
typedef struct {
    iris_image view;
    int32_t scale;
} pane;

static void stroke(const pane *p, double x0, double y0, double x1, double y1, iris_color color)
{
    double from[2] = {(x0 + 0.5) * p->scale - 0.5, (y0 + 0.5) * p->scale - 0.5};
    double to[2] = {(x1 + 0.5) * p->scale - 0.5, (y1 + 0.5) * p->scale - 0.5};
    sim_picture_stroke(&p->view, from, to, 3, color, 0.95);
}

static void draw_gray(const pane *p, const sim_shot *shot)
{
    for (int32_t y = 0; y < SIM_H * p->scale; y++) {
        for (int32_t x = 0; x < SIM_W * p->scale; x++) {
            uint8_t gray = shot->gray[y / p->scale * SIM_W + x / p->scale];
            sim_picture_mix(&p->view, x, y, (iris_color){gray, gray, gray}, 1);
        }
    }
}

/* The column of an offset. */
static double column(iris_q16 offset_q16)
{
    return (SIM_W - 1) / 2.0 + offset_q16 / 65536.0 * (SIM_W / 2.0);
}

static void draw_line(const pane *p, const sim_shot *shot)
{
    const iris_follow_result *line = &shot->line;
    for (int32_t y = 0; y < SIM_H; y++) {
        iris_span span = shot->rows[y];
        if (span.left <= span.right) {
            int32_t top = y * p->scale;
            iris_draw_rect_filled(&p->view, (iris_rect){span.left * p->scale - 1, top, 2, p->scale - 1},
                                  EDGE);
            iris_draw_rect_filled(&p->view,
                                  (iris_rect){(span.right + 1) * p->scale - 1, top, 2, p->scale - 1}, EDGE);
        }
    }
    for (int32_t k = 0; k < line->segment_count; k++) {
        const iris_segment *s = &line->segments[k];
        stroke(p, s->x0, s->y0, s->x1, s->y1, k % 2 == 0 ? NEAR : FAR);
    }
    for (int32_t k = 0; k < line->segment_count; k++) {
        const iris_segment *s = &line->segments[k];
        iris_draw_circle(&p->view, s->x0 * p->scale, s->y0 * p->scale, 5, INK);
    }
    double row = (SIM_H - 1) / 3.0;
    for (int32_t x = 0; x < SIM_W; x += 6) {
        stroke(p, x, row, x + 1, row, AHEAD);
    }
    double at = column(line->lookahead_offset_q16);
    if (line->state != IRIS_LINE_LOST && at > 2 && at < SIM_W - 2) {
        iris_draw_circle(&p->view, (int32_t)(at * p->scale), (int32_t)(row * p->scale), 7, AHEAD);
        iris_draw_circle(&p->view, (int32_t)(at * p->scale), (int32_t)(row * p->scale), 8, AHEAD);
    }
}

/* A bar from the middle to the side it steers to. */
static void draw_gauge(const iris_image *view, int32_t y, const sim_shot *shot)
{
    int32_t middle = view->w / 2, half = middle - 10;
    int32_t reach = shot->command.steer_permil * half / 1000;
    iris_draw_rect(view, (iris_rect){middle - half, y, 2 * half, 10}, FAINT);
    iris_draw_rect_filled(view, (iris_rect){reach < 0 ? middle + reach : middle, y, abs(reach), 10}, NEAR);
    iris_draw_rect_filled(view, (iris_rect){middle - 1, y - 3, 2, 16}, INK);
}

static void draw_numbers(const iris_image *view, const sim_shot *shot)
{
    static const char *const state[] = {"LOST", "STALE", "FOUND"};
    const iris_follow_result *line = &shot->line;
    char text[120], next[24] = "";
    if (line->has_next) {
        snprintf(next, sizeof next, " then %+.0f", line->next_angle * 360.0 / 65536);
    }
    snprintf(text, sizeof text, "%.0f cm before: %s", shot->ahead_cm, shot->mark->name);
    iris_draw_text(view, 10, 8, text, 2, INK);
    snprintf(text, sizeof text, "%s %+.0f deg%s", state[shot->command.state], line->angle * 360.0 / 65536,
             next);
    iris_draw_text(view, 10, 30, text, 2, line->state == IRIS_LINE_FOUND ? AHEAD : FAR);
    snprintf(text, sizeof text, "offset %+.2f ahead %+.2f", line->offset_q16 / 65536.0,
             line->lookahead_offset_q16 / 65536.0);
    iris_draw_text(view, 10, 52, text, 2, FAINT);
    snprintf(text, sizeof text, "steer %+.2f speed %.2f", shot->command.steer_permil / 1000.0,
             shot->command.speed_permil / 1000.0);
    iris_draw_text(view, 10, 74, text, 2, NEAR);
    draw_gauge(view, 98, shot);
}

enum { NUMBERS = 118 }; /* height of the numbers below a frame */

/* Draws frame and numbers with their top left corner at (x, y), where the picture has room for them. */
static void draw_shot(const iris_image *picture, int32_t x, int32_t y, int32_t scale, const sim_shot *shot)
{
    pane p = {.scale = scale};
    iris_image numbers;
    iris_rect rect = {x, y, SIM_W * scale, SIM_H * scale};
    iris_rect below = {x, y + rect.h, rect.w, NUMBERS};
    if (iris_image_crop(&p.view, picture, rect) == IRIS_OK &&
        iris_image_crop(&numbers, picture, below) == IRIS_OK) {
        draw_gray(&p, shot);
        draw_line(&p, shot);
        draw_numbers(&numbers, shot);
    }
}

static int save_one(const char *folder, int number, const sim_shot *shot)
{
    enum { SCALE = 5 };
    char name[32];
    iris_image picture = sim_picture_make(SIM_W * SCALE, SIM_H * SCALE + NUMBERS, PAPER);
    if (!picture.data) {
        return 0;
    }
    draw_shot(&picture, 0, 0, SCALE, shot);
    snprintf(name, sizeof name, "frame-%d.bmp", number);
    int good = sim_picture_save(&picture, folder, name);
    free(picture.data);
    return good;
}

int sim_overlay_save(const char *folder, const sim_record *record)
{
    enum {
        SCALE = 3,
        COLUMNS = 4,
        GAP = 12,
        CELL_W = SIM_W * SCALE + GAP,
        CELL_H = SIM_H * SCALE + NUMBERS + GAP
    };
    iris_image sheet = sim_picture_make(COLUMNS * CELL_W + GAP, SIM_SHOTS / COLUMNS * CELL_H + GAP, PAPER);
    int good = sheet.data != NULL;
    for (int i = 0; i < SIM_SHOTS && good; i++) {
        if (record->shot[i].mark) {
            draw_shot(&sheet, GAP + i % COLUMNS * CELL_W, GAP + i / COLUMNS * CELL_H, SCALE,
                      &record->shot[i]);
            good = i % 2 == 0 || save_one(folder, i / 2 + 1, &record->shot[i]);
        }
    }
    good = good && sim_picture_save(&sheet, folder, "frames.bmp");
    free(sheet.data);
    return good;
}
