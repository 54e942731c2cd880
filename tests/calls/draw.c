/* Drawing. */
#include "iris/draw.h"

#include <string.h>

#include "calls.h"

static const iris_image *any_picture(void)
{
    return draw_output(draw_chance(3) ? IRIS_MASK1 : draw_gray_or_color(), draw_size());
}

static iris_color any_color(void)
{
    uint32_t bits = draw_below(1u << 24);
    return (iris_color){(uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16)};
}

static int32_t place(void)
{
    return draw_int(-40, 100);
}

static void line(void)
{
    const iris_image *image = any_picture();
    int32_t at[4] = {place(), place(), place(), place()};
    iris_color color = any_color();
    CALL(iris_draw_line(image, at[0], at[1], at[2], at[3], color));
}

static void rectangle(iris_status (*draw)(const iris_image *image, iris_rect rect, iris_color color))
{
    const iris_image *image = any_picture();
    iris_rect rect = {place(), place(), place(), place()};
    iris_color color = any_color();
    CALL(draw(image, rect, color));
}

static void rect(void)
{
    rectangle(iris_draw_rect);
}

static void rect_filled(void)
{
    rectangle(iris_draw_rect_filled);
}

static void circle(void)
{
    const iris_image *image = any_picture();
    int32_t x = place(), y = place(), radius = draw_int(0, draw_chance(20) ? IRIS_SIDE_MAX : 60);
    iris_color color = any_color();
    CALL(iris_draw_circle(image, x, y, radius, color));
}

static void cross(void)
{
    const iris_image *image = any_picture();
    int32_t x = place(), y = place(), arm = draw_int(0, 60);
    iris_color color = any_color();
    CALL(iris_draw_cross(image, x, y, arm, color));
}

static void text(void)
{
    char letters[12];
    const iris_image *image = any_picture();
    for (size_t i = 0; i < sizeof letters; i++) {
        letters[i] = (char)(draw_chance(8)   ? '\n'
                            : draw_chance(8) ? (int)draw_below(256)
                                             : draw_within(32, 126));
    }
    letters[sizeof letters - 1] = '\0';
    const char *given = OR_NULL(draw_given(letters, strlen(letters) + 1));
    int32_t x = place(), y = place(), scale = draw_int(1, draw_chance(4) ? IRIS_TEXT_SCALE_MAX : 4);
    iris_color color = any_color();
    CALL(iris_draw_text(image, x, y, given, scale, color));
}

const random_call calls_draw[] = {
    {"iris_draw_line", line},
    {"iris_draw_rect", rect},
    {"iris_draw_rect_filled", rect_filled},
    {"iris_draw_circle", circle},
    {"iris_draw_cross", cross},
    {"iris_draw_text", text},
    {NULL, NULL},
};
