#include "iris/xt/follow.h"
#include "follow_parts.h"

#define SIDE_MIN 8

void iris_follow_defaults(iris_follow_config *config)
{
    static const iris_follow_config defaults = {
        .kind = IRIS_FOLLOW_DARK,
        .format = IRIS_GRAY8,
        .contrast_permil = 350,
        .min_width_permil = 12,
        .lookahead_permil = 333,
        .hold_ms = 200,
    };
    if (config) {
        *config = defaults;
    }
}

static int within(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

static int is_valid(const iris_follow_config *config)
{
    return within((int32_t)config->kind, IRIS_FOLLOW_DARK, IRIS_FOLLOW_COLOR) && within(config->lane, 0, 1) &&
           within(config->contrast_permil, 100, 900) && within(config->min_width_permil, 1, 500) &&
           within(config->lookahead_permil, 0, 1000) && within(config->hold_ms, 0, 60000);
}

static int is_convertible(iris_format format)
{
    switch (format) {
    case IRIS_GRAY8:
    case IRIS_RGB888:
    case IRIS_BGR888:
    case IRIS_RGB565:
    case IRIS_RGB565_SWAP:
    case IRIS_YUYV:
    case IRIS_UYVY:
        return 1;
    default:
        return 0;
    }
}

static iris_status take_memory(iris_follow *follow, iris_scratch *scratch)
{
    size_t h = (size_t)follow->size.h, blocks = IRIS_FOLLOW_BLOCKS(follow->size.w);
    size_t mark = iris_scratch_mark(scratch);
    follow->runs = iris_scratch_take(scratch, h * IRIS_FOLLOW_RUNS * sizeof(iris_span));
    follow->owner = iris_scratch_take(scratch, h * IRIS_FOLLOW_RUNS);
    follow->chains = iris_scratch_take(scratch, IRIS_FOLLOW_CHAINS * sizeof(iris_follow_chain));
    follow->floor = iris_scratch_take(scratch, blocks * 2);
    follow->blocks = iris_scratch_take(scratch, blocks * sizeof(iris_block8));
    follow->mask = iris_scratch_take(scratch, ((size_t)follow->size.w + 31) / 32 * 4);
    follow->row = iris_scratch_take(scratch, (size_t)follow->size.w * 3);
    if (!follow->runs || !follow->owner || !follow->chains || !follow->floor || !follow->blocks ||
        !follow->mask || !follow->row) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    return IRIS_OK;
}

iris_status iris_follow_init(iris_follow *follow, iris_size size, const iris_follow_config *config,
                             iris_scratch *scratch)
{
    iris_follow made = {.size = size, .y = -1};
    if (!follow || !scratch) {
        return IRIS_ERR_ARG;
    }
    iris_follow_defaults(&made.config);
    made.config = config ? *config : made.config;
    if (!is_valid(&made.config)) {
        return IRIS_ERR_ARG;
    }
    if (!within(size.w, SIDE_MIN, IRIS_FOLLOW_SIDE_MAX) || !within(size.h, SIDE_MIN, IRIS_FOLLOW_SIDE_MAX)) {
        return IRIS_ERR_RANGE;
    }
    if (made.config.kind == IRIS_FOLLOW_COLOR &&
        iris_hsl_range_prepare(&made.color, &made.config.color) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (!is_convertible(made.config.format)) {
        return IRIS_ERR_FORMAT;
    }
    int32_t least = size.w * made.config.min_width_permil / 1000;
    made.min_width = least < 2 ? 2 : least;
    made.max_gap = 1 + (size.w < size.h ? size.w : size.h) / 80;
    made.contrast_q10 = made.config.contrast_permil * 1024 / 1000;
    iris_status status = take_memory(&made, scratch);
    if (status == IRIS_OK) {
        *follow = made;
    }
    return status;
}

iris_status iris_follow_begin(iris_follow *follow)
{
    if (!follow || !follow->runs) {
        return IRIS_ERR_ARG;
    }
    follow->y = 0;
    follow->chain_count = 0;
    return IRIS_OK;
}

/* The row as GRAY8, or as RGB888 where color counts. */
static iris_status to_row(iris_follow *follow, const void *pixels)
{
    iris_format format = follow->config.format;
    return follow->config.kind == IRIS_FOLLOW_COLOR
               ? iris_color_rgb_row(follow->row, pixels, format, follow->size.w)
               : iris_color_gray_row(follow->row, pixels, format, IRIS_GRAY_LUMA, follow->size.w);
}

iris_status iris_follow_row(iris_follow *follow, const void *pixels)
{
    if (!follow || !pixels) {
        return IRIS_ERR_ARG;
    }
    if (follow->y < 0 || follow->y >= follow->size.h) {
        return IRIS_ERR_RANGE;
    }
    int by_color = follow->config.kind == IRIS_FOLLOW_COLOR;
    const uint8_t *row = pixels;
    if (follow->config.format != (by_color ? IRIS_RGB888 : IRIS_GRAY8)) {
        iris_status status = to_row(follow, pixels);
        if (status != IRIS_OK) {
            return status;
        }
        row = follow->row;
    }
    if (by_color) {
        iris_follow_mark_color(follow, row);
        iris_follow_collect(follow, NULL);
    } else {
        iris_follow_mark_floor(follow, row);
        iris_follow_collect(follow, row);
    }
    follow->y++;
    return IRIS_OK;
}

/* No line in this frame: the last result for a while, then nothing. */
static void repeat_last(iris_follow_result *result, iris_follow *follow, uint32_t now_ms)
{
    if (follow->seen && now_ms - follow->seen_ms <= (uint32_t)follow->config.hold_ms) {
        *result = follow->last;
        result->state = IRIS_LINE_STALE;
        result->rows = NULL;
    } else {
        follow->seen = 0;
    }
}

iris_status iris_follow_end(iris_follow_result *result, iris_follow *follow, uint32_t now_ms)
{
    static const iris_follow_result lost = {.state = IRIS_LINE_LOST};
    if (!result || !follow) {
        return IRIS_ERR_ARG;
    }
    if (follow->y < 0) {
        return IRIS_ERR_RANGE;
    }
    *result = lost;
    int32_t line = iris_follow_choose(follow);
    int32_t other = line >= 0 && follow->config.lane ? iris_follow_choose(follow) : -1;
    if (line >= 0 && (other >= 0 || !follow->config.lane) &&
        iris_follow_describe(result, follow, line, other)) {
        result->state = IRIS_LINE_FOUND;
        follow->last = *result;
        follow->seen = 1;
        follow->seen_ms = now_ms;
    } else {
        repeat_last(result, follow, now_ms);
    }
    follow->y = -1;
    return IRIS_OK;
}

iris_status iris_follow_frame(iris_follow_result *result, iris_follow *follow, const iris_image *frame,
                              uint32_t now_ms)
{
    if (!result || !follow || iris_image_check(frame) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (frame->w != follow->size.w || frame->h != follow->size.h) {
        return IRIS_ERR_RANGE;
    }
    if (frame->format != follow->config.format) {
        return IRIS_ERR_FORMAT;
    }
    iris_status status = iris_follow_begin(follow);
    for (int32_t y = 0; status == IRIS_OK && y < frame->h; y++) {
        status = iris_follow_row(follow, iris_image_row(frame, y));
    }
    return status == IRIS_OK ? iris_follow_end(result, follow, now_ms) : status;
}

void iris_follow_forget(iris_follow *follow)
{
    if (follow) {
        follow->seen = 0;
    }
}
