/* Contours: masks worked out by hand; and every border of random, awkward, and real masks against parts and holes found by
 * flooding, pixel by pixel. */
#include "iris/xt/contour.h"
#include "shape_mask.h"

#define MOST 40000

static uint32_t words[(SHAPE_SIDE_MAX / 32 + 4) * SHAPE_SIDE_MAX];
static IRIS_SCRATCH_BUFFER(memory, IRIS_CONTOUR_SCRATCH_BYTES(SHAPE_SIDE_MAX, SHAPE_SIDE_MAX));
static shape drawn;
static iris_contour found[MOST], some[MOST];
static iris_contour_point points[4 * SHAPE_SIDE_MAX * SHAPE_SIDE_MAX];
static uint32_t seed = 11;

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_image drawn_mask(void)
{
    size_t bytes = iris_format_row_bytes(IRIS_MASK1, drawn.w) * (size_t)drawn.h;
    return shape_mask(words, bytes, &drawn, 0, ~0u);
}

static int32_t find(const iris_image *mask)
{
    iris_scratch scratch = arena(IRIS_CONTOUR_SCRATCH_BYTES(mask->w, mask->h));
    int32_t count = -1;
    assert_int_equal(iris_contour_find(found, MOST, &count, mask, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, IRIS_CONTOUR_SCRATCH_BYTES(mask->w, mask->h));
    return count;
}

/* --- the truth: regions by flooding, selected ones over corners, the others over sides; region 0 is the outside --- */

#define SIDE (SHAPE_SIDE_MAX + 2)
static int32_t region[SIDE][SIDE]; /* pixel (x, y) at [y + 1][x + 1] */
static int32_t regions, region_pixels[MOST];

static void flood(int32_t x, int32_t y, int32_t name)
{
    static int32_t stack[SIDE * SIDE];
    int32_t used = 0;
    int of = shape_at(&drawn, x - 1, y - 1);
    stack[used++] = y * SIDE + x;
    region[y][x] = name;
    region_pixels[name] = 0;
    while (used > 0) {
        int32_t at_x = stack[--used] % SIDE, at_y = stack[used] / SIDE;
        region_pixels[name]++;
        for (int k = 0; k < 9; k++) {
            int32_t to_x = at_x + k % 3 - 1, to_y = at_y + k / 3 - 1;
            if ((of || k % 2 == 1) && to_x >= 0 && to_y >= 0 && to_x < drawn.w + 2 && to_y < drawn.h + 2 &&
                region[to_y][to_x] < 0 && shape_at(&drawn, to_x - 1, to_y - 1) == of) {
                region[to_y][to_x] = name;
                stack[used++] = to_y * SIDE + to_x;
            }
        }
    }
}

static void flood_all(void)
{
    regions = 0;
    memset(region, -1, (size_t)(drawn.h + 2) * sizeof region[0]);
    for (int32_t y = 0; y < drawn.h + 2; y++) {
        for (int32_t x = 0; x < drawn.w + 2; x++) {
            if (region[y][x] < 0) {
                flood(x, y, regions++);
            }
        }
    }
}

static int32_t region_at(int32_t x, int32_t y)
{
    return region[y + 1][x + 1];
}

/* The regions inside and outside of a border. */
static int32_t inner(const iris_contour *c)
{
    return region_at(c->x, c->y);
}

static int32_t outer(const iris_contour *c)
{
    return region_at(c->x - 1, c->y);
}

/* How many points of the contour each pixel is. */
static uint8_t times[SHAPE_SIDE_MAX][SHAPE_SIDE_MAX];

static void assert_polygon(const iris_contour *c, const iris_image *mask)
{
    int32_t count = -1, diagonals = 0;
    assert_int_equal(iris_contour_points(points, c->points, &count, c, mask), IRIS_OK);
    assert_int_equal(count, c->points);
    assert_int_equal(points[0].x, c->x - c->is_hole);
    assert_int_equal(points[0].y, c->y);
    int64_t twice_area = 0;
    for (int32_t i = 0; i < count; i++) {
        iris_contour_point a = points[i], b = points[(i + 1) % count];
        int dx = abs(a.x - b.x), dy = abs(a.y - b.y);
        assert_true(dx <= 1 && dy <= 1 && (dx + dy > 0 || count == 1));
        diagonals += dx + dy == 2;
        twice_area += (int64_t)a.x * b.y - (int64_t)a.y * b.x;
        assert_true(times[a.y][a.x] < 4);
        times[a.y][a.x]++;
    }
    assert_int_equal(diagonals, c->diagonals);
    assert_true(c->is_hole ? twice_area < 0 : twice_area >= 0);
}

/* The polygon's pixels are just those of the selected region that touch the other one by a side, and each at most once
 * for each such side. */
static void assert_on_border(const iris_contour *c, const iris_image *mask)
{
    int32_t selected = c->is_hole ? outer(c) : inner(c), other = c->is_hole ? inner(c) : outer(c);
    memset(times, 0, (size_t)drawn.h * sizeof times[0]);
    assert_polygon(c, mask);
    for (int32_t y = 0; y < drawn.h; y++) {
        for (int32_t x = 0; x < drawn.w; x++) {
            int sides = region_at(x - 1, y) == other;
            sides += region_at(x + 1, y) == other;
            sides += region_at(x, y - 1) == other;
            sides += region_at(x, y + 1) == other;
            sides = region_at(x, y) == selected ? sides : 0;
            assert_true(sides > 0 ? times[y][x] >= 1 && times[y][x] <= sides : times[y][x] == 0);
        }
    }
}

/* Each border once, in order, with the right parent, and the pixels that are enclosed. */
static int32_t assert_contours(const iris_image *mask, int polygons)
{
    static int32_t of_region[MOST], enclosed[MOST];
    int32_t count = find(mask);
    flood_all();
    assert_int_equal(count, regions - 1); /* each region but the outside has one border around it */
    memset(of_region, -1, sizeof of_region);
    for (int32_t i = 0; i < count; i++) {
        const iris_contour *c = &found[i];
        assert_int_equal(c->is_hole, !shape_at(&drawn, c->x, c->y));
        assert_true(inner(c) > 0 && of_region[inner(c)] == -1);
        of_region[inner(c)] = i;
        assert_int_equal(c->parent, outer(c) == 0 ? -1 : of_region[outer(c)]);
        assert_true(i == 0 || found[i - 1].y < c->y || (found[i - 1].y == c->y && found[i - 1].x < c->x));
        enclosed[i] = region_pixels[inner(c)];
        if (polygons) {
            assert_on_border(c, mask);
        }
    }
    for (int32_t i = count - 1; i >= 0; i--) {
        assert_int_equal(found[i].area, enclosed[i]);
        if (found[i].parent >= 0) {
            enclosed[found[i].parent] += enclosed[i];
        }
    }
    return count;
}

static void assert_boxes(int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        int32_t name = inner(&found[i]), left = drawn.w, right = -1, top = drawn.h, bottom = -1;
        for (int32_t y = 0; y < drawn.h; y++) {
            for (int32_t x = 0; x < drawn.w; x++) {
                if (region_at(x, y) == name) {
                    left = x < left ? x : left;
                    right = x > right ? x : right;
                    top = y < top ? y : top;
                    bottom = y;
                }
            }
        }
        assert_int_equal(found[i].box.x, left);
        assert_int_equal(found[i].box.y, top);
        assert_int_equal(found[i].box.w, right + 1 - left);
        assert_int_equal(found[i].box.h, bottom + 1 - top);
    }
}

static void assert_drawn(void)
{
    iris_image mask = drawn_mask();
    assert_boxes(assert_contours(&mask, 1));
}

/* --- tests --- */

static void by_hand(void **state)
{
    (void)state;
    shape_draw(&drawn, 7, 6,
               ".#####."
               ".#...#."
               ".#.#.##"
               ".#...#."
               ".#####."
               "#......");
    iris_image mask = drawn_mask();
    assert_int_equal(find(&mask), 3);
    const iris_contour ring = {1, 0, 0, -1, {0, 0, 7, 6}, 27, 18, 4};
    const iris_contour hole = {2, 1, 1, 0, {2, 1, 3, 3}, 9, 12, 4};
    const iris_contour speck = {3, 2, 0, 1, {3, 2, 1, 1}, 1, 1, 0};
    assert_memory_equal(&found[0], &ring, sizeof ring);
    assert_memory_equal(&found[1], &hole, sizeof hole);
    assert_memory_equal(&found[2], &speck, sizeof speck);
    int32_t count = 0;
    assert_int_equal(iris_contour_points(points, 12, &count, &found[1], &mask), IRIS_OK);
    const iris_contour_point around[12] = {{1, 1}, {1, 2}, {1, 3}, {2, 4}, {3, 4}, {4, 4},
                                           {5, 3}, {5, 2}, {5, 1}, {4, 0}, {3, 0}, {2, 0}};
    assert_memory_equal(points, around, sizeof around);
    shape_draw(&drawn, 4, 1, ".##.");
    mask = drawn_mask();
    assert_int_equal(find(&mask), 1);
    assert_int_equal(found[0].points, 2);
    shape_draw(&drawn, 3, 1, "...");
    mask = drawn_mask();
    assert_int_equal(find(&mask), 0);
}

static void draw_random(int32_t w, int32_t h, uint32_t of_256)
{
    drawn.w = w;
    drawn.h = h;
    for (int32_t i = 0; i < w * h; i++) {
        drawn.at[i / w][i % w] = next_random(&seed) % 256 < of_256;
    }
}

static void every_small_mask(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits < 65536; bits++) {
        drawn.w = 4;
        drawn.h = 4;
        for (int32_t i = 0; i < 16; i++) {
            drawn.at[i / 4][i % 4] = bits >> i & 1;
        }
        assert_drawn();
    }
}

static void random_masks(void **state)
{
    (void)state;
    for (int i = 0; i < 120; i++) {
        int32_t w = 1 + (int32_t)(next_random(&seed) % 100), h = 1 + (int32_t)(next_random(&seed) % 24);
        draw_random(w, h, 8 * (1 + (uint32_t)i % 32));
        assert_drawn();
    }
    for (uint32_t i = 0; i < 12; i++) {
        draw_random(340 + (int32_t)i, 402, 20 * i);
        iris_image mask = drawn_mask();
        (void)assert_contours(&mask, 0);
    }
}

/* Rings in rings, checks, combs, holes, a spiral. */
static int awkward(int kind, int32_t x, int32_t y)
{
    int32_t ring = x < y ? x : y;
    ring = drawn.w - 1 - x < ring ? drawn.w - 1 - x : ring;
    ring = drawn.h - 1 - y < ring ? drawn.h - 1 - y : ring;
    switch (kind) {
    case 0:
        return 1;
    case 1:
        return (x + y) % 2;
    case 2:
        return ring % 2;
    case 3:
        return ring % 2 == 0;
    case 4:
        return y == drawn.h / 2 || x % 2;
    case 5:
        return x % 3 != 1 || y % 3 != 1;
    case 6:
        return ring % 2 == 0 ? !(x == ring && y == ring + 1) : x == ring && y == ring;
    case 7:
        return x % 7 == 0 || y % 7 == 0 || (x % 7 == 3 && y % 7 == 3);
    default:
        return ring / 2 % 2 == 0 || (x + y) % 9 == 0;
    }
}

static void awkward_masks(void **state)
{
    (void)state;
    const int32_t sizes[][2] = {{1, 1}, {1, 70}, {70, 1}, {31, 9}, {32, 11}, {33, 12}, {64, 12}, {65, 37}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int kind = 0; kind < 9; kind++) {
            drawn.w = sizes[i][0];
            drawn.h = sizes[i][1];
            for (int32_t k = 0; k < drawn.w * drawn.h; k++) {
                drawn.at[k / drawn.w][k % drawn.w] = (uint8_t)awkward(kind, k % drawn.w, k / drawn.w);
            }
            assert_drawn();
        }
    }
}

static void real_shapes(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPE_NAMES; i++) {
        if (!shape_load(&drawn, shape_name(i))) {
            skip();
        }
        iris_image mask = drawn_mask();
        (void)assert_contours(&mask, 1);
    }
}

static void views_of_every_kind(void **state)
{
    (void)state;
    for (int i = 0; i < 24; i++) {
        draw_random(1 + (int32_t)(next_random(&seed) % 100), 20, 150);
        ptrdiff_t bytes = (drawn.w + 31) / 32 * 4 + 4 * (i % 3);
        iris_image mask =
            shape_mask(words, sizeof words, &drawn, i % 4 < 2 ? bytes : -bytes, i % 2 ? ~0u : 0);
        assert_boxes(assert_contours(&mask, 1));
    }
    draw_random(150, 40, 256); /* a region ends at its edge */
    iris_image all = drawn_mask(), part;
    assert_int_equal(iris_image_crop(&part, &all, (iris_rect){64, 5, 50, 21}), IRIS_OK);
    assert_int_equal(find(&part), 1);
    assert_int_equal(found[0].area, 50 * 21);
    assert_int_equal(found[0].points, 2 * (50 + 21) - 4);
}

/* Too little room: the largest are there, and each one's parent is the nearest kept one around it. */
static void full(void **state)
{
    (void)state;
    for (int round = 0; round < 60; round++) {
        draw_random(80, 50, 100 + 2 * (uint32_t)round);
        iris_image mask = drawn_mask();
        int32_t all = find(&mask), count = -1, kept = 0;
        int32_t capacity = (int32_t)(next_random(&seed) % (uint32_t)all);
        static int32_t name[MOST]; /* index among the kept */
        iris_scratch scratch = arena(IRIS_CONTOUR_SCRATCH_BYTES(80, 50));
        assert_int_equal(iris_contour_find(some, capacity, &count, &mask, &scratch), IRIS_ERR_FULL);
        assert_int_equal(count, all);
        for (int32_t i = 0; i < all; i++) {
            int32_t better = 0, parent = found[i].parent;
            for (int32_t k = 0; k < all; k++) {
                better += found[k].area > found[i].area || (k < i && found[k].area == found[i].area);
            }
            name[i] = better < capacity ? kept++ : -1;
            if (name[i] >= 0) {
                iris_contour expected = found[i];
                assert_true(parent < 0 || name[parent] >= 0);
                expected.parent = parent < 0 ? -1 : name[parent];
                assert_memory_equal(&some[name[i]], &expected, sizeof expected);
            }
        }
        assert_int_equal(kept, capacity);
    }
}

static void few_points(void **state)
{
    (void)state;
    shape_draw(&drawn, 3, 3, "####.####");
    iris_image mask = drawn_mask();
    assert_int_equal(find(&mask), 2);
    int32_t count = -1;
    memset(points, 0x35, sizeof points);
    assert_int_equal(iris_contour_points(points, 3, &count, &found[0], &mask), IRIS_ERR_FULL);
    assert_int_equal(count, 8);
    assert_int_equal(points[2].x, 2);
    assert_int_equal(points[3].x, 0x3535);
    assert_int_equal(iris_contour_points(NULL, 0, &count, &found[0], &mask), IRIS_ERR_FULL);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static uint8_t bytes[32 * 32];
    draw_random(32, 32, 128);
    iris_image mask = drawn_mask(), gray, bad = mask;
    bad.w = 0;
    assert_int_equal(iris_image_wrap(&gray, bytes, sizeof bytes, (iris_size){32, 32}, 0, IRIS_GRAY8),
                     IRIS_OK);
    int32_t count = 77;
    iris_contour none[2] = {{77, 77, 77, 77, {77, 77, 77, 77}, 77, 77, 77}}, first = none[0];
    iris_scratch exact = arena(IRIS_CONTOUR_SCRATCH_BYTES(32, 32));
    iris_scratch less = arena(IRIS_CONTOUR_SCRATCH_BYTES(32, 32) - 1);
    assert_int_equal(iris_contour_find(NULL, 2, &count, &mask, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_find(none, -1, &count, &mask, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_find(none, 2, NULL, &mask, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_find(none, 2, &count, NULL, &exact), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_find(none, 2, &count, &mask, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_find(none, 2, &count, &bad, &exact), IRIS_ERR_RANGE);
    assert_int_equal(iris_contour_find(none, 2, &count, &gray, &exact), IRIS_ERR_FORMAT);
    assert_int_equal(iris_contour_find(none, 2, &count, &mask, &less), IRIS_ERR_SCRATCH);
    iris_contour_point point = {7, 7};
    iris_contour nowhere = {.x = 32, .y = 0}, negative = {.x = 0, .y = INT32_MIN}, within = {.x = 5, .y = 5};
    assert_int_equal(iris_contour_points(NULL, 1, &count, &within, &mask), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_points(&point, -1, &count, &within, &mask), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_points(&point, 1, NULL, &within, &mask), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_points(&point, 1, &count, NULL, &mask), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_points(&point, 1, &count, &within, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_contour_points(&point, 1, &count, &within, &gray), IRIS_ERR_FORMAT);
    assert_int_equal(iris_contour_points(&point, 1, &count, &nowhere, &mask), IRIS_ERR_RANGE);
    assert_int_equal(iris_contour_points(&point, 1, &count, &negative, &mask), IRIS_ERR_RANGE);
    draw_random(32, 32, 256);
    mask = drawn_mask();
    assert_int_equal(iris_contour_points(&point, 1, &count, &within, &mask), IRIS_ERR_RANGE);
    assert_int_equal(count, 77);
    assert_int_equal(point.x, 7);
    assert_memory_equal(&none[0], &first, sizeof first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(every_small_mask),
        cmocka_unit_test(random_masks),
        cmocka_unit_test(awkward_masks),
        cmocka_unit_test(real_shapes),
        cmocka_unit_test(views_of_every_kind),
        cmocka_unit_test(full),
        cmocka_unit_test(few_points),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("contour", tests, NULL, NULL);
}
