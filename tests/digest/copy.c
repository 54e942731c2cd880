#include "digest.h"

#include "iris/copy.h"
#include "iris/turn.h"

static void resized(iris_status (*resize)(const iris_image *dst, const iris_image *src), iris_format format)
{
    static const iris_size sizes[] = {{20, 12}, {53, 31}, {7, 40}, {40, 1}};
    iris_image src = digest_picture(format, 33, 17);
    for (int i = 0; i < 4; i++) {
        iris_image dst = digest_canvas(format, sizes[i].w, sizes[i].h);
        digest_number(resize(&dst, &src));
        digest_view(&dst);
    }
}

static void resize_nearest_gray(void)
{
    resized(iris_resize_nearest, IRIS_GRAY8);
}

static void resize_bilinear_gray(void)
{
    resized(iris_resize_bilinear, IRIS_GRAY8);
}

static void resize_bilinear_rgb(void)
{
    static const iris_size size = {25, 20};
    iris_image src = digest_picture(IRIS_RGB888, 33, 17);
    iris_image dst = digest_canvas(IRIS_RGB888, size.w, size.h);
    digest_number(iris_resize_bilinear(&dst, &src));
    digest_view(&dst);
}

static void resize_area_gray(void)
{
    resized(iris_resize_area, IRIS_GRAY8);
}

static void resize_area_rgb(void)
{
    iris_image src = digest_picture(IRIS_RGB888, 33, 17);
    iris_image dst = digest_canvas(IRIS_RGB888, 14, 19);
    digest_number(iris_resize_area(&dst, &src));
    digest_view(&dst);
}

/* Every turning, and what can be done in place. */
static void turned(iris_format format, int32_t w, int32_t h)
{
    iris_image src = digest_picture(format, w, h);
    iris_image upright = digest_canvas(format, w, h);
    iris_image lying = digest_canvas(format, h, w);
    for (int how = IRIS_TURN_NONE; how <= IRIS_TRANSVERSE; how++) {
        const iris_image *dst = how < IRIS_TRANSPOSE ? &upright : &lying;
        digest_number(iris_turn(dst, &src, (iris_turning)how));
        digest_view(dst);
        digest_number(iris_turn(&src, &src, (iris_turning)how));
    }
    digest_view(&src);
}

static void turn_gray(void)
{
    turned(IRIS_GRAY8, 43, 36);
}

static void turn_mask(void)
{
    turned(IRIS_MASK1, 71, 40);
}

static void turn_rgb(void)
{
    turned(IRIS_RGB888, 35, 13);
}

static void turn_hsl48(void)
{
    turned(IRIS_HSL48, 11, 34);
}

static void paste(void)
{
    iris_image src = digest_picture(IRIS_RGB888, 15, 11);
    iris_image dst = digest_canvas(IRIS_RGB888, 40, 24);
    for (int i = 0; i < 40; i++) {
        int32_t x = digest_between(-20, 45);
        int32_t y = digest_between(-14, 28);
        digest_number(iris_paste(&dst, &src, x, y));
    }
    digest_view(&dst);
}

static void mask_copy(void)
{
    iris_image src = digest_picture(IRIS_MASK1, 100, 12);
    for (int i = 0; i < 40; i++) {
        iris_image dst = digest_canvas(IRIS_MASK1, 1 + i, 10);
        digest_number(iris_mask_copy(&dst, &src, digest_between(0, 60), i % 3));
        digest_view(&dst);
    }
}

static void channels(void)
{
    iris_image rgb = digest_picture(IRIS_RGB888, 30, 20);
    iris_image gray = digest_canvas(IRIS_GRAY8, 30, 20);
    for (int i = 0; i < 3; i++) {
        digest_number(iris_channel_extract(&gray, &rgb, i));
        digest_view(&gray);
        digest_number(iris_channel_insert(&rgb, &gray, (i + 1) % 3));
        digest_view(&rgb);
    }
}

static void fill(void)
{
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_GRAY_S16, IRIS_GRAY_U32,
                                          IRIS_MASK1, IRIS_RGB888,   IRIS_HSL48};
    for (int i = 0; i < 6; i++) {
        iris_image dst = digest_canvas(formats[i], 21, 7);
        digest_number(iris_fill(&dst, 1));
        digest_view(&dst);
    }
}

const digest_operation digest_copy[] = {
    {"copy.resize_nearest_gray", resize_nearest_gray},
    {"copy.resize_bilinear_gray", resize_bilinear_gray},
    {"copy.resize_bilinear_rgb", resize_bilinear_rgb},
    {"copy.resize_area_gray", resize_area_gray},
    {"copy.resize_area_rgb", resize_area_rgb},
    {"turn.gray", turn_gray},
    {"turn.mask", turn_mask},
    {"turn.rgb", turn_rgb},
    {"turn.hsl48", turn_hsl48},
    {"copy.paste", paste},
    {"copy.mask_copy", mask_copy},
    {"copy.channels", channels},
    {"copy.fill", fill},
    {NULL, NULL},
};
