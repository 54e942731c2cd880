#include "bench.h"

#include "iris/xt/threshold.h"

static void fixed(void)
{
    (void)iris_threshold(&bench_frame.mask_to, &bench_frame.gray, 100, IRIS_SELECT_DARK);
}

static void otsu(void)
{
    uint8_t value;
    (void)iris_threshold_otsu(&value, &bench_frame.mask_to, &bench_frame.gray, IRIS_SELECT_DARK,
                              &bench_frame.scratch);
}

static void adaptive(void)
{
    (void)iris_threshold_adaptive(&bench_frame.mask_to, &bench_frame.gray, 12, 20, IRIS_SELECT_DARK,
                                  &bench_frame.scratch);
}

const bench_case bench_threshold[] = {
    {"threshold, fixed", fixed, NULL},
    {"threshold, Otsu", otsu, NULL},
    {"threshold, adaptive 25x25", adaptive, NULL},
    {0},
};
