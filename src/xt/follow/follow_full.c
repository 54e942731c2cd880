/* Followers of every kind: colored lines, lanes, and rows that are not gray. */
#include "../../foundation/hsl.h"
#include "follow_parts.h"

static const uint8_t *mark_converted(iris_follow *follow, const void *pixels)
{
    (void)iris_color_gray_row(follow->row, pixels, follow->config.format, IRIS_GRAY_LUMA, follow->size.w);
    iris_follow_mark(follow, follow->row);
    return follow->row;
}

static const uint8_t *mark_color(iris_follow *follow, const void *pixels)
{
    int32_t blocks = (int32_t)IRIS_FOLLOW_BLOCKS(follow->size.w);
    const uint8_t *rgb = pixels;
    if (follow->config.format != IRIS_RGB888 && follow->config.format != IRIS_BGR888) {
        (void)iris_color_rgb_row(follow->row, pixels, follow->config.format, follow->size.w);
        rgb = follow->row;
    }
    follow->mask[(follow->size.w - 1) / 32] = 0; /* bits past w */
    iris_row_hsl_range(follow->mask, rgb, &follow->color, follow->size.w);
    for (int32_t b = 0; b < blocks; b++) {
        follow->blocks[b].below = (uint8_t)(follow->mask[b / 4] >> (b % 4 * 8));
    }
    return NULL;
}

iris_status iris_follow_init_full(iris_follow *follow, iris_size size, const iris_follow_config *config,
                                  iris_scratch *scratch)
{
    if (!follow || !scratch) {
        return IRIS_ERR_ARG;
    }
    const iris_follow_config *used = iris_follow_config_of(config);
    iris_hsl_range_test color = {0};
    if (used->kind == IRIS_FOLLOW_COLOR && iris_hsl_range_prepare(&color, &used->color) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    if (!iris_color_takes(used->format) || iris_format_row_bytes(used->format, size.w) == 0) {
        return iris_color_takes(used->format) ? IRIS_ERR_RANGE : IRIS_ERR_FORMAT;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_status status;
    void *memory = iris_follow_memory(&status, size, used, scratch);
    if (!memory) {
        return status;
    }
    uint32_t *mask = iris_scratch_take(scratch, ((size_t)size.w + 31) / 32 * 4);
    uint8_t *row = iris_scratch_take(scratch, (size_t)size.w * 3);
    if (!mask || !row) {
        iris_scratch_release(scratch, mark);
        return IRIS_ERR_SCRATCH;
    }
    iris_follow_prepare(follow, size, used, memory);
    follow->mark = used->kind == IRIS_FOLLOW_COLOR ? mark_color : mark_converted;
    follow->describe = used->lane ? iris_follow_describe_lane : iris_follow_describe_line;
    follow->color = used->format == IRIS_BGR888 ? iris_hsl_range_of_bgr(&color) : color;
    follow->mask = mask;
    follow->row = row;
    return IRIS_OK;
}
