#include "digest.h"

#include "iris/xt/birdseye.h"
#include "iris/xt/pursuit.h"

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
    iris_floor_mark *marks = digest_take(20 * sizeof *marks);
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

static void text(void)
{
    iris_floor *floor = digest_take(sizeof *floor), *again = digest_take(sizeof *again);
    char *made = digest_take(IRIS_FLOOR_TEXT_BYTES);
    size_t length = 0;
    int32_t line = 0;
    if (digest_fit(floor, 7)) {
        digest_number(iris_floor_write_text(made, IRIS_FLOOR_TEXT_BYTES, &length, floor));
        digest_bytes(made, length);
        digest_number(iris_floor_read_text(again, &line, made, length));
        digest_number(again->to_floor[5]);
        digest_number(iris_floor_read_text(again, &line, made, length / 2));
        digest_number(line);
    }
}

static void draw_map(iris_format format)
{
    iris_floor floor;
    iris_birdseye birdseye;
    iris_birdseye_window window = {
        .size = {48, 32}, .corner = iris_place_of(-200, 700), .mm_per_pixel_q16 = 500000, .fill = 9};
    if (!digest_fit(&floor, 9)) {
        return;
    }
    for (int i = 0; i < 6; i++) { /* pictures of 40x30, an eighth of those the marks are of */
        floor.to_image_q32[i] /= 8;
    }
    floor.to_image_q32[1] += 4 * floor.to_image_q32[7]; /* and turned, so that depths change along rows */
    floor.to_image_q32[6] += floor.to_image_q32[7] / 3;
    digest_number(iris_floor_init(&floor, (iris_size){40, 30}, floor.to_image_q32));
    iris_image src = digest_picture(format, 40, 30), dst = digest_canvas(format, 48, 32);
    digest_number(iris_birdseye_init(&birdseye, &floor, &window));
    digest_number(iris_birdseye_draw(&dst, &src, &birdseye));
    digest_view(&dst);
}

static void birdseye_gray(void)
{
    draw_map(IRIS_GRAY8);
}

static void birdseye_color(void)
{
    draw_map(IRIS_RGB888);
}

static void birdseye_places(void)
{
    iris_floor floor;
    iris_birdseye birdseye;
    iris_place *places = digest_take(64 * sizeof *places);
    iris_birdseye_window window = {
        .size = {64, 48}, .corner = iris_place_of(-300, 1400), .mm_per_pixel_q16 = 900000};
    if (!digest_fit(&floor, 9)) {
        return;
    }
    digest_number(iris_birdseye_init(&birdseye, &floor, &window));
    for (int32_t y = 0; y < 48; y += 5) {
        digest_number(iris_birdseye_places(places, &birdseye, y));
        digest_values(places, 64 * sizeof *places, sizeof places->x_q16);
    }
}

static void pursuit(void)
{
    iris_floor floor;
    iris_steer steer;
    iris_pursuit by = {&floor, NULL};
    if (!digest_fit(&floor, 9) || iris_steer_init(&steer, NULL) != IRIS_OK) {
        return;
    }
    for (int32_t frame = 0; frame < 60; frame++) {
        iris_follow_result line = {.state = frame % 20 > 17 ? IRIS_LINE_LOST : IRIS_LINE_FOUND};
        iris_pursuit_goal goal;
        iris_command command;
        int32_t x = 160, y = 239;
        line.segment_count = 1 + frame % 3;
        line.has_next = frame % 10 < 2;
        line.next_angle = (iris_angle)digest_between(-16000, 16000);
        for (int i = 0; i < line.segment_count; i++) {
            int32_t to_x = x + digest_between(-60, 60), to_y = y - digest_between(0, 60);
            line.segments[i] = (iris_segment){x, y, to_x, to_y};
            x = to_x;
            y = to_y;
        }
        digest_number(iris_pursuit_update(&command, &goal, &steer, &line, &by, 33));
        digest_number(command.steer_permil);
        digest_number(goal.found);
        digest_number(goal.offset_q16);
        digest_number(goal.distance_q16);
        digest_number(goal.heading);
        digest_number(goal.steer_permil);
    }
}

const digest_operation digest_floor[] = {
    {"floor.fit", fit},
    {"floor.points", points},
    {"floor.text", text},
    {"floor.birdseye_gray", birdseye_gray},
    {"floor.birdseye_color", birdseye_color},
    {"floor.birdseye_places", birdseye_places},
    {"floor.pursuit", pursuit},
    {NULL, NULL},
};
