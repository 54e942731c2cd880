/* Color signatures. */
#include "iris/xt/signature.h"

#include "calls.h"

static iris_format camera_format(void)
{
    static const iris_format formats[] = {IRIS_GRAY8,  IRIS_RGB888,      IRIS_BGR888, IRIS_RGBA8888,
                                          IRIS_RGB565, IRIS_RGB565_SWAP, IRIS_YUYV,   IRIS_UYVY};
    return draw_chance(20) ? draw_format() : formats[draw_below(8)];
}

static iris_size size_for(iris_format format)
{
    iris_size size = draw_size();
    if (format == IRIS_YUYV || format == IRIS_UYVY) {
        size.w += size.w % 2;
    }
    return size;
}

static int32_t any_signature(void)
{
    return draw_int(0, 7);
}

static const iris_signatures *any_table(void)
{
    return OR_NULL(draw_given(NULL, sizeof(iris_signatures)));
}

static void clear(void)
{
    iris_signatures *table = OR_NULL(draw_results(sizeof *table));
    int32_t which = any_signature();
    CALL(iris_signature_clear(table, which));
}

static void from_range(void)
{
    iris_signatures *table = OR_NULL(draw_results(sizeof *table));
    int32_t s0 = draw_int(0, 100), l0 = draw_int(0, 100);
    int32_t s1 = draw_chance(20) ? -1 : s0 < 100 ? draw_within(s0, 100) : 100;
    int32_t l1 = l0 < 100 ? draw_within(l0, 100) : 100;
    iris_hsl_range range = {draw_int(0, 360), draw_int(0, 360), s0, s1, l0, l1};
    const iris_hsl_range *given = OR_NULL(draw_given(&range, sizeof range));
    int32_t which = any_signature();
    CALL(iris_signature_from_range(table, which, given));
}

static void teach(void)
{
    iris_format format = camera_format();
    iris_size size = size_for(format);
    iris_signature_lesson *lesson = OR_NULL(draw_results(sizeof *lesson));
    iris_signatures *table = OR_NULL(draw_results(sizeof *table));
    const iris_image *image = draw_input(format, size);
    iris_rect rect = {draw_int(0, size.w / 2), draw_int(0, size.h / 2), draw_int(1, size.w / 2 + 1),
                      draw_int(1, size.h / 2 + 1)};
    iris_scratch *scratch = draw_scratch(IRIS_SIGNATURE_SCRATCH_BYTES);
    int32_t which = any_signature();
    CALL(iris_signature_teach(lesson, table, which, image, rect, scratch));
}

static void classify(void)
{
    iris_format format = camera_format();
    iris_size size = size_for(format);
    const iris_image *dst = draw_output(IRIS_GRAY8, size);
    const iris_image *src = draw_input(format, size);
    const iris_signatures *table = any_table();
    CALL(iris_signature_classify(dst, src, table));
}

static void mask(void)
{
    iris_format format = camera_format();
    iris_size size = size_for(format);
    const iris_image *dst = draw_output(IRIS_MASK1, size);
    const iris_image *src = draw_input(format, size);
    const iris_signatures *table = any_table();
    uint32_t selected = (uint32_t)draw_int(0, 255);
    CALL(iris_signature_mask(dst, src, table, selected));
}

static void row(void)
{
    iris_format format = camera_format();
    int32_t n = size_for(format).w;
    size_t bytes = iris_format_row_bytes(format, n) + 1;
    uint8_t *dst = OR_NULL(draw_results((size_t)n + 1));
    const uint8_t *src = OR_NULL(draw_chance(30) ? dst : draw_given(NULL, bytes));
    const iris_signatures *table = any_table();
    CALL(iris_signature_row(dst, src, format, n, table));
}

const random_call calls_signature[] = {
    {"iris_signature_clear", clear},
    {"iris_signature_from_range", from_range},
    {"iris_signature_teach", teach},
    {"iris_signature_classify", classify},
    {"iris_signature_mask", mask},
    {"iris_signature_row", row},
    {NULL, NULL},
};
