#include "digest.h"

#include "iris/xt/hitmiss.h"
#include "iris/xt/morph.h"

#define W 45
#define H 20

typedef iris_status (*morph_call)(const iris_image *, const iris_image *, const iris_morph_element *,
                                  iris_border, iris_scratch *);

static void morph(iris_format format, morph_call call, int steps)
{
    static const iris_morph_element elements[] = {
        {3, 3, IRIS_MORPH_SQUARE, 0}, {4, 7, IRIS_MORPH_CROSS, 0}, {12, 2, IRIS_MORPH_SQUARE, 1}};
    iris_image picture = digest_picture(format, W, H);
    iris_image result = digest_canvas(format, W, H);
    uint8_t *memory = digest_take(2 * IRIS_MORPH_SCRATCH_BYTES(IRIS_GRAY8, W, 4, 7));
    for (int i = 0; i < 3; i++) {
        const iris_morph_element *element = &elements[i];
        iris_border border = {(iris_border_rule)i, 100};
        iris_scratch scratch;
        size_t bytes = IRIS_MORPH_SCRATCH_BYTES(format, W, element->w, element->h);
        digest_number(iris_scratch_init(&scratch, memory, (size_t)steps * bytes));
        digest_number(call(&result, &picture, element, border, &scratch));
        digest_view(&result);
    }
}

static void dilate(void)
{
    morph(IRIS_GRAY8, iris_morph_dilate, 1);
}

static void erode(void)
{
    morph(IRIS_GRAY8, iris_morph_erode, 1);
}

static void open_gray(void)
{
    morph(IRIS_GRAY8, iris_morph_open, 2);
}

static void gradient(void)
{
    morph(IRIS_GRAY8, iris_morph_gradient, 2);
}

static void tophat(void)
{
    morph(IRIS_GRAY8, iris_morph_tophat, 2);
}

static void dilate_mask(void)
{
    morph(IRIS_MASK1, iris_morph_dilate, 1);
}

static void close_mask(void)
{
    morph(IRIS_MASK1, iris_morph_close, 2);
}

static void blackhat_mask(void)
{
    morph(IRIS_MASK1, iris_morph_blackhat, 2);
}

static void hitmiss(void)
{
    static const char *const patterns[] = {"000/.1./111", "10", "1/1/0/1"};
    iris_image mask = digest_picture(IRIS_MASK1, W, H);
    iris_image result = digest_canvas(IRIS_MASK1, W, H);
    for (int i = 0; i < 3; i++) {
        iris_hitmiss_pattern pattern = {0};
        digest_number(iris_hitmiss_pattern_read(&pattern, patterns[i]));
        iris_scratch scratch = digest_scratch(IRIS_HITMISS_SCRATCH_BYTES(W, pattern.w, pattern.h));
        digest_number(
            iris_hitmiss_find(&result, &mask, &pattern, (iris_border){(iris_border_rule)i, 0}, &scratch));
        digest_view(&result);
    }
}

const digest_operation digest_morph[] = {
    {"morph.dilate", dilate},         {"morph.erode", erode},
    {"morph.open", open_gray},        {"morph.gradient", gradient},
    {"morph.tophat", tophat},         {"morph.dilate_mask", dilate_mask},
    {"morph.close_mask", close_mask}, {"morph.blackhat_mask", blackhat_mask},
    {"hitmiss.find", hitmiss},        {NULL, NULL},
};
