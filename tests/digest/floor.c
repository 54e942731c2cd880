#include "digest.h"

#include "iris/xt/floor.h"

/* A camera 200 mm above the floor, by its formula, read off with errors. */
static void draw_marks(iris_floor_mark *marks, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        int32_t x = digest_between(-300, 300), y = digest_between(150, 900);
        marks[i].floor = iris_place_of(x, y);
        marks[i].image = iris_place_of(160 + 300 * x / (y + 100), 20 + 60000 / (y + 100));
        marks[i].image.x_q16 += digest_between(-30000, 30000);
        marks[i].image.y_q16 += digest_between(-30000, 30000);
    }
}

static int digest_fit(iris_floor *floor, int32_t count)
{
    iris_floor_mark marks[20];
    iris_floor_quality quality = {.flaw = IRIS_FLOOR_FINE};
    draw_marks(marks, count);
    iris_status status = iris_floor_fit(floor, &quality, (iris_size){320, 240}, marks, count);
    digest_number(status);
    digest_number(quality.flaw);
    digest_number(quality.worst);
    digest_number(quality.max_px_q16);
    digest_number(quality.rms_px_q16);
    digest_number(quality.max_mm_q16);
    digest_number(quality.rms_mm_q16);
    for (int i = 0; i < 9 && status == IRIS_OK; i++) {
        digest_number(floor->to_image_q32[i]);
        digest_number(floor->to_floor[i]);
    }
    return status == IRIS_OK;
}

static void fit(void)
{
    static const int32_t counts[] = {3, 4, 5, 8, 20};
    iris_floor floor;
    for (int i = 0; i < 5; i++) {
        (void)digest_fit(&floor, counts[i]);
    }
}

static void points(void)
{
    iris_floor floor;
    if (!digest_fit(&floor, 12)) {
        return;
    }
    for (int32_t i = 0; i < 40; i++) {
        iris_place a = iris_place_of(i * 8, 239 - i * 6), b = iris_place_of(160, i * 6), to = {0, 0};
        iris_floor_line line = {{0, 0}, {0, 0}, 0, 0};
        iris_angle angle = 0;
        digest_number(iris_floor_point(&to, &floor, a));
        digest_number(to.x_q16);
        digest_number(to.y_q16);
        digest_number(iris_floor_image(&to, &floor, b));
        digest_number(to.x_q16);
        digest_number(to.y_q16);
        digest_number(iris_floor_angle(&angle, &floor, a, (iris_angle)(i * 1600)));
        digest_number(angle);
        digest_number(iris_floor_segment(&line, &floor, a, b));
        digest_number(line.length_q16);
        digest_number(line.angle);
    }
}

const digest_operation digest_floor[] = {
    {"floor.fit", fit},
    {"floor.points", points},
    {NULL, NULL},
};
