#include "bench.h"

#include "iris/xt/junction.h"
#include "iris/xt/line_mask.h"
#include "iris/xt/paths.h"

static iris_status line_mask(void)
{
    return iris_line_mask(NULL, &bench_frame.mask_to, &bench_frame.gray, NULL, &bench_frame.scratch);
}

static iris_status junctions(void)
{
    iris_junction found[IRIS_JUNCTIONS_MAX];
    int32_t count;
    return iris_junctions_find(found, IRIS_JUNCTIONS_MAX, &count, &bench_frame.mask, NULL,
                               &bench_frame.scratch);
}

static iris_status paths(void)
{
    iris_path found[4];
    int32_t count;
    return iris_paths_find(found, 4, &count, &bench_frame.mask, NULL, &bench_frame.scratch);
}

/* A bar across the frame, a tenth of its height. */
static void bar(void)
{
    int32_t h = bench_frame.mask.h;
    for (int32_t y = h / 2; y < h / 2 + h / 10; y++) {
        uint32_t *row = iris_image_row(&bench_frame.mask, y);
        for (int32_t x = 0; x < bench_frame.mask.w; x++) {
            row[x / 32] |= (uint32_t)1 << x % 32;
        }
    }
}

const bench_case bench_junction[] = {
    {"line mask", line_mask, NULL},
    {"junctions of a line", junctions, NULL},
    {"junctions of a crossing", junctions, bar},
    {"paths of a crossing", paths, bar},
    {0},
};
