#include "canvas.h"

#include <math.h>
#include <string.h>

#include "iris/copy.h"

#define READABLE_W  320 /* pixels that the text needs */
#define ENLARGE_MAX 8
#define PLACE_MAX   1e8 /* far beyond any picture */

canvas canvas_plain(const iris_image *image)
{
    return (canvas){*image, 1};
}

iris_status canvas_enlarge(canvas *c, picture_buffer *buffer, const iris_image *frame)
{
    *c = canvas_plain(frame);
    while (frame->w * c->scale < READABLE_W && c->scale < ENLARGE_MAX) {
        c->scale++;
    }
    if (c->scale == 1) {
        return IRIS_OK;
    }
    iris_size size = {frame->w * c->scale, frame->h * c->scale};
    if (size.h > IRIS_SIDE_MAX) {
        c->scale = 1;
        return IRIS_OK;
    }
    iris_status status = picture_reserve(buffer, size, IRIS_RGB888);
    if (status == IRIS_OK) {
        c->image = buffer->image;
        iris_resize_nearest(&c->image, frame);
    }
    return status;
}

int32_t canvas_at(const canvas *c, double place)
{
    double at = place * c->scale + (c->scale - 1) / 2.0;
    return at > PLACE_MAX ? (int32_t)PLACE_MAX : at > -PLACE_MAX ? (int32_t)lround(at) : -(int32_t)PLACE_MAX;
}

int32_t canvas_stroke(const canvas *c)
{
    return c->image.w >= 2 * READABLE_W ? c->image.w / (2 * READABLE_W) : 1;
}

int32_t canvas_text_scale(const canvas *c)
{
    return c->image.w >= 2 * READABLE_W ? c->image.w / READABLE_W : 1;
}

void canvas_thick(const iris_image *image, const int32_t ends[4], int32_t reach, iris_color color)
{
    for (int32_t dy = -reach; dy <= reach; dy++) {
        for (int32_t dx = -reach; dx <= reach; dx++) {
            iris_draw_line(image, ends[0] + dx, ends[1] + dy, ends[2] + dx, ends[3] + dy, color);
        }
    }
}

/* Lines of a picture that is not enlarged are thin where it is small: what lies below is to be seen too. */
static int32_t thin(const canvas *c)
{
    return c->image.w < READABLE_W && c->scale == 1 ? 0 : canvas_stroke(c) / 2;
}

void canvas_line(const canvas *c, canvas_point from, canvas_point to, iris_color color)
{
    const int32_t ends[4] = {canvas_at(c, from.x), canvas_at(c, from.y), canvas_at(c, to.x),
                             canvas_at(c, to.y)};
    canvas_thick(&c->image, ends, thin(c), color);
}

void canvas_circle(const canvas *c, canvas_point center, double radius, iris_color color)
{
    int32_t x = canvas_at(c, center.x), y = canvas_at(c, center.y), reach = thin(c);
    for (int32_t d = -reach; d <= reach; d++) {
        double r = radius * c->scale + d;
        if (r >= 0 && r <= IRIS_SIDE_MAX) {
            iris_draw_circle(&c->image, x, y, (int32_t)lround(r), color);
        }
    }
}

void canvas_cross(const canvas *c, canvas_point center, double arm, iris_color color)
{
    canvas_line(c, (canvas_point){center.x - arm, center.y}, (canvas_point){center.x + arm, center.y}, color);
    canvas_line(c, (canvas_point){center.x, center.y - arm}, (canvas_point){center.x, center.y + arm}, color);
}

void canvas_rect(const canvas *c, iris_rect rect, iris_color color)
{
    const canvas_point corners[4] = {{rect.x, rect.y},
                                     {rect.x + (double)rect.w - 1, rect.y},
                                     {rect.x + (double)rect.w - 1, rect.y + (double)rect.h - 1},
                                     {rect.x, rect.y + (double)rect.h - 1}};
    canvas_polygon(c, corners, 4, 1, color);
}

void canvas_polygon(const canvas *c, const canvas_point *points, int count, int closed, iris_color color)
{
    for (int i = 1; i < count; i++) {
        canvas_line(c, points[i - 1], points[i], color);
    }
    if (closed && count > 1) {
        canvas_line(c, points[count - 1], points[0], color);
    }
}

void canvas_text(const canvas *c, canvas_point at, iris_color color, const char *text)
{
    static const iris_color outline = {0, 0, 0};
    int32_t x = canvas_at(c, at.x), y = canvas_at(c, at.y), scale = canvas_text_scale(c);
    for (int k = 0; k < 9; k++) {
        iris_draw_text(&c->image, x + (k % 3 - 1) * scale, y + (k / 3 - 1) * scale, text, scale, outline);
    }
    iris_draw_text(&c->image, x, y, text, scale, color);
}

iris_color canvas_color(int i)
{
    static const iris_color colors[] = {{0, 255, 90},  {255, 0, 200},  {0, 220, 255}, {255, 220, 0},
                                        {255, 90, 40}, {140, 90, 255}, {170, 255, 0}, {255, 150, 190}};
    return colors[(size_t)i % (sizeof colors / sizeof colors[0])];
}
