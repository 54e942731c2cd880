/* Views: wrap, crop, overlap. Expected values are worked out by hand. */
#include "iris/image.h"
#include "test.h"

static void row_bytes_of_every_kind(void **state)
{
    (void)state;
    assert_int_equal(iris_format_row_bytes(IRIS_GRAY8, 7), 7);
    assert_int_equal(iris_format_row_bytes(IRIS_RGB888, 7), 21);
    assert_int_equal(iris_format_row_bytes(IRIS_HSL48, 7), 42);
    assert_int_equal(iris_format_row_bytes(IRIS_MASK1, 32), 4);
    assert_int_equal(iris_format_row_bytes(IRIS_MASK1, 33), 8);
    assert_int_equal(iris_format_row_bytes(IRIS_YUYV, 6), 12);
    assert_int_equal(iris_format_row_bytes(IRIS_YUYV, 7), 0);
    assert_int_equal(iris_format_row_bytes(IRIS_GRAY8, 0), 0);
    assert_int_equal(iris_format_row_bytes(IRIS_GRAY8, IRIS_SIDE_MAX + 1), 0);
    assert_int_equal(iris_format_row_bytes((iris_format)99, 8), 0);
}

static void wrap_checks_size_and_alignment(void **state)
{
    (void)state;
    static uint32_t words[64];
    uint8_t *bytes = (uint8_t *)words;
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, bytes, 12, (iris_size){4, 3}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(image.stride, 4);
    assert_int_equal(iris_image_wrap(&image, bytes, 11, (iris_size){4, 3}, 0, IRIS_GRAY8), IRIS_ERR_RANGE);
    /* the last row needs no padding: 2 * 8 + 4 */
    assert_int_equal(iris_image_wrap(&image, bytes, 20, (iris_size){4, 3}, 8, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&image, bytes, 19, (iris_size){4, 3}, 8, IRIS_GRAY8), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_wrap(&image, bytes, 64, (iris_size){4, 3}, 3, IRIS_GRAY8), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_wrap(&image, bytes, 64, (iris_size){0, 3}, 0, IRIS_GRAY8), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_wrap(&image, bytes, 64, (iris_size){4, -1}, 0, IRIS_GRAY8), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_wrap(&image, bytes + 2, 64, (iris_size){4, 3}, 0, IRIS_MASK1),
                     IRIS_ERR_ALIGN);
    assert_int_equal(iris_image_wrap(&image, bytes, 64, (iris_size){4, 3}, 6, IRIS_MASK1), IRIS_ERR_ALIGN);
    assert_int_equal(iris_image_wrap(&image, bytes + 1, 64, (iris_size){4, 3}, 0, IRIS_GRAY_U16),
                     IRIS_ERR_ALIGN);
    assert_int_equal(iris_image_wrap(&image, NULL, 64, (iris_size){4, 3}, 0, IRIS_GRAY8), IRIS_ERR_ARG);
    assert_int_equal(iris_image_wrap(&image, bytes, 64, (iris_size){4, 3}, 0, (iris_format)0), IRIS_ERR_ARG);
    assert_int_equal(iris_image_wrap(&image, bytes, SIZE_MAX, (iris_size){4, 2}, PTRDIFF_MIN, IRIS_GRAY8),
                     IRIS_ERR_RANGE); /* no memory is that large */
    assert_int_equal(
        iris_image_wrap(&image, bytes, (size_t)PTRDIFF_MAX + 1, (iris_size){4, 3}, 0, IRIS_GRAY8),
        IRIS_ERR_RANGE);
    assert_int_equal(iris_image_wrap(&image, bytes, SIZE_MAX, (iris_size){4, 3}, PTRDIFF_MIN, IRIS_GRAY8),
                     IRIS_ERR_RANGE);
}

static void bottom_up_view_starts_at_the_last_row(void **state)
{
    (void)state;
    uint8_t bytes[] = {7, 8, 9, 0, 4, 5, 6, 0, 1, 2, 3};
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, bytes, sizeof bytes, (iris_size){3, 3}, -4, IRIS_GRAY8),
                     IRIS_OK);
    for (int y = 0; y < 3; y++) {
        const uint8_t *row = iris_image_row(&image, y);
        assert_int_equal(row[0], 3 * y + 1);
        assert_int_equal(row[2], 3 * y + 3);
    }
    iris_image part;
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){1, 1, 2, 2}), IRIS_OK);
    assert_int_equal(((const uint8_t *)iris_image_row(&part, 0))[0], 5);
    assert_int_equal(((const uint8_t *)iris_image_row(&part, 1))[1], 9);
}

static void crop_is_wholly_inside_or_refused(void **state)
{
    (void)state;
    static uint32_t words[256];
    iris_image image, part = {0};
    assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){16, 16}, 0, IRIS_GRAY8),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){0, 0, 17, 1}), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){15, 15, 1, 2}), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){-1, 0, 4, 4}), IRIS_ERR_RANGE);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){1, 0, INT32_MAX, 4}), IRIS_ERR_RANGE);
    assert_null(part.data);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){15, 15, 1, 1}), IRIS_OK);
    assert_ptr_equal(part.data, (uint8_t *)words + 255);

    assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){70, 8}, 0, IRIS_MASK1),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){8, 0, 8, 8}), IRIS_ERR_ALIGN);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){64, 1, 6, 2}), IRIS_OK);
    assert_ptr_equal(part.data, words + 3 + 2);

    assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){8, 8}, 0, IRIS_BAYER8_RGGB),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){1, 0, 4, 4}), IRIS_OK);
    assert_int_equal(part.format, IRIS_BAYER8_GRBG);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){0, 1, 4, 4}), IRIS_OK);
    assert_int_equal(part.format, IRIS_BAYER8_GBRG);
    assert_int_equal(iris_image_crop(&part, &image, (iris_rect){1, 1, 4, 4}), IRIS_OK);
    assert_int_equal(part.format, IRIS_BAYER8_BGGR);
}

static void overlap_sees_columns_of_one_image(void **state)
{
    (void)state;
    static uint8_t bytes[400];
    iris_image image, a, b;
    assert_int_equal(iris_image_wrap(&image, bytes, sizeof bytes, (iris_size){20, 20}, 0, IRIS_GRAY8),
                     IRIS_OK);
    const struct {
        iris_rect a, b;
        int overlap;
    } cases[] = {
        {{0, 0, 10, 20}, {10, 0, 10, 20}, 0}, {{0, 0, 11, 20}, {10, 0, 10, 20}, 1},
        {{5, 3, 4, 4}, {9, 2, 4, 9}, 0},      {{5, 3, 4, 4}, {8, 6, 4, 9}, 1},
        {{0, 0, 20, 5}, {0, 5, 20, 5}, 0},    {{12, 0, 8, 9}, {0, 1, 12, 3}, 0},
        {{12, 0, 8, 9}, {0, 1, 13, 3}, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(iris_image_crop(&a, &image, cases[i].a), IRIS_OK);
        assert_int_equal(iris_image_crop(&b, &image, cases[i].b), IRIS_OK);
        assert_int_equal(iris_image_overlaps(&a, &b), cases[i].overlap);
        assert_int_equal(iris_image_overlaps(&b, &a), cases[i].overlap);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(row_bytes_of_every_kind),
        cmocka_unit_test(wrap_checks_size_and_alignment),
        cmocka_unit_test(bottom_up_view_starts_at_the_last_row),
        cmocka_unit_test(crop_is_wholly_inside_or_refused),
        cmocka_unit_test(overlap_sees_columns_of_one_image),
    };
    return cmocka_run_group_tests_name("image", tests, NULL, NULL);
}
