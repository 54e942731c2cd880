#include "iris/xt/pursuit.h"

#include <stddef.h>

#define STEEP     10923 /* 60 degrees */
#define STEER_MAX 100000
#define HALVINGS  20 /* of a piece of line, to find where it is as far as wanted */

void iris_pursuit_defaults(iris_pursuit_config *config)
{
    if (config) {
        *config = (iris_pursuit_config){.lookahead_mm = 200, .radius_mm = 75, .axle_mm = 0};
    }
}

static int is_valid(const iris_pursuit_config *c)
{
    return c->lookahead_mm >= 10 && c->lookahead_mm <= 10000 && c->radius_mm >= 1 && c->radius_mm <= 100000 &&
           c->axle_mm >= -10000 && c->axle_mm <= 10000;
}

/* From the middle of the axle, q16 mm, rounded down; saturated. */
static uint32_t distance(const iris_pursuit_config *c, iris_place at)
{
    return iris_hypot(at.x_q16, iris_sat_s32((int64_t)at.y_q16 - (int64_t)c->axle_mm * 65536));
}

/* The place from a to b, where b is at least as far as `wanted`, that is as far; b if a is too. */
static iris_place as_far(const iris_pursuit_config *c, iris_place a, iris_place b, uint32_t wanted)
{
    for (int i = 0; i < HALVINGS && distance(c, a) < wanted; i++) {
        iris_place middle = {(iris_q16)(((int64_t)a.x_q16 + b.x_q16) / 2),
                             (iris_q16)(((int64_t)a.y_q16 + b.y_q16) / 2)};
        if (distance(c, middle) < wanted) {
            a = middle;
        } else {
            b = middle;
        }
    }
    return b;
}

static int is_across(iris_angle angle)
{
    int32_t magnitude = angle < 0 ? -(int32_t)angle : angle;
    return magnitude > STEEP && magnitude < 32768 - STEEP;
}

/* The piece of line on the floor, near to far. 0 when it is not wholly on the floor. */
static int piece_of(iris_floor_line *piece, const iris_floor *floor, const iris_segment *segment,
                    int32_t side)
{
    if (iris_floor_segment(piece, floor, iris_place_of(segment->x0, segment->y0),
                           iris_place_of(segment->x1, segment->y1)) != IRIS_OK) {
        return 0;
    }
    if (side != 0 && is_across(piece->angle) && (piece->angle > 0) != (side > 0)) {
        iris_place a = piece->a;
        piece->a = piece->b;
        piece->b = a;
        piece->angle = iris_angle_wrap(piece->angle + 32768);
    }
    return 1;
}

/* 1000 * radius * 2 x / d^2, for d at least a pixel or so. */
static int32_t steer_for(const iris_pursuit_config *c, const iris_pursuit_goal *goal)
{
    int64_t d = (goal->distance_q16 >> 8) + 1;                           /* 8 fraction bits, below 2^24 */
    int64_t curve = (int64_t)goal->offset_q16 * 2000 / d * c->radius_mm; /* 8 more than d */
    int64_t steer = curve / d;
    return (int32_t)(steer > STEER_MAX ? STEER_MAX : steer < -STEER_MAX ? -STEER_MAX : steer);
}

/* Follows the pieces from the robot to the goal. */
static void pursue(iris_pursuit_goal *goal, const iris_floor *floor, const iris_follow_result *line,
                   int32_t side, const iris_pursuit_config *c)
{
    uint32_t wanted = (uint32_t)c->lookahead_mm << 16;
    int32_t count =
        line->segment_count < IRIS_FOLLOW_SEGMENTS_MAX ? line->segment_count : IRIS_FOLLOW_SEGMENTS_MAX;
    for (int32_t i = 0; i < count; i++) {
        iris_floor_line piece;
        if (!piece_of(&piece, floor, &line->segments[i], side)) {
            break;
        }
        if (!goal->found) {
            goal->heading = piece.angle;
        }
        goal->found = 1;
        goal->goal = distance(c, piece.a) >= wanted ? piece.a : piece.b;
        if (distance(c, goal->goal) >= wanted) {
            goal->goal = as_far(c, piece.a, goal->goal, wanted);
            break;
        }
    }
    if (goal->found) {
        uint32_t away = distance(c, goal->goal);
        goal->offset_q16 = goal->goal.x_q16;
        goal->distance_q16 = (iris_q16)(away > INT32_MAX ? INT32_MAX : away);
        goal->steer_permil = steer_for(c, goal);
    }
}

iris_status iris_pursuit_find(iris_pursuit_goal *goal, const iris_floor *floor,
                              const iris_follow_result *line, int32_t side, const iris_pursuit_config *config)
{
    iris_pursuit_config c;
    iris_pursuit_goal found = {0};
    iris_pursuit_defaults(&c);
    if (config) {
        c = *config;
    }
    if (!goal || !floor || !line || !is_valid(&c)) {
        return IRIS_ERR_ARG;
    }
    if (line->state == IRIS_LINE_FOUND) {
        pursue(&found, floor, line, side, &c);
    }
    *goal = found;
    return IRIS_OK;
}

iris_status iris_pursuit_update(iris_command *command, iris_pursuit_goal *goal, iris_steer *steer,
                                const iris_follow_result *line, const iris_pursuit *by, int32_t elapsed_ms)
{
    if (!command || !goal || !steer || !line || !by || !by->floor || (by->config && !is_valid(by->config))) {
        return IRIS_ERR_ARG;
    }
    iris_pursuit_goal found = {0};
    iris_command made;
    (void)iris_steer_update(&made, steer, line, elapsed_ms);
    (void)iris_pursuit_find(&found, by->floor, line, steer->bend, by->config);
    if (found.found) {
        int32_t limit = steer->config.limit_permil;
        int32_t wanted = found.steer_permil;
        steer->steer = wanted > limit ? limit : wanted < -limit ? -limit : wanted;
        steer->side = steer->bend != 0 ? steer->bend : wanted < 0 ? -1 : 1;
        made.steer_permil = steer->steer;
    }
    *command = made;
    *goal = found;
    return IRIS_OK;
}
