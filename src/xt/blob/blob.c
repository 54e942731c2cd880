#include "../../foundation/mean.h"
#include "../../foundation/views.h"
#include "blob_parts.h"

#define NONE 65535

/* What a run of this row shares with the runs above it. */
typedef struct {
    int32_t overlap; /* columns */
    int32_t links;   /* runs that it touches */
    int32_t same;    /* ends in one column */
} contact;

/* The blob that a part of it belongs to. The way there gets shorter. */
static inline int32_t root_of(iris_open_blob *open, int32_t i)
{
    while (open[i].link != i) {
        open[i].link = open[open[i].link].link;
        i = open[i].link;
    }
    return i;
}

/* ---- from an open blob to a finished one ---- */

/* sum / count, rounded half up. Means of few pixels need no division of 64 bits: it is slow on small processors. */
static iris_q16 center_q16(int64_t twice_sum, int32_t count)
{
    if (twice_sum <= 65535 && count < 65536) {
        return (iris_q16)(((uint32_t)twice_sum * 32768u + (uint32_t)count / 2u) / (uint32_t)count);
    }
    return (iris_q16)((twice_sum * 32768 + count / 2) / count);
}

static iris_color mean_color(const iris_blob_scan *scan, int32_t i)
{
    if (!scan->colors) {
        return (iris_color){0, 0, 0};
    }
    const uint64_t *sums = scan->colors[i];
    uint32_t area = (uint32_t)scan->open[i].area;
    uint8_t first = iris_mean_u8(sums[0], area);
    return scan->channels == 1
               ? (iris_color){first, first, first}
               : (iris_color){first, iris_mean_u8(sums[1], area), iris_mean_u8(sums[2], area)};
}

static iris_blob describe(const iris_blob_scan *scan, int32_t i)
{
    const iris_open_blob *from = &scan->open[i];
    iris_blob blob = {.moments = {from->area, from->twice_x / 2, from->y, from->twelve_xx / 12,
                                  from->twice_xy / 2, from->yy},
                      .box = {from->left, from->top, from->right - from->left, from->bottom - from->top + 1},
                      .first_x = from->first_x,
                      .area = from->area,
                      .x_q16 = center_q16(from->twice_x, from->area),
                      .y_q16 = center_q16(2 * from->y, from->area),
                      .edges = 2 * from->half_edges,
                      .corners = from->corners,
                      .holes = 1 - from->euler,
                      .mean = mean_color(scan, i)};
    return blob;
}

/* A blob to which no run of this row belongs, and none that is still to come can. */
static void finish(iris_blob_scan *scan, int32_t i)
{
    const iris_blob_filter *filter = &scan->config.filter;
    iris_open_blob *open = &scan->open[i];
    if (open->area >= filter->min_area && open->area <= filter->max_area) {
        iris_blob blob = describe(scan, i);
        if (iris_blob_passes(&blob, filter, scan->size)) {
            iris_blob_keep(scan, &blob);
        }
    }
    open->link = (uint16_t)scan->free_open;
    scan->free_open = i;
}

/* Nothing more can touch this run of the row above. */
static inline void leave(iris_blob_scan *scan, const iris_blob_run *run)
{
    int32_t i = root_of(scan->open, run->open);
    if (--scan->open[i].refs == 0) {
        finish(scan, i);
    }
}

/* ---- rows ---- */

/* The row's runs, and one behind them that nothing reaches. Returns how many they are. */
static int32_t find_runs(iris_blob_run *runs, const uint32_t *mask, int32_t w)
{
    iris_blob_run *run = runs;
    uint32_t before = 0; /* the pixel before this word */
    for (int32_t at = 0; at < w; at += 32) {
        uint32_t word = mask[at / 32];
        if (w - at < 32) {
            word &= ((uint32_t)1 << (w - at)) - 1;
        }
        uint32_t turns = word ^ (word << 1 | before);
        for (; turns != 0; turns &= turns - 1) {
            uint16_t x = (uint16_t)(at + __builtin_ctz(turns));
            if (before == 0) {
                run->first = x;
            } else {
                run->end = x;
                run++;
            }
            before ^= 1;
        }
    }
    if (before != 0) {
        run->end = (uint16_t)w;
        run++;
    }
    run->first = run->end = NONE;
    return (int32_t)(run - runs);
}

static int32_t start_blob(iris_blob_scan *scan, const iris_blob_run *run)
{
    int32_t i = scan->free_open;
    iris_open_blob *open = &scan->open[i];
    scan->free_open = open->link;
    *open = (iris_open_blob){.left = (int16_t)run->first,
                             .right = (int16_t)run->end,
                             .top = (int16_t)scan->y,
                             .first_x = (int16_t)run->first,
                             .link = (uint16_t)i};
    if (scan->colors) {
        scan->colors[i][0] = scan->colors[i][1] = scan->colors[i][2] = 0;
    }
    return i;
}

/* Two blobs turn out to be one. The other is unused from the end of this row on: runs still name it. */
static int32_t join(iris_blob_scan *scan, int32_t a, int32_t b, int32_t *joined)
{
    if (scan->open[a].refs < scan->open[b].refs) {
        int32_t other = a;
        a = b;
        b = other;
    }
    iris_open_blob *to = &scan->open[a], *from = &scan->open[b];
    to->twice_x += from->twice_x;
    to->y += from->y;
    to->twelve_xx += from->twelve_xx;
    to->twice_xy += from->twice_xy;
    to->yy += from->yy;
    to->area += from->area;
    to->half_edges += from->half_edges;
    to->corners += from->corners;
    to->euler += from->euler;
    if (from->top < to->top || (from->top == to->top && from->first_x < to->first_x)) {
        to->top = from->top;
        to->first_x = from->first_x;
    }
    to->left = from->left < to->left ? from->left : to->left;
    to->right = from->right > to->right ? from->right : to->right;
    to->refs = (uint16_t)(to->refs + from->refs);
    for (int c = 0; scan->colors && c < 3; c++) {
        scan->colors[a][c] += scan->colors[b][c];
    }
    from->link = (uint16_t)a;
    from->next = (uint16_t)*joined;
    *joined = b;
    return a;
}

static inline void add_run(iris_open_blob *to, const iris_blob_run *run, int32_t y, contact with)
{
    int32_t n = run->end - run->first, ends = run->first + run->end - 1;
    int64_t twice_x = (int64_t)n * ends;
    to->twice_x += twice_x;
    to->y += n * y;
    to->twelve_xx += n * (3 * (int64_t)ends * ends + ((int64_t)n * n - 1));
    to->twice_xy += twice_x * y;
    to->yy += (int64_t)(n * y) * y;
    to->area += n;
    to->half_edges += 1 + n - with.overlap;
    to->corners += 4 - 2 * with.same;
    to->euler += 1 - with.links;
    to->left = (int16_t)(run->first < to->left ? run->first : to->left);
    to->right = (int16_t)(run->end > to->right ? run->end : to->right);
    to->bottom = (int16_t)y;
    to->refs++;
}

static void add_colors(uint64_t *sums, const uint8_t *row, const iris_blob_run *run, int32_t channels)
{
    if (channels == 1) {
        uint32_t sum = 0;
        for (int32_t x = run->first; x < run->end; x++) {
            sum += row[x];
        }
        sums[0] += sum;
        return;
    }
    uint32_t r = 0, g = 0, b = 0;
    for (const uint8_t *p = row + 3 * run->first, *end = row + 3 * run->end; p < end; p += 3) {
        r += p[0];
        g += p[1];
        b += p[2];
    }
    sums[0] += r;
    sums[1] += g;
    sums[2] += b;
}

/* The blob of a run, which touches the runs above from `above` on. */
static inline int32_t meet(iris_blob_scan *scan, const iris_blob_run *run, const iris_blob_run *above,
                           int32_t reach, int32_t *joined)
{
    contact with = {0, 0, 0};
    int32_t blob = NONE, end = run->end, first = run->first;
    for (; above->first < end + reach; above++) {
        int32_t from = above->first > first ? above->first : first, to = above->end < end ? above->end : end;
        int32_t other = root_of(scan->open, above->open);
        with.overlap += to > from ? to - from : 0;
        with.same += (above->first == first) + (above->end == end);
        with.links++;
        blob = blob == NONE ? other : blob == other ? blob : join(scan, blob, other, joined);
    }
    if (blob == NONE) {
        blob = start_blob(scan, run);
    }
    add_run(&scan->open[blob], run, scan->y, with);
    return blob;
}

static void take_row(iris_blob_scan *scan, const uint32_t *mask, const uint8_t *picture)
{
    iris_blob_run *runs = scan->new_runs, *above = scan->runs;
    int32_t reach = scan->config.connectivity == 8, joined = NONE;
    int32_t count = find_runs(runs, mask, scan->size.w);
    for (iris_blob_run *run = runs; run < runs + count; run++) {
        for (; above->end + reach <= run->first; above++) {
            leave(scan, above);
        }
        int32_t blob = meet(scan, run, above, reach, &joined);
        run->open = (uint16_t)blob;
        if (scan->colors && picture) {
            add_colors(scan->colors[blob], picture, run, scan->channels);
        }
    }
    for (; above->end != NONE; above++) {
        leave(scan, above);
    }
    if (joined != NONE) {
        for (iris_blob_run *run = runs; run < runs + count; run++) {
            run->open = (uint16_t)root_of(scan->open, run->open);
        }
    }
    while (joined != NONE) {
        int32_t next = scan->open[joined].next;
        scan->open[joined].link = (uint16_t)scan->free_open;
        scan->free_open = joined;
        joined = next;
    }
    scan->new_runs = scan->runs;
    scan->runs = runs;
    scan->y++;
}

/* ---- the calls ---- */

/* No row yet, and nothing open. */
static void restart(iris_blob_scan *scan)
{
    scan->y = scan->kept = scan->found = 0;
    scan->runs->first = scan->runs->end = NONE;
}

static iris_status take_memory(iris_blob_scan *scan, iris_scratch *scratch)
{
    size_t start = iris_scratch_mark(scratch), w = (size_t)scan->size.w;
    size_t open = IRIS_BLOB_OPEN(w), run_bytes = (IRIS_BLOB_RUNS(w) + 1) * sizeof(iris_blob_run);
    scan->open = (iris_open_blob *)iris_scratch_take(scratch, open * sizeof(iris_open_blob));
    scan->runs = (iris_blob_run *)iris_scratch_take(scratch, run_bytes);
    scan->new_runs = (iris_blob_run *)iris_scratch_take(scratch, run_bytes);
    scan->order = (int32_t *)iris_scratch_take(scratch, (size_t)scan->table->capacity * sizeof(int32_t));
    scan->colors =
        scan->channels > 0 ? (uint64_t(*)[3])iris_scratch_take(scratch, open * sizeof(uint64_t[3])) : NULL;
    if (!scan->open || !scan->runs || !scan->new_runs || !scan->order ||
        (scan->channels > 0 && !scan->colors)) {
        iris_scratch_release(scratch, start);
        return IRIS_ERR_SCRATCH;
    }
    for (size_t i = 0; i < open; i++) {
        scan->open[i].link = (uint16_t)(i + 1);
    }
    scan->free_open = 0;
    restart(scan);
    return IRIS_OK;
}

static int table_is_bad(const iris_blob_table *table)
{
    return !table || table->capacity < 0 || (!table->blobs && table->capacity > 0);
}

iris_status iris_blob_begin(iris_blob_scan *scan, iris_blob_table *table, iris_size size, int32_t channels,
                            const iris_blob_config *config, iris_scratch *scratch)
{
    if (!scan || table_is_bad(table) || !scratch || (channels != 0 && channels != 1 && channels != 3)) {
        return IRIS_ERR_ARG;
    }
    iris_blob_scan made = {.table = table, .size = size, .channels = channels};
    iris_blob_defaults(&made.config);
    if (config) {
        made.config = *config;
    }
    if (iris_blob_config_is_bad(&made.config)) {
        return IRIS_ERR_ARG;
    }
    if (size.w < 1 || size.w > IRIS_SIDE_MAX || size.h < 1 || size.h > IRIS_SIDE_MAX ||
        (size_t)table->capacity > SIZE_MAX / sizeof(iris_blob)) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = take_memory(&made, scratch);
    if (status == IRIS_OK) {
        *scan = made;
    }
    return status;
}

iris_status iris_blob_row(iris_blob_scan *scan, const uint32_t *mask_row, const uint8_t *picture_row)
{
    if (!scan || !scan->open || !mask_row || (scan->channels > 0 && !picture_row)) {
        return IRIS_ERR_ARG;
    }
    if (scan->y >= scan->size.h) {
        return IRIS_ERR_RANGE;
    }
    take_row(scan, mask_row, picture_row);
    return IRIS_OK;
}

iris_status iris_blob_end(iris_blob_scan *scan)
{
    if (!scan || !scan->open) {
        return IRIS_ERR_ARG;
    }
    for (const iris_blob_run *run = scan->runs; run->end != NONE; run++) {
        leave(scan, run);
    }
    iris_blob_sort(scan);
    scan->table->count = scan->found;
    restart(scan);
    return scan->table->count > scan->table->capacity ? IRIS_ERR_FULL : IRIS_OK;
}

/* The errors of the pictures. */
static iris_status check_pictures(const iris_image *mask, const iris_image *picture)
{
    iris_status status = iris_image_check(mask);
    if (status == IRIS_OK && picture) {
        status = iris_image_check(picture);
    }
    if (status != IRIS_OK) {
        return status;
    }
    if (mask->format != IRIS_MASK1 ||
        (picture && picture->format != IRIS_GRAY8 && picture->format != IRIS_RGB888)) {
        return IRIS_ERR_FORMAT;
    }
    return picture && (picture->w != mask->w || picture->h != mask->h) ? IRIS_ERR_RANGE : IRIS_OK;
}

iris_status iris_blobs(iris_blob_table *table, const iris_image *mask, const iris_image *picture,
                       const iris_blob_config *config, iris_scratch *scratch)
{
    if (table_is_bad(table) || !mask || !scratch || (config && iris_blob_config_is_bad(config))) {
        return IRIS_ERR_ARG;
    }
    iris_blob_scan scan;
    size_t start = iris_scratch_mark(scratch);
    iris_status status = check_pictures(mask, picture);
    if (status == IRIS_OK) {
        int32_t channels = !picture ? 0 : picture->format == IRIS_GRAY8 ? 1 : 3;
        status = iris_blob_begin(&scan, table, (iris_size){mask->w, mask->h}, channels, config, scratch);
    }
    if (status != IRIS_OK) {
        return status;
    }
    for (int32_t y = 0; y < mask->h; y++) {
        take_row(&scan, (const uint32_t *)iris_image_row(mask, y),
                 picture ? (const uint8_t *)iris_image_row(picture, y) : NULL);
    }
    status = iris_blob_end(&scan);
    iris_scratch_release(scratch, start);
    return status;
}
