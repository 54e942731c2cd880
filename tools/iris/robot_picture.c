#include "robot_picture.h"

#include <math.h>
#include <stdio.h>

#include "canvas.h"
#include "complain.h"
#include "iris/copy.h"
#include "picture_write.h"

enum {
    SIDE = 720,
    SEEN_MM = 900
}; /* the picture's side, and how much further than the body it shows of long reaches */

static const double turn = 6.28318530717958648;

typedef struct {
    canvas c;
    double scale; /* pixels to a mm */
    double ahead; /* mm: what the picture's middle shows */
} drawing;

static const iris_color ink = {40, 40, 40}, body_color = {120, 120, 120}, wheel_color = {0, 0, 0};
static const iris_color scale_color = {255, 255, 255};

/* Ahead is up, left is left. */
static canvas_point at(const drawing *d, double x, double y)
{
    return (canvas_point){SIDE / 2.0 - y * d->scale, SIDE / 2.0 - (x - d->ahead) * d->scale};
}

static void line(const drawing *d, const double ends[4], iris_color color)
{
    canvas_line(&d->c, at(d, ends[0], ends[1]), at(d, ends[2], ends[3]), color);
}

static void rectangle(const drawing *d, const double middle[3], double length, double width, iris_color color)
{
    canvas_point corners[4];
    const double c = cos(middle[2]), s = sin(middle[2]);
    for (int i = 0; i < 4; i++) {
        const double x = (i == 0 || i == 3 ? length : -length) / 2, y = (i < 2 ? width : -width) / 2;
        corners[i] = at(d, middle[0] + x * c - y * s, middle[1] + x * s + y * c);
    }
    canvas_polygon(&d->c, corners, 4, 1, color);
}

static void draw_wheels(const drawing *d, const osiris_drive_config *drive)
{
    const double half = drive->track_mm / 2.0,
                 size = drive->kind == OSIRIS_OMNI ? drive->radius_mm * 0.5 : half * 0.8;
    if (drive->kind == OSIRIS_OMNI) {
        for (int i = 0; i < drive->wheels; i++) {
            const double a = (2 * i + 1) * turn / 2 / drive->wheels;
            const double middle[3] = {drive->radius_mm * cos(a), drive->radius_mm * sin(a), a + turn / 4};
            rectangle(d, middle, size, size / 3, wheel_color);
        }
        return;
    }
    for (int i = 0; i < (drive->kind == OSIRIS_ACKERMANN ? 4 : 2); i++) {
        const double middle[3] = {i < 2 ? 0 : drive->wheelbase_mm, i % 2 ? half : -half, i < 2 ? 0 : -0.2};
        rectangle(d, middle, size, size / 3, wheel_color);
    }
}

/* What it sees: a cone up to its reach, or what a line sensor crosses. */
static void draw_device(const drawing *d, const osiris_device *device, int index, double most)
{
    const iris_color color = canvas_color(index);
    const double x = device->place.x_mm, y = device->place.y_mm,
                 looks = device->place.heading / 65536.0 * turn;
    canvas_circle(&d->c, at(d, x, y), 4, color);
    if (device->kind == OSIRIS_LINE) {
        const double across[4] = {x - device->most * sin(looks), y + device->most * cos(looks),
                                  x + device->most * sin(looks), y - device->most * cos(looks)};
        line(d, across, color);
    } else if (device->kind == OSIRIS_CAMERA || device->kind == OSIRIS_RANGE || device->kind == OSIRIS_BUMP) {
        const double reach = device->kind == OSIRIS_BUMP ? 40 : fmin(device->most, most);
        const double half = device->width / 65536.0 * turn / 2;
        canvas_point fan[32];
        int count = 0;
        fan[count++] = at(d, x, y);
        for (int i = 0; i <= 24; i++) {
            const double a = looks - half + i * half / 12;
            fan[count++] = at(d, x + reach * cos(a), y + reach * sin(a));
        }
        canvas_polygon(&d->c, fan, count, 1, color);
    }
}

static void draw_names(const drawing *d, const osiris_plan *plan)
{
    int row = 0;
    char text[80];
    for (int32_t i = 0; i < plan->device_count; i++) {
        const osiris_device *device = &plan->devices[i];
        snprintf(text, sizeof text, "%s %s", osiris_kind_name(device->kind), device->name);
        canvas_text(&d->c, (canvas_point){4, 4.0 + 18 * row++}, canvas_color((int)i), text);
    }
    snprintf(text, sizeof text, "%d mm", 100);
    canvas_text(&d->c, (canvas_point){SIDE - 110, SIDE - 24}, scale_color, text);
    canvas_line(&d->c, (canvas_point){SIDE - 20 - 100 * d->scale, SIDE - 6},
                (canvas_point){SIDE - 20, SIDE - 6}, ink);
}

int robot_picture_write(const char *path, const osiris_plan *plan)
{
    static uint8_t pixels[SIDE * SIDE * 3];
    iris_image image;
    const double half = fmax(plan->length_mm, plan->width_mm) / 2.0, most = SEEN_MM;
    const double middle[3] = {plan->ahead_mm, 0, 0};
    if (iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){SIDE, SIDE}, SIDE * 3, IRIS_RGB888) !=
            IRIS_OK ||
        iris_fill(&image, 0xF4F4F4) != IRIS_OK) {
        complain(path, "no picture");
        return 0;
    }
    double reach = half + 60;
    for (int32_t i = 0; i < plan->device_count; i++) {
        const osiris_device *d = &plan->devices[i];
        if (d->kind == OSIRIS_CAMERA || d->kind == OSIRIS_RANGE) {
            reach = fmax(reach, half + fmin(d->most, most));
        }
    }
    const drawing d = {canvas_plain(&image), SIDE / 2.0 / (reach + 20), plan->ahead_mm};
    const double nose[4] = {plan->ahead_mm + plan->length_mm / 2.0, 0,
                            plan->ahead_mm + plan->length_mm / 2.0 - half / 2, 0};
    rectangle(&d, middle, plan->length_mm, plan->width_mm, body_color);
    line(&d, nose, body_color);
    draw_wheels(&d, &plan->drive);
    canvas_cross(&d.c, at(&d, 0, 0), 6, ink);
    for (int32_t i = 0; i < plan->device_count; i++) {
        draw_device(&d, &plan->devices[i], (int)i, most);
    }
    draw_names(&d, plan);
    return picture_write(path, &image);
}
