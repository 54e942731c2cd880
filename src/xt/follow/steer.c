#include "iris/xt/steer.h"

#include <stddef.h>

#define TIME_MAX     60000   /* ms */
#define OFFSET_MAX   131072  /* 2.0 */
#define RATE_MAX     2097152 /* 0.125 per ms */
#define BEND_ANGLE   5461    /* 30 degrees: what counts as a sharp bend */
#define QUARTER_TURN 16384
#define STEEP        10923 /* 60 degrees: beyond, a bend's memory says which end of the line is ahead */

static int32_t clamp(int32_t value, int32_t low, int32_t high)
{
    return value < low ? low : value > high ? high : value;
}

/* value limited to -most..most. */
static int32_t within(int32_t value, int32_t most)
{
    return clamp(value, -most, most);
}

static int32_t magnitude(int32_t value)
{
    return value < 0 ? -value : value;
}

static int32_t sign(int32_t value)
{
    return (value > 0) - (value < 0);
}

void iris_steer_defaults(iris_steer_config *config)
{
    if (config) {
        *config = (iris_steer_config){
            .offset_gain_permil = 700,
            .angle_gain_permil = 300,
            .lookahead_permil = 150,
            .derivative_ms = 120,
            .filter_ms = 60,
            .bend_widths_permil = 1000,
            .limit_permil = 1000,
            .full_lock_centideg = 4500,
            .cruise_permil = 600,
            .slow_permil = 250,
            .curve_permil = 500,
            .hold_ms = 200,
            .search_steer_permil = 1000,
            .search_speed_permil = 200,
            .stop_ms = 3000,
        };
    }
}

/* The largest value of each field of the config, in its order; the smallest is 0. */
static const uint16_t largest[] = {10000, 10000, 1000,  1000,     1000, 20000, 1000,    9000,
                                   1000,  1000,  10000, TIME_MAX, 1000, 1000,  TIME_MAX};

typedef char
    one_limit_per_field[sizeof(iris_steer_config) == sizeof largest / sizeof largest[0] * 4 ? 1 : -1];

static int is_valid(const iris_steer_config *config)
{
    const char *fields = (const char *)config;
    for (size_t i = 0; i < sizeof largest / sizeof largest[0]; i++) {
        uint32_t value = *(const uint32_t *)(const void *)(fields + 4 * i);
        if (value > largest[i]) {
            return 0;
        }
    }
    return config->curve_permil > 0;
}

iris_status iris_steer_init(iris_steer *steer, const iris_steer_config *config)
{
    if (!steer || (config && !is_valid(config))) {
        return IRIS_ERR_ARG;
    }
    iris_steer made = {0};
    iris_steer_defaults(&made.config);
    if (config) {
        made.config = *config;
    }
    *steer = made;
    return IRIS_OK;
}

/* Smooths the change of the offset since the last frame into rate_q24. */
static void follow_rate(iris_steer *steer, int32_t offset_q16, int32_t elapsed_ms)
{
    if (!steer->settled) {
        steer->rate_q24 = 0;
    } else if (elapsed_ms > 0) {
        int32_t rate_q24 = within((offset_q16 - steer->offset_q16) * 256 / elapsed_ms, RATE_MAX);
        int32_t share_q8 = elapsed_ms * 256 / (elapsed_ms + steer->config.filter_ms);
        steer->rate_q24 += (rate_q24 - steer->rate_q24) * share_q8 / 256;
    }
    steer->settled = 1;
    steer->offset_q16 = offset_q16;
}

/* Is the bend so close that the line in front of it no longer counts? The last segment is the part behind the bend. */
static int at_bend(const iris_steer *steer, const iris_follow_result *line)
{
    int32_t last = clamp(line->segment_count, 0, IRIS_FOLLOW_SEGMENTS_MAX) - 2;
    if (last < 0) {
        return 1;
    }
    int32_t rows =
        clamp(line->segments[0].y0, 0, IRIS_SIDE_MAX) - clamp(line->segments[last].y1, 0, IRIS_SIDE_MAX);
    return rows * 1000 / (clamp(line->width_px, 0, IRIS_SIDE_MAX) + 1) < steer->config.bend_widths_permil;
}

/* The direction to steer for, -180 to 180 degrees, and the memory of bends. *sharp is the sharpest one in sight. */
static int32_t direction(int32_t *sharp, iris_steer *steer, const iris_follow_result *line)
{
    int32_t angle = within(line->angle, QUARTER_TURN);
    int32_t next = line->has_next ? within(line->next_angle, QUARTER_TURN) : 0;
    *sharp = magnitude(angle) > magnitude(next) ? magnitude(angle) : magnitude(next);
    if (magnitude(next) > BEND_ANGLE) {
        steer->bend = sign(next);
        return at_bend(steer, line) ? next : angle;
    }
    if (magnitude(angle) > STEEP) {
        steer->bend = steer->bend == 0 ? sign(angle) : steer->bend;
        return sign(angle) == steer->bend ? angle : angle + 2 * QUARTER_TURN * steer->bend;
    }
    steer->bend = 0;
    return angle;
}

static void steer_for_line(iris_command *command, iris_steer *steer, const iris_follow_result *line,
                           int32_t elapsed_ms)
{
    const iris_steer_config *config = &steer->config;
    int32_t near_q16 = within(line->offset_q16, OFFSET_MAX);
    int32_t far_q16 = within(line->lookahead_offset_q16, OFFSET_MAX);
    int32_t offset_q16 = near_q16 + (far_q16 - near_q16) / 8 * config->lookahead_permil / 125;
    int32_t sharp;
    int32_t angle = direction(&sharp, steer, line);
    follow_rate(steer, offset_q16, elapsed_ms);
    int32_t ahead_q16 = within(offset_q16 + steer->rate_q24 / 16 * config->derivative_ms / 16, OFFSET_MAX);
    int32_t wanted =
        ahead_q16 * config->offset_gain_permil / 65536 + angle * config->angle_gain_permil / QUARTER_TURN;
    int32_t bent = sharp * config->angle_gain_permil / QUARTER_TURN;
    int32_t curve = magnitude(wanted) > bent ? magnitude(wanted) : bent;
    curve = clamp(curve, 0, config->curve_permil);

    steer->steer = within(wanted, config->limit_permil);
    steer->side = steer->bend != 0 ? steer->bend : wanted < 0 ? -1 : 1;
    steer->seen = 1;
    steer->since_ms = 0;
    command->steer_permil = steer->steer;
    command->speed_permil =
        config->cruise_permil + (config->slow_permil - config->cruise_permil) * curve / config->curve_permil;
}

static void steer_without_line(iris_command *command, iris_steer *steer)
{
    const iris_steer_config *config = &steer->config;
    steer->settled = 0;
    if (!steer->seen || steer->since_ms >= config->stop_ms) {
        command->steer_permil = 0;
        command->speed_permil = 0;
    } else if (steer->since_ms <= config->hold_ms) {
        command->steer_permil = steer->bend != 0 ? steer->bend * config->limit_permil : steer->steer;
        command->speed_permil = config->slow_permil;
    } else {
        command->steer_permil = steer->side * clamp(config->search_steer_permil, 0, config->limit_permil);
        command->speed_permil = config->search_speed_permil;
    }
}

iris_status iris_steer_update(iris_command *command, iris_steer *steer, const iris_follow_result *line,
                              int32_t elapsed_ms)
{
    if (!command || !steer || !line) {
        return IRIS_ERR_ARG;
    }
    int32_t elapsed = clamp(elapsed_ms, 0, TIME_MAX);
    *command = (iris_command){.seq = steer->seq, .state = IRIS_LINE_LOST};
    steer->seq = steer->seq >= 9999 ? 0 : steer->seq + 1;
    if (line->state == IRIS_LINE_FOUND || line->state == IRIS_LINE_STALE) {
        int32_t angle = within(line->angle, QUARTER_TURN);
        command->state = line->state;
        command->angle_centideg = iris_angle_to_centidegrees((iris_angle)angle);
        command->offset_permil = within(line->offset_q16, OFFSET_MAX) * 125 / 8192;
        command->confidence_permil = clamp(line->confidence_permil, 0, 1000);
    }
    if (line->state == IRIS_LINE_FOUND) {
        steer_for_line(command, steer, line, elapsed);
    } else {
        steer->since_ms = clamp(steer->since_ms + elapsed, 0, TIME_MAX);
        steer_without_line(command, steer);
    }
    return IRIS_OK;
}

int32_t iris_steer_wheel_centideg(const iris_steer *steer, const iris_command *command)
{
    if (!steer || !command) {
        return 0;
    }
    return within(command->steer_permil, 1000) * clamp(steer->config.full_lock_centideg, 0, 9000) / 1000;
}
