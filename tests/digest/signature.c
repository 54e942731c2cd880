#include "digest.h"

#include "iris/xt/signature.h"

/* Teaching takes more working memory than there is here: tests/xt/signature.c is about it. */

#define W 46
#define H 13

static const iris_hsl_range ranges[] = {
    {340, 20, 20, 100, 10, 90}, {80, 160, 0, 100, 0, 60}, {0, 360, 0, 30, 40, 100}};

static iris_signatures *make_table(void)
{
    iris_signatures *table = (iris_signatures *)digest_take(sizeof *table);
    for (int32_t k = 0; k < 3; k++) {
        digest_number(iris_signature_from_range(table, 2 * k, &ranges[k]));
    }
    return table;
}

static void from_range(void)
{
    iris_signatures *table = make_table();
    digest_bytes(table->cells, sizeof table->cells);
    digest_number(iris_signature_clear(table, 2));
    digest_bytes(table->cells, sizeof table->cells);
}

static void classify(void)
{
    const iris_signatures *table = make_table();
    iris_image rgb = digest_picture(IRIS_RGB888, W, H), bits = digest_canvas(IRIS_GRAY8, W, H);
    digest_number(iris_signature_classify(&bits, &rgb, table));
    digest_view(&bits);
}

/* Noise is a picture of every kind. */
static void every_format(void)
{
    static const iris_format formats[] = {IRIS_GRAY8,       IRIS_BGR888, IRIS_RGBA8888, IRIS_RGB565,
                                          IRIS_RGB565_SWAP, IRIS_YUYV,   IRIS_UYVY};
    const iris_signatures *table = make_table();
    uint8_t *pixels = (uint8_t *)digest_take((size_t)4 * W);
    uint8_t *bits = (uint8_t *)digest_take(W);
    for (int32_t i = 0; i < 4 * W; i++) {
        pixels[i] = (uint8_t)digest_random();
    }
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        digest_number(iris_signature_row(bits, pixels, formats[i], W, table));
        digest_bytes(bits, W);
    }
}

static void mask(void)
{
    const iris_signatures *table = make_table();
    iris_image rgb = digest_picture(IRIS_RGB888, W, H), bits = digest_canvas(IRIS_MASK1, W, H);
    digest_number(iris_signature_mask(&bits, &rgb, table, 5));
    digest_view(&bits);
}

const digest_operation digest_signature[] = {
    {"signature.from_range", from_range},
    {"signature.classify", classify},
    {"signature.every_format", every_format},
    {"signature.mask", mask},
    {NULL, NULL},
};
