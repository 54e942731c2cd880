/* The course from above. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "picture.h"

enum { SCALE = 5, FOOT = 104, TEXT = 2 }; /* pixels per cm; height of the legend; size of text */

static const iris_color PAPER = {24, 27, 33};
static const iris_color INK = {236, 238, 242};
static const iris_color FAINT = {150, 156, 168};
static const iris_color BODY = {32, 110, 200};
static const iris_color TIRE = {28, 30, 36};

typedef struct {
    iris_image image;
    const sim_track *track;
} map;

/* Pixels of a place on the floor. */
static void to_pixels(double at[2], const map *m, double x, double y)
{
    at[0] = (x - m->track->left) * SCALE - 0.5;
    at[1] = (m->track->top - y) * SCALE - 0.5;
}

static uint8_t tone(double gray, double tint)
{
    double value = 255 * pow(fmin(gray, 255) / 255, 0.7) * tint; /* lifts the dark side of the course */
    return (uint8_t)(fmin(value, 255) + 0.5);
}

static void draw_floor(const map *m, const sim_floor *floor)
{
    for (int j = 0; j < m->image.h - FOOT; j++) {
        uint8_t *pixel = iris_image_row(&m->image, j);
        for (int i = 0; i < m->image.w; i++, pixel += 3) {
            double x = m->track->left + (i + 0.5) / SCALE, y = m->track->top - (j + 0.5) / SCALE;
            double gray = sim_floor_gray(floor, x, y, 1.0 / SCALE);
            double white = fmax(0, fmin(1, (gray - 200) / 55)); /* glare has no color */
            pixel[0] = tone(gray, 1.0);
            pixel[1] = tone(gray, 0.955 + 0.045 * white);
            pixel[2] = tone(gray, 0.87 + 0.13 * white);
        }
    }
}

/* Green on the line, yellow at half, red at the whole of what is allowed. */
static iris_color error_color(double share)
{
    static const double stop[3][3] = {{0, 205, 130}, {255, 200, 0}, {235, 35, 45}};
    double t = fmin(1, fabs(share)) * 2;
    int k = t >= 1;
    t -= k;
    return (iris_color){(uint8_t)(stop[k][0] + (stop[k + 1][0] - stop[k][0]) * t),
                        (uint8_t)(stop[k][1] + (stop[k + 1][1] - stop[k][1]) * t),
                        (uint8_t)(stop[k][2] + (stop[k + 1][2] - stop[k][2]) * t)};
}

static void draw_path(const map *m, const sim_record *record, double allowed)
{
    for (int pass = 0; pass < 2; pass++) { /* a dark rim, then the color */
        for (int i = 1; i < record->steps; i++) {
            double from[2], to[2];
            to_pixels(from, m, record->step[i - 1].x, record->step[i - 1].y);
            to_pixels(to, m, record->step[i].x, record->step[i].y);
            iris_color color = error_color(record->step[i].lateral_cm / allowed);
            sim_picture_stroke(&m->image, from, to, pass == 0 ? 5 : 3, pass == 0 ? TIRE : color,
                               pass == 0 ? 0.35 : 1);
        }
    }
}

/* A rounded box in the robot's own coordinates, cm: ahead and left of the reference point. */
static void draw_box(const map *m, sim_pose pose, const double low[2], const double high[2], iris_color color)
{
    double c = cos(pose.heading), s = sin(pose.heading), center[2];
    to_pixels(center, m, pose.x, pose.y);
    for (int j = (int)center[1] - 20 * SCALE; j <= center[1] + 20 * SCALE; j++) {
        for (int i = (int)center[0] - 20 * SCALE; i <= center[0] + 20 * SCALE; i++) {
            double x = (i - center[0]) / SCALE, y = (center[1] - j) / SCALE;
            double ahead = c * x + s * y, left = c * y - s * x, round = 0.8;
            double u = fmax(low[0] + round - ahead, ahead - high[0] + round);
            double v = fmax(low[1] + round - left, left - high[1] + round);
            double out = (u > 0 && v > 0 ? hypot(u, v) : fmax(u, v)) - round;
            sim_picture_mix(&m->image, i, j, color, 0.5 - out * SCALE);
        }
    }
}

static void draw_robot(const map *m, const sim_robot *robot, const sim_camera *camera)
{
    static const double image[5][2] = {
        {0, 0}, {SIM_W - 1, 0}, {SIM_W - 1, SIM_H - 1}, {0, SIM_H - 1}, {0, 0}};
    for (int k = 0; k < 4; k++) { /* what the camera sees */
        sim_pose a = sim_camera_floor(camera, robot->pose, image[k][0], image[k][1]);
        sim_pose b = sim_camera_floor(camera, robot->pose, image[k + 1][0], image[k + 1][1]);
        double from[2], to[2];
        to_pixels(from, m, a.x, a.y);
        to_pixels(to, m, b.x, b.y);
        sim_picture_stroke(&m->image, from, to, 2, BODY, 0.8);
    }
    double half = robot->width_cm / 2, wheel = robot->axle_cm / 2;
    draw_box(m, robot->pose, (double[]){-3.2, wheel - 1.3}, (double[]){3.2, half + 0.4}, TIRE);
    draw_box(m, robot->pose, (double[]){-3.2, -half - 0.4}, (double[]){3.2, 1.3 - wheel}, TIRE);
    draw_box(m, robot->pose, (double[]){-8, -half + 1.6}, (double[]){9, half - 1.6}, BODY);
    double lens = camera->forward_cm;
    draw_box(m, robot->pose, (double[]){lens - 1.6, -1.6}, (double[]){lens + 1.6, 1.6}, INK);
    draw_box(m, robot->pose, (double[]){-0.9, -0.9}, (double[]){0.9, 0.9}, TIRE); /* the reference point */
}

static void draw_label(const map *m, double x, double y, const char *text)
{
    double at[2];
    to_pixels(at, m, x, y);
    iris_size size = iris_draw_text_size(text, TEXT);
    for (int j = -4; j < size.h + 4; j++) {
        for (int i = -6; i < size.w + 6; i++) {
            sim_picture_mix(&m->image, (int)at[0] + i, (int)at[1] + j, PAPER, 0.72);
        }
    }
    iris_draw_text(&m->image, (int)at[0], (int)at[1], text, TEXT, INK);
}

static void draw_legend(const map *m, const sim_record *record, double allowed)
{
    char text[160];
    int top = m->image.h - FOOT, right = m->image.w - 345;
    iris_draw_rect_filled(&m->image, (iris_rect){0, top, m->image.w, FOOT}, PAPER);
    snprintf(text, sizeof text, "IRIS closed loop: %.2f laps, %d frames, by camera alone", record->laps,
             record->frames);
    iris_draw_text(&m->image, 20, top + 18, text, TEXT, INK);
    snprintf(text, sizeof text, "from the center line: rms %.1f cm, largest %.1f cm (allowed %.1f)",
             sqrt(record->mean_square), record->largest_cm, allowed);
    iris_draw_text(&m->image, 20, top + 46, text, TEXT, record->largest_cm < allowed ? INK : error_color(1));
    snprintf(text, sizeof text, "frames found %d, stale %d, lost %d%s%s", record->count[IRIS_LINE_FOUND],
             record->count[IRIS_LINE_STALE], record->count[IRIS_LINE_LOST], record->end ? " - " : "",
             record->end ? record->end : "");
    iris_draw_text(&m->image, 20, top + 74, text, TEXT, record->end ? error_color(1) : FAINT);
    for (int i = 0; i < 300; i++) {
        iris_draw_rect_filled(&m->image, (iris_rect){right + i, top + 18, 1, 14}, error_color(i / 299.0));
    }
    iris_draw_text(&m->image, right, top + 40, "0", TEXT, FAINT);
    snprintf(text, sizeof text, "%.0f cm", allowed);
    iris_draw_text(&m->image, right + 300 - iris_draw_text_size(text, TEXT).w, top + 40, text, TEXT, FAINT);
    iris_draw_text(&m->image, right + 60, top + 40, "off the line", TEXT, FAINT);
    iris_draw_rect_filled(&m->image, (iris_rect){right, top + 72, 50 * SCALE, 4}, INK);
    iris_draw_rect_filled(&m->image, (iris_rect){right, top + 66, 4, 16}, INK);
    iris_draw_rect_filled(&m->image, (iris_rect){right + 50 * SCALE - 4, top + 66, 4, 16}, INK);
    iris_draw_text(&m->image, right + 50 * SCALE + 8, top + 67, "50 cm", TEXT, INK);
}

int sim_map_save(const char *folder, const sim_record *record, const sim_floor *floor,
                 const sim_camera *camera, const sim_robot *start)
{
    const sim_track *track = floor->track;
    int32_t w = (int32_t)((track->right - track->left) * SCALE),
            h = (int32_t)((track->top - track->bottom) * SCALE);
    map m = {sim_picture_make(w, h + FOOT, PAPER), track};
    if (!m.image.data) {
        return 0;
    }
    draw_floor(&m, floor);
    draw_robot(&m, start, camera);
    draw_path(&m, record, start->width_cm / 2);
    for (int i = 0; i < SIM_MARKS; i++) {
        sim_pose at = sim_track_at(track, track->mark[i].s);
        draw_label(&m, at.x + track->mark[i].label_x, at.y + track->mark[i].label_y, track->mark[i].name);
    }
    draw_label(&m, start->pose.x - 8, start->pose.y - 14, "start");
    draw_legend(&m, record, start->width_cm / 2);
    int good = sim_picture_save(&m.image, folder, "track.bmp");
    free(m.image.data);
    return good;
}
