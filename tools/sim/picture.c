#include "picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "iris/bmp.h"

iris_image sim_picture_make(int32_t w, int32_t h, iris_color color)
{
    iris_image image = {NULL, (ptrdiff_t)w * 3, w, h, IRIS_RGB888};
    image.data = malloc((size_t)w * (size_t)h * 3);
    if (image.data) {
        iris_draw_rect_filled(&image, (iris_rect){0, 0, w, h}, color);
    }
    return image;
}

static ptrdiff_t write_file(void *user, const uint8_t *data, size_t bytes)
{
    return (ptrdiff_t)fwrite(data, 1, bytes, user);
}

int sim_picture_save(const iris_image *picture, const char *folder, const char *name)
{
    char path[512];
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path) {
        return 0;
    }
    FILE *file = fopen(path, "wb");
    if (!file) {
        return 0;
    }
    iris_sink sink = {write_file, file};
    int good = iris_bmp_write(sink, picture) == IRIS_OK;
    return (fclose(file) == 0) & good;
}

static uint8_t mixed(uint8_t under, uint8_t over, double share)
{
    return (uint8_t)(under + (over - under) * share + 0.5);
}

void sim_picture_mix(const iris_image *picture, int x, int y, iris_color color, double share)
{
    if (x < 0 || y < 0 || x >= picture->w || y >= picture->h || share <= 0) {
        return;
    }
    uint8_t *pixel = (uint8_t *)iris_image_row(picture, y) + 3 * x;
    share = share > 1 ? 1 : share;
    pixel[0] = mixed(pixel[0], color.r, share);
    pixel[1] = mixed(pixel[1], color.g, share);
    pixel[2] = mixed(pixel[2], color.b, share);
}

void sim_picture_stroke(const iris_image *picture, const double from[2], const double to[2], double width,
                        iris_color color, double share)
{
    double dx = to[0] - from[0], dy = to[1] - from[1], square = dx * dx + dy * dy;
    double reach = width / 2 + 1;
    for (int y = (int)floor(fmin(from[1], to[1]) - reach); y <= fmax(from[1], to[1]) + reach; y++) {
        for (int x = (int)floor(fmin(from[0], to[0]) - reach); x <= fmax(from[0], to[0]) + reach; x++) {
            double t = square > 0 ? ((x - from[0]) * dx + (y - from[1]) * dy) / square : 0;
            t = t < 0 ? 0 : t > 1 ? 1 : t;
            double away = hypot(x - from[0] - t * dx, y - from[1] - t * dy);
            sim_picture_mix(picture, x, y, color, share * fmin(1, width / 2 + 0.5 - away));
        }
    }
}
