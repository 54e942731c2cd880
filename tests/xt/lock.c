/* Locking on: drawn sequences of discs whose places are known, one for each thing that may happen. */
#include "iris/xt/lock.h"

#include "test.h"

enum { W = 160, H = 120 };

static uint8_t pixels[W * H * 3];
static iris_signatures table;
static iris_lock lock;
static iris_lock_result seen;
static IRIS_SCRATCH_BUFFER(memory, IRIS_LOCK_SCRATCH_BYTES(W, H));
static uint32_t seed = 1;

static const iris_color RED = {200, 40, 45}, BLUE = {40, 60, 200};

static uint32_t next_random(void)
{
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image view(void *data, size_t bytes, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, data, bytes, (iris_size){W, H}, 0, format), IRIS_OK);
    return image;
}

static void put(int32_t i, iris_color color, int32_t light_percent)
{
    const uint8_t rgb[3] = {color.r, color.g, color.b};
    for (int k = 0; k < 3; k++) {
        int32_t value = rgb[k] * light_percent / 100 + (int32_t)(next_random() % 11) - 5;
        pixels[3 * i + k] = (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
    }
}

/* A room of two grays. */
static void draw_room(int32_t light_percent)
{
    for (int32_t i = 0; i < W * H; i++) {
        put(i, i % W / 20 % 2 ? (iris_color){150, 150, 145} : (iris_color){90, 92, 95}, light_percent);
    }
}

static void draw_disc(int32_t x, int32_t y, int32_t r, iris_color color, int32_t light_percent)
{
    for (int32_t i = 0; i < W * H; i++) {
        int32_t dx = i % W - x, dy = i / W - y;
        if (dx * dx + dy * dy <= r * r) {
            put(i, color, light_percent);
        }
    }
}

static void begin(const iris_lock_config *config)
{
    (void)memset(&table, 0, sizeof table);
    assert_int_equal(iris_lock_init(&lock, (iris_size){W, H}, &table, 2, config), IRIS_OK);
}

static void teach(int32_t x, int32_t y, int32_t r)
{
    iris_image image = view(pixels, sizeof pixels, IRIS_RGB888);
    iris_scratch scratch = arena(sizeof memory);
    iris_rect rect = {x - r, y - r, 2 * r + 1, 2 * r + 1};
    assert_int_equal(iris_lock_teach(&seen, &lock, &image, rect, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
}

static void look(void)
{
    iris_image image = view(pixels, sizeof pixels, IRIS_RGB888);
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_lock_frame(&seen, &lock, &image, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
}

static void assert_found_at(int32_t x, int32_t y, int32_t within)
{
    assert_int_equal(seen.state, IRIS_LOCK_FOUND);
    assert_true(abs(seen.x_q16 - x * 65536) <= within * 65536 &&
                abs(seen.y_q16 - y * 65536) <= within * 65536);
    assert_true(seen.score_permil >= 1 && seen.score_permil <= 1000);
    assert_int_equal(seen.missed, 0);
}

static void assert_not_found(void)
{
    assert_int_not_equal(seen.state, IRIS_LOCK_FOUND);
    assert_int_equal(seen.area, 0);
    assert_int_equal(seen.score_permil, 0);
    if (seen.state == IRIS_LOCK_LOST) {
        assert_int_equal(seen.x_q16 | seen.y_q16 | seen.box.x | seen.box.y | seen.box.w | seen.box.h, 0);
    }
}

/* A red disc at 40, 60 is known. */
static void teach_red(void)
{
    begin(NULL);
    draw_room(100);
    draw_disc(40, 60, 8, RED, 100);
    teach(40, 60, 8);
    assert_found_at(40, 60, 1);
    assert_true(seen.area > 170 && seen.area < 210);
    assert_true(seen.box.x >= 31 && seen.box.w >= 15 && seen.box.w <= 18);
    assert_int_equal(seen.id, 1);
    assert_int_equal(seen.age, 1);
}

static void follows(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 1; t < 20; t++) {
        draw_room(100);
        draw_disc(40 + 5 * t, 60 - 2 * t, 8, RED, 100);
        look();
        assert_found_at(40 + 5 * t, 60 - 2 * t, 1);
        assert_int_equal(seen.id, 1);
        assert_int_equal(seen.age, 1 + t);
    }
}

static void light_goes_and_comes(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 1; t < 40; t++) {
        int32_t light = t < 20 ? 100 - 3 * t : 43 + 4 * (t - 20), x = 40 + 2 * t;
        draw_room(light);
        draw_disc(x, 60, 8, RED, light);
        look();
        assert_found_at(x, 60, 1);
        assert_true(seen.area > 140);
        assert_int_equal(seen.id, 1);
    }
}

static void hidden_for_a_while(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 1; t < 20; t++) {
        draw_room(100);
        if (t < 7 || t > 11) {
            draw_disc(40 + 5 * t, 60, 8, RED, 100);
        }
        look();
        assert_int_equal(seen.age, 1 + t);
        assert_int_equal(seen.id, 1);
        if (t < 7 || t > 11) {
            assert_found_at(40 + 5 * t, 60, 1);
        } else {
            assert_not_found();
            assert_int_equal(seen.state, IRIS_LOCK_COASTING);
            assert_int_equal(seen.missed, t - 6);
            assert_true(abs(seen.x_q16 / 65536 - (40 + 5 * t)) <= 3);
        }
    }
}

/* Another disc of its color, there from the start: it is never taken for the object, hidden or not. */
static void a_similar_one_is_not_it(void **state)
{
    (void)state;
    begin(NULL);
    for (int32_t t = 0; t < 24; t++) {
        int32_t x = 30 + 4 * t;
        draw_room(100);
        draw_disc(100, 85, 8, RED, 100);
        if (t < 13 || t > 17) {
            draw_disc(x, 40, 8, RED, 100);
        }
        t == 0 ? teach(30, 40, 8) : look();
        if (t < 13 || t > 17) {
            assert_found_at(x, 40, 1);
            assert_int_equal(seen.id, 1);
        } else {
            assert_not_found();
        }
    }
}

static void jumps_anywhere(void **state)
{
    (void)state;
    static const int32_t places[][2] = {{120, 20}, {20, 100}, {80, 60}, {140, 100}, {15, 15}, {90, 90}};
    teach_red();
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        draw_room(100);
        draw_disc(places[i][0], places[i][1], 8, RED, 100);
        draw_disc(60, 30, 8, BLUE, 100);
        look();
        assert_found_at(places[i][0], places[i][1], 1);
        assert_int_equal(seen.id, 1);
    }
}

static void in_pieces(void **state)
{
    (void)state;
    teach_red();
    draw_room(100);
    draw_disc(45, 60, 8, RED, 100);
    for (int32_t i = 0; i < W * H; i++) { /* a bar before it, and a cross bar */
        if ((i % W >= 43 && i % W <= 45) || i / W == 63) {
            put(i, (iris_color){40, 40, 40}, 100);
        }
    }
    look();
    assert_found_at(45, 60, 2);
    assert_true(seen.area > 110 && seen.box.w >= 15 && seen.box.h >= 15);
}

/* It touches a large thing of its color, and is still where it is. */
static void before_its_own_color(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 1; t < 12; t++) {
        int32_t x = 40 + 3 * t;
        draw_room(100);
        for (int32_t i = 0; i < W * H; i++) {
            if (i % W >= x + 8 && i % W < x + 60 && t >= 6) {
                put(i, RED, 100);
            }
        }
        draw_disc(x, 60, 8, RED, 100);
        look();
        assert_found_at(x, 60, t < 6 ? 1 : 9);
    }
}

/* The rectangle shows a part of the object: the rest of it is no background. */
static void taught_by_a_part(void **state)
{
    (void)state;
    for (int32_t half = 4; half <= 12; half += 2) {
        begin(NULL);
        for (int32_t t = 0; t < 12; t++) {
            int32_t x = 50 + 4 * t;
            draw_room(100);
            draw_disc(x, 60, 15, RED, 100);
            t == 0 ? teach(x, 60, half) : look();
            assert_found_at(x, 60, 1);
            assert_int_equal(seen.id, 1);
        }
        assert_true(seen.box.w >= 29 && seen.box.w <= 32 && seen.area > 640);
    }
}

/* Another one of its color touches it when it is taught, and goes away. */
static void touched_when_taught(void **state)
{
    (void)state;
    for (int32_t r = 5; r <= 12; r += 7) {
        begin(NULL);
        for (int32_t t = 0; t < 14; t++) {
            int32_t x = 40 + 4 * t;
            draw_room(100);
            if (t < 4) {
                draw_disc(x, 60 + 9 + r, r, RED, 100);
            }
            draw_disc(x, 60, 9, RED, 100);
            t == 0 ? teach(x, 60, 7) : look();
            assert_found_at(x, 60, t < 4 ? 14 : 1); /* 14: where the middle of both is */
            assert_int_equal(seen.id, 1);
        }
        assert_true(seen.box.w >= 17 && seen.box.w <= 20);
    }
}

/* The rectangle is around it, but the room's color is near to its own and goes on: that is no part of it. */
static void what_is_paler_is_not_its_rest(void **state)
{
    (void)state;
    begin(NULL);
    for (int32_t t = 0; t < 10; t++) {
        int32_t x = 40 + 4 * t;
        draw_room(100);
        draw_disc(46, 70, 22, (iris_color){165, 75, 80}, 100);
        draw_disc(x, 60, 8, RED, 100);
        t == 0 ? teach(x, 60, 5) : look();
        assert_found_at(x, 60, 1);
        assert_true(seen.box.w >= 10 && seen.box.w <= 18);
    }
}

/* Its twin touches it for a while: the box stays that of one. */
static void touched_on_the_way(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 1; t < 24; t++) {
        int32_t x = 40 + 4 * t;
        draw_room(100);
        draw_disc(x, 60, 8, RED, 100);
        if (t >= 8 && t < 16) {
            draw_disc(x + 13, 65, 8, RED, 100);
        }
        look();
        assert_found_at(x, 60, t >= 8 && t < 16 ? 6 : 1);
        assert_true(seen.box.w <= 25 && seen.box.h <= 22 && seen.area < 300);
        assert_int_equal(seen.id, 1);
    }
}

/* It comes nearer by up to half of its area at a time: that is the object, all of it. */
static void comes_nearer(void **state)
{
    (void)state;
    static const int32_t radii[] = {8, 9, 11, 13, 16, 18};
    teach_red();
    for (int32_t t = 0; t < 6; t++) {
        draw_room(100);
        draw_disc(45 + 3 * t, 60, radii[t], RED, 100);
        look();
        assert_found_at(45 + 3 * t, 60, 1);
        assert_true(seen.box.w >= 2 * radii[t] - 1);
    }
}

/* The light gets warm, step by step, until the room has the color that the object had: the object is told from it
 * still. */
static void the_room_takes_its_color(void **state)
{
    (void)state;
    begin(NULL);
    for (int32_t t = 0; t < 12; t++) {
        int32_t x = 40 + 4 * t;
        draw_room(100);
        draw_disc(x, 60, 8, (iris_color){120, 90, 75}, 100); /* a pale brown */
        for (int32_t i = 0; i < W * H; i++) {
            pixels[3 * i] = (uint8_t)(pixels[3 * i] + pixels[3 * i] * 3 * t / 100);
            pixels[3 * i + 2] = (uint8_t)(pixels[3 * i + 2] - pixels[3 * i + 2] * 3 * t / 100);
        }
        t == 0 ? teach(x, 60, 8) : look();
        assert_found_at(x, 60, 2);
        assert_int_equal(seen.id, 1);
    }
}

static void gone_means_lost(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 1; t < 40; t++) {
        draw_room(100);
        draw_disc(60, 30, 8, BLUE, 100);
        look();
        assert_not_found();
        assert_int_equal(seen.missed, t);
        assert_int_equal(seen.state, t <= 10 ? IRIS_LOCK_COASTING : IRIS_LOCK_LOST);
    }
    draw_disc(120, 90, 8, RED, 100);
    look();
    assert_found_at(120, 90, 1);
    assert_int_equal(seen.id, 1); /* the same color and size */
    assert_int_equal(seen.age, 41);
}

static void another_one_is_another(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 1; t < 20; t++) {
        draw_room(100);
        look();
    }
    draw_disc(100, 60, 19, RED, 100); /* too large to be the same */
    look();
    assert_found_at(100, 60, 1);
    assert_int_equal(seen.id, 2);
    assert_int_equal(seen.age, 1);
}

static void long_gone_is_forgotten(void **state)
{
    (void)state;
    const iris_lock_config config = {5, 3, 6, 1};
    begin(&config);
    draw_room(100);
    draw_disc(40, 60, 8, RED, 100);
    teach(40, 60, 8);
    for (int32_t t = 1; t < 9; t++) {
        draw_room(100);
        look();
        assert_int_equal(seen.state, t <= 3 ? IRIS_LOCK_COASTING : IRIS_LOCK_LOST);
    }
    draw_disc(42, 60, 8, RED, 100);
    look();
    assert_found_at(42, 60, 1);
    assert_int_equal(seen.id, 2);
}

/* Without a lesson it is the largest blob of a range of colors. */
static void of_a_range(void **state)
{
    (void)state;
    begin(NULL);
    assert_int_equal(iris_signature_from_range(&table, 2, &(iris_hsl_range){340, 20, 40, 100, 10, 90}),
                     IRIS_OK);
    iris_image image = view(pixels, sizeof pixels, IRIS_RGB888);
    iris_scratch scratch = arena(IRIS_LOCK_LOOK_BYTES(W, H)); /* there is nothing to learn */
    draw_room(100);
    assert_int_equal(iris_lock_frame(&seen, &lock, &image, &scratch), IRIS_OK);
    assert_not_found();
    assert_int_equal(seen.id, 0);
    assert_int_equal(seen.age, 0);
    draw_disc(30, 30, 4, RED, 100);
    draw_disc(120, 70, 9, RED, 100);
    assert_int_equal(iris_lock_frame(&seen, &lock, &image, &scratch), IRIS_OK);
    assert_found_at(120, 70, 1);
    assert_int_equal(seen.id, 1);
    assert_int_equal(seen.age, 1);
}

/* The same frames in another format: the same places. */
static void other_formats(void **state)
{
    (void)state;
    static uint16_t other[W * H];
    teach_red();
    (void)memset(&table, 0, sizeof table);
    for (int32_t t = 0; t < 8; t++) {
        draw_room(100);
        draw_disc(40 + 5 * t, 60, 8, RED, 100);
        for (int32_t i = 0; i < W * H; i++) {
            other[i] = (uint16_t)((pixels[3 * i] >> 3) << 11 | (pixels[3 * i + 1] >> 2) << 5 |
                                  pixels[3 * i + 2] >> 3);
        }
        iris_image image = view(other, sizeof other, IRIS_RGB565);
        iris_scratch scratch = arena(sizeof memory);
        assert_int_equal(t == 0 ? iris_lock_teach(&seen, &lock, &image, (iris_rect){32, 52, 17, 17}, &scratch)
                                : iris_lock_frame(&seen, &lock, &image, &scratch),
                         IRIS_OK);
        assert_found_at(40 + 5 * t, 60, 1);
        assert_int_equal(seen.id, 2);
    }
}

/* Whatever comes: results stay within the frame. */
static void noise(void **state)
{
    (void)state;
    teach_red();
    for (int32_t t = 0; t < 60; t++) {
        for (size_t i = 0; i < sizeof pixels; i++) {
            pixels[i] = (uint8_t)next_random();
        }
        if (t % 3 == 0) {
            draw_disc((int32_t)(next_random() % W), (int32_t)(next_random() % H), t, RED, 100);
        }
        look();
        if (seen.state == IRIS_LOCK_FOUND) {
            assert_true(seen.box.x >= 0 && seen.box.y >= 0 && seen.box.x + seen.box.w <= W &&
                        seen.box.y + seen.box.h <= H && seen.area > 0 &&
                        seen.area <= seen.box.w * seen.box.h);
        }
    }
}

static void memory_is_what_the_header_says(void **state)
{
    (void)state;
    iris_image image = view(pixels, sizeof pixels, IRIS_RGB888);
    iris_scratch exact = arena(IRIS_LOCK_SCRATCH_BYTES(W, H)),
                 less = arena(IRIS_LOCK_SCRATCH_BYTES(W, H) - 1);
    iris_scratch look_less = arena(IRIS_LOCK_LOOK_BYTES(W, H) - 1);
    teach_red();
    const iris_lock before = lock;
    const iris_lock_result result = seen;
    assert_int_equal(iris_lock_teach(&seen, &lock, &image, (iris_rect){30, 50, 20, 20}, &less),
                     IRIS_ERR_SCRATCH);
    assert_int_equal(iris_lock_frame(&seen, &lock, &image, &less), IRIS_ERR_SCRATCH);
    lock.config.adapt = 0;
    assert_int_equal(iris_lock_frame(&seen, &lock, &image, &look_less), IRIS_ERR_SCRATCH);
    lock.config.adapt = 1;
    assert_memory_equal(&before, &lock, sizeof lock);
    assert_memory_equal(&result, &seen, sizeof seen);
    assert_int_equal(iris_lock_frame(&seen, &lock, &image, &exact), IRIS_OK);
    assert_int_equal(iris_lock_teach(&seen, &lock, &image, (iris_rect){30, 50, 20, 20}, &exact), IRIS_OK);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static const iris_lock_config wrong[] = {{0, 10, 150, 1}, {5, -1, 150, 1},     {5, 10001, 150, 1},
                                             {5, 10, -1, 1},  {5, 10, 1000001, 1}, {5, 10, 150, 2}};
    const iris_size size = {W, H};
    iris_image image = view(pixels, sizeof pixels, IRIS_RGB888), hsl = image, other = image;
    iris_scratch scratch = arena(sizeof memory);
    const iris_rect rect = {10, 10, 9, 9};
    hsl.format = IRIS_HSL24;
    other.h--;
    begin(NULL);
    const iris_lock before = lock;
    assert_int_equal(iris_lock_init(NULL, size, &table, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_lock_init(&lock, size, NULL, 0, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_lock_init(&lock, size, &table, 8, NULL), IRIS_ERR_RANGE);
    assert_int_equal(iris_lock_init(&lock, (iris_size){0, 5}, &table, 0, NULL), IRIS_ERR_RANGE);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(iris_lock_init(&lock, size, &table, 0, &wrong[i]), IRIS_ERR_ARG);
    }
    seen.area = -5;
    assert_int_equal(iris_lock_frame(NULL, &lock, &image, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_lock_frame(&seen, NULL, &image, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_lock_frame(&seen, &lock, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_lock_frame(&seen, &lock, &image, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_lock_frame(&seen, &lock, &hsl, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_lock_frame(&seen, &lock, &other, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_lock_teach(&seen, &lock, &other, rect, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_lock_teach(&seen, &lock, &hsl, rect, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_lock_teach(NULL, &lock, &image, rect, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_lock_teach(&seen, &lock, &image, (iris_rect){W - 8, 0, 9, 9}, &scratch),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_lock_teach(&seen, &lock, &image, (iris_rect){0, 0, 0, 9}, &scratch),
                     IRIS_ERR_RANGE);
    assert_int_equal(seen.area, -5);
    assert_memory_equal(&before, &lock, sizeof lock);
    iris_lock_defaults(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows),
        cmocka_unit_test(light_goes_and_comes),
        cmocka_unit_test(hidden_for_a_while),
        cmocka_unit_test(a_similar_one_is_not_it),
        cmocka_unit_test(jumps_anywhere),
        cmocka_unit_test(in_pieces),
        cmocka_unit_test(before_its_own_color),
        cmocka_unit_test(taught_by_a_part),
        cmocka_unit_test(touched_when_taught),
        cmocka_unit_test(what_is_paler_is_not_its_rest),
        cmocka_unit_test(touched_on_the_way),
        cmocka_unit_test(comes_nearer),
        cmocka_unit_test(the_room_takes_its_color),
        cmocka_unit_test(gone_means_lost),
        cmocka_unit_test(another_one_is_another),
        cmocka_unit_test(long_gone_is_forgotten),
        cmocka_unit_test(of_a_range),
        cmocka_unit_test(other_formats),
        cmocka_unit_test(noise),
        cmocka_unit_test(memory_is_what_the_header_says),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("lock", tests, NULL, NULL);
}
