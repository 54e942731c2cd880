/* Quadtrees: trees worked out by hand, the definition followed by recursion, and real pictures. */
#include "iris/quadtree.h"
#include "picture.h"

#define SIDE   70
#define STRIDE (3 * SIDE + 7)

static uint8_t pixels[SIDE * STRIDE];
static iris_quadtree_leaf leaves[SIDE * SIDE + 1], expected[SIDE * SIDE + 1];
static uint32_t state = 7;

static iris_image view_of(int32_t w, int32_t h, iris_format format, int upside_down)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){w, h},
                                     upside_down ? -STRIDE : STRIDE, format),
                     IRIS_OK);
    return image;
}

static iris_quadtree tree_in(iris_quadtree_leaf *room, int32_t capacity)
{
    return (iris_quadtree){.leaves = room, .capacity = capacity};
}

static int channels_of(const iris_image *image)
{
    return image->format == IRIS_GRAY8 ? 1 : 3;
}

static int sample(const iris_image *image, int32_t x, int32_t y, int c)
{
    int n = channels_of(image);
    return ((const uint8_t *)iris_image_row(image, y))[x * n + c];
}

/* What is in a block: range, and the exact mean as a color. */
static iris_quadtree_leaf measured(const iris_image *image, int32_t x, int32_t y, int32_t w, int32_t h)
{
    uint8_t mean[3] = {0, 0, 0};
    int range = 0;
    for (int c = 0; c < channels_of(image); c++) {
        int low = 255, high = 0;
        double sum = 0;
        for (int32_t i = 0; i < w * h; i++) {
            int level = sample(image, x + i % w, y + i / w, c);
            low = level < low ? level : low;
            high = level > high ? level : high;
            sum += level;
        }
        range = high - low > range ? high - low : range;
        mean[c] = (uint8_t)(sum / (w * h) + 0.5);
    }
    iris_color color = image->format == IRIS_GRAY8    ? (iris_color){mean[0], mean[0], mean[0]}
                       : image->format == IRIS_RGB888 ? (iris_color){mean[0], mean[1], mean[2]}
                                                      : (iris_color){mean[2], mean[1], mean[0]};
    return (iris_quadtree_leaf){(uint16_t)x, (uint16_t)y, (uint16_t)w, (uint16_t)h, color, (uint8_t)range};
}

/* The definition. Appends the leaves of a block and returns their number. */
static int32_t reference(iris_quadtree_leaf *out, const iris_image *image, iris_rect r, int tolerance,
                         int least)
{
    iris_quadtree_leaf all = measured(image, r.x, r.y, r.w, r.h);
    int32_t right = r.w / 2 >= least ? r.w / 2 : 0, below = r.h / 2 >= least ? r.h / 2 : 0, n = 0;
    if (all.range <= tolerance || (right == 0 && below == 0)) {
        *out = all;
        return 1;
    }
    int32_t left = r.w - right, above = r.h - below;
    for (int quarter = 0; quarter < 4; quarter++) {
        iris_rect part = {r.x + (quarter % 2 ? left : 0), r.y + (quarter / 2 ? above : 0),
                          quarter % 2 ? right : left, quarter / 2 ? below : above};
        if (part.w > 0 && part.h > 0) {
            n += reference(out + n, image, part, tolerance, least);
        }
    }
    return n;
}

static void assert_leaves(const iris_quadtree *tree, const iris_quadtree_leaf *right, int32_t count)
{
    assert_int_equal(tree->count, count);
    for (int32_t i = 0; i < count; i++) {
        const iris_quadtree_leaf *a = &tree->leaves[i], *b = &right[i];
        assert_memory_equal(a, b, sizeof *a);
    }
}

/* Noise, two levels, slopes with noise, and even patches. */
static void paint(int kind)
{
    for (int32_t i = 0; i < SIDE * STRIDE; i++) {
        int x = i % STRIDE, y = i / STRIDE, noise = (int)(next_random(&state) & 255);
        pixels[i] = (uint8_t)(kind == 0   ? noise
                              : kind == 1 ? noise / 128 * 255
                              : kind == 2 ? (x / 2 + y + noise / 32) & 255
                                          : ((x / 27) * 50 + (y / 11) * 30 + noise / 100) & 255);
    }
}

static void a_square_by_hand(void **unused)
{
    (void)unused;
    /* 8x8, black, with a white square at x 4..5, y 0..1, and one gray pixel at (1, 6). */
    iris_image image = view_of(8, 8, IRIS_GRAY8, 0);
    iris_quadtree tree = tree_in(leaves, 64);
    memset(pixels, 0, sizeof pixels);
    for (int i = 0; i < 4; i++) {
        pixels[i / 2 * STRIDE + 4 + i % 2] = 255;
    }
    pixels[6 * STRIDE + 1] = 100;
    const iris_quadtree_leaf right[] = {
        {0, 0, 4, 4, {0, 0, 0}, 0}, {4, 0, 2, 2, {255, 255, 255}, 0}, {6, 0, 2, 2, {0, 0, 0}, 0},
        {4, 2, 2, 2, {0, 0, 0}, 0}, {6, 2, 2, 2, {0, 0, 0}, 0},       {0, 4, 2, 2, {0, 0, 0}, 0},
        {2, 4, 2, 2, {0, 0, 0}, 0}, {0, 6, 1, 1, {0, 0, 0}, 0},       {1, 6, 1, 1, {100, 100, 100}, 0},
        {0, 7, 1, 1, {0, 0, 0}, 0}, {1, 7, 1, 1, {0, 0, 0}, 0},       {2, 6, 2, 2, {0, 0, 0}, 0},
        {4, 4, 4, 4, {0, 0, 0}, 0},
    };
    assert_int_equal(iris_quadtree_segment(&tree, &image, NULL), IRIS_OK);
    assert_leaves(&tree, right, 13);
    assert_int_equal(tree.wanted, 13);
    assert_int_equal(tree.least_side, 1);
    assert_int_equal(tree.size.w, 8);
    assert_int_equal(tree.size.h, 8);
    assert_int_equal(tree.format, IRIS_GRAY8);

    /* With a tolerance of 100 the gray pixel is part of its quarter, whose mean is 100 / 16 = 6.25. */
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){100, 1}), IRIS_OK);
    assert_int_equal(tree.count, 7);
    const iris_quadtree_leaf quarter = {0, 4, 4, 4, {6, 6, 6}, 100};
    assert_memory_equal(&leaves[5], &quarter, sizeof quarter);
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){99, 1}), IRIS_OK);
    assert_int_equal(tree.count, 13);
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){254, 1}), IRIS_OK);
    assert_int_equal(tree.count, 7);
    /* The whole: (4 * 255 + 100) / 64 = 17.5, half up. */
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){255, 1}), IRIS_OK);
    const iris_quadtree_leaf whole = {0, 0, 8, 8, {18, 18, 18}, 255};
    assert_leaves(&tree, &whole, 1);
}

static void odd_sides_by_hand(void **unused)
{
    (void)unused;
    /* 5x3: 5 is 3 and 2, 3 is 2 and 1; with a least side of 2 only the width can be halved. */
    iris_image image = view_of(5, 3, IRIS_RGB888, 0);
    iris_quadtree tree = tree_in(leaves, 64);
    memset(pixels, 10, sizeof pixels);
    pixels[2 * STRIDE + 3 * 4 + 1] = 110; /* green of (4, 2) */
    const iris_quadtree_leaf right[] = {
        {0, 0, 3, 2, {10, 10, 10}, 0}, {3, 0, 2, 2, {10, 10, 10}, 0},  {0, 2, 3, 1, {10, 10, 10}, 0},
        {3, 2, 1, 1, {10, 10, 10}, 0}, {4, 2, 1, 1, {10, 110, 10}, 0},
    };
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){99, 1}), IRIS_OK);
    assert_leaves(&tree, right, 5);
    const iris_quadtree_leaf two[] = {{0, 0, 3, 3, {10, 10, 10}, 0}, {3, 0, 2, 3, {10, 27, 10}, 100}};
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){99, 2}), IRIS_OK);
    assert_leaves(&tree, two, 2); /* 10 + 100 / 6 = 26.67 */
    image.format = IRIS_BGR888;
    pixels[2 * STRIDE + 3 * 4] = 16; /* blue of (4, 2) */
    const iris_quadtree_leaf blue[] = {{0, 0, 3, 3, {10, 10, 10}, 0}, {3, 0, 2, 3, {10, 27, 11}, 100}};
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){99, 2}), IRIS_OK);
    assert_leaves(&tree, blue, 2);
    assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){0, IRIS_SIDE_MAX}),
                     IRIS_OK);
    assert_int_equal(tree.count, 1);
}

/* Every pixel in one leaf, and no leaf before one above it or left of it. */
static void assert_cover(const iris_quadtree *tree)
{
    static int32_t above[SIDE], left[SIDE];
    memset(above, 0, sizeof above);
    memset(left, 0, sizeof left);
    int64_t area = 0;
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        for (int32_t x = leaf->x; x < leaf->x + leaf->w; x++) {
            assert_int_equal(above[x], leaf->y);
            above[x] += leaf->h;
        }
        for (int32_t y = leaf->y; y < leaf->y + leaf->h; y++) {
            assert_int_equal(left[y], leaf->x);
            left[y] += leaf->w;
        }
        area += leaf->w * leaf->h;
    }
    assert_int_equal(area, tree->size.w * tree->size.h);
}

static void assert_within_tolerance(const iris_image *image, const iris_quadtree *tree, int tolerance)
{
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        for (int32_t k = 0; k < leaf->w * leaf->h && leaf->range <= tolerance; k++) {
            for (int c = 0; c < channels_of(image); c++) {
                int mean = (image->format == IRIS_BGR888 ? 2 - c : c) == 0 ? leaf->mean.r
                           : c == 1                                        ? leaf->mean.g
                                                                           : leaf->mean.b;
                int level = sample(image, leaf->x + k % leaf->w, leaf->y + k / leaf->w, c);
                assert_true(abs(level - mean) <= tolerance);
            }
        }
        assert_true(leaf->range <= tolerance || tree->least_side > 1);
    }
}

static void every_size_as_defined(void **unused)
{
    (void)unused;
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    static const int tolerances[] = {0, 1, 12, 51, 120, 254, 255}, least[] = {1, 1, 2, 3, 5, 16, 69, 400};
    for (int32_t w = 1; w <= SIDE; w++) {
        paint(w % 4);
        for (int k = 0; k < 6; k++) {
            int32_t h = k == 0 ? w : 1 + (int32_t)(next_random(&state) % SIDE);
            iris_image image = view_of(w, h, formats[(w + k) % 3], k % 2);
            iris_quadtree tree = tree_in(leaves, SIDE * SIDE);
            iris_quadtree_config by = {tolerances[next_random(&state) % 7], least[next_random(&state) % 8]};
            int32_t count = reference(expected, &image, (iris_rect){0, 0, w, h}, by.tolerance, by.least_side);
            assert_int_equal(iris_quadtree_segment(&tree, &image, &by), IRIS_OK);
            assert_leaves(&tree, expected, count);
            assert_cover(&tree);
            assert_within_tolerance(&image, &tree, by.tolerance);
            for (int32_t i = 0; i < tree.count; i++) {
                assert_true(leaves[i].w >= (w < by.least_side ? w : by.least_side));
                assert_true(leaves[i].h >= (h < by.least_side ? h : by.least_side));
            }
        }
    }
}

static void noise_is_all_pixels(void **unused)
{
    (void)unused;
    for (int32_t i = 0; i < SIDE * STRIDE; i++) { /* no two neighbors alike */
        pixels[i] = (uint8_t)((i % STRIDE + i / STRIDE) % 2 * 128 + (next_random(&state) & 63));
    }
    iris_image image = view_of(SIDE, SIDE, IRIS_GRAY8, 0);
    iris_quadtree tree = tree_in(leaves, SIDE * SIDE);
    assert_int_equal(iris_quadtree_segment(&tree, &image, NULL), IRIS_OK);
    assert_int_equal(tree.count, SIDE * SIDE);
    for (int32_t i = 0; i < tree.count; i++) {
        assert_int_equal(leaves[i].w * leaves[i].h, 1);
        assert_int_equal(leaves[i].mean.g, sample(&image, leaves[i].x, leaves[i].y, 0));
    }
}

/* The longest sides there are, one pixel of which is different: the depth of 15. */
static void the_longest_sides(void **unused)
{
    (void)unused;
    static uint8_t line[IRIS_SIDE_MAX];
    for (int upright = 0; upright < 2; upright++) {
        for (int32_t at = 0; at < IRIS_SIDE_MAX; at += 2978) { /* 11 * 2978 + 8 = 32766 */
            memset(line, 200, sizeof line);
            line[at] = 0;
            iris_image image = {line, upright ? 1 : IRIS_SIDE_MAX, upright ? 1 : IRIS_SIDE_MAX,
                                upright ? IRIS_SIDE_MAX : 1, IRIS_GRAY8};
            iris_quadtree tree = tree_in(leaves, 100);
            assert_int_equal(iris_quadtree_segment(&tree, &image, NULL), IRIS_OK);
            assert_in_range(tree.count, 15, 16);
            int32_t next = 0;
            for (int32_t i = 0; i < tree.count; i++) {
                int32_t start = upright ? leaves[i].y : leaves[i].x,
                        side = upright ? leaves[i].h : leaves[i].w;
                assert_int_equal(start, next);
                assert_int_equal(leaves[i].mean.r, start == at ? 0 : 200);
                assert_true(start != at || side == 1);
                next = start + side;
            }
            assert_int_equal(next, IRIS_SIDE_MAX);
        }
    }
}

/* Sums above 32 bits. */
static void large_blocks_have_exact_means(void **unused)
{
    (void)unused;
    int32_t w = 6000, h = 4000;
    uint8_t *large = malloc((size_t)w * (size_t)h);
    if (!large) {
        skip();
    }
    memset(large, 255, (size_t)w * (size_t)h);
    memset(large, 254, (size_t)w * (size_t)h / 2);
    iris_image image = {large, w, w, h, IRIS_GRAY8};
    iris_quadtree tree = tree_in(leaves, 1);
    assert_int_equal(iris_quadtree_segment(&tree, &image, NULL), IRIS_OK);
    assert_int_equal(leaves[0].mean.r, 255); /* 254.5, half up */
    large[0] = 253;
    assert_int_equal(iris_quadtree_segment(&tree, &image, NULL), IRIS_OK);
    assert_int_equal(leaves[0].mean.r, 254);
    assert_int_equal(leaves[0].range, 2);
    free(large);
}

static void a_full_tree_is_coarser_and_complete(void **unused)
{
    (void)unused;
    paint(2);
    iris_image image = view_of(61, 47, IRIS_RGB888, 1);
    iris_quadtree all = tree_in(expected, SIDE * SIDE);
    iris_quadtree_config by = {9, 1};
    assert_int_equal(iris_quadtree_segment(&all, &image, &by), IRIS_OK);
    assert_int_equal(all.wanted, all.count);
    int32_t wanted = all.count;
    for (int32_t capacity = 1; capacity <= wanted; capacity += capacity < 20 ? 1 : 37) {
        leaves[capacity].range = 77;
        iris_quadtree tree = tree_in(leaves, capacity);
        assert_int_equal(iris_quadtree_segment(&tree, &image, &by), IRIS_ERR_FULL);
        assert_int_equal(leaves[capacity].range, 77);
        assert_int_equal(tree.wanted, wanted);
        assert_cover(&tree);
        /* It is the tree of its least side, and that of half the side would not fit. */
        iris_quadtree_config coarse = {9, tree.least_side}, fine = {9, tree.least_side / 2};
        assert_int_equal(tree.least_side & (tree.least_side - 1), 0);
        assert_int_equal(iris_quadtree_segment(&all, &image, &coarse), IRIS_OK);
        assert_leaves(&tree, expected, all.count);
        assert_int_equal(iris_quadtree_segment(&all, &image, &fine), IRIS_OK);
        assert_true(all.count > capacity);
    }
    iris_quadtree tree = tree_in(leaves, wanted);
    assert_int_equal(iris_quadtree_segment(&tree, &image, &by), IRIS_OK);
    assert_int_equal(tree.count, wanted);
    by.least_side = IRIS_SIDE_MAX;
    tree.capacity = 1;
    assert_int_equal(iris_quadtree_segment(&tree, &image, &by), IRIS_OK);
}

static void crops_see_only_themselves(void **unused)
{
    (void)unused;
    paint(0);
    iris_image whole = view_of(SIDE, SIDE, IRIS_RGB888, 0), part;
    assert_int_equal(iris_image_crop(&part, &whole, (iris_rect){13, 9, 31, 22}), IRIS_OK);
    for (int32_t y = 0; y < part.h; y++) {
        memset(iris_image_row(&part, y), 50, 3 * 31);
    }
    iris_quadtree tree = tree_in(leaves, 1);
    assert_int_equal(iris_quadtree_segment(&tree, &part, &(iris_quadtree_config){0, 1}), IRIS_OK);
    const iris_quadtree_leaf even = {0, 0, 31, 22, {50, 50, 50}, 0};
    assert_leaves(&tree, &even, 1);

    /* And the means are written only there. */
    static uint8_t before[sizeof pixels];
    leaves[0].mean = (iris_color){1, 2, 3};
    memcpy(before, pixels, sizeof pixels);
    assert_int_equal(iris_quadtree_means(&part, &tree), IRIS_OK);
    for (int32_t i = 0; i < SIDE * STRIDE; i++) {
        int32_t x = i % STRIDE / 3, y = i / STRIDE;
        int inside = x >= 13 && x < 44 && y >= 9 && y < 31;
        assert_int_equal(pixels[i], inside ? 1 + i % STRIDE % 3 : before[i]);
    }
}

static void means_by_hand(void **unused)
{
    (void)unused;
    iris_quadtree_leaf two[] = {{0, 0, 2, 2, {10, 20, 30}, 0}, {2, 0, 1, 2, {40, 50, 60}, 9}};
    iris_quadtree tree = {two, 2, 2, 2, 0, 1, {3, 2}, IRIS_RGB888};
    iris_image image = view_of(3, 2, IRIS_BGR888, 0);
    memset(pixels, 7, sizeof pixels);
    assert_int_equal(iris_quadtree_means(&image, &tree), IRIS_OK);
    const uint8_t row[] = {30, 20, 10, 30, 20, 10, 60, 50, 40, 7};
    assert_memory_equal(pixels, row, 10);
    assert_memory_equal(pixels + STRIDE, row, 10);
    assert_int_equal(pixels[2 * STRIDE], 7);
    image.format = IRIS_RGB888;
    assert_int_equal(iris_quadtree_means(&image, &tree), IRIS_OK);
    const uint8_t rgb[] = {10, 20, 30, 10, 20, 30, 40, 50, 60, 7};
    assert_memory_equal(pixels, rgb, 10);
    image.format = IRIS_GRAY8;
    assert_int_equal(iris_quadtree_means(&image, &tree), IRIS_ERR_FORMAT);
    tree.format = IRIS_GRAY8;
    assert_int_equal(iris_quadtree_means(&image, &tree), IRIS_OK);
    const uint8_t gray[] = {10, 10, 40, 10};
    assert_memory_equal(pixels, gray, 4);
}

static void means_reproduce_the_picture(void **unused)
{
    (void)unused;
    static uint8_t copy[sizeof pixels];
    for (int kind = 0; kind < 4; kind++) {
        for (int tolerance = 0; tolerance <= 255; tolerance += 15) {
            paint(kind);
            memcpy(copy, pixels, sizeof pixels);
            iris_image image = view_of(67, 41, tolerance % 2 ? IRIS_RGB888 : IRIS_GRAY8, kind % 2);
            iris_image original = image;
            original.data = copy + ((uint8_t *)image.data - pixels);
            iris_quadtree tree = tree_in(leaves, SIDE * SIDE);
            assert_int_equal(iris_quadtree_segment(&tree, &image, &(iris_quadtree_config){tolerance, 1}),
                             IRIS_OK);
            assert_int_equal(iris_quadtree_means(&image, &tree), IRIS_OK);
            for (int32_t i = 0; i < 67 * 41 * channels_of(&image); i++) {
                int32_t n = channels_of(&image), x = i / n % 67, y = i / n / 67;
                assert_true(abs(sample(&image, x, y, i % n) - sample(&original, x, y, i % n)) <= tolerance);
            }
            assert_int_equal(pixels[67 * 3 + 1], copy[67 * 3 + 1]);
        }
    }
}

static int32_t low_first(const uint8_t *bytes)
{
    return (int32_t)(bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                     (uint32_t)bytes[3] << 24);
}

/* A 24-bit BMP without compression, or a PGM, of the shared data: pixels for free(); null when it is not there. */
static uint8_t *load(iris_image *image, const char *name)
{
    size_t bytes;
    uint8_t *data = NULL;
    if (strstr(name, ".pgm")) {
        picture p = load_pnm(data_path(name));
        *image = (iris_image){p.pixels, p.w, p.w, p.h, IRIS_GRAY8};
        return p.pixels;
    }
    data = load_file(data_path(name), &bytes);
    if (data) {
        int32_t start = low_first(data + 10), w = low_first(data + 18), h = low_first(data + 22);
        ptrdiff_t stride = (3 * w + 3) / 4 * 4;
        *image = (iris_image){data + start + (h - 1) * stride, -stride, w, h, IRIS_BGR888};
    }
    return data;
}

static void real_pictures(void **unused)
{
    (void)unused;
    static const char *const names[] = {"edges/bsds/3063.bmp",          "edges/bsds/69007.pgm",
                                        "edges/classic/camera_256.pgm", "edges/classic/moon_256.pgm",
                                        "colour/fruits_256.bmp",        "colour/baboon_256.bmp"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        iris_image image = {0};
        uint8_t *data = load(&image, names[i]);
        if (!data) {
            print_message("[  SKIPPED ] %s is not there\n", names[i]);
            skip();
        }
        size_t area = (size_t)image.w * (size_t)image.h;
        iris_quadtree_leaf *room = malloc(area * sizeof *room), *right = malloc(area * sizeof *right);
        iris_quadtree tree = tree_in(room, (int32_t)area);
        for (int tolerance = 5; tolerance < 100; tolerance += 45) {
            iris_quadtree_config by = {tolerance, tolerance < 50 ? 1 : 4};
            int32_t count =
                reference(right, &image, (iris_rect){0, 0, image.w, image.h}, tolerance, by.least_side);
            assert_int_equal(iris_quadtree_segment(&tree, &image, &by), IRIS_OK);
            assert_leaves(&tree, right, count);
            assert_within_tolerance(&image, &tree, tolerance);
        }
        free(room);
        free(right);
        free(data);
    }
}

static void wrong_calls_are_refused(void **unused)
{
    (void)unused;
    iris_image image = view_of(20, 20, IRIS_GRAY8, 0), bad;
    iris_quadtree tree = {leaves, 5, -1, -2, -3, -4, {-5, -6}, IRIS_MASK1}, no_room = tree;
    const iris_quadtree before = tree;
    memset(leaves, 0x5A, sizeof leaves);
    assert_int_equal(iris_quadtree_segment(NULL, &image, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_quadtree_segment(&tree, NULL, NULL), IRIS_ERR_ARG);
    no_room.leaves = NULL;
    assert_int_equal(iris_quadtree_segment(&no_room, &image, NULL), IRIS_ERR_ARG);
    no_room = tree;
    no_room.capacity = 0;
    assert_int_equal(iris_quadtree_segment(&no_room, &image, NULL), IRIS_ERR_ARG);
    static const iris_quadtree_config wrong[] = {{-1, 1}, {256, 1}, {9, 0}, {9, -1}, {9, IRIS_SIDE_MAX + 1}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(iris_quadtree_segment(&tree, &image, &wrong[i]), IRIS_ERR_ARG);
    }
    bad = image;
    bad.format = IRIS_HSL24;
    bad.w = 9;
    assert_int_equal(iris_quadtree_segment(&tree, &bad, NULL), IRIS_ERR_FORMAT);
    bad.w = 0;
    assert_int_equal(iris_quadtree_segment(&tree, &bad, NULL), IRIS_ERR_RANGE);
    assert_memory_equal(&tree, &before, sizeof tree);
    assert_int_equal(leaves[0].x, 0x5A5A);
    iris_quadtree_defaults(NULL);
}

static void trees_are_checked(void **unused)
{
    (void)unused;
    iris_image image = view_of(20, 20, IRIS_GRAY8, 0);
    iris_quadtree_leaf two[] = {{0, 0, 12, 20, {9, 9, 9}, 0}, {12, 0, 8, 20, {9, 9, 9}, 0}};
    const iris_quadtree good = {two, 2, 2, 2, 0, 1, {20, 20}, IRIS_GRAY8};
    iris_quadtree bad = good;
    memset(pixels, 3, sizeof pixels);
    assert_int_equal(iris_quadtree_check(&good), IRIS_OK);
    assert_int_equal(iris_quadtree_check(NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_quadtree_means(NULL, &good), IRIS_ERR_ARG);
    assert_int_equal(iris_quadtree_means(&image, NULL), IRIS_ERR_ARG);
    bad.leaves = NULL;
    assert_int_equal(iris_quadtree_means(&image, &bad), IRIS_ERR_ARG);
    bad = good;
    bad.count = 0;
    assert_int_equal(iris_quadtree_means(&image, &bad), IRIS_ERR_ARG);
    bad.count = 1; /* half of the picture */
    assert_int_equal(iris_quadtree_means(&image, &bad), IRIS_ERR_RANGE);
    bad = good;
    bad.format = IRIS_HSL24;
    assert_int_equal(iris_quadtree_means(&image, &bad), IRIS_ERR_FORMAT);
    for (int32_t side = 0; side <= 65536; side += side == 0    ? 19
                                                  : side == 19 ? 2
                                                  : side == 21 ? 32747
                                                               : 32768) {
        bad = good;
        bad.size.w = side;
        assert_int_equal(iris_quadtree_check(&bad), IRIS_ERR_RANGE);
        bad = good;
        bad.size.h = side;
        assert_int_equal(iris_quadtree_means(&image, &bad), IRIS_ERR_RANGE);
    }
    static const iris_quadtree_leaf outside[] = {
        {13, 0, 8, 20, {9, 9, 9}, 0}, {12, 1, 8, 20, {9, 9, 9}, 0},
        {12, 0, 0, 20, {9, 9, 9}, 0}, {12, 0, 8, 0, {9, 9, 9}, 0},
        {11, 0, 9, 20, {9, 9, 9}, 0}, {65535, 65535, 65535, 65535, {9, 9, 9}, 0}};
    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        two[1] = outside[i];
        assert_int_equal(iris_quadtree_check(&good), IRIS_ERR_RANGE);
        assert_int_equal(iris_quadtree_means(&image, &good), IRIS_ERR_RANGE);
    }
    two[1] = (iris_quadtree_leaf){12, 0, 8, 20, {9, 9, 9}, 0};
    image.w = 19;
    assert_int_equal(iris_quadtree_means(&image, &good), IRIS_ERR_RANGE);
    image.format = IRIS_MASK1;
    assert_int_not_equal(iris_quadtree_means(&image, &good), IRIS_OK);
    assert_int_equal(pixels[0], 3);
    image = view_of(20, 20, IRIS_GRAY8, 0);
    assert_int_equal(iris_quadtree_means(&image, &good), IRIS_OK);
    assert_int_equal(pixels[0], 9);
}

static void areas_do_not_wrap(void **unused)
{
    (void)unused;
    /* 2^32 pixels too many: four times the largest picture, 8 rows, and 4 pixels. */
    iris_quadtree_leaf many[7];
    for (int i = 0; i < 7; i++) {
        many[i] =
            (iris_quadtree_leaf){0, 0, i == 6 ? 4 : 32767, i == 6 ? 1 : i == 5 ? 8 : 32767, {9, 9, 9}, 0};
    }
    iris_quadtree bad = {many, 7, 7, 7, 0, 1, {32767, 32767}, IRIS_GRAY8};
    assert_int_equal(iris_quadtree_check(&bad), IRIS_ERR_RANGE);
    bad.count = 1;
    assert_int_equal(iris_quadtree_check(&bad), IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_by_hand),
        cmocka_unit_test(odd_sides_by_hand),
        cmocka_unit_test(every_size_as_defined),
        cmocka_unit_test(noise_is_all_pixels),
        cmocka_unit_test(the_longest_sides),
        cmocka_unit_test(large_blocks_have_exact_means),
        cmocka_unit_test(a_full_tree_is_coarser_and_complete),
        cmocka_unit_test(crops_see_only_themselves),
        cmocka_unit_test(means_by_hand),
        cmocka_unit_test(means_reproduce_the_picture),
        cmocka_unit_test(real_pictures),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(trees_are_checked),
        cmocka_unit_test(areas_do_not_wrap),
    };
    return cmocka_run_group_tests_name("quadtree", tests, NULL, NULL);
}
