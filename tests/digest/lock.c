#include "digest.h"

#include "iris/xt/lock.h"

/* Teaching takes more working memory than there is here: tests/xt/lock.c is about it. */

#define W 22
#define H 14

static void draw(const iris_image *rgb, int32_t x, int32_t y, int32_t r)
{
    for (int32_t i = 0; i < W * H; i++) {
        uint8_t *pixel = (uint8_t *)iris_image_row(rgb, i / W) + (size_t)(3 * (i % W));
        int32_t dx = i % W - x, dy = i / W - y, is_disc = r > 0 && dx * dx + dy * dy <= r * r;
        pixel[0] = (uint8_t)digest_between(is_disc ? 170 : 90, is_disc ? 220 : 110);
        pixel[1] = (uint8_t)digest_between(is_disc ? 30 : 90, is_disc ? 50 : 110);
        pixel[2] = (uint8_t)digest_between(is_disc ? 30 : 90, is_disc ? 50 : 110);
    }
}

/* A red disc moves, is hidden, comes back, jumps, and touches another one. */
static void frames(void)
{
    static const int16_t places[][3] = {{3, 4, 2},  {5, 5, 2},  {7, 6, 2},  {0, 0, -1}, {11, 8, 2},
                                        {18, 3, 2}, {17, 4, 2}, {15, 6, 5}, {0, 0, -1}, {14, 7, 2}};
    iris_lock lock;
    iris_signatures *table = (iris_signatures *)digest_take(sizeof *table);
    iris_image rgb = digest_canvas(IRIS_RGB888, W, H);
    iris_scratch scratch = digest_scratch(IRIS_LOCK_LOOK_BYTES(W, H));
    digest_number(iris_signature_from_range(table, 1, &(iris_hsl_range){340, 20, 30, 100, 10, 90}));
    digest_number(iris_lock_init(&lock, (iris_size){W, H}, table, 1, NULL));
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        iris_lock_result seen = {.id = 0};
        draw(&rgb, places[i][0], places[i][1], places[i][2]);
        digest_number(iris_lock_frame(&seen, &lock, &rgb, &scratch));
        digest_number(seen.state);
        digest_number(seen.id);
        digest_number(seen.age);
        digest_values(&seen.box, sizeof seen.box, 4);
        digest_number(seen.x_q16);
        digest_number(seen.y_q16);
        digest_number(seen.area);
        digest_number(seen.score_permil);
    }
}

const digest_operation digest_lock[] = {
    {"lock.frames", frames},
    {NULL, NULL},
};
