/* The floor: fits, points, angles, texts, and bird's-eye views. */
#include "iris/xt/birdseye.h"
#include "iris/xt/pursuit.h"

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

static void write_text(void)
{
    const iris_floor *floor = any_floor();
    size_t capacity = draw_chance(3) ? (size_t)draw_within(0, IRIS_FLOOR_TEXT_BYTES) : IRIS_FLOOR_TEXT_BYTES;
    char *text = OR_NULL(draw_results(capacity));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    CALL(iris_floor_write_text(text, capacity, length, floor));
}

static void read_text(void)
{
    char text[IRIS_FLOOR_TEXT_BYTES] = "iris floor 1";
    size_t length = 12;
    const iris_floor *floor = any_floor();
    if (floor) {
        (void)iris_floor_write_text(text, sizeof text, &length, floor);
    }
    if (draw_chance(2)) {
        text[draw_below((uint32_t)length)] ^= (char)draw_below(128);
    }
    iris_floor *to = OR_NULL(draw_results(sizeof *to));
    int32_t *line = OR_NULL(draw_state(NULL, sizeof *line));
    length = draw_chance(4) ? draw_below((uint32_t)length + 1) : length;
    const char *given = OR_NULL(draw_given(text, length));
    CALL(iris_floor_read_text(to, line, given, length));
}

static iris_birdseye_window any_window(void)
{
    iris_birdseye_window window = {.size = draw_size(),
                                   .corner = iris_place_of(draw_within(-300, 100), draw_within(100, 2000)),
                                   .mm_per_pixel_q16 = draw_within(60000, 800000),
                                   .fill = (uint8_t)draw_below(256)};
    if (draw_chance(10)) {
        window.mm_per_pixel_q16 = draw_int(IRIS_BIRDSEYE_SCALE_MIN, IRIS_BIRDSEYE_SCALE_MAX);
    }
    return window;
}

static void birdseye_init(void)
{
    const iris_floor *floor = any_floor();
    iris_birdseye_window window = any_window();
    iris_birdseye *birdseye = OR_NULL(draw_results(sizeof *birdseye));
    const iris_birdseye_window *given = OR_NULL(draw_given(&window, sizeof window));
    CALL(iris_birdseye_init(birdseye, floor, given));
}

/* A view of pictures of this size; rarely null. */
static const iris_birdseye *any_birdseye(iris_size size, iris_size *map)
{
    iris_birdseye birdseye;
    iris_floor floor;
    iris_birdseye_window window = any_window();
    const iris_floor *drawn = any_floor();
    *map = window.size;
    if (!drawn) {
        return NULL;
    }
    floor = *drawn;
    floor.size = size;
    if (iris_birdseye_init(&birdseye, &floor, &window) != IRIS_OK) {
        return NULL;
    }
    return OR_NULL(draw_given(&birdseye, sizeof birdseye));
}

static void birdseye_draw(void)
{
    iris_size size = draw_size(), map;
    iris_format format = draw_gray_or_color();
    const iris_birdseye *birdseye = any_birdseye(size, &map);
    const iris_image *src = draw_input(format, size), *dst = draw_output(format, map);
    CALL(iris_birdseye_draw(dst, src, birdseye));
}

static void birdseye_row(void)
{
    iris_size size = draw_size(), map;
    iris_format format = draw_gray_or_color();
    const iris_birdseye *birdseye = any_birdseye(size, &map);
    const iris_image *src = draw_input(format, size);
    void *pixels = OR_NULL(draw_results(3 * 70));
    int32_t y = draw_int(0, map.h);
    CALL(iris_birdseye_row(pixels, birdseye, src, y));
}

static void birdseye_places(void)
{
    iris_size map;
    const iris_birdseye *birdseye = any_birdseye(draw_size(), &map);
    iris_place *places = OR_NULL(draw_results(70 * sizeof *places));
    int32_t y = draw_int(0, map.h);
    CALL(iris_birdseye_places(places, birdseye, y));
}

static iris_follow_result any_line(void)
{
    iris_follow_result line = {.state = draw_chance(4) ? IRIS_LINE_LOST : IRIS_LINE_FOUND};
    line.segment_count = draw_int(0, IRIS_FOLLOW_SEGMENTS_MAX);
    for (int i = 0; i < IRIS_FOLLOW_SEGMENTS_MAX; i++) {
        int32_t x0 = draw_int(0, 320), y0 = draw_int(0, 240);
        line.segments[i] = (iris_segment){x0, y0, draw_within(0, 320), draw_within(0, 240)};
    }
    return line;
}

static iris_pursuit_config any_pursuit(void)
{
    iris_pursuit_config config = {draw_int(10, 10000), draw_int(1, 100000), draw_int(-10000, 10000)};
    return config;
}

static void pursuit_find(void)
{
    const iris_floor *floor = any_floor();
    iris_follow_result line = any_line();
    iris_pursuit_config config = any_pursuit();
    iris_pursuit_goal *goal = OR_NULL(draw_results(sizeof *goal));
    const iris_follow_result *given = OR_NULL(draw_given(&line, sizeof line));
    const iris_pursuit_config *with = OR_NULL(draw_given(&config, sizeof config));
    int32_t side = draw_int(-1, 1);
    CALL(iris_pursuit_find(goal, floor, given, side, with));
}

static void pursuit_update(void)
{
    iris_follow_result line = any_line();
    iris_pursuit_config config = any_pursuit();
    iris_steer made;
    iris_pursuit by = {any_floor(), OR_NULL(draw_given(&config, sizeof config))};
    (void)iris_steer_init(&made, NULL);
    iris_steer *steer = draw_results(sizeof *steer);
    *steer = made;
    steer = OR_NULL(steer);
    iris_command *command = OR_NULL(draw_results(sizeof *command));
    iris_pursuit_goal *goal = OR_NULL(draw_results(sizeof *goal));
    const iris_follow_result *given = OR_NULL(draw_given(&line, sizeof line));
    const iris_pursuit *with = OR_NULL(draw_given(&by, sizeof by));
    int32_t elapsed_ms = draw_int(0, 60000);
    CALL(iris_pursuit_update(command, goal, steer, given, with, elapsed_ms));
}

const random_call calls_floor[] = {
    {"iris_floor_fit", fit},
    {"iris_floor_init", init},
    {"iris_floor_point", point},
    {"iris_floor_image", image},
    {"iris_floor_angle", angle},
    {"iris_floor_segment", segment},
    {"iris_floor_foot", foot},
    {"iris_floor_write_text", write_text},
    {"iris_floor_read_text", read_text},
    {"iris_birdseye_init", birdseye_init},
    {"iris_birdseye_draw", birdseye_draw},
    {"iris_birdseye_row", birdseye_row},
    {"iris_birdseye_places", birdseye_places},
    {"iris_pursuit_find", pursuit_find},
    {"iris_pursuit_update", pursuit_update},
    {NULL, NULL},
};
