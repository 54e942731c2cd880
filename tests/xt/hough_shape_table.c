/* Tables of shapes: their bytes, what becomes of damaged ones, and silhouettes. */
#include "egg.h"

/* Written out; the CRC is zlib's. */
static void bytes_are_as_the_header_says(void **state)
{
    (void)state;
    static const iris_edge_point eight[8] = {{0, 10, -1},     {10, 0, 0},     {20, 0, 1024},
                                             {0, 10, 1023},   {10, 10, 5000}, {20, 10, 5001},
                                             {0, 20, -32768}, {20, 20, 16384}};
    uint8_t made[IRIS_HOUGH_SHAPE_TABLE_BYTES(8)];
    int32_t entries;
    iris_q16 x, y;
    assert_int_equal(iris_hough_shape_teach(made, sizeof made, &table_bytes, eight, 8, NULL), IRIS_OK);
    assert_int_equal(table_bytes, 198);
    assert_memory_equal(made, "IRSH\1\0\10\0\0\0\12\0\0\0\12\0", 16); /* reference point 10, 10 */
    static const uint8_t sorted[8] = {1, 3, 2, 4, 5, 7, 6, 0};
    for (int i = 0; i < 8; i++) {
        const iris_edge_point *p = &eight[sorted[i]];
        const uint8_t *entry = made + 150 + 6 * i;
        assert_int_equal((int16_t)(entry[0] | entry[1] << 8), (p->x - 10) * 16);
        assert_int_equal((int16_t)(entry[2] | entry[3] << 8), (p->y - 10) * 16);
        assert_int_equal(entry[4] | entry[5] << 8, (uint16_t)p->angle);
    }
    for (int bin = 0; bin <= 64; bin++) {
        int first = 0;
        for (int i = 0; i < 8; i++) {
            first += (uint16_t)eight[i].angle >> 10 < bin;
        }
        assert_int_equal(made[20 + 2 * bin] | made[21 + 2 * bin] << 8, first);
    }
    assert_int_equal(iris_hough_shape_table(&entries, &x, &y, made, sizeof made), IRIS_OK);
    assert_int_equal(entries, 8);
    assert_int_equal(x, 10 * 65536);
    assert_int_equal(y, 10 * 65536);
    assert_int_equal((uint32_t)made[16] | (uint32_t)made[17] << 8 | (uint32_t)made[18] << 16 |
                         (uint32_t)made[19] << 24,
                     0xC54974D5);
}

static void damaged_tables_are_refused(void **state)
{
    (void)state;
    int32_t entries;
    iris_q16 x, y;
    teach(32);
    assert_int_equal(iris_hough_shape_table(&entries, &x, &y, table, table_bytes + 1), IRIS_OK);
    for (size_t i = 0; i < table_bytes; i++) {
        for (int bit = 0; bit < 8; bit++) {
            table[i] ^= (uint8_t)(1 << bit);
            iris_status status = iris_hough_shape_table(&entries, &x, &y, table, table_bytes);
            assert_true(i == 4 || i == 5 ? status == IRIS_ERR_UNSUPPORTED
                                         : status == IRIS_ERR_DATA ||
                                               (status == IRIS_ERR_TRUNCATED && (i == 6 || i == 7)));
            table[i] ^= (uint8_t)(1 << bit);
        }
    }
    for (size_t bytes = 0; bytes < table_bytes; bytes++) {
        uint8_t *cut = malloc(bytes + !bytes); /* flush against what a sanitizer guards */
        memcpy(cut, table, bytes);
        assert_int_equal(iris_hough_shape_table(&entries, &x, &y, cut, bytes), IRIS_ERR_TRUNCATED);
        free(cut);
    }
}

/* Of an entry and a point of like direction, pixels; far when they are not. */
static double distance(const uint8_t *entry, int x_q4, int y_q4, iris_angle angle)
{
    int turn = (int16_t)((entry[4] | entry[5] << 8) - angle);
    return abs(turn) < 8192 ? hypot((int16_t)(entry[0] | entry[1] << 8) - x_q4,
                                    (int16_t)(entry[2] | entry[3] << 8) - y_q4) /
                                  16
                            : 1e9;
}

/* Of many points: what is left out has an entry near by, and entries of like direction keep away from each other. */
static void entries_cover_the_outline(void **state)
{
    (void)state;
    for (int32_t entries = 8; entries <= 200; entries += 24) {
        teach(entries);
        int32_t count = (int32_t)((table_bytes - 150) / 6);
        assert_true(count <= entries && count >= entries * 3 / 4);
        double widest = 0, narrowest = 1e9;
        for (int32_t i = 0; i < outline_count; i++) {
            double nearest = 1e9;
            for (int32_t k = 0; k < count; k++) {
                nearest = fmin(nearest, distance(table + 150 + 6 * k, outline[i].x - 800, outline[i].y - 800,
                                                 outline[i].angle));
            }
            widest = fmax(widest, nearest);
        }
        for (int32_t k = 0; k < count; k++) {
            for (int32_t i = 0; i < k; i++) {
                const uint8_t *b = table + 150 + 6 * i;
                narrowest =
                    fmin(narrowest, distance(table + 150 + 6 * k, (int16_t)(b[0] | b[1] << 8),
                                             (int16_t)(b[2] | b[3] << 8), (int16_t)(b[4] | b[5] << 8)));
            }
        }
        assert_true(widest <= narrowest && narrowest > 0.7 * 200 / entries);
    }
}

static void silhouettes(void **state)
{
    (void)state;
    uint32_t rows[5] = {0, 0x6, 0x6, 0, 0x10}; /* a square of two pixels; one in the lower right corner */
    iris_image mask;
    iris_edge_point p[20];
    int32_t count;
    assert_int_equal(iris_image_wrap(&mask, rows, sizeof rows, (iris_size){5, 5}, 0, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_hough_shape_silhouette(p, 20, &count, &mask), IRIS_OK);
    assert_int_equal(count, 12);
    static const int16_t at[12][2] = {{2, 1}, {4, 1}, {1, 2}, {5, 2}, {1, 4}, {2, 5},
                                      {5, 4}, {4, 5}, {8, 7}, {7, 8}, {9, 8}, {8, 9}};
    for (int i = 0; i < 12; i++) {
        assert_int_equal(p[i].x, at[i][0]);
        assert_int_equal(p[i].y, at[i][1]);
    }
    iris_edge_point first[4];
    memset(first, 0xA5, sizeof first);
    assert_int_equal(iris_hough_shape_silhouette(first, 3, &count, &mask), IRIS_ERR_FULL);
    assert_int_equal(count, 12);
    assert_memory_equal(first, p, 3 * sizeof p[0]);
    assert_int_equal(first[3].x, (int16_t)0xA5A5);
    rows[4] = 0xFFFFFFE0; /* past the width */
    assert_int_equal(iris_hough_shape_silhouette(NULL, 0, &count, &mask), IRIS_ERR_FULL);
    assert_int_equal(count, 8);
    memset(rows, 0, sizeof rows);
    rows[2] = 4; /* a pixel alone: down, right, left, up */
    assert_int_equal(iris_hough_shape_silhouette(p, 20, &count, &mask), IRIS_OK);
    assert_int_equal(count, 4);
    assert_int_equal(p[0].angle, 16384);
    assert_int_equal(p[1].angle, 0);
    assert_int_equal(p[2].angle, -32768);
    assert_int_equal(p[3].angle, -16384);
    mask.format = IRIS_GRAY8;
    mask.w = 4;
    assert_int_equal(iris_hough_shape_silhouette(p, 20, &count, &mask), IRIS_ERR_FORMAT);
}

static void wrong_teaching(void **state)
{
    (void)state;
    uint8_t small[IRIS_HOUGH_SHAPE_TABLE_BYTES(32)];
    size_t bytes = 7;
    iris_hough_shape_teaching by;
    draw_template();
    iris_hough_shape_teaching_defaults(&by);
    by.fraction_bits = 4;
    by.entries = 32;
    memset(small, 0xA5, sizeof small);
    assert_int_equal(iris_hough_shape_teach(NULL, sizeof small, &bytes, outline, outline_count, &by),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_hough_shape_teach(small, sizeof small, &bytes, outline, 7, &by), IRIS_ERR_RANGE);
    by.is_chosen = 1; /* its points are up to 100 pixels to the right */
    by.x_q16 = -1960 * 65536;
    by.y_q16 = 0;
    assert_int_equal(iris_hough_shape_teach(small, sizeof small, &bytes, outline, outline_count, &by),
                     IRIS_ERR_RANGE);
    const iris_hough_shape_teaching wrong[] = {{5, 32, 0, 0, 0},
                                               {-1, 32, 0, 0, 0},
                                               {4, 7, 0, 0, 0},
                                               {4, IRIS_HOUGH_SHAPE_ENTRIES_MAX + 1, 0, 0, 0},
                                               {4, 32, 2, 0, 0}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(
            iris_hough_shape_teach(small, sizeof small, &bytes, outline, outline_count, &wrong[i]),
            IRIS_ERR_ARG);
    }
    assert_int_equal(bytes, 7);
    by.is_chosen = 0;
    assert_int_equal(iris_hough_shape_teach(small, sizeof small - 1, &bytes, outline, outline_count, &by),
                     IRIS_ERR_FULL);
    assert_int_equal(bytes, sizeof small);
    for (size_t i = 0; i < sizeof small; i++) {
        assert_int_equal(small[i], 0xA5);
    }
    assert_int_equal(iris_hough_shape_teach(small, sizeof small, &bytes, outline, outline_count, &by),
                     IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_are_as_the_header_says),
        cmocka_unit_test(damaged_tables_are_refused),
        cmocka_unit_test(entries_cover_the_outline),
        cmocka_unit_test(silhouettes),
        cmocka_unit_test(wrong_teaching),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
