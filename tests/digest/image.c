#include "digest.h"

static void row_bytes(void)
{
    for (int format = 0; format <= IRIS_HSL48 + 1; format++) {
        for (int32_t w = 0; w < 70; w++) {
            digest_number((int64_t)iris_format_row_bytes((iris_format)format, w));
        }
    }
}

static void crop(void)
{
    iris_image image = digest_picture(IRIS_BAYER8_RGGB, 40, 24);
    for (int32_t i = 0; i < 64; i++) {
        iris_rect rect = {i % 7, i % 5, 3 + i % 11, 2 + i % 13};
        iris_image part;
        digest_number(iris_image_crop(&part, &image, rect));
        digest_number(part.format);
        digest_view(&part);
    }
}

static void overlaps(void)
{
    iris_image image = digest_canvas(IRIS_GRAY8, 20, 20);
    for (int32_t i = 0; i < 256; i++) {
        iris_image a, b;
        (void)iris_image_crop(&a, &image, (iris_rect){digest_between(0, 9), i % 9, 1 + i % 10, 1 + i % 8});
        (void)iris_image_crop(&b, &image, (iris_rect){digest_between(0, 9), i % 7, 1 + i % 9, 1 + i % 5});
        digest_number(iris_image_overlaps(&a, &b));
    }
}

const digest_operation digest_image[] = {
    {"image.row_bytes", row_bytes},
    {"image.crop", crop},
    {"image.overlaps", overlaps},
    {NULL, NULL},
};
