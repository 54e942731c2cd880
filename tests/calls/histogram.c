/* Histograms. */
#include "iris/xt/histogram.h"

#include "calls.h"

static iris_format counted_format(void)
{
    return draw_chance(3) ? draw_either(IRIS_MASK1, IRIS_HSL24) : draw_gray_or_color();
}

static void picture(void)
{
    iris_size size = draw_size();
    uint32_t *histogram = OR_NULL(draw_results(256 * sizeof *histogram));
    const iris_image *src = draw_input(counted_format(), size);
    const iris_image *mask = draw_chance(2) ? NULL : draw_input(IRIS_MASK1, size);
    int32_t channel = draw_chance(2) ? 0 : draw_int(IRIS_CHANNEL_LIGHTNESS, 2);
    CALL(iris_histogram(histogram, src, channel, mask));
}

static void row(void)
{
    iris_format format = counted_format();
    int32_t n = draw_within(1, 70), count = draw_chance(20) ? draw_within(-1, 0) : n;
    uint32_t *histogram = OR_NULL(draw_results(256 * sizeof *histogram));
    const void *pixels = OR_NULL(draw_given(NULL, iris_format_row_bytes(format, n)));
    const uint32_t *mask = draw_chance(2) ? NULL : draw_given(NULL, iris_format_row_bytes(IRIS_MASK1, n));
    int32_t channel = draw_chance(2) ? 0 : draw_int(IRIS_CHANNEL_LIGHTNESS, 2);
    CALL(iris_histogram_row(histogram, pixels, format, channel, count, mask));
}

static const uint32_t *any_histogram(void)
{
    uint32_t histogram[256] = {0};
    uint32_t sparse = 1 + draw_below(100), most = draw_chance(10) ? UINT32_MAX : 1 + draw_below(5000000);
    for (int i = 0; i < 256 && !draw_chance(200); i++) {
        histogram[i] = draw_chance(sparse) ? draw_below(most) : 0;
    }
    return OR_NULL(draw_given(histogram, sizeof histogram));
}

static void measure(void)
{
    iris_histogram_statistics *statistics = OR_NULL(draw_results(sizeof *statistics));
    const uint32_t *histogram = any_histogram();
    CALL(iris_histogram_measure(statistics, histogram));
}

static void percentile(void)
{
    uint8_t *level = OR_NULL(draw_results(1));
    const uint32_t *histogram = any_histogram();
    iris_q16 share = draw_int(0, IRIS_Q16_ONE);
    CALL(iris_histogram_percentile(level, histogram, share));
}

static void extremes(void)
{
    uint8_t *darkest = OR_NULL(draw_results(1)), *brightest = OR_NULL(draw_results(1));
    const iris_image *src = draw_input(counted_format(), draw_size());
    CALL(iris_histogram_extremes(darkest, brightest, src));
}

const random_call calls_histogram[] = {
    {"iris_histogram", picture},           {"iris_histogram_row", row},
    {"iris_histogram_measure", measure},   {"iris_histogram_percentile", percentile},
    {"iris_histogram_extremes", extremes}, {NULL, NULL},
};
