/* The line follower over a few frames of 96x60 that are made row by row: no frame exists at any time. */
#include "digest.h"

#include "iris/xt/follow.h"

#include <string.h>

#define W 96
#define H 60

static void digest_result(const iris_follow_result *result)
{
    digest_number(result->state);
    digest_number(result->has_next);
    digest_number(result->angle);
    digest_number(result->next_angle);
    digest_number(result->offset_q16);
    digest_number(result->lookahead_offset_q16);
    digest_number(result->width_px);
    digest_number(result->confidence_permil);
    digest_number(result->segment_count);
    for (int32_t i = 0; i < result->segment_count; i++) {
        digest_values(&result->segments[i], sizeof result->segments[i], 4);
    }
    for (int32_t y = 0; result->rows && y < H; y++) {
        digest_number(result->rows[y].left);
        digest_number(result->rows[y].right);
    }
}

/* Frame t of a course: a line of the given side of the floor (sign -1 dark, 1 bright) that bends, moves, and, in every
 * fifth frame, is not there. `bytes` per pixel. */
static void course_row(uint8_t *row, int32_t y, int32_t t, int32_t sign, int32_t bytes)
{
    int32_t line = 25 + 5 * sign + 3 * bytes + 4 * t + sign * (y - 30) * (y - 30) / 60;
    for (int32_t x = 0; x < W; x++) {
        int32_t level = 110 + x / 4 + digest_between(-6, 6);
        if (t % 5 != 4 && x >= line && x < line + 9) {
            level += sign * 70;
        }
        for (int32_t i = 0; i < bytes; i++) {
            row[x * bytes + i] = (uint8_t)(i == 2 ? level / 3 : level);
        }
    }
}

static void drive(const iris_follow_config *config, int32_t sign, int32_t bytes)
{
    iris_follow *follow = digest_take(sizeof *follow);
    uint8_t *row = digest_take((size_t)(W * bytes));
    iris_scratch scratch = digest_scratch(IRIS_FOLLOW_FULL_SCRATCH_BYTES(W, H));
    digest_number(bytes == 1 ? iris_follow_init(follow, (iris_size){W, H}, config, &scratch)
                             : iris_follow_init_full(follow, (iris_size){W, H}, config, &scratch));
    for (int32_t t = 0; t < 6; t++) {
        iris_follow_result result = {0};
        digest_number(iris_follow_begin(follow));
        for (int32_t y = 0; y < H; y++) {
            course_row(row, y, t, sign, bytes);
            digest_number(iris_follow_row(follow, row));
        }
        digest_number(iris_follow_end(&result, follow, (uint32_t)t * 33u));
        digest_result(&result);
    }
}

/* The same course, whose line is red, in YUYV. */
static void by_signature(void)
{
    const iris_hsl_range red = {330, 20, 30, 100, 5, 90};
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_COLOR;
    config.format = IRIS_YUYV;
    iris_follow *follow = digest_take(sizeof *follow);
    uint8_t *row = digest_take(2 * (size_t)W);
    iris_signatures *signatures = digest_take(sizeof *signatures);
    iris_scratch scratch = digest_scratch(IRIS_FOLLOW_SIGNATURE_SCRATCH_BYTES(W, H));
    memset(signatures, 0, sizeof *signatures);
    digest_number(iris_signature_from_range(signatures, 2, &red));
    digest_number(
        iris_follow_init_signature(follow, (iris_size){W, H}, &config, signatures, 1u << 2, &scratch));
    for (int32_t t = 0; t < 6; t++) {
        iris_follow_result result = {0};
        digest_number(iris_follow_begin(follow));
        for (int32_t y = 0; y < H; y++) {
            course_row(row, y, t, -1, 2);
            for (int32_t x = 0; x < W; x++) {
                row[2 * x + 1] = (uint8_t)(row[2 * x] >= 90 ? 128 : x % 2 ? 200 : 110);
            }
            digest_number(iris_follow_row(follow, row));
        }
        digest_number(iris_follow_end(&result, follow, (uint32_t)t * 33u));
        digest_result(&result);
    }
}

static void dark(void)
{
    drive(NULL, -1, 1);
}

static void bright(void)
{
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_BRIGHT;
    drive(&config, 1, 1);
}

static void dark_in_color_frames(void)
{
    iris_follow_config config;
    iris_follow_defaults(&config);
    config.format = IRIS_RGB888;
    drive(&config, -1, 3);
}

const digest_operation digest_follow[] = {
    {"follow.dark", dark},
    {"follow.bright", bright},
    {"follow.dark_in_color_frames", dark_in_color_frames},
    {"follow.by_signature", by_signature},
    {NULL, NULL},
};
