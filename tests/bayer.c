/* Bayer. Truth: a plain reference that asks every neighbor what it saw, constant colors, and a real picture behind
 * the filter. */
#include "iris/bayer.h"
#include "bmp_decode.h"

#include <math.h>

enum { SIDE = 150 };

static const iris_format orders[] = {IRIS_BAYER8_RGGB, IRIS_BAYER8_GRBG, IRIS_BAYER8_GBRG, IRIS_BAYER8_BGGR};
static const char *const letters[] = {"RGGB", "GRBG", "GBRG", "BGGR"};
static uint8_t raw[SIDE * 8], out[SIDE * 8 * 4];

static iris_image wrap(void *buffer, size_t bytes, int32_t w, int32_t h, ptrdiff_t stride, iris_format format)
{
    iris_image image;
    assert_int_equal(iris_image_wrap(&image, buffer, bytes, (iris_size){w, h}, stride, format), IRIS_OK);
    return image;
}

/* What pixel (x, y) saw: 0 red, 1 green, 2 blue. */
static int seen_by(int order, int32_t x, int32_t y)
{
    char letter = letters[order][2 * (y & 1) + (x & 1)];
    return letter == 'R' ? 0 : letter == 'G' ? 1 : 2;
}

static int32_t mirrored(int32_t i, int32_t n)
{
    return n == 1 ? 0 : i < 0 ? -i : i >= n ? 2 * n - 2 - i : i;
}

/* The mean of those of the eight neighbors that saw this color: the four beside it for a green one. */
static int reference(const iris_image *src, int order, int32_t x, int32_t y, int color)
{
    const uint8_t *row = iris_image_row(src, y);
    if (seen_by(order, x, y) == color) {
        return row[x];
    }
    double sum = 0, count = 0;
    for (int32_t v = y - 1; v <= y + 1; v++) {
        for (int32_t u = x - 1; u <= x + 1; u++) {
            if (seen_by(order, u, v) == color) {
                row = iris_image_row(src, mirrored(v, src->h));
                sum += row[mirrored(u, src->w)];
                count++;
            }
        }
    }
    return (int)floor(sum / count + 0.5);
}

static void assert_demosaiced(const iris_image *dst, const iris_image *src, int order)
{
    for (int32_t y = 0; y < src->h; y++) {
        const uint8_t *row = iris_image_row(dst, y);
        for (int32_t x = 0; x < src->w; x++) {
            int color[3];
            for (int c = 0; c < 3; c++) {
                color[c] = reference(src, order, x, y, c);
            }
            if (dst->format == IRIS_GRAY8) {
                assert_int_equal(row[x], (77 * color[0] + 150 * color[1] + 29 * color[2] + 128) / 256);
            }
            for (int c = 0; c < 3 && dst->format != IRIS_GRAY8; c++) {
                assert_int_equal(row[3 * x + c], color[dst->format == IRIS_BGR888 ? 2 - c : c]);
            }
        }
    }
}

static void by_hand(void **state)
{
    (void)state;
    uint8_t pixels[] = {10, 20, 30, 40, /* R G R G */
                        50, 60, 70, 80, /* G B G B */
                        90, 11, 22, 33};
    /* (1, 1) is blue: green of 20 50 70 11, red of 10 30 90 22. (2, 1) is green: red above and below, blue beside. */
    iris_image src = wrap(pixels, sizeof pixels, 4, 3, 0, IRIS_BAYER8_RGGB);
    iris_image dst = wrap(out, sizeof out, 4, 3, 0, IRIS_RGB888);
    assert_int_equal(iris_bayer_convert(&dst, &src), IRIS_OK);
    const uint8_t expected[] = {38, 38, 60, 26, 70, 70};
    assert_memory_equal(out + 3 * 5, expected, 6);
    const uint8_t corner[] = {10, 35, 60}; /* green: 20 twice and 50 twice; blue: 60 four times */
    assert_memory_equal(out, corner, 3);
}

static void against_the_reference(void **state)
{
    (void)state;
    const iris_format targets[] = {IRIS_RGB888, IRIS_BGR888, IRIS_GRAY8};
    const int32_t widths[] = {1, 2, 3, 4, 5, 6, 7, 8, 31, 63, 64, 65, 66, 67, 127, 128, 129, 130};
    uint32_t seed = 1;
    for (size_t i = 0; i < sizeof widths / sizeof widths[0]; i++) {
        for (int32_t h = 1; h <= 5; h++) {
            for (int k = 0; k < 12; k++) {
                for (size_t b = 0; b < sizeof raw; b++) {
                    uint32_t next = next_random(&seed);
                    raw[b] = (uint8_t)(h % 2 ? next : next % 2 * 255);
                }
                int32_t w = widths[i];
                iris_image src = wrap(raw, sizeof raw, w, h, k % 2 ? -(w + 2) : w + 1, orders[k % 4]);
                iris_image dst = wrap(out, sizeof out, w, h, -(3 * w + 7), targets[k / 4]);
                memset(out, 0x5A, sizeof out);
                assert_int_equal(iris_bayer_convert(&dst, &src), IRIS_OK);
                assert_demosaiced(&dst, &src, k % 4);
                for (size_t p = iris_format_row_bytes(targets[k / 4], w); p < 3 * (size_t)w + 7; p++) {
                    assert_int_equal(((uint8_t *)iris_image_row(&dst, 0))[p], 0x5A);
                }
            }
        }
    }
}

/* The three rows, as a sensor would have them. */
static void rows_give_the_pixels_of_the_picture(void **state)
{
    (void)state;
    uint32_t seed = 9;
    for (size_t b = 0; b < sizeof raw; b++) {
        raw[b] = (uint8_t)next_random(&seed);
    }
    for (int order = 0; order < 4; order++) {
        iris_image src = wrap(raw, sizeof raw, 67, 5, 0, orders[order]);
        iris_image dst = wrap(out, sizeof out, 67, 5, 0, IRIS_BGR888);
        assert_int_equal(iris_bayer_convert(&dst, &src), IRIS_OK);
        for (int32_t y = 0; y < 5; y++) {
            iris_image below; /* the order of a picture that begins with this row */
            assert_int_equal(iris_image_crop(&below, &src, (iris_rect){0, y, 67, 1}), IRIS_OK);
            const uint8_t *rows[3] = {raw + 67 * mirrored(y - 1, 5), raw + 67 * y,
                                      raw + 67 * mirrored(y + 1, 5)};
            uint8_t row[3 * 67 + 1];
            row[3 * 67] = 0x5A;
            assert_int_equal(iris_bayer_row(row, IRIS_BGR888, rows, below.format, 67), IRIS_OK);
            assert_memory_equal(row, iris_image_row(&dst, y), 3 * 67);
            assert_int_equal(row[3 * 67], 0x5A);
        }
    }
}

static void a_constant_color_stays_what_it_is(void **state)
{
    (void)state;
    const uint8_t color[3] = {201, 30, 77};
    for (int order = 0; order < 4; order++) {
        iris_image whole = wrap(raw, sizeof raw, 21, 8, 0, orders[order]), src;
        for (int32_t i = 0; i < 21 * 8; i++) {
            raw[i] = color[seen_by(order, i % 21, i / 21)];
        }
        for (int32_t y = 0; y < 6; y++) { /* crops at any offset, two pixels and more */
            for (int32_t x = 0; x < 6; x++) {
                assert_int_equal(iris_image_crop(&src, &whole, (iris_rect){x, y, 15 - 2 * x, 8 - y}),
                                 IRIS_OK);
                iris_image dst = wrap(out, sizeof out, src.w, src.h, 0, IRIS_RGB888);
                assert_int_equal(iris_bayer_convert(&dst, &src), IRIS_OK);
                for (int32_t i = 0; i < src.w * src.h; i++) {
                    assert_memory_equal(out + 3 * i, color, 3);
                }
            }
        }
    }
}

static double psnr(const picture *image, const uint8_t *made)
{
    double sum = 0;
    int32_t values = image->w * image->h * 3;
    for (int32_t i = 0; i < values; i++) {
        double off = image->pixels[i] - made[i];
        sum += off * off;
    }
    return 10 * log10(255.0 * 255.0 * values / sum);
}

/* Photographs, seen through each filter and made whole again: what is lost is fine detail, of which the first is
 * full. */
static void real_pictures(void **state)
{
    (void)state;
    const struct {
        const char *name;
        double least; /* dB */
    } cases[] = {{"colour/baboon_256.bmp", 22}, {"colour/fruits_256.bmp", 28}};
    for (int i = 0; i < 2; i++) {
        size_t bytes = 0;
        uint8_t *file = load_file(data_path(cases[i].name), &bytes);
        if (!file) {
            print_message("# SKIP no %s\n", data_path(cases[i].name));
            skip();
        }
        decoded from = decode(file, bytes, IRIS_RGB888);
        assert_int_equal(from.status, IRIS_OK);
        int32_t w = from.image.w, h = from.image.h;
        const size_t count = (size_t)w * (size_t)h;
        uint8_t *mosaic = malloc(count), *made = malloc(3 * count);
        for (int order = 0; order < 4; order++) {
            for (int32_t p = 0; p < w * h; p++) {
                mosaic[p] = from.image.pixels[3 * p + seen_by(order, p % w, p / w)];
            }
            iris_image src = wrap(mosaic, count, w, h, 0, orders[order]);
            iris_image dst = wrap(made, 3 * count, w, h, 0, IRIS_RGB888);
            assert_int_equal(iris_bayer_convert(&dst, &src), IRIS_OK);
            double reached = psnr(&from.image, made);
            print_message("# %s %s: %.1f dB\n", cases[i].name, letters[order], reached);
            assert_true(reached > cases[i].least);
        }
        free(made);
        free(mosaic);
        free(from.image.pixels);
        free(file);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static uint8_t before[sizeof out];
    memset(out, 0x5A, sizeof out);
    memset(before, 0x5A, sizeof before);
    iris_image src = wrap(raw, sizeof raw, 6, 5, 0, IRIS_BAYER8_GBRG),
               dst = wrap(out, sizeof out, 6, 5, 0, IRIS_RGB888);
    iris_image bad = dst;
    assert_int_equal(iris_bayer_convert(NULL, &src), IRIS_ERR_ARG);
    assert_int_equal(iris_bayer_convert(&dst, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_bayer_convert(&dst, &dst), IRIS_ERR_FORMAT);
    assert_int_equal(iris_bayer_convert(&src, &src), IRIS_ERR_FORMAT);
    bad.w = 5;
    assert_int_equal(iris_bayer_convert(&bad, &src), IRIS_ERR_RANGE);
    bad = dst;
    bad.data = raw + 29;
    assert_int_equal(iris_bayer_convert(&bad, &src), IRIS_ERR_ALIAS);
    bad = src;
    bad.format = IRIS_GRAY8;
    assert_int_equal(iris_bayer_convert(&bad, &src), IRIS_ERR_ALIAS);
    const uint8_t *rows[3] = {raw, raw + 6, raw + 12};
    assert_int_equal(iris_bayer_row(NULL, IRIS_RGB888, rows, IRIS_BAYER8_RGGB, 6), IRIS_ERR_ARG);
    assert_int_equal(iris_bayer_row(out, IRIS_RGB888, NULL, IRIS_BAYER8_RGGB, 6), IRIS_ERR_ARG);
    assert_int_equal(iris_bayer_row(out, IRIS_GRAY8, rows, IRIS_GRAY8, 6), IRIS_ERR_FORMAT);
    assert_int_equal(iris_bayer_row(out, IRIS_BAYER8_RGGB, rows, IRIS_BAYER8_RGGB, 6), IRIS_ERR_FORMAT);
    assert_int_equal(iris_bayer_row(out, IRIS_RGB888, rows, IRIS_BAYER8_RGGB, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_bayer_row(out, IRIS_RGB888, rows, IRIS_BAYER8_RGGB, IRIS_SIDE_MAX + 1),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_bayer_row(raw + 17, IRIS_RGB888, rows, IRIS_BAYER8_RGGB, 6), IRIS_ERR_ALIAS);
    rows[1] = NULL;
    assert_int_equal(iris_bayer_row(out, IRIS_RGB888, rows, IRIS_BAYER8_RGGB, 6), IRIS_ERR_ARG);
    assert_memory_equal(out, before, sizeof out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(against_the_reference),
        cmocka_unit_test(rows_give_the_pixels_of_the_picture),
        cmocka_unit_test(a_constant_color_stays_what_it_is),
        cmocka_unit_test(real_pictures),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("bayer", tests, NULL, NULL);
}
