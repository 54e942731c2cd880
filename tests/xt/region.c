/* Regions: pictures worked out by hand, the definition followed pixel by pixel, and trees that are none. */
#include "iris/xt/region.h"
#include "../picture.h"

#define SIDE       70
#define LEAVES_MAX (SIDE * SIDE)

static uint8_t pixels[3 * SIDE * SIDE];
static iris_quadtree_leaf leaves[LEAVES_MAX];
static iris_region regions[LEAVES_MAX + 1];
static int32_t labels[LEAVES_MAX + 1];
static IRIS_SCRATCH_BUFFER(memory, IRIS_REGION_SCRATCH_BYTES(SIDE, SIDE, LEAVES_MAX));
static uint32_t state = 3;

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static iris_region_table table_of(int32_t capacity)
{
    return (iris_region_table){regions, capacity, labels, -1};
}

static iris_image view_of(int32_t w, int32_t h, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, pixels, sizeof pixels, (iris_size){w, h}, 0, format), IRIS_OK);
    return image;
}

static iris_quadtree tree_of(const iris_image *image, int32_t tolerance, int32_t least_side)
{
    iris_quadtree tree = {.leaves = leaves, .capacity = LEAVES_MAX};
    assert_int_equal(iris_quadtree_segment(&tree, image, &(iris_quadtree_config){tolerance, least_side}),
                     IRIS_OK);
    return tree;
}

static iris_status merge(iris_region_table *table, const iris_quadtree *tree, int32_t tolerance,
                         int32_t least_area)
{
    iris_scratch scratch = arena(sizeof memory.memory);
    iris_status status =
        iris_region_merge(table, tree, &(iris_region_config){tolerance, least_area}, &scratch);
    assert_int_equal(scratch.used, 0);
    return status;
}

static void assert_region(const iris_region *is, iris_color mean, int32_t area, int32_t count, iris_rect box)
{
    assert_int_equal(is->mean.r, mean.r);
    assert_int_equal(is->mean.g, mean.g);
    assert_int_equal(is->mean.b, mean.b);
    assert_int_equal(is->area, area);
    assert_int_equal(is->leaves, count);
    assert_int_equal(is->box.x, box.x);
    assert_int_equal(is->box.y, box.y);
    assert_int_equal(is->box.w, box.w);
    assert_int_equal(is->box.h, box.h);
}

static void two_squares_by_hand(void **unused)
{
    (void)unused;
    /* 16x16 gray, a white bar of 8x4 at (4, 4) across the middle, and one dark pixel in the last corner. */
    iris_image image = view_of(16, 16, IRIS_GRAY8);
    memset(pixels, 100, sizeof pixels);
    for (int i = 0; i < 32; i++) {
        pixels[(4 + i / 8) * 16 + 4 + i % 8] = 255;
    }
    pixels[255] = 0;
    iris_quadtree tree = tree_of(&image, 51, 1);
    assert_int_equal(tree.count,
                     19); /* 4 + 4 + 1 + (3 + 3 + 4), each of the 4s with one half of the bar; and 1 */
    iris_region_table table = table_of(9);
    assert_int_equal(merge(&table, &tree, 10, 0), IRIS_OK);
    assert_int_equal(table.count, 3);
    assert_region(&regions[0], (iris_color){100, 100, 100}, 256 - 32 - 1, 16, (iris_rect){0, 0, 16, 16});
    assert_region(&regions[1], (iris_color){255, 255, 255}, 32, 2, (iris_rect){4, 4, 8, 4});
    assert_region(&regions[2], (iris_color){0, 0, 0}, 1, 1, (iris_rect){15, 15, 1, 1});
    for (int32_t i = 0; i < tree.count; i++) {
        assert_int_equal(labels[i], leaves[i].mean.r == 100 ? 0 : leaves[i].mean.r == 255 ? 1 : 2);
    }

    /* The one pixel joins: (223 * 100 + 0) / 224 = 99.55. The bar is too far at any area below its own. */
    assert_int_equal(merge(&table, &tree, 10, 32), IRIS_OK);
    assert_int_equal(table.count, 2);
    assert_region(&regions[0], (iris_color){100, 100, 100}, 224, 17, (iris_rect){0, 0, 16, 16});
    assert_int_equal(merge(&table, &tree, 10, 33), IRIS_OK);
    assert_int_equal(table.count, 1);
    assert_int_equal(regions[0].mean.r, 119); /* (22300 + 8160) / 256 = 118.98 */

    /* Only the largest are kept, and labels are those of all. */
    table = table_of(1);
    regions[1].area = 77;
    assert_int_equal(merge(&table, &tree, 10, 0), IRIS_ERR_FULL);
    assert_int_equal(table.count, 3);
    assert_int_equal(regions[0].area, 223);
    assert_int_equal(regions[1].area, 77);
    assert_int_equal(labels[tree.count - 1], 2);
    table = (iris_region_table){NULL, 0, labels, 0};
    assert_int_equal(merge(&table, &tree, 10, 0), IRIS_ERR_FULL);
    assert_int_equal(table.count, 3);
    iris_scratch scratch = arena(sizeof memory.memory);
    table = table_of(9);
    assert_int_equal(iris_region_merge(&table, &tree, NULL, &scratch), IRIS_OK); /* 25 levels, 64 pixels */
    assert_int_equal(table.count, 1);
}

static void corners_do_not_touch(void **unused)
{
    (void)unused;
    iris_image image = view_of(2, 2, IRIS_RGB888);
    const uint8_t checks[12] = {0, 0, 0, 90, 0, 0, 90, 0, 0, 0, 0, 0};
    memcpy(pixels, checks, 12);
    iris_quadtree tree = tree_of(&image, 51, 1);
    iris_region_table table = table_of(4);
    assert_int_equal(merge(&table, &tree, 89, 0), IRIS_OK);
    assert_int_equal(table.count, 4);
    for (int i = 0; i < 4; i++) { /* as large as each other: in the order of their leaves */
        assert_int_equal(labels[i], i);
        assert_region(&regions[i], (iris_color){i % 3 ? 90 : 0, 0, 0}, 1, 1, (iris_rect){i % 2, i / 2, 1, 1});
    }
    assert_int_equal(merge(&table, &tree, 90, 0), IRIS_OK);
    assert_int_equal(table.count, 1);
}

/* Light that changes by 2 levels for each column, all the way from 0 to 126. */
static void slow_light_is_one_region(void **unused)
{
    (void)unused;
    iris_image image = view_of(64, 64, IRIS_GRAY8);
    for (int32_t i = 0; i < 64 * 64; i++) {
        pixels[i] = (uint8_t)(i % 64 * 2);
    }
    iris_region_table table = table_of(LEAVES_MAX);
    iris_quadtree tree = tree_of(&image, 14, 1);
    assert_int_equal(tree.count, 64); /* blocks of 8x8: 14 levels from side to side */
    assert_int_equal(merge(&table, &tree, 16, 0), IRIS_OK);
    assert_int_equal(table.count, 1);
    assert_int_equal(merge(&table, &tree, 15, 0), IRIS_OK); /* 16 from block to block */
    assert_int_equal(table.count, 8);
    tree.tolerance = 13; /* as if they were not even */
    assert_int_equal(merge(&table, &tree, 16, 0), IRIS_OK);
    assert_in_range(table.count, 3, 7);
    tree = tree_of(&image, 5, 1); /* blocks of 2x2, too small to witness: by means alone */
    assert_int_equal(tree.count, 32 * 32);
    assert_int_equal(merge(&table, &tree, 16, 0), IRIS_OK);
    assert_in_range(table.count, 3, 8);
}

/* --- the definition, pixel by pixel --- */

static int32_t of_pixel[SIDE][SIDE];  /* the leaf */
static int32_t region_of[LEAVES_MAX]; /* any number that names its region */

static void region_mean(int *mean, int64_t *area, int32_t name, const iris_quadtree *tree)
{
    double sum[3] = {0, 0, 0};
    *area = 0;
    for (int32_t i = 0; i < tree->count; i++) {
        if (region_of[i] == name) {
            int64_t here = tree->leaves[i].w * tree->leaves[i].h;
            sum[0] += (double)here * tree->leaves[i].mean.r;
            sum[1] += (double)here * tree->leaves[i].mean.g;
            sum[2] += (double)here * tree->leaves[i].mean.b;
            *area += here;
        }
    }
    for (int c = 0; c < 3; c++) {
        mean[c] = (int)(sum[c] / (double)*area + 0.5);
    }
}

static int apart(const int *a, const int *b)
{
    int most = 0;
    for (int c = 0; c < 3; c++) {
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    }
    return most;
}

static int even(const iris_quadtree *tree, const iris_quadtree_leaf *leaf)
{
    return leaf->w >= 4 && leaf->h >= 4 && leaf->range <= tree->tolerance;
}

static void meet(const iris_quadtree *tree, int32_t a, int32_t b, int limit, int tolerance, int least_area)
{
    const iris_quadtree_leaf *p = &tree->leaves[a], *q = &tree->leaves[b];
    int of_p[3] = {p->mean.r, p->mean.g, p->mean.b}, of_q[3] = {q->mean.r, q->mean.g, q->mean.b}, means[2][3];
    int64_t areas[2];
    if (region_of[a] == region_of[b]) {
        return;
    }
    region_mean(means[0], &areas[0], region_of[a], tree);
    region_mean(means[1], &areas[1], region_of[b], tree);
    int between = apart(means[0], means[1]), step = apart(of_p, of_q), joins;
    if (least_area > 0) {
        joins = between <= limit && (areas[0] < least_area || areas[1] < least_area);
    } else {
        joins =
            step <= limit && (between <= tolerance || (step <= tolerance && even(tree, p) && even(tree, q)));
    }
    int32_t from = region_of[a], to = region_of[b];
    for (int32_t i = 0; i < tree->count && joins; i++) {
        region_of[i] = region_of[i] == from ? to : region_of[i];
    }
}

static void reference_round(const iris_quadtree *tree, int limit, int tolerance, int least_area)
{
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        for (int32_t x = leaf->x; x < leaf->x + leaf->w && leaf->y > 0; x++) {
            meet(tree, of_pixel[leaf->y - 1][x], i, limit, tolerance, least_area);
        }
        for (int32_t y = leaf->y; y < leaf->y + leaf->h && leaf->x > 0; y++) {
            meet(tree, of_pixel[y][leaf->x - 1], i, limit, tolerance, least_area);
        }
    }
}

static void reference(const iris_quadtree *tree, int tolerance, int least_area)
{
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        for (int32_t k = 0; k < leaf->w * leaf->h; k++) {
            of_pixel[leaf->y + k / leaf->w][leaf->x + k % leaf->w] = i;
        }
        region_of[i] = i;
    }
    reference_round(tree, 15, tolerance, 0);
    reference_round(tree, 63, tolerance, 0);
    reference_round(tree, 255, tolerance, 0);
    if (least_area > 0) {
        reference_round(tree, 15, 0, least_area);
        reference_round(tree, 63, 0, least_area);
        reference_round(tree, 255, 0, least_area);
    }
}

/* Are labels and table those of region_of? */
static void assert_regions(const iris_region_table *table, const iris_quadtree *tree)
{
    static int32_t label_of[LEAVES_MAX];
    int32_t count = 0;
    for (int32_t i = 0; i < tree->count; i++) {
        label_of[i] = -1;
    }
    for (int32_t i = 0; i < tree->count; i++) {
        int32_t *label = &label_of[region_of[i]];
        count += *label == -1;
        *label = *label == -1 ? labels[i] : *label;
        assert_int_equal(labels[i], *label);
    }
    assert_int_equal(table->count, count);
    int64_t before = INT64_MAX, all = 0;
    int32_t first_before = -1;
    for (int32_t label = 0; label < count; label++) {
        int32_t first = 0, right = 0, below = 0, n = 0;
        int mean[3];
        int64_t area;
        iris_rect box = {SIDE, SIDE, 0, 0};
        while (labels[first] != label) {
            assert_true(++first < tree->count);
        }
        for (int32_t i = first; i < tree->count; i++) {
            const iris_quadtree_leaf *leaf = &tree->leaves[i];
            if (labels[i] == label) {
                n++;
                box.x = leaf->x < box.x ? leaf->x : box.x;
                box.y = leaf->y < box.y ? leaf->y : box.y;
                right = leaf->x + leaf->w > right ? leaf->x + leaf->w : right;
                below = leaf->y + leaf->h > below ? leaf->y + leaf->h : below;
            }
        }
        box.w = right - box.x;
        box.h = below - box.y;
        region_mean(mean, &area, region_of[first], tree);
        assert_true(area < before || (area == before && first > first_before));
        assert_region(&table->regions[label],
                      (iris_color){(uint8_t)mean[0], (uint8_t)mean[1], (uint8_t)mean[2]}, (int32_t)area, n,
                      box);
        before = area;
        first_before = first;
        all += area;
    }
    assert_int_equal(all, tree->size.w * tree->size.h);
}

/* Noise, few levels, patches with noise, and slopes. */
static void paint(int kind)
{
    int shift = (int)(next_random(&state) % 40) + 5;
    for (int32_t i = 0; i < 3 * SIDE * SIDE; i++) {
        int noise = (int)(next_random(&state) & 255), x = i % 90, y = i / 90;
        pixels[i] = (uint8_t)(kind == 0   ? noise
                              : kind == 1 ? noise / 86 * shift
                              : kind == 2 ? (x / shift * 60 + y / shift * 40 + noise / 30) & 255
                                          : (x + y * shift / 9 + noise / 60) & 255);
    }
}

static void as_defined(void **unused)
{
    (void)unused;
    for (int k = 0; k < 120; k++) {
        int32_t most = k % 4 == 0 ? 14 : 34;
        int32_t w = 1 + (int32_t)(next_random(&state) % (uint32_t)most);
        int32_t h = 1 + (int32_t)(next_random(&state) % (uint32_t)most);
        paint(k % 4);
        iris_image image = view_of(w, h, k % 3 ? IRIS_RGB888 : IRIS_GRAY8);
        int32_t tolerance = (int32_t)(next_random(&state) % 60), least = k % 5 == 0 ? 0 : k % 13;
        iris_quadtree tree = tree_of(&image, (int32_t)(next_random(&state) % 90), k % 7 == 0 ? 4 : 1);
        iris_region_table table = table_of(LEAVES_MAX);
        assert_int_equal(merge(&table, &tree, tolerance, least), IRIS_OK);
        reference(&tree, tolerance, least);
        assert_regions(&table, &tree);
        for (int32_t i = 0; i < table.count && table.count > 1; i++) {
            assert_true(regions[i].area >= least);
        }
    }
}

static void extremes(void **unused)
{
    (void)unused;
    paint(0);
    iris_image image = view_of(SIDE, SIDE, IRIS_GRAY8);
    iris_quadtree tree = tree_of(&image, 0, 1);
    iris_region_table table = table_of(LEAVES_MAX);
    assert_int_equal(merge(&table, &tree, 255, 0), IRIS_OK);
    assert_int_equal(table.count, 1);
    assert_int_equal(merge(&table, &tree, 0, INT32_MAX), IRIS_OK);
    assert_int_equal(table.count, 1);
    assert_int_equal(merge(&table, &tree, 0, 0), IRIS_OK);
    assert_in_range(table.count, SIDE * SIDE / 2, SIDE * SIDE);
    image = view_of(1, 1, IRIS_GRAY8);
    tree = tree_of(&image, 0, 1);
    assert_int_equal(merge(&table, &tree, 0, 9), IRIS_OK);
    assert_region(&regions[0], (iris_color){pixels[0], pixels[0], pixels[0]}, 1, 1, (iris_rect){0, 0, 1, 1});

    /* The largest picture there is: sums of 38 bits. */
    iris_quadtree_leaf halves[] = {{0, 0, 16384, 32767, {255, 254, 0}, 0},
                                   {16384, 0, 16383, 32767, {255, 255, 1}, 0}};
    iris_quadtree large = {halves, 2, 2, 2, 0, 1, {32767, 32767}, IRIS_RGB888};
    static IRIS_SCRATCH_BUFFER(sides, IRIS_REGION_SCRATCH_BYTES(32767, 32767, 2));
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, sides.memory, sizeof sides.memory), IRIS_OK);
    assert_int_equal(iris_region_merge(&table, &large, NULL, &scratch), IRIS_OK);
    assert_int_equal(table.count, 1);
    assert_region(&regions[0], (iris_color){255, 254, 0}, 32767 * 32767, 2, (iris_rect){0, 0, 32767, 32767});
}

static void scratch_is_exact(void **unused)
{
    (void)unused;
    paint(2);
    iris_image image = view_of(37, 21, IRIS_RGB888);
    iris_quadtree tree = tree_of(&image, 20, 1);
    size_t bytes = IRIS_REGION_SCRATCH_BYTES(37, 21, tree.count);
    assert_int_equal(IRIS_REGION_SCRATCH_BYTES(37, 21, 1), 32 + 16 + 160 + 96);
    iris_region_table table = table_of(LEAVES_MAX);
    regions[0].area = 77;
    labels[0] = 78;
    iris_scratch scratch = arena(bytes - 1);
    assert_int_equal(iris_region_merge(&table, &tree, NULL, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(table.count, -1);
    assert_int_equal(regions[0].area, 77);
    assert_int_equal(labels[0], 78);
    scratch = arena(bytes);
    assert_int_equal(iris_region_merge(&table, &tree, NULL, &scratch), IRIS_OK);
    assert_int_equal(scratch.peak, bytes);
    assert_int_equal(scratch.used, 0);
}

/* Leaves in another order, or one over another, are no tree, but nothing may break. */
static void trees_that_are_none(void **unused)
{
    (void)unused;
    iris_quadtree_leaf wrong[] = {
        {2, 0, 2, 2, {9, 9, 9}, 0}, {0, 0, 2, 4, {9, 9, 9}, 0}, {1, 1, 2, 2, {9, 9, 9}, 0}};
    iris_quadtree tree = {wrong, 3, 3, 3, 5, 1, {4, 4}, IRIS_GRAY8};
    iris_region_table table = table_of(3);
    assert_int_equal(merge(&table, &tree, 5, 0), IRIS_OK);
    assert_int_equal(table.count, 1);
    assert_int_equal(regions[0].area, 16);
    for (int k = 0; k < 300; k++) { /* any boxes whose areas happen to fit */
        int32_t left = SIDE * SIDE, n = 0;
        while (left > 0) {
            int32_t w = 1 + (int32_t)(next_random(&state) % 20), h = 1 + (int32_t)(next_random(&state) % 20);
            w = w * h > left ? 1 : w;
            h = w * h > left ? 1 : h;
            leaves[n++] = (iris_quadtree_leaf){(uint16_t)(next_random(&state) % (uint32_t)(SIDE - w + 1)),
                                               (uint16_t)(next_random(&state) % (uint32_t)(SIDE - h + 1)),
                                               (uint16_t)w,
                                               (uint16_t)h,
                                               {(uint8_t)(next_random(&state) % 90), 0, 0},
                                               0};
            left -= w * h;
        }
        tree = (iris_quadtree){leaves, n, n, n, 5, 1, {SIDE, SIDE}, IRIS_RGB888};
        table = table_of(2);
        iris_status status = merge(&table, &tree, 9, 30);
        assert_true(status == IRIS_OK || status == IRIS_ERR_FULL);
    }
}

static void wrong_calls_are_refused(void **unused)
{
    (void)unused;
    paint(0);
    iris_image image = view_of(9, 9, IRIS_GRAY8);
    iris_quadtree tree = tree_of(&image, 20, 1), bad = tree;
    iris_scratch scratch = arena(sizeof memory.memory);
    iris_region_table table = table_of(5), other = table;
    assert_int_equal(iris_region_merge(NULL, &tree, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_region_merge(&table, NULL, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_region_merge(&table, &tree, NULL, NULL), IRIS_ERR_ARG);
    other.labels = NULL;
    assert_int_equal(iris_region_merge(&other, &tree, NULL, &scratch), IRIS_ERR_ARG);
    other = table;
    other.regions = NULL;
    assert_int_equal(iris_region_merge(&other, &tree, NULL, &scratch), IRIS_ERR_ARG);
    other = table;
    other.capacity = -1;
    assert_int_equal(iris_region_merge(&other, &tree, NULL, &scratch), IRIS_ERR_ARG);
    static const iris_region_config wrong[] = {{-1, 0}, {256, 0}, {9, -1}};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(iris_region_merge(&table, &tree, &wrong[i], &scratch), IRIS_ERR_ARG);
    }
    bad.count--;
    assert_int_equal(iris_region_merge(&table, &bad, NULL, &scratch), IRIS_ERR_RANGE);
    bad.count = 0;
    assert_int_equal(iris_region_merge(&table, &bad, NULL, &scratch), IRIS_ERR_ARG);
    bad = tree;
    bad.format = IRIS_MASK1;
    assert_int_equal(iris_region_merge(&table, &bad, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(table.count, -1);
    iris_region_defaults(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_squares_by_hand),
        cmocka_unit_test(corners_do_not_touch),
        cmocka_unit_test(slow_light_is_one_region),
        cmocka_unit_test(as_defined),
        cmocka_unit_test(extremes),
        cmocka_unit_test(scratch_is_exact),
        cmocka_unit_test(trees_that_are_none),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("region", tests, NULL, NULL);
}
