#include "digest.h"

#include "iris/xt/equalize.h"
#include "iris/xt/histogram.h"
#include "iris/xt/tone.h"

#define W 41
#define H 29

static void curves(void)
{
    for (int32_t k = 0; k < 24; k++) {
        const iris_tone_segments segments = {digest_between(0, 100), digest_between(100, 255),
                                             digest_between(-90000, 90000), digest_between(0, 200000),
                                             9000 * k};
        iris_tone tone;
        digest_number(iris_tone_identity(&tone));
        digest_number(iris_tone_compress(&tone, IRIS_TONE_COMPRESS_C - 70000 * k));
        digest_number(iris_tone_gamma(&tone, 7000 + 9000 * k));
        digest_bytes(&tone, sizeof tone);
        digest_number(iris_tone_levels(&tone, 3 * k, 255 - 4 * k));
        digest_number(iris_tone_stretch(&tone, k == 0 ? NULL : &segments));
        digest_bytes(&tone, sizeof tone);
        digest_number(iris_tone_negate(&tone));
        digest_number(iris_tone_add(&tone, 10 * k - 100));
        digest_number(iris_tone_then(&tone, &tone));
        digest_bytes(&tone, sizeof tone);
    }
}

static void pictures(void)
{
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    for (int i = 0; i < 3; i++) {
        iris_image image = digest_picture(formats[i], W, H / 2);
        iris_tone tone, other;
        (void)iris_tone_identity(&tone);
        (void)iris_tone_identity(&other);
        (void)iris_tone_gamma(&tone, IRIS_Q16_ONE / 2);
        (void)iris_tone_negate(&other);
        digest_number(iris_tone_apply(&image, &image, &tone));
        digest_view(&image);
        digest_number(iris_tone_apply_rgb(&image, &image, &tone, &other, &tone));
        digest_view(&image);
        digest_number(iris_tone_apply_lightness(&image, &image, &other));
        digest_view(&image);
    }
}

static void adjust(void)
{
    iris_image image = digest_picture(IRIS_BGR888, W, H);
    for (int32_t k = 0; k < 9; k++) {
        iris_adjustment by = {5 * k, -3 * k, 10 - k, 50 * k - 100, 3 * k - 10, 7 - 2 * k};
        digest_number(iris_adjust(&image, &image, &by));
        digest_view(&image);
    }
}

static void digest_histogram_of(const iris_image *image, int32_t channel, const iris_image *mask)
{
    uint32_t *histogram = digest_take(1024);
    iris_histogram_statistics is = {0};
    digest_number(iris_histogram(histogram, image, channel, mask));
    for (int i = 0; i < 256; i++) {
        digest_number(histogram[i]);
    }
    digest_number(iris_histogram_measure(&is, histogram));
    digest_number(is.count);
    digest_number(is.min << 16 | is.median << 8 | is.max);
    digest_number(is.mean_q16);
    digest_number(is.variance_q16);
}

static void histogram(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image rgb = digest_picture(IRIS_RGB888, W, H / 2);
    iris_image mask = digest_picture(IRIS_MASK1, W, H);
    digest_histogram_of(&gray, 0, NULL);
    digest_histogram_of(&gray, 0, &mask);
    digest_histogram_of(&mask, 0, NULL);
    digest_histogram_of(&rgb, 1, NULL);
    digest_histogram_of(&rgb, IRIS_CHANNEL_LIGHTNESS, NULL);
}

static void extremes(void)
{
    iris_image image = digest_picture(IRIS_GRAY8, W, H);
    uint8_t darkest = 0, brightest = 0;
    digest_number(iris_histogram_extremes(&darkest, &brightest, &image));
    digest_number(darkest << 8 | brightest);
}

static void equalize(void)
{
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_RGB888};
    for (int i = 0; i < 2; i++) {
        iris_image image = digest_picture(formats[i], W, H / 2);
        iris_scratch scratch = digest_scratch(IRIS_EQUALIZE_SCRATCH_BYTES);
        digest_number(iris_equalize(&image, &image, &scratch));
        digest_view(&image);
    }
}

static void equalize_local(void)
{
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_BGR888};
    for (int32_t i = 0; i < 2; i++) {
        iris_image image = digest_picture(formats[i], W, H / 2);
        iris_equalize_local_config by = {2 + i, (2 - i) * IRIS_Q16_ONE};
        iris_scratch scratch = digest_scratch(IRIS_EQUALIZE_LOCAL_SCRATCH_BYTES(by.tiles));
        digest_number(iris_equalize_local(&image, &image, &by, &scratch));
        digest_view(&image);
    }
}

const digest_operation digest_tone[] = {
    {"tone.curves", curves},
    {"tone.pictures", pictures},
    {"tone.adjust", adjust},
    {"histogram.counts", histogram},
    {"histogram.extremes", extremes},
    {"equalize.whole", equalize},
    {"equalize.local", equalize_local},
    {NULL, NULL},
};
