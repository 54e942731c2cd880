#include "digest.h"

#include "iris/draw.h"

static void figures(iris_format format)
{
    iris_image image = digest_canvas(format, 48, 40);
    for (int i = 0; i < 24; i++) {
        int32_t x = digest_between(-20, 70);
        int32_t y = digest_between(-20, 60);
        uint32_t bits = digest_random();
        iris_color color = {(uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16)};
        digest_number(iris_draw_line(&image, x, y, 60 - 2 * y, x, color));
        digest_number(iris_draw_rect(&image, (iris_rect){y, x, x / 2, y / 2}, color));
        digest_number(iris_draw_rect_filled(&image, (iris_rect){x, y, 5, 3}, color));
        digest_number(iris_draw_circle(&image, y, x, i, color));
        digest_number(iris_draw_cross(&image, x, y, i % 6, color));
        digest_number(iris_draw_text(&image, x, y, "Iris 3.14\n|?", 1 + i % 2, color));
    }
    digest_view(&image);
}

static void gray(void)
{
    figures(IRIS_GRAY8);
}

static void rgb(void)
{
    figures(IRIS_RGB888);
}

static void mask(void)
{
    figures(IRIS_MASK1);
}

const digest_operation digest_draw[] = {
    {"draw.gray8", gray},
    {"draw.rgb888", rgb},
    {"draw.mask1", mask},
    {NULL, NULL},
};
