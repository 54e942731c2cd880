/* BMP by hand: run lengths, bit fields, absurd headers, and what the writer writes, byte by byte and back. */
#include "bmp_decode.h"

/* A header of 54 bytes, bottom-up. */
static size_t put_header(uint8_t *file, int w, int h, int bits, int compression, int colors)
{
    const int fields[] = {0, 0, 54, 40, w, h, 1 | bits << 16, compression, 0, 0, 0, colors, 0};
    file[0] = 'B';
    file[1] = 'M';
    for (int i = 0; i < 52; i++) {
        file[2 + i] = (uint8_t)((uint32_t)fields[i / 4] >> 8 * (i % 4));
    }
    file[10] = (uint8_t)(54 + 4 * colors);
    return 54;
}

/* Four gray levels 10, 20, 30, 40, then the given codes; returns the file's bytes. */
static size_t put_rle(uint8_t *file, int w, int h, int bits, const uint8_t *codes, size_t bytes)
{
    size_t at = put_header(file, w, h, bits, bits == 8 ? 1 : bits == 4 ? 2 : 4, bits == 24 ? 0 : 4);
    for (int i = 0; i < 4 && bits != 24; i++, at += 4) {
        memset(file + at, 10 * (i + 1), 3);
        file[at + 3] = 0;
    }
    memcpy(file + at, codes, bytes);
    return at + bytes;
}

static void assert_gray(const uint8_t *file, size_t bytes, iris_status status, const uint8_t *expected)
{
    decoded result = decode(file, bytes, IRIS_GRAY8);
    assert_int_equal(result.status, status);
    assert_memory_equal(result.image.pixels, expected, (size_t)(result.image.w * result.image.h));
    free(result.image.pixels);
}

static void run_lengths_by_hand(void **state)
{
    (void)state;
    uint8_t file[400];
    /* 5x4, bottom row first: run of 3, literal of 3 cut to 2 and padded; delta by 1, 2; a run; end */
    const uint8_t codes8[] = {3, 1, 0, 3, 2, 3, 3, 0, 0, 0, 1, 3, 0, 2, 1, 2, 9, 1, 0, 1};
    const uint8_t expected8[] = {
        10, 10, 20, 20, 20, 10, 10, 10, 10, 10, 40, 10, 10, 10, 10, 20, 20, 20, 30, 40,
    };
    size_t bytes = put_rle(file, 5, 4, 8, codes8, sizeof codes8);
    assert_gray(file, bytes, IRIS_OK, expected8);
    /* without the end of bitmap the picture is whole; without the last run it is not */
    assert_gray(file, bytes - 2, IRIS_OK, expected8);
    decoded cut = decode(file, bytes - 4, IRIS_GRAY8);
    assert_int_equal(cut.status, IRIS_ERR_TRUNCATED);
    assert_int_equal(cut.rows, 3);
    free(cut.image.pixels);
    /* 5x2 of 4 bits: a run of 5 in alternation; a literal of 5 (3 bytes and padding) */
    const uint8_t codes4[] = {5, 0x12, 0, 0, 0, 5, 0x30, 0x12, 0x30, 0, 0, 1};
    const uint8_t expected4[] = {40, 10, 20, 30, 40, 20, 30, 20, 30, 20};
    assert_gray(file, put_rle(file, 5, 2, 4, codes4, sizeof codes4), IRIS_OK, expected4);
    /* 3x2 of 24 bits: a literal of 3 (9 bytes and padding); a run of 2, the rest stays black */
    const uint8_t codes24[] = {0, 3, 7, 7, 7, 8, 8, 8, 9, 9, 9, 0, 0, 0, 2, 50, 50, 50, 0, 1};
    const uint8_t expected24[] = {50, 50, 0, 7, 8, 9};
    assert_gray(file, put_rle(file, 3, 2, 24, codes24, sizeof codes24), IRIS_OK, expected24);
}

/* Codes that do nothing, from a source that never ends. */
static void run_lengths_cannot_go_on_forever(void **state)
{
    (void)state;
    uint8_t file[400];
    const uint8_t idle[] = {0, 2, 0, 0}, beyond[] = {255, 1};
    const struct {
        const uint8_t *codes;
        size_t bytes;
    } bombs[] = {{idle, sizeof idle}, {beyond, sizeof beyond}};
    for (size_t i = 0; i < 2; i++) {
        size_t bytes = put_rle(file, 100, 100, 8, idle, 0);
        awkward_source from = {file, bytes, 0, SIZE_MAX, SIZE_MAX, bombs[i].codes, bombs[i].bytes};
        decoded result = decode_from(&from, IRIS_RGB888);
        assert_int_equal(result.status, IRIS_ERR_DATA);
        assert_true(from.position < bytes + 4 * 300);
        free(result.image.pixels);
    }
}

static void bit_fields_by_hand(void **state)
{
    (void)state;
    const struct {
        int bits;
        uint32_t masks[3], pixel;
        iris_status status;
        uint8_t expected[3];
    } cases[] = {
        {16, {0x8000, 0x7000, 0x0FFF}, 0x8FFF, IRIS_OK, {255, 0, 255}},
        {16, {0x8000, 0x7000, 0x0FFF}, 0x3800, IRIS_OK, {0, 109, 128}}, /* 3 of 7, 2048 of 4095 */
        {32, {0x1, 0x6, 0xFFFFFFF8}, 0x80000003, IRIS_OK, {255, 85, 128}},
        {32, {0, 0xFF, 0}, 0xFFFFFF42, IRIS_OK, {0, 0x42, 0}},
        {32, {0xFFFFFFFF, 0xFFFFFFFF, 1}, 0x7F000001, IRIS_OK, {127, 127, 255}},
        {16, {0x10000, 1, 2}, 0, IRIS_ERR_DATA, {0}},
        {32, {0x5, 1, 2}, 0, IRIS_ERR_DATA, {0}},
        {32, {0, 0, 0}, 0, IRIS_ERR_DATA, {0}},
        {24, {1, 2, 4}, 0, IRIS_ERR_DATA, {0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint8_t file[80] = {0};
        put_header(file, 1, 1, cases[i].bits, 3, 0);
        for (int k = 0; k < 16; k++) {
            file[54 + k] = (uint8_t)((k < 12 ? cases[i].masks[k / 4] : cases[i].pixel) >> 8 * (k % 4));
        }
        decoded result = decode(file, 70, IRIS_RGB888);
        assert_int_equal(result.status, cases[i].status);
        if (result.status == IRIS_OK) {
            for (int k = 0; k < 3; k++) {
                assert_true(abs(result.image.pixels[k] - cases[i].expected[k]) <= 1);
            }
        }
        free(result.image.pixels);
    }
}

/* Fields of 1 to 8 bits are rounded exactly: the value times 255 over the largest value. */
static void narrow_fields_are_exact(void **state)
{
    (void)state;
    for (int bits = 1; bits <= 8; bits++) {
        uint32_t largest = (1u << bits) - 1;
        for (uint32_t value = 0; value <= largest; value++) {
            const uint32_t words[] = {largest << 24, largest << 3, largest << 13, value << 24 | value << 3};
            uint8_t file[80] = {0};
            put_header(file, 1, 1, 32, 3, 0);
            for (int k = 0; k < 16; k++) {
                file[54 + k] = (uint8_t)(words[k / 4] >> 8 * (k % 4));
            }
            decoded result = decode(file, 70, IRIS_RGB888);
            assert_int_equal(result.status, IRIS_OK);
            assert_int_equal(result.image.pixels[0], (int)(value * 255.0 / largest + 0.5));
            assert_int_equal(result.image.pixels[1], result.image.pixels[0]);
            assert_int_equal(result.image.pixels[2], 0);
            free(result.image.pixels);
        }
    }
}

/* A data offset of 0 means: right behind the palette as declared. The padding of the last row may be missing. */
static void what_is_missing_is_assumed(void **state)
{
    (void)state;
    static const uint8_t expected[] = {10, 20, 30, 40, 10, 10};
    static const uint8_t rows[] = {3, 0, 0, 0xFF, 0, 1, 2, 0xFF};
    uint8_t file[100];
    for (int i = 0; i < 2; i++) {
        size_t bytes = put_rle(file, 3, 2, 8, rows, sizeof rows) - sizeof rows;
        file[30] = 0; /* not compressed */
        file[10] = (uint8_t)(i ? 0 : bytes);
        decoded result = decode(file, bytes + 7, IRIS_GRAY8);
        assert_int_equal(result.status, IRIS_OK);
        assert_memory_equal(result.image.pixels, expected, 6);
        free(result.image.pixels);
    }
}

static void absurd_headers_are_refused(void **state)
{
    (void)state;
    const struct {
        int w, h, bits, compression, offset;
        iris_status status;
    } cases[] = {
        {0, 1, 24, 0, 54, IRIS_ERR_DATA},
        {1, 0, 24, 0, 54, IRIS_ERR_DATA},
        {32768, 1, 24, 0, 54, IRIS_ERR_RANGE},
        {1, 32768, 24, 0, 54, IRIS_ERR_RANGE},
        {1, INT32_MIN, 24, 0, 54, IRIS_ERR_RANGE},
        {INT32_MIN, 1, 24, 0, 54, IRIS_ERR_DATA},
        {1, 1, 24, 0, INT32_MAX, IRIS_ERR_DATA},
        {1, 1, 24, 0, -1, IRIS_ERR_DATA},
        {1, 1, 64, 0, 54, IRIS_ERR_UNSUPPORTED},
        {1, 1, 0, 4, 54, IRIS_ERR_UNSUPPORTED},
        {1, 1, 0, 5, 54, IRIS_ERR_UNSUPPORTED},
        {1, 1, 8, 99, 54, IRIS_ERR_UNSUPPORTED},
        {1, 1, 8, 2, 54, IRIS_ERR_DATA},
        {1, 1, 7, 0, 54, IRIS_ERR_DATA},
        {1, 1, 8, 0, 55, IRIS_ERR_DATA}, /* no room for a palette */
        {1, 1, 24, 0, 0, IRIS_OK},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint8_t file[80] = {0};
        put_header(file, cases[i].w, cases[i].h, cases[i].bits, cases[i].compression, 0);
        for (int k = 0; k < 4; k++) {
            file[10 + k] = (uint8_t)((uint32_t)cases[i].offset >> 8 * k);
        }
        decoded result = decode(file, sizeof file, IRIS_RGB888);
        assert_int_equal(result.status, cases[i].status);
        free(result.image.pixels);
    }
}

/* A 1x1 picture of the given gray, with a declared file size and bytes behind its end. */
static size_t put_pixel(uint8_t *file, uint8_t gray, uint32_t declared, size_t behind)
{
    put_header(file, 1, 1, 24, 0, 0);
    for (int i = 0; i < 4; i++) {
        file[2 + i] = (uint8_t)(declared >> 8 * i);
        file[54 + i] = i < 3 ? gray : 0;
    }
    memset(file + 58, 'x', behind);
    return 58 + behind;
}

/* The next picture begins behind the pixels, or at the declared size if that is not far; run lengths tell their end. */
static void the_next_picture_is_found(void **state)
{
    (void)state;
    static uint8_t file[1000];
    const uint8_t codes[] = {2, 1, 0, 0, 2, 2, 0, 0, 0, 1};
    size_t bytes = 0;
    bytes += put_pixel(file + bytes, 10, 0, 0);
    bytes += put_pixel(file + bytes, 20, 58 + 7, 7);              /* a tail, declared */
    bytes += put_pixel(file + bytes, 30, 14, 0);                  /* too small */
    bytes += put_pixel(file + bytes, 40, 0x7FFFFFFF, 0);          /* absurd */
    bytes += put_rle(file + bytes, 2, 2, 8, codes, sizeof codes); /* no sizes: up to the end of bitmap */
    bytes += put_rle(file + bytes, 2, 2, 8, codes, 6);            /* nor an end of bitmap */
    size_t last = bytes;
    bytes += put_pixel(file + bytes, 60, 1000, 0); /* the input ends before the declared size */
    awkward_source from = {file, bytes, 0, 3, SIZE_MAX, NULL, 0};
    const int first_pixel[] = {10, 20, 30, 40, 30, 30, 60};
    iris_stream stream;
    assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, &from}), IRIS_OK);
    for (int i = 0; i < 7; i++) {
        iris_picture_kind kind;
        assert_int_equal(iris_stream_kind(&kind, &stream), IRIS_OK);
        assert_true(i < 6 || stream.position == last);
        decoded result = decode_stream(&stream, IRIS_GRAY8);
        assert_int_equal(result.status, IRIS_OK);
        assert_int_equal(result.image.pixels[0], first_pixel[i]);
        free(result.image.pixels);
    }
    iris_picture_kind kind;
    assert_int_equal(iris_stream_kind(&kind, &stream), IRIS_ERR_END);
}

/* Nothing is asked for beyond the last pixel: a picture over a pipe is answered before the next one comes. */
static void no_byte_is_asked_for_too_early(void **state)
{
    (void)state;
    static uint8_t file[400];
    const uint8_t codes[] = {2, 1, 0, 0, 2, 2, 0, 1};
    for (int rle = 0; rle < 2; rle++) {
        size_t bytes = rle ? put_rle(file, 2, 2, 8, codes, sizeof codes) : put_pixel(file, 10, 0, 0);
        awkward_source from = {file, bytes, 0, SIZE_MAX, bytes, NULL, 0}; /* fails at the byte behind */
        decoded result = decode_from(&from, IRIS_RGB888);
        assert_int_equal(result.status, IRIS_OK);
        free(result.image.pixels);
    }
}

static void every_byte_may_fail(void **state)
{
    (void)state;
    static uint8_t file[400];
    const uint8_t codes[] = {3, 1, 0, 3, 2, 3, 3, 0, 0, 0, 1, 3, 0, 2, 1, 2, 9, 1, 0, 1};
    size_t bytes = put_rle(file, 5, 4, 8, codes, sizeof codes);
    for (size_t n = 0; n < bytes; n++) {
        awkward_source from = {file, bytes, 0, 7, n, NULL, 0};
        decoded result = decode_from(&from, IRIS_RGB888);
        assert_int_equal(result.status, IRIS_ERR_IO);
        free(result.image.pixels);
    }
}

/* Whole files, spelled out. */
static void writer_writes_these_bytes(void **state)
{
    (void)state;
    static const uint8_t header24[] = {
        'B', 'M', 70, 0, 0, 0, 0, 0,  0, 0, 54, 0,    0,    0, 40, 0,    0,    0, 2, 0, 0, 0, 2, 0, 0, 0, 1,
        0,   24,  0,  0, 0, 0, 0, 16, 0, 0, 0,  0x13, 0x0B, 0, 0,  0x13, 0x0B, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    };
    static const uint8_t pixels24[] = {9, 8, 7, 12, 11, 10, 0, 0, 3, 2, 1, 6, 5, 4, 0, 0};
    uint8_t rgb[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    uint8_t file[2000];
    iris_image image;
    iris_memory_sink memory = {file, sizeof file, 0};
    assert_int_equal(iris_image_wrap(&image, rgb, sizeof rgb, (iris_size){2, 2}, 0, IRIS_RGB888), IRIS_OK);
    assert_int_equal(iris_bmp_write(iris_sink_memory(&memory), &image), IRIS_OK);
    assert_int_equal(memory.used, 70);
    assert_memory_equal(file, header24, 54);
    assert_memory_equal(file + 54, pixels24, 16);

    uint32_t mask[] = {0xFFFFF805u, 2}; /* of 11 pixels, 0 and 2 are set; bits past the row do not matter */
    memory.used = 0;
    assert_int_equal(iris_image_wrap(&image, mask, sizeof mask, (iris_size){11, 2}, 0, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_bmp_write(iris_sink_memory(&memory), &image), IRIS_OK);
    static const uint8_t tail1[] = {0, 0, 0, 0, 255, 255, 255, 0, 0x40, 0, 0, 0, 0xA0, 0, 0, 0};
    assert_int_equal(memory.used, 54 + 16);
    assert_int_equal(file[28], 1);
    assert_int_equal(file[10], 62);
    assert_memory_equal(file + 54, tail1, 16);

    uint8_t gray[] = {50, 60, 70};
    memory.used = 0;
    assert_int_equal(iris_image_wrap(&image, gray, sizeof gray, (iris_size){3, 1}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_bmp_write(iris_sink_memory(&memory), &image), IRIS_OK);
    assert_int_equal(memory.used, 54 + 1024 + 4);
    static const uint8_t tail8[] = {254, 254, 254, 0, 255, 255, 255, 0, 50, 60, 70, 0};
    assert_memory_equal(file + memory.used - 12, tail8, 12);
}

/* What a view of the format shows at x, y: red first, gray three times. */
static void pixel_of(uint8_t color[3], const iris_image *image, int x, int y)
{
    const uint8_t *row = iris_image_row(image, y);
    int bgr = image->format == IRIS_BGR888;
    for (int k = 0; k < 3; k++) {
        if (image->format == IRIS_MASK1) {
            color[k] = ((const uint32_t *)(const void *)row)[x / 32] >> x % 32 & 1 ? 255 : 0;
        } else {
            color[k] = image->format == IRIS_GRAY8 ? row[x] : row[3 * x + (bgr ? 2 - k : k)];
        }
    }
}

static void assert_shows(const uint8_t *file, size_t bytes, const iris_image *image)
{
    decoded result = decode(file, bytes, IRIS_RGB888);
    assert_int_equal(result.status, IRIS_OK);
    assert_int_equal(result.image.w, image->w);
    assert_int_equal(result.image.h, image->h);
    for (int i = 0; i < image->w * image->h; i++) {
        uint8_t color[3];
        pixel_of(color, image, i % image->w, i / image->w);
        assert_memory_equal(result.image.pixels + 3 * i, color, 3);
    }
    free(result.image.pixels);
}

/* Every format, widths around every padding and piece, bottom-up and top-down views, crops, both orders of rows. */
static void what_is_written_is_read_back(void **state)
{
    (void)state;
    static const iris_format formats[] = {IRIS_MASK1, IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    static uint32_t words[20000];
    static uint8_t file[80000];
    uint32_t random = 3;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        words[i] = next_random(&random) << 12 ^ next_random(&random);
    }
    for (int i = 0; i < 4 * 90; i++) {
        iris_format format = formats[i % 4];
        iris_size size = {i < 320 ? 1 + i / 4 : 1900 + i, 3 + i % 3};
        size_t row_bytes = (iris_format_row_bytes(format, size.w + 32) + 3) / 4 * 4;
        ptrdiff_t stride = i % 3 == 0 ? -(ptrdiff_t)row_bytes : (ptrdiff_t)row_bytes;
        iris_image image;
        size_t room = sizeof words - 4 * (size_t)i;
        iris_size outer = {size.w + 32, size.h + 1};
        assert_int_equal(iris_image_wrap(&image, words + i, room, outer, stride, format), IRIS_OK);
        assert_int_equal(iris_image_crop(&image, &image, (iris_rect){i % 2 ? 32 : 0, 1, size.w, size.h}),
                         IRIS_OK);
        awkward_sink to = {file, 0, i % 5 ? SIZE_MAX : 9, sizeof file};
        assert_int_equal(iris_bmp_write((iris_sink){awkward_write, &to}, &image), IRIS_OK);
        assert_shows(file, to.used, &image);

        size_t whole = to.used;
        iris_bmp_writer writer;
        to.used = 0;
        assert_int_equal(iris_bmp_write_begin(&writer, (iris_sink){awkward_write, &to}, size, format, 1),
                         IRIS_OK);
        for (int y = 0; y < size.h; y++) {
            assert_int_equal(iris_bmp_write_end(&writer), IRIS_ERR_TRUNCATED);
            assert_int_equal(iris_bmp_write_row(&writer, iris_image_row(&image, y)), IRIS_OK);
        }
        assert_int_equal(iris_bmp_write_row(&writer, iris_image_row(&image, 0)), IRIS_ERR_RANGE);
        assert_int_equal(iris_bmp_write_end(&writer), IRIS_OK);
        assert_int_equal(to.used, whole);
        assert_shows(file, to.used, &image);
    }
}

static void failing_sinks_are_reported(void **state)
{
    (void)state;
    static uint8_t file[2000];
    uint32_t words[16] = {0};
    static const iris_format formats[] = {IRIS_MASK1, IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    for (int i = 0; i < 4; i++) {
        iris_image image;
        awkward_sink to = {file, 0, SIZE_MAX, SIZE_MAX};
        assert_int_equal(iris_image_wrap(&image, words, sizeof words, (iris_size){5, 3}, 0, formats[i]),
                         IRIS_OK);
        assert_int_equal(iris_bmp_write((iris_sink){awkward_write, &to}, &image), IRIS_OK);
        size_t whole = to.used;
        for (size_t n = 0; n < whole; n++) {
            to = (awkward_sink){file, 0, 11, n};
            assert_int_equal(iris_bmp_write((iris_sink){awkward_write, &to}, &image), IRIS_ERR_IO);
            iris_memory_sink memory = {file, n, 0};
            assert_int_equal(iris_bmp_write(iris_sink_memory(&memory), &image), IRIS_ERR_IO);
            assert_int_equal(memory.used, n);
        }
    }
}

static void wrong_writes_are_refused(void **state)
{
    (void)state;
    static uint8_t file[2000];
    uint32_t words[16] = {0};
    iris_memory_sink memory = {file, sizeof file, 0};
    iris_sink sink = iris_sink_memory(&memory);
    iris_bmp_writer writer;
    iris_image image;
    assert_int_equal(iris_bmp_write_begin(NULL, sink, (iris_size){1, 1}, IRIS_GRAY8, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_write_begin(&writer, (iris_sink){0}, (iris_size){1, 1}, IRIS_GRAY8, 0),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_write_begin(&writer, sink, (iris_size){1, 1}, IRIS_HSL24, 0), IRIS_ERR_FORMAT);
    assert_int_equal(iris_bmp_write_begin(&writer, sink, (iris_size){0, 1}, IRIS_GRAY8, 0), IRIS_ERR_RANGE);
    assert_int_equal(iris_bmp_write_begin(&writer, sink, (iris_size){1, 32768}, IRIS_GRAY8, 0),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_bmp_write(sink, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_image_wrap(&image, words, 64, (iris_size){2, 2}, 0, IRIS_RGBA8888), IRIS_OK);
    assert_int_equal(iris_bmp_write(sink, &image), IRIS_ERR_FORMAT);
    assert_int_equal(memory.used, 0);
    assert_int_equal(iris_bmp_write_begin(&writer, sink, (iris_size){40, 2}, IRIS_MASK1, 1), IRIS_OK);
    assert_int_equal(iris_bmp_write_row(&writer, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_write_row(NULL, words), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_write_row(&writer, (uint8_t *)words + 2), IRIS_ERR_ALIGN);
    assert_int_equal(iris_bmp_write_end(NULL), IRIS_ERR_ARG);
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    uint8_t file[80] = {0}, row[16] = {0};
    put_header(file, 2, 1, 24, 0, 0);
    iris_memory_source memory = {file, 62, 0};
    iris_stream stream;
    iris_bmp_reader reader = {0};
    iris_image image;
    assert_int_equal(iris_stream_init(&stream, iris_source_memory(&memory)), IRIS_OK);
    assert_int_equal(iris_bmp_row(row, NULL, &reader, IRIS_GRAY8), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_finish(&reader), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_begin(NULL, &stream), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_begin(&reader, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_begin(&reader, &stream), IRIS_OK);
    assert_int_equal(iris_bmp_row(NULL, NULL, &reader, IRIS_GRAY8), IRIS_ERR_ARG);
    assert_int_equal(iris_bmp_row(row, NULL, &reader, IRIS_MASK1), IRIS_ERR_FORMAT);
    assert_int_equal(iris_image_wrap(&image, row, sizeof row, (iris_size){3, 1}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_bmp_read(&image, &reader), IRIS_ERR_RANGE);
    image.format = IRIS_HSL24;
    image.w = 2;
    assert_int_equal(iris_bmp_read(&image, &reader), IRIS_ERR_FORMAT);
    assert_int_equal(iris_bmp_read(NULL, &reader), IRIS_ERR_ARG);
    image.format = IRIS_GRAY8;
    assert_int_equal(iris_bmp_read(&image, &reader), IRIS_OK);
    assert_int_equal(iris_bmp_begin(&reader, &stream), IRIS_ERR_END);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(run_lengths_by_hand),          cmocka_unit_test(run_lengths_cannot_go_on_forever),
        cmocka_unit_test(bit_fields_by_hand),           cmocka_unit_test(narrow_fields_are_exact),
        cmocka_unit_test(what_is_missing_is_assumed),   cmocka_unit_test(absurd_headers_are_refused),
        cmocka_unit_test(the_next_picture_is_found),    cmocka_unit_test(no_byte_is_asked_for_too_early),
        cmocka_unit_test(every_byte_may_fail),          cmocka_unit_test(writer_writes_these_bytes),
        cmocka_unit_test(what_is_written_is_read_back), cmocka_unit_test(failing_sinks_are_reported),
        cmocka_unit_test(wrong_writes_are_refused),     cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("bmp", tests, NULL, NULL);
}
