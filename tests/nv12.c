/* NV12. Truth: the same frame written as YUYV, whose conversion tests/color.c holds against BT.601, and pixels by
 * hand. */
#include "iris/nv12.h"
#include "iris/color.h"
#include "test.h"

enum { SIDE = 21 };

static uint8_t luma_bytes[SIDE * SIDE * 2], chroma_bytes[SIDE * SIDE * 2], out[SIDE * SIDE * 4],
    before[sizeof out];

static iris_image wrap(void *buffer, size_t bytes, int32_t w, int32_t h, ptrdiff_t stride, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, stride, format), IRIS_OK);
    return image;
}

static void random_bytes(void *bytes, size_t count, uint32_t seed)
{
    for (size_t i = 0; i < count; i++) {
        seed = seed * 1664525u + 1013904223u;
        ((uint8_t *)bytes)[i] = (uint8_t)(seed >> 24);
    }
}

static void by_hand(void **state)
{
    (void)state;
    /* Black and white squares, gray below them, and a column of red: 3 x 3 pixels with 2 x 2 colors. */
    uint8_t y[9] = {16, 235, 81, 235, 16, 81, 81, 81, 81}, uv[8] = {128, 128, 90, 240, 128, 128, 90, 240};
    const uint8_t expected[27] = {0, 0,   0, 255, 255, 255, 255, 0,  0,  255, 255, 255, 0, 0,
                                  0, 255, 0, 0,   76,  76,  76,  76, 76, 76,  255, 0,   0};
    iris_image luma = wrap(y, sizeof y, 3, 3, 0, IRIS_GRAY8),
               chroma = wrap(uv, sizeof uv, 2, 2, 0, IRIS_UV88);
    iris_image rgb = wrap(out, sizeof out, 3, 3, 0, IRIS_RGB888);
    assert_int_equal(iris_nv12_convert(&rgb, &luma, &chroma), IRIS_OK);
    for (int i = 0; i < 27; i++) {
        assert_true(abs(out[i] - expected[i]) <= 2); /* 8-bit YUV cannot say red exactly */
    }
    assert_memory_equal(out, expected, 6);
}

/* Every size, padded and bottom-up views, all targets: the pixels of a YUYV picture with each pair's color. */
static void the_same_as_yuyv(void **state)
{
    (void)state;
    const iris_format targets[] = {IRIS_RGB888, IRIS_BGR888, IRIS_GRAY8};
    for (int32_t w = 1; w <= SIDE; w++) {
        for (int32_t h = 1; h <= 5; h++) {
            random_bytes(luma_bytes, sizeof luma_bytes, (uint32_t)(w * 100 + h));
            random_bytes(chroma_bytes, sizeof chroma_bytes, (uint32_t)(w * 100 + h + 50));
            int32_t half = (w + 1) / 2;
            iris_image luma = wrap(luma_bytes, sizeof luma_bytes, w, h, w % 2 ? -(w + 3) : 0, IRIS_GRAY8);
            iris_image chroma = wrap(chroma_bytes, sizeof chroma_bytes, half, (h + 1) / 2,
                                     h % 2 ? 2 * half + 1 : -2 * half, IRIS_UV88);
            for (int t = 0; t < 3; t++) {
                size_t pixel = iris_format_row_bytes(targets[t], 1);
                memset(out, 0x5A, sizeof out);
                iris_image dst = wrap(out, sizeof out, w, h, -(3 * SIDE + 5), targets[t]);
                assert_int_equal(iris_nv12_convert(&dst, &luma, &chroma), IRIS_OK);
                for (int32_t y = 0; y < h; y++) {
                    uint8_t yuyv[2 * SIDE + 2], expected[3 * SIDE + 3], row[3 * SIDE + 1];
                    const uint8_t *ys = iris_image_row(&luma, y), *uv = iris_image_row(&chroma, y / 2);
                    for (int32_t x = 0; x < 2 * half; x++) {
                        yuyv[2 * x] = ys[x < w ? x : w - 1];
                        yuyv[2 * x + 1] = uv[x];
                    }
                    assert_int_equal(iris_color_row(expected, targets[t], yuyv, IRIS_YUYV, 2 * half),
                                     IRIS_OK);
                    const uint8_t *made = iris_image_row(&dst, y);
                    assert_memory_equal(made, expected, pixel * (size_t)w);
                    for (size_t i = pixel * (size_t)w; i < 3 * SIDE + 5 && y > 0; i++) {
                        assert_int_equal(made[i], 0x5A);
                    }
                    row[pixel * (size_t)w] = 0x5A;
                    assert_int_equal(iris_nv12_row(row, targets[t], ys, uv, w), IRIS_OK);
                    assert_memory_equal(row, expected, pixel * (size_t)w);
                    assert_int_equal(row[pixel * (size_t)w], 0x5A);
                }
            }
        }
    }
}

/* A part converted is the part of what is converted. */
static void crops_keep_their_colors(void **state)
{
    (void)state;
    static uint8_t whole_bytes[3 * 13 * 9];
    random_bytes(luma_bytes, sizeof luma_bytes, 5);
    random_bytes(chroma_bytes, sizeof chroma_bytes, 6);
    iris_image luma = wrap(luma_bytes, sizeof luma_bytes, 13, 9, 15, IRIS_GRAY8);
    iris_image chroma = wrap(chroma_bytes, sizeof chroma_bytes, 7, 5, 14, IRIS_UV88);
    iris_image whole = wrap(whole_bytes, sizeof whole_bytes, 13, 9, 0, IRIS_RGB888);
    assert_int_equal(iris_nv12_convert(&whole, &luma, &chroma), IRIS_OK);
    for (int32_t x = 0; x < 13; x++) {
        for (int32_t y = 0; y < 9; y++) {
            iris_rect rect = {x, y, (x * 7 + y) % (13 - x) + 1, (x + y * 5) % (9 - y) + 1};
            iris_image luma_part = luma, chroma_part = chroma, part, dst;
            iris_status status = iris_nv12_crop(&luma_part, &chroma_part, &luma_part, &chroma_part, rect);
            if (x % 2 || y % 2) {
                assert_int_equal(status, IRIS_ERR_ALIGN);
                assert_memory_equal(&luma_part, &luma, sizeof luma);
                continue;
            }
            assert_int_equal(status, IRIS_OK);
            dst = wrap(out, sizeof out, rect.w, rect.h, 0, IRIS_RGB888);
            assert_int_equal(iris_nv12_convert(&dst, &luma_part, &chroma_part), IRIS_OK);
            assert_int_equal(iris_image_crop(&part, &whole, rect), IRIS_OK);
            for (int32_t v = 0; v < rect.h; v++) {
                assert_memory_equal(iris_image_row(&dst, v), iris_image_row(&part, v), 3 * (size_t)rect.w);
            }
        }
    }
    iris_image kept = luma, kept_too = chroma;
    assert_int_equal(iris_nv12_crop(&kept, &kept_too, &luma, &chroma, (iris_rect){0, 0, 14, 9}),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_nv12_crop(&kept, &kept_too, &luma, &chroma, (iris_rect){12, 0, 2, 1}),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_nv12_crop(NULL, &kept_too, &luma, &chroma, (iris_rect){0, 0, 1, 1}), IRIS_ERR_ARG);
    assert_int_equal(iris_nv12_crop(&kept, NULL, &luma, &chroma, (iris_rect){0, 0, 1, 1}), IRIS_ERR_ARG);
    assert_int_equal(iris_nv12_crop(&kept, &kept_too, &chroma, &luma, (iris_rect){0, 0, 1, 1}),
                     IRIS_ERR_FORMAT);
    assert_memory_equal(&kept, &luma, sizeof luma);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    memset(out, 0x5A, sizeof out);
    memcpy(before, out, sizeof out);
    iris_image luma = wrap(luma_bytes, sizeof luma_bytes, 6, 5, 0, IRIS_GRAY8);
    iris_image chroma = wrap(chroma_bytes, sizeof chroma_bytes, 3, 3, 0, IRIS_UV88);
    iris_image dst = wrap(out, sizeof out, 6, 5, 0, IRIS_RGB888), bad = dst;
    assert_int_equal(iris_nv12_convert(NULL, &luma, &chroma), IRIS_ERR_ARG);
    assert_int_equal(iris_nv12_convert(&dst, NULL, &chroma), IRIS_ERR_ARG);
    assert_int_equal(iris_nv12_convert(&dst, &luma, NULL), IRIS_ERR_ARG);
    bad.format = IRIS_HSL24;
    assert_int_equal(iris_nv12_convert(&bad, &luma, &chroma), IRIS_ERR_FORMAT);
    assert_int_equal(iris_nv12_convert(&dst, &dst, &chroma), IRIS_ERR_FORMAT);
    assert_int_equal(iris_nv12_convert(&dst, &luma, &luma), IRIS_ERR_FORMAT);
    for (int32_t w = 2; w <= 4; w++) {
        for (int32_t h = 2; h <= 4; h++) {
            iris_image other = wrap(chroma_bytes, sizeof chroma_bytes, w, h, 0, IRIS_UV88);
            assert_int_equal(iris_nv12_convert(&dst, &luma, &other),
                             w == 3 && h == 3 ? IRIS_OK : IRIS_ERR_RANGE);
        }
    }
    memcpy(out, before, sizeof out);
    bad = dst;
    bad.h = 4;
    assert_int_equal(iris_nv12_convert(&bad, &luma, &chroma), IRIS_ERR_RANGE);
    bad = dst;
    bad.data = luma_bytes + 3;
    assert_int_equal(iris_nv12_convert(&bad, &luma, &chroma), IRIS_ERR_ALIAS);
    bad.data = chroma_bytes;
    assert_int_equal(iris_nv12_convert(&bad, &luma, &chroma), IRIS_ERR_ALIAS);
    assert_int_equal(iris_nv12_convert(&luma, &luma, &chroma), IRIS_OK); /* nothing to do */
    assert_int_equal(iris_nv12_row(NULL, IRIS_RGB888, luma_bytes, chroma_bytes, 3), IRIS_ERR_ARG);
    assert_int_equal(iris_nv12_row(out, IRIS_RGB888, NULL, chroma_bytes, 3), IRIS_ERR_ARG);
    assert_int_equal(iris_nv12_row(out, IRIS_RGB888, luma_bytes, NULL, 3), IRIS_ERR_ARG);
    assert_int_equal(iris_nv12_row(out, IRIS_HSL48, luma_bytes, chroma_bytes, 3), IRIS_ERR_FORMAT);
    assert_int_equal(iris_nv12_row(out, IRIS_RGB888, luma_bytes, chroma_bytes, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_nv12_row(out, IRIS_RGB888, luma_bytes, chroma_bytes, IRIS_SIDE_MAX + 1),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_nv12_row(luma_bytes, IRIS_RGB888, luma_bytes, chroma_bytes, 3), IRIS_ERR_ALIAS);
    assert_int_equal(iris_nv12_row(chroma_bytes + 3, IRIS_GRAY8, luma_bytes, chroma_bytes, 3),
                     IRIS_ERR_ALIAS);
    assert_int_equal(iris_nv12_row(luma_bytes, IRIS_GRAY8, luma_bytes, chroma_bytes, 3), IRIS_OK);
    assert_memory_equal(out, before, sizeof out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(the_same_as_yuyv),
        cmocka_unit_test(crops_keep_their_colors),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("nv12", tests, NULL, NULL);
}
