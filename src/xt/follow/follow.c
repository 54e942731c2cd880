#include "iris/xt/follow.h"
#include <stddef.h>
#include <string.h>

#include "../line/regress_rows.h"
#include "follow_parts.h"

#define SIDE_MIN 8

static const iris_follow_config defaults = {
    .kind = IRIS_FOLLOW_DARK,
    .format = IRIS_GRAY8,
    .contrast_permil = 350,
    .min_width_permil = 12,
    .lookahead_permil = 333,
    .hold_ms = 200,
};

void iris_follow_defaults(iris_follow_config *config)
{
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

/* The block that was taken, cut into its parts. */
static void cut_memory(iris_follow *follow, void *memory)
{
    size_t h = (size_t)follow->size.h, blocks = IRIS_FOLLOW_BLOCKS(follow->size.w);
    iris_follow_chain *chains = memory;
    follow->chains = chains;
    follow->runs = (void *)(chains + IRIS_FOLLOW_CHAINS);
    follow->blocks = (void *)(follow->runs + h * IRIS_FOLLOW_RUNS);
    follow->floor = (void *)(follow->blocks + blocks + 1);
    follow->owner = (void *)(follow->floor + blocks);
    follow->blocks[blocks].below = 1;
}

static iris_status fit_by_regression(iris_line *line, const iris_follow *follow, const int16_t *twice_x,
                                     int32_t y0, int32_t y1)
{
    enum { TRIMS = 2 };
    (void)follow;
    return iris_regress_rows_rough(line, twice_x, y0, y1, TRIMS);
}

const iris_follow_config *iris_follow_config_of(const iris_follow_config *config)
{
    return config ? config : &defaults;
}

void *iris_follow_memory(iris_status *status, iris_size size, const iris_follow_config *config,
                         iris_scratch *scratch)
{
    void *memory = NULL;
    if (!is_valid(config)) {
        *status = IRIS_ERR_ARG;
    } else if (!within(size.w, SIDE_MIN, IRIS_FOLLOW_SIDE_MAX) ||
               !within(size.h, SIDE_MIN, IRIS_FOLLOW_SIDE_MAX)) {
        *status = IRIS_ERR_RANGE;
    } else {
        memory = iris_scratch_take(scratch, IRIS_FOLLOW_SCRATCH_BYTES(size.w, (size_t)size.h));
        *status = memory ? IRIS_OK : IRIS_ERR_SCRATCH;
    }
    return memory;
}

void iris_follow_prepare(iris_follow *follow, iris_size size, const iris_follow_config *config, void *memory)
{
    follow->config = *config; /* which may be the same */
    config = &follow->config;
    memset((uint8_t *)follow + sizeof follow->config, 0,
           offsetof(iris_follow, color) - sizeof follow->config);
    follow->size = size;
    follow->describe = iris_follow_describe_line;
    follow->fit = fit_by_regression;
    follow->y = -1;
    int32_t least = size.w * config->min_width_permil / 1000;
    follow->min_width = least < 2 ? 2 : least;
    follow->max_gap = 1 + (size.w < size.h ? size.w : size.h) / 80;
    follow->contrast_q10 = config->contrast_permil * 1024 / 1000;
    follow->brighter_q10 = 1024000 / (1000 - config->contrast_permil);
    follow->learn_rows = size.h < 360 ? 3 : size.h / 120;
    cut_memory(follow, memory);
}

static const uint8_t *mark_gray(iris_follow *follow, const void *pixels)
{
    iris_follow_mark(follow, pixels);
    return pixels;
}

iris_status iris_follow_init(iris_follow *follow, iris_size size, const iris_follow_config *config,
                             iris_scratch *scratch)
{
    if (!follow || !scratch) {
        return IRIS_ERR_ARG;
    }
    const iris_follow_config *used = iris_follow_config_of(config);
    if (used->kind == IRIS_FOLLOW_COLOR || used->format != IRIS_GRAY8) {
        return IRIS_ERR_FORMAT;
    }
    if (used->lane == 1) {
        return IRIS_ERR_UNSUPPORTED;
    }
    iris_status status;
    void *memory = iris_follow_memory(&status, size, used, scratch);
    if (memory) {
        iris_follow_prepare(follow, size, used, memory);
        follow->mark = mark_gray;
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
    follow->rows_to_learn = 1;
    follow->dark_rows = 0;
    return IRIS_OK;
}

iris_status iris_follow_row(iris_follow *follow, const void *pixels)
{
    if (!follow || !pixels) {
        return IRIS_ERR_ARG;
    }
    if (follow->y < 0 || follow->y >= follow->size.h) {
        return IRIS_ERR_RANGE;
    }
    const uint8_t *gray = follow->mark(follow, pixels);
    iris_follow_collect(follow, gray);
    if (gray) {
        iris_follow_learn(follow);
    }
    follow->y++;
    return IRIS_OK;
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
    follow->y = -1;
    *result = lost;
    int32_t line = iris_follow_choose(follow);
    if (line >= 0 && follow->describe(result, follow, line)) {
        result->state = IRIS_LINE_FOUND;
        follow->last = *result;
        follow->seen = 1;
        follow->seen_ms = now_ms;
    } else if (follow->seen && now_ms - follow->seen_ms <= (uint32_t)follow->config.hold_ms) {
        *result = follow->last;
        result->state = IRIS_LINE_STALE;
        result->rows = NULL;
    } else {
        follow->seen = 0;
    }
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
