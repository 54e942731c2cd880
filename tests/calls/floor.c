/* The floor: fits, points, angles. */
#include "iris/xt/floor.h"

#include "calls.h"

/* Marks of a plain camera 200 mm above the floor, pushed around; rarely anything. */
static void any_marks(iris_floor_mark *marks, int32_t count)
{
    int anything = draw_chance(6);
    for (int32_t i = 0; i < count; i++) {
        int32_t x = draw_within(-300, 300), y = draw_within(150, 900);
        iris_place image = iris_place_of(160 + 300 * x / (y + 100), 20 + 60000 / (y + 100));
        image.x_q16 += draw_within(-30000, 30000);
        marks[i] = (iris_floor_mark){image, iris_place_of(x, y)};
        if (anything) {
            marks[i].image.x_q16 = draw_within(INT32_MIN / 2, INT32_MAX / 2) * 2;
            marks[i].floor.y_q16 = draw_int(-70000, 70000);
        }
    }
}

static void fit(void)
{
    iris_floor_mark marks[9];
    int32_t count = draw_int(0, 9);
    int fits = count >= 0 && count <= 9;
    any_marks(marks, 9);
    iris_floor *floor = OR_NULL(draw_results(sizeof *floor));
    iris_floor_quality *quality = OR_NULL(draw_state(NULL, sizeof *quality));
    iris_size size = draw_size();
    const iris_floor_mark *given = OR_NULL(draw_given(marks, (fits ? (size_t)count : 9) * sizeof *marks));
    count = fits || count < 0 || count > IRIS_FLOOR_MARKS_MAX ? count : 9;
    CALL(iris_floor_fit(floor, quality, size, given, count));
}

static void init(void)
{
    iris_q32 numbers[9];
    for (int i = 0; i < 9; i++) {
        int64_t high = draw_int(-2000, 2000);
        numbers[i] = high * 1048576 + draw_within(-1000000, 1000000);
    }
    iris_floor *floor = OR_NULL(draw_results(sizeof *floor));
    iris_size size = draw_size();
    const iris_q32 *given = OR_NULL(draw_given(numbers, sizeof numbers));
    CALL(iris_floor_init(floor, size, given));
}

/* A floor in memory that is not to be changed; rarely null. */
static const iris_floor *any_floor(void)
{
    iris_floor floor;
    iris_floor_quality quality;
    iris_floor_mark marks[9];
    do {
        any_marks(marks, 9);
    } while (iris_floor_fit(&floor, &quality, (iris_size){320, 240}, marks, 9) != IRIS_OK);
    return OR_NULL(draw_given(&floor, sizeof floor));
}

static iris_place any_place(void)
{
    iris_place place = iris_place_of(draw_int(-400, 700), draw_int(-100, 900));
    return place;
}

static void point(void)
{
    const iris_floor *floor = any_floor();
    iris_place *mm = OR_NULL(draw_results(sizeof *mm)), at = any_place();
    CALL(iris_floor_point(mm, floor, at));
}

static void image(void)
{
    const iris_floor *floor = any_floor();
    iris_place *pixels = OR_NULL(draw_results(sizeof *pixels)), at = any_place();
    CALL(iris_floor_image(pixels, floor, at));
}

static void angle(void)
{
    const iris_floor *floor = any_floor();
    iris_angle *to = OR_NULL(draw_results(sizeof *to)), direction = (iris_angle)draw_within(-32768, 32767);
    iris_place at = any_place();
    CALL(iris_floor_angle(to, floor, at, direction));
}

static void segment(void)
{
    const iris_floor *floor = any_floor();
    iris_floor_line *line = OR_NULL(draw_results(sizeof *line));
    iris_place a = any_place(), b = any_place();
    CALL(iris_floor_segment(line, floor, a, b));
}

static void foot(void)
{
    const iris_floor *floor = any_floor();
    iris_place *mm = OR_NULL(draw_results(sizeof *mm));
    iris_rect box = {draw_int(0, 320), draw_int(0, 240), draw_int(1, 40), draw_int(1, 40)};
    CALL(iris_floor_foot(mm, floor, box));
}

const random_call calls_floor[] = {
    {"iris_floor_fit", fit},     {"iris_floor_init", init},
    {"iris_floor_point", point}, {"iris_floor_image", image},
    {"iris_floor_angle", angle}, {"iris_floor_segment", segment},
    {"iris_floor_foot", foot},   {NULL, NULL},
};
