#include "smooth.h"

#include <math.h>

#include "iris/copy.h"

#define TIMES        3
#define PI           3.14159265358979323846
#define DISC_CORNERS 48

iris_status smooth_begin(smooth_picture *picture, iris_size size, iris_color background)
{
    const iris_size large = {size.w * TIMES, size.h * TIMES};
    iris_status status = picture_reserve(&picture->large, large, IRIS_RGB888);
    if (status == IRIS_OK) {
        status = picture_reserve(&picture->small, size, IRIS_RGB888);
    }
    if (status == IRIS_OK) {
        iris_draw_rect_filled(&picture->large.image, (iris_rect){0, 0, large.w, large.h}, background);
    }
    return status;
}

/* Where the middle of row y crosses the edges, from left to right. */
static int cross(double *at, const canvas_point *points, int count, double y)
{
    int crossings = 0;
    for (int i = 0; i < count; i++) {
        const canvas_point a = points[i], b = points[(i + 1) % count];
        if ((a.y <= y) == (b.y <= y)) {
            continue;
        }
        const double x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
        int k = crossings++;
        for (; k > 0 && at[k - 1] > x; k--) {
            at[k] = at[k - 1];
        }
        at[k] = x;
    }
    return crossings;
}

void smooth_polygon(const smooth_picture *picture, const canvas_point *points, int count, iris_color color)
{
    const iris_image *image = &picture->large.image;
    canvas_point large[SMOOTH_POINTS_MAX];
    double at[SMOOTH_POINTS_MAX], least = image->h, most = 0;
    count = count < SMOOTH_POINTS_MAX ? count : SMOOTH_POINTS_MAX;
    for (int i = 0; i < count; i++) {
        large[i] = (canvas_point){points[i].x * TIMES, points[i].y * TIMES};
        least = fmin(least, large[i].y);
        most = fmax(most, large[i].y);
    }
    const int32_t top = (int32_t)fmax(least, 0), bottom = (int32_t)fmin(most, image->h - 1);
    for (int32_t y = top; y <= bottom; y++) {
        const int crossings = cross(at, large, count, y + 0.5);
        for (int i = 0; i + 1 < crossings; i += 2) {
            const double left = fmax(ceil(at[i] - 0.5), 0), right = fmin(ceil(at[i + 1] - 0.5), image->w) - 1;
            if (left <= right) {
                iris_draw_line(image, (int32_t)left, y, (int32_t)right, y, color);
            }
        }
    }
}

void smooth_disc(const smooth_picture *picture, canvas_point center, double radius, iris_color color)
{
    canvas_point points[DISC_CORNERS];
    for (int i = 0; i < DISC_CORNERS; i++) {
        const double angle = 2 * PI * i / DISC_CORNERS;
        points[i] = (canvas_point){center.x + radius * cos(angle), center.y + radius * sin(angle)};
    }
    smooth_polygon(picture, points, DISC_CORNERS, color);
}

void smooth_stroke(const smooth_picture *picture, canvas_point from, canvas_point to, double width,
                   iris_color color)
{
    const double dx = to.x - from.x, dy = to.y - from.y, length = hypot(dx, dy);
    if (length > 0) {
        const double x = -dy / length * width / 2, y = dx / length * width / 2;
        const canvas_point side[4] = {
            {from.x + x, from.y + y}, {to.x + x, to.y + y}, {to.x - x, to.y - y}, {from.x - x, from.y - y}};
        smooth_polygon(picture, side, 4, color);
    }
    if (width > 1) {
        smooth_disc(picture, from, width / 2, color);
        smooth_disc(picture, to, width / 2, color);
    }
}

const iris_image *smooth_end(smooth_picture *picture)
{
    iris_resize_area(&picture->small.image, &picture->large.image);
    return &picture->small.image;
}

void smooth_free(smooth_picture *picture)
{
    picture_free(&picture->large);
    picture_free(&picture->small);
}
