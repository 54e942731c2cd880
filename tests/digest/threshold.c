#include "digest.h"

#include "iris/xt/regress.h"
#include "iris/xt/threshold.h"

#define W 61
#define H 40

static void fixed(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    for (int value = 0; value < 256; value += 17) {
        digest_number(
            iris_threshold(&mask, &gray, (uint8_t)value, value % 2 ? IRIS_SELECT_DARK : IRIS_SELECT_BRIGHT));
        digest_view(&mask);
    }
}

static void otsu(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    iris_scratch scratch = digest_scratch(IRIS_THRESHOLD_OTSU_SCRATCH_BYTES);
    uint8_t value = 0;
    digest_number(iris_threshold_otsu(&value, &mask, &gray, IRIS_SELECT_DARK, &scratch));
    digest_number(value);
    digest_view(&mask);
}

static void adaptive(void)
{
    static const int32_t radius[] = {0, 1, 7, 100};
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    for (int i = 0; i < 4; i++) {
        iris_scratch scratch = digest_scratch(IRIS_THRESHOLD_SCRATCH_BYTES(W, radius[i]));
        digest_number(
            iris_threshold_adaptive(&mask, &gray, radius[i], 20 * i - 15, IRIS_SELECT_DARK, &scratch));
        digest_view(&mask);
    }
}

static void digest_line(const iris_line *line)
{
    digest_number(line->x_q16);
    digest_number(line->y_q16);
    digest_number(line->angle);
    digest_number(line->dx);
    digest_number(line->dy);
    digest_number(line->points);
}

static void regress_mask(void)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    for (int value = 20; value < 240; value += 20) {
        iris_line line = {0};
        (void)iris_threshold(&mask, &gray, (uint8_t)value, IRIS_SELECT_DARK);
        digest_number(iris_regress_mask(&line, &mask));
        digest_line(&line);
    }
}

static void regress_rows(void)
{
    int16_t *twice_x = digest_take(2 * H);
    for (int slope = -9; slope <= 9; slope++) {
        for (int32_t y = 0; y < H; y++) {
            int32_t x = 100 + slope * y + digest_between(-3, 3);
            twice_x[y] = (int16_t)(y % 7 == 3 ? IRIS_REGRESS_NONE : y % 11 == 5 ? x + 90 : x);
        }
        iris_line line = {0};
        digest_number(iris_regress_rows(&line, twice_x, 0, H - 1, 2));
        digest_line(&line);
    }
}

const digest_operation digest_threshold[] = {
    {"threshold.fixed", fixed},     {"threshold.otsu", otsu},       {"threshold.adaptive", adaptive},
    {"regress.mask", regress_mask}, {"regress.rows", regress_rows}, {NULL, NULL},
};
