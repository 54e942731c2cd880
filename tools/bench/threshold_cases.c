#include "bench.h"

#include "iris/xt/threshold.h"

static iris_status fixed(void)
{
    return iris_threshold(&bench_frame.mask_to, &bench_frame.gray, 100, IRIS_SELECT_DARK);
}

static iris_status otsu(void)
{
    uint8_t value;
    return iris_threshold_otsu(&value, &bench_frame.mask_to, &bench_frame.gray, IRIS_SELECT_DARK,
                               &bench_frame.scratch);
}

static iris_status adaptive(void)
{
    return iris_threshold_adaptive(&bench_frame.mask_to, &bench_frame.gray, 12, 20, IRIS_SELECT_DARK,
                                   &bench_frame.scratch);
}

const bench_case bench_threshold[] = {
    {"threshold, fixed", fixed, NULL},
    {"threshold, Otsu", otsu, NULL},
    {"threshold, adaptive 25x25", adaptive, NULL},
    {0},
};
