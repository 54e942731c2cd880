#include "iris/xt/tone.h"

#include "../../foundation/logarithm.h"
#include "iris/xt/histogram.h"

static uint8_t clamp_u8(int64_t value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
}

/* a x with 48 fraction bits, for x with 58 and below 2^31; 256 when it is more. */
static uint64_t product_q48(uint32_t a_q16, uint64_t x_q58)
{
    uint64_t high_q42 = a_q16 * (x_q58 >> 32);
    if (high_q42 >= (uint64_t)256 << 42) {
        return (uint64_t)256 << 48;
    }
    return (high_q42 << 6) + (a_q16 * (x_q58 & 0xFFFFFFFFu) >> 26);
}

iris_status iris_tone_identity(iris_tone *tone)
{
    if (!tone) {
        return IRIS_ERR_ARG;
    }
    for (int32_t p = 0; p < 256; p++) {
        tone->level[p] = (uint8_t)p;
    }
    return IRIS_OK;
}

iris_status iris_tone_then(iris_tone *tone, const iris_tone *next)
{
    if (!tone || !next) {
        return IRIS_ERR_ARG;
    }
    iris_tone first = *tone, second = *next;
    for (int32_t p = 0; p < 256; p++) {
        tone->level[p] = second.level[first.level[p]];
    }
    return IRIS_OK;
}

iris_status iris_tone_negate(iris_tone *tone)
{
    if (!tone) {
        return IRIS_ERR_ARG;
    }
    for (int32_t p = 0; p < 256; p++) {
        tone->level[p] = (uint8_t)(255 - tone->level[p]);
    }
    return IRIS_OK;
}

iris_status iris_tone_add(iris_tone *tone, int32_t amount)
{
    if (!tone) {
        return IRIS_ERR_ARG;
    }
    for (int32_t p = 0; p < 256; p++) {
        tone->level[p] = clamp_u8((int64_t)tone->level[p] + amount);
    }
    return IRIS_OK;
}

iris_status iris_tone_compress(iris_tone *tone, iris_q16 c_q16)
{
    if (!tone || c_q16 < 0) {
        return tone ? IRIS_ERR_RANGE : IRIS_ERR_ARG;
    }
    for (int32_t p = 0; p < 256; p++) {
        uint64_t value_q48 = product_q48((uint32_t)c_q16, iris_ln_q58(tone->level[p] + 1u));
        tone->level[p] = clamp_u8(iris_round_shift((int64_t)value_q48, 48));
    }
    return IRIS_OK;
}

iris_status iris_tone_gamma(iris_tone *tone, iris_q16 gamma_q16)
{
    if (!tone || gamma_q16 <= 0) {
        return tone ? IRIS_ERR_RANGE : IRIS_ERR_ARG;
    }
    const uint64_t ln_255 = iris_ln_q58(255);
    for (int32_t p = 0; p < 256; p++) {
        uint32_t level = tone->level[p];
        if (level == 0) {
            continue;
        }
        uint64_t exponent_q48 = product_q48((uint32_t)gamma_q16, ln_255 - iris_ln_q58(level));
        /* From e^-8 on, 255 times it is below a half. */
        uint64_t power_q56 = exponent_q48 >> 51 ? 0 : iris_exp_minus_q56(exponent_q48 << 10);
        tone->level[p] = (uint8_t)((255 * power_q56 + ((uint64_t)1 << 55)) >> 56);
    }
    return IRIS_OK;
}

void iris_tone_segments_defaults(iris_tone_segments *segments)
{
    if (segments) {
        *segments = (iris_tone_segments){85, 170, IRIS_Q16_ONE / 2, 2 * IRIS_Q16_ONE, IRIS_Q16_ONE / 2};
    }
}

iris_status iris_tone_stretch(iris_tone *tone, const iris_tone_segments *segments)
{
    iris_tone_segments lines;
    if (!tone) {
        return IRIS_ERR_ARG;
    }
    iris_tone_segments_defaults(&lines);
    if (segments) {
        lines = *segments;
    }
    if (lines.a < 0 || lines.b < lines.a || lines.b > 255) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < 256; i++) {
        int32_t p = tone->level[i];
        int64_t first = p < lines.a ? p : lines.a;
        int64_t second = p < lines.a ? 0 : p < lines.b ? p - lines.a : lines.b - lines.a;
        int64_t third = p < lines.b ? 0 : p - lines.b;
        int64_t value_q16 = first * lines.below + second * lines.between + third * lines.above;
        tone->level[i] = clamp_u8(iris_round_shift(value_q16, 16));
    }
    return IRIS_OK;
}

iris_status iris_tone_levels(iris_tone *tone, int32_t low, int32_t high)
{
    if (!tone) {
        return IRIS_ERR_ARG;
    }
    if (low < 0 || low > high || high > 255) {
        return IRIS_ERR_RANGE;
    }
    int32_t range = high - low;
    for (int32_t i = 0; i < 256 && range > 0; i++) {
        int32_t above = tone->level[i] - low;
        tone->level[i] = (uint8_t)(above <= 0       ? 0
                                   : above >= range ? 255
                                                    : (510 * above + range) / (2 * range));
    }
    return IRIS_OK;
}

iris_status iris_tone_stretch_share(iris_tone *tone, const uint32_t histogram[256], iris_q16 share_q16)
{
    uint8_t low = 0, high = 0;
    if (!tone || !histogram) {
        return IRIS_ERR_ARG;
    }
    if (share_q16 < 0 || share_q16 >= IRIS_Q16_ONE / 2) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = iris_histogram_percentile(&low, histogram, share_q16);
    if (status == IRIS_OK) {
        status = iris_histogram_percentile(&high, histogram, IRIS_Q16_ONE - share_q16);
    }
    return status == IRIS_OK ? iris_tone_levels(tone, low, high) : status;
}

iris_status iris_tone_equalize(iris_tone *tone, const uint32_t histogram[256])
{
    if (!tone || !histogram) {
        return IRIS_ERR_ARG;
    }
    uint64_t total = 0, darkest = 0, up_to = 0;
    for (int32_t p = 0; p < 256; p++) {
        darkest = total > 0 ? darkest : histogram[p];
        total += histogram[p];
    }
    if (total == 0) {
        return IRIS_ERR_RANGE;
    }
    uint64_t rest = total - darkest;
    iris_tone step;
    (void)iris_tone_identity(&step);
    for (int32_t p = 0; p < 256 && rest > 0; p++) {
        up_to += histogram[p];
        uint64_t above = up_to > darkest ? up_to - darkest : 0;
        step.level[p] = (uint8_t)((510 * above + rest) / (2 * rest));
    }
    return iris_tone_then(tone, &step);
}
