/* Blobs, in masks of noise; searches are on their way when their rows are fed. */
#include "iris/xt/blob.h"

#include <string.h>

#include "calls.h"

#define W    70
#define ROOM 8

static iris_blob_config any_config(void)
{
    iris_blob_config config;
    iris_blob_defaults(&config);
    config.connectivity = draw_chance(20) ? draw_int(0, 9) : draw_chance(2) ? 4 : 8;
    iris_blob_filter *by = &config.filter;
    int32_t *bounds[] = {&by->min_area,
                         &by->max_area,
                         &by->min_w,
                         &by->max_w,
                         &by->min_h,
                         &by->max_h,
                         &by->min_fill_permil,
                         &by->max_fill_permil,
                         &by->min_holes,
                         &by->max_holes,
                         &by->min_elongation_q16,
                         &by->max_elongation_q16,
                         &by->center_in.x,
                         &by->center_in.y,
                         &by->center_in.w,
                         &by->center_in.h};
    for (int i = draw_within(-3, 3); i > 0; i--) {
        *bounds[draw_below(16)] = draw_chance(3) ? draw_int(0, 200000) : draw_int(0, 60);
    }
    by->inside = draw_chance(8) ? draw_int(0, 1) : 0;
    return config;
}

/* A table of the caller's; *capacity: how many fit. */
static iris_blob_table *any_table(int32_t *capacity)
{
    iris_blob_table table = {NULL, draw_within(-1, ROOM), 0};
    size_t room = table.capacity > 0 ? (size_t)table.capacity : 0;
    table.blobs = OR_NULL(draw_results(room * sizeof *table.blobs));
    *capacity = table.capacity > 0 ? table.capacity : 0;
    return OR_NULL(memcpy(draw_results(sizeof table), &table, sizeof table));
}

static void blobs(void)
{
    iris_size size = draw_size();
    iris_blob_config config = any_config();
    int32_t capacity;
    iris_blob_table *table = any_table(&capacity);
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    int colored = (int)draw_below(2);
    const iris_image *picture = colored ? draw_input(draw_either(IRIS_GRAY8, IRIS_RGB888), size) : NULL;
    const iris_blob_config *given = OR_NULL(draw_given(&config, sizeof config));
    size_t w = size.w > 0 ? (size_t)size.w : 1;
    size_t bytes = IRIS_BLOB_SCRATCH_BYTES(w, capacity) + (picture ? IRIS_BLOB_COLOR_SCRATCH_BYTES(w) : 0);
    iris_scratch *scratch = colored == (picture != NULL) ? draw_scratch(bytes) : draw_scratch_up_to(bytes);
    CALL(iris_blobs(table, mask, picture, given, scratch));
}

static void begin(void)
{
    iris_blob_config config = any_config();
    int32_t capacity, channels = draw_int(0, 3);
    iris_blob_scan *scan = OR_NULL(draw_results(sizeof *scan));
    iris_blob_table *table = any_table(&capacity);
    iris_size size = draw_size();
    const iris_blob_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch =
        draw_scratch_up_to(IRIS_BLOB_SCRATCH_BYTES(W, ROOM) + IRIS_BLOB_COLOR_SCRATCH_BYTES(W));
    draw_scratch_is_kept();
    CALL(iris_blob_begin(scan, table, size, channels, given, scratch));
}

/* A search on its way through rows of noise, in memory that calls may change; null when it could not begin. */
static iris_blob_scan *begun(iris_size size)
{
    static const uint8_t black[3 * W];
    iris_blob_scan scan;
    iris_scratch scratch;
    iris_blob_config config = any_config();
    size_t bytes = IRIS_BLOB_SCRATCH_BYTES(W, ROOM) + IRIS_BLOB_COLOR_SCRATCH_BYTES(W);
    iris_blob_table table = {draw_results(ROOM * sizeof(iris_blob)), draw_within(0, ROOM), 0};
    iris_blob_table *kept = memcpy(draw_results(sizeof table), &table, sizeof table);
    if (iris_scratch_init(&scratch, draw_results(bytes), bytes) != IRIS_OK ||
        iris_blob_begin(&scan, kept, size, draw_chance(2) ? 0 : 3, &config, &scratch) != IRIS_OK) {
        return NULL;
    }
    for (int32_t y = draw_within(0, size.h); y > 0; y--) {
        uint32_t row[(W + 31) / 32];
        for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
            row[i] = draw_below(65536) << 16 | draw_below(65536);
        }
        (void)iris_blob_row(&scan, row, black);
    }
    return memcpy(draw_results(sizeof scan), &scan, sizeof scan);
}

static void row(void)
{
    iris_size size = draw_size();
    iris_blob_scan *scan = begun(size);
    size_t w = size.w > 0 ? (size_t)size.w : 0;
    const uint32_t *mask = OR_NULL(draw_given(NULL, (w + 31) / 32 * 4));
    const uint8_t *pixels = draw_chance(4) ? NULL : draw_given(NULL, 3 * w);
    CALL(iris_blob_row(scan, mask, pixels));
}

static void end(void)
{
    iris_blob_scan *scan = begun(draw_size());
    CALL(iris_blob_end(scan));
}

/* Sums that a blob can have, and some that it cannot. */
static void shape_of(void)
{
    iris_blob blob = {.edges = draw_int(0, 100000), .corners = draw_int(0, 100000)};
    for (int i = draw_within(0, 6); i > 0; i--) {
        int32_t first = draw_within(0, 32766);
        iris_moments_add_run(&blob.moments, first, draw_within(first, 32766), draw_within(0, 32766));
    }
    int64_t *sums[] = {&blob.moments.n,  &blob.moments.x,  &blob.moments.y,
                       &blob.moments.xx, &blob.moments.xy, &blob.moments.yy};
    if (draw_chance(4)) {
        *sums[draw_below(6)] += (int64_t)draw_int(-1000000, 1000000) * draw_int(0, 1000000);
    }
    iris_blob_shape *shape = OR_NULL(draw_results(sizeof *shape));
    const iris_blob *given = OR_NULL(draw_given(&blob, sizeof blob));
    CALL(iris_blob_shape_of(shape, given));
}

static void mask_of(void)
{
    iris_size size = draw_size();
    const iris_image *src = draw_input(IRIS_MASK1, size), *dst = draw_output(IRIS_MASK1, size);
    iris_blob blob = {.first_x = draw_int(0, 20), .box = {0, draw_int(0, 20), 1, 1}};
    const iris_blob *given = OR_NULL(draw_given(&blob, sizeof blob));
    int32_t connectivity = draw_chance(20) ? draw_int(0, 9) : draw_chance(2) ? 4 : 8;
    iris_scratch *scratch =
        draw_scratch(IRIS_BLOB_MASK_SCRATCH_BYTES(size.w > 0 ? size.w : 0, size.h > 0 ? size.h : 0));
    CALL(iris_blob_mask(dst, src, given, connectivity, scratch));
}

const random_call calls_blob[] = {
    {"iris_blobs", blobs},  {"iris_blob_begin", begin},       {"iris_blob_row", row},
    {"iris_blob_end", end}, {"iris_blob_shape_of", shape_of}, {"iris_blob_mask", mask_of},
    {NULL, NULL},
};
