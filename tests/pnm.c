/* PGM and PPM: hand-made files, the shared data, damaged files, streams mixed with BMP, and writing. */
#include "iris/pnm.h"

#include "iris/bmp.h"
#include "picture.h"

/* Begins to read a text with `bytes` bytes. */
static iris_status begin(iris_pnm_reader *reader, iris_stream *stream, awkward_source *from, const void *data,
                         size_t bytes)
{
    *from = (awkward_source){data, bytes, 0, 2, SIZE_MAX, NULL, 0};
    assert_int_equal(iris_stream_init(stream, (iris_source){awkward_read, from}), IRIS_OK);
    return iris_pnm_begin(reader, stream);
}

static void headers_are_read_or_refused(void **state)
{
    (void)state;
    const struct {
        const char *text;
        iris_status status;
        int w, h, is_gray;
    } cases[] = {
        {"P5\n3 2\n255\n", IRIS_OK, 3, 2, 1},
        {"P6 3 2 255 ", IRIS_OK, 3, 2, 0},
        {"P5#3 9\n# 1 1\r\t3 #4\n\n 002\v# x\n255\r", IRIS_OK, 3, 2, 1},
        {"P5 32767 32767 255\n", IRIS_OK, 32767, 32767, 1},
        {"P5 32768 1 255\n", IRIS_ERR_RANGE, 0, 0, 0},
        {"P5 1 99999999999999999999 255\n", IRIS_ERR_RANGE, 0, 0, 0},
        {"P5 0 1 255\n", IRIS_ERR_DATA, 0, 0, 0},
        {"P5 1 0 255\n", IRIS_ERR_DATA, 0, 0, 0},
        {"P5 -1 1 255\n", IRIS_ERR_DATA, 0, 0, 0},
        {"P5 1x1 255\n", IRIS_ERR_DATA, 0, 0, 0},
        {"P5 1 1 0\n", IRIS_ERR_DATA, 0, 0, 0},
        {"P5 1 1 65536\n", IRIS_ERR_DATA, 0, 0, 0},
        {"P5 1 1 65535\n", IRIS_ERR_UNSUPPORTED, 0, 0, 0},
        {"P5 1 1 15\n", IRIS_ERR_UNSUPPORTED, 0, 0, 0},
        {"P2 1 1 255\n", IRIS_ERR_UNSUPPORTED, 0, 0, 0},
        {"P4 1 1\n", IRIS_ERR_UNSUPPORTED, 0, 0, 0},
        {"P7\n", IRIS_ERR_UNSUPPORTED, 0, 0, 0},
        {"P8\n", IRIS_ERR_DATA, 0, 0, 0},
        {"", IRIS_ERR_END, 0, 0, 0},
        {"P", IRIS_ERR_TRUNCATED, 0, 0, 0},
        {"P5 1 1 25", IRIS_ERR_TRUNCATED, 0, 0, 0},
        {"P5 1 1 255", IRIS_ERR_TRUNCATED, 0, 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        awkward_source from;
        iris_stream stream;
        iris_pnm_reader reader;
        assert_int_equal(begin(&reader, &stream, &from, cases[i].text, strlen(cases[i].text)),
                         cases[i].status);
        if (cases[i].status == IRIS_OK) {
            assert_int_equal(reader.w, cases[i].w);
            assert_int_equal(reader.h, cases[i].h);
            assert_int_equal(reader.is_gray, cases[i].is_gray);
            assert_int_equal(stream.position, strlen(cases[i].text));
        }
    }
}

static void headers_end(void **state)
{
    (void)state;
    static const char *forever[] = {"# comment ", " ", "1"};
    for (size_t i = 0; i < 3; i++) {
        const uint8_t *tail = (const uint8_t *)forever[i];
        awkward_source from = {(const uint8_t *)"P5 ", 3, 0, SIZE_MAX, SIZE_MAX, tail, strlen(forever[i])};
        iris_stream stream;
        iris_pnm_reader reader;
        assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, &from}), IRIS_OK);
        assert_int_equal(iris_pnm_begin(&reader, &stream), IRIS_ERR_DATA);
        assert_int_equal(from.position, IRIS_PNM_HEADER_MAX);
    }
}

static void pixels_by_hand(void **state)
{
    (void)state;
    static const uint8_t gray[] = "P5 3 2 255\n\x00\x01\xFFxyz";
    static const uint8_t color[] = "P6 2 1 255\n\x0A\x14\x1E\xFF\xFF\xFF";
    static const uint8_t gray_as_color[] = {0, 0, 0, 1, 1, 1, 255, 255, 255};
    awkward_source from;
    iris_stream stream;
    iris_pnm_reader reader;
    uint8_t row[9];
    int32_t y = -1;
    assert_int_equal(begin(&reader, &stream, &from, gray, sizeof gray - 1), IRIS_OK);
    assert_int_equal(iris_pnm_row(row, &y, &reader, IRIS_RGB888), IRIS_OK);
    assert_int_equal(y, 0);
    assert_memory_equal(row, gray_as_color, 9);
    assert_int_equal(iris_pnm_row(row, &y, &reader, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(y, 1);
    assert_memory_equal(row, "xyz", 3);
    assert_int_equal(iris_pnm_row(row, &y, &reader, IRIS_GRAY8), IRIS_ERR_END);
    assert_int_equal(y, 1);
    assert_int_equal(iris_pnm_finish(&reader), IRIS_OK);
    static const uint8_t rgb[] = {10, 20, 30, 255, 255, 255}, bgr[] = {30, 20, 10, 255, 255, 255};
    assert_int_equal(begin(&reader, &stream, &from, color, sizeof color - 1), IRIS_OK);
    assert_int_equal(iris_pnm_row(row, NULL, &reader, IRIS_RGB888), IRIS_OK);
    assert_memory_equal(row, rgb, 6);
    assert_int_equal(begin(&reader, &stream, &from, color, sizeof color - 1), IRIS_OK);
    assert_int_equal(iris_pnm_row(row, NULL, &reader, IRIS_BGR888), IRIS_OK);
    assert_memory_equal(row, bgr, 6);
    assert_int_equal(begin(&reader, &stream, &from, color, sizeof color - 1), IRIS_OK);
    assert_int_equal(iris_pnm_row(row, NULL, &reader, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(row[0], 18); /* 0.299 * 10 + 0.587 * 20 + 0.114 * 30 = 18.15 */
    assert_int_equal(row[1], 255);
}

/* Real pictures against a reader of the test's own. */
static void shared_pictures_are_read(void **state)
{
    (void)state;
    static const char *names[] = {"hough/coins.pgm", "calib/zhang/CalibIm1.pgm", "bmp/ref/pal8.ppm"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        size_t bytes = 0;
        picture reference = load_pnm(data_path(names[i]));
        uint8_t *file = load_file(data_path(names[i]), &bytes);
        if (!reference.pixels || !file) {
            skip();
        }
        awkward_source from;
        iris_stream stream;
        iris_pnm_reader reader;
        iris_image image;
        assert_int_equal(begin(&reader, &stream, &from, file, bytes), IRIS_OK);
        iris_format format = reader.is_gray ? IRIS_GRAY8 : IRIS_RGB888;
        size_t size = (size_t)reference.w * (size_t)reference.h * (size_t)reference.channels;
        uint8_t *pixels = malloc(size);
        assert_int_equal(
            iris_image_wrap(&image, pixels, size, (iris_size){reference.w, reference.h}, 0, format), IRIS_OK);
        assert_int_equal(iris_pnm_read(&image, &reader), IRIS_OK);
        assert_memory_equal(pixels, reference.pixels, size);
        assert_int_equal(stream.position, bytes);
        free(pixels);
        free(file);
        free(reference.pixels);
    }
}

/* Ends and failures at every byte; rows before are delivered. */
static void cut_or_failing_anywhere_is_reported(void **state)
{
    (void)state;
    static const uint8_t file[] = "P5 3 4 255\nabcdefghijkl";
    for (size_t n = 0; n < sizeof file - 1; n++) {
        for (int fails = 0; fails < 2; fails++) {
            awkward_source from = {file, fails ? sizeof file - 1 : n, 0, 2, fails ? n : SIZE_MAX, NULL, 0};
            iris_status expected = fails ? IRIS_ERR_IO : n == 0 ? IRIS_ERR_END : IRIS_ERR_TRUNCATED;
            uint8_t pixels[12];
            iris_stream stream;
            iris_pnm_reader reader;
            iris_image image;
            memset(pixels, '-', sizeof pixels);
            assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, &from}), IRIS_OK);
            assert_int_equal(iris_image_wrap(&image, pixels, 12, (iris_size){3, 4}, 0, IRIS_GRAY8), IRIS_OK);
            iris_status status = iris_pnm_begin(&reader, &stream);
            if (status == IRIS_OK) {
                status = iris_pnm_read(&image, &reader);
                assert_int_equal(reader.next, (n - 11) / 3);
                assert_memory_equal(pixels, file + 11, (n - 11) / 3 * 3);
                assert_int_equal(pixels[11], '-');
                assert_int_equal(iris_pnm_row(pixels, NULL, &reader, IRIS_GRAY8), expected);
            }
            assert_int_equal(status, expected);
            assert_int_equal(iris_pnm_finish(&reader), expected);
        }
    }
}

static void kinds_may_be_mixed_in_a_stream(void **state)
{
    (void)state;
    static uint8_t file[2000];
    uint8_t pixels[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, back[12];
    iris_memory_sink sink = {file, sizeof file, 0};
    iris_image gray, color;
    assert_int_equal(iris_image_wrap(&gray, pixels, 12, (iris_size){4, 3}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&color, pixels, 12, (iris_size){2, 2}, 0, IRIS_BGR888), IRIS_OK);
    assert_int_equal(iris_pnm_write(iris_sink_memory(&sink), &gray), IRIS_OK);
    assert_int_equal(iris_bmp_write(iris_sink_memory(&sink), &gray), IRIS_OK);
    assert_int_equal(iris_pnm_write(iris_sink_memory(&sink), &color), IRIS_OK);
    assert_int_equal(iris_pnm_write(iris_sink_memory(&sink), &color), IRIS_OK);
    assert_int_equal(iris_bmp_write(iris_sink_memory(&sink), &color), IRIS_OK);
    assert_int_equal(iris_pnm_write(iris_sink_memory(&sink), &gray), IRIS_OK);
    awkward_source from = {file, sink.used, 0, 5, SIZE_MAX, NULL, 0};
    iris_stream stream;
    iris_picture_kind kind;
    char kinds[8] = "";
    assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, &from}), IRIS_OK);
    while (iris_stream_kind(&kind, &stream) == IRIS_OK) {
        iris_bmp_reader bmp;
        iris_pnm_reader pnm;
        iris_image image;
        strcat(kinds, kind == IRIS_PICTURE_BMP ? "b" : "p");
        assert_int_equal(kind == IRIS_PICTURE_BMP ? iris_bmp_begin(&bmp, &stream)
                                                  : iris_pnm_begin(&pnm, &stream),
                         IRIS_OK);
        int is_gray = kind == IRIS_PICTURE_BMP ? bmp.is_gray : pnm.is_gray;
        image = is_gray ? gray : color;
        image.data = back;
        if (strlen(kinds) == 3) {
            assert_int_equal(iris_pnm_finish(&pnm), IRIS_OK); /* one is passed over */
            continue;
        }
        assert_int_equal(kind == IRIS_PICTURE_BMP ? iris_bmp_read(&image, &bmp) : iris_pnm_read(&image, &pnm),
                         IRIS_OK);
        assert_memory_equal(back, pixels, 12);
    }
    assert_string_equal(kinds, "pbppbp");
    assert_int_equal(iris_stream_kind(&kind, &stream), IRIS_ERR_END);
}

static void writer_writes_these_bytes(void **state)
{
    (void)state;
    uint8_t pixels[] = {1, 2, 3, 4, 5, 6}, file[100];
    uint32_t mask[] = {0xFFFFFFF5u, 2};
    uint16_t deep[] = {0x0102, 0xFF00, 0x0506};
    const struct {
        void *pixels;
        iris_size size;
        iris_format format;
        const char *header;
        uint8_t body[6];
    } cases[] = {
        {deep, {1, 3}, IRIS_GRAY_U16, "P5\n1 3\n65535\n", {1, 2, 255, 0, 5, 6}},
        {pixels, {2, 3}, IRIS_GRAY8, "P5\n2 3\n255\n", {1, 2, 3, 4, 5, 6}},
        {pixels, {1, 2}, IRIS_RGB888, "P6\n1 2\n255\n", {1, 2, 3, 4, 5, 6}},
        {pixels, {2, 1}, IRIS_BGR888, "P6\n2 1\n255\n", {3, 2, 1, 6, 5, 4}},
        {mask, {3, 2}, IRIS_MASK1, "P5\n3 2\n255\n", {255, 0, 255, 0, 255, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_image image;
        size_t header = strlen(cases[i].header);
        for (size_t n = 0; n <= header + 6; n++) {
            awkward_sink to = {file, 0, 4, n};
            size_t room = cases[i].format == IRIS_MASK1 ? 8 : 6;
            assert_int_equal(
                iris_image_wrap(&image, cases[i].pixels, room, cases[i].size, 0, cases[i].format), IRIS_OK);
            iris_status expected = n < header + 6 ? IRIS_ERR_IO : IRIS_OK;
            assert_int_equal(iris_pnm_write((iris_sink){awkward_write, &to}, &image), expected);
        }
        assert_memory_equal(file, cases[i].header, header);
        assert_memory_equal(file + header, cases[i].body, 6);
    }
}

/* Long rows, more than one piece, and the longest header. */
static void what_is_written_is_read_back(void **state)
{
    (void)state;
    static const iris_format formats[] = {IRIS_MASK1, IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888};
    static uint32_t words[24600];
    static uint8_t file[98500], back[98400];
    uint32_t random = 5;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        words[i] = next_random(&random) << 12 ^ next_random(&random);
    }
    for (int i = 0; i < 40; i++) {
        int w = i < 4 ? IRIS_SIDE_MAX : 74 + i / 4 * 3;
        iris_format format = formats[i % 4];
        iris_image image, read;
        iris_memory_sink memory = {file, sizeof file, 0};
        ptrdiff_t stride = (ptrdiff_t)(iris_format_row_bytes(format, w) + 3) / 4 * 4 * (i % 3 == 0 ? -1 : 1);
        iris_size size = {w, i < 4 ? 1 : 5};
        assert_int_equal(iris_image_wrap(&image, words, sizeof words, size, stride, format), IRIS_OK);
        assert_int_equal(iris_pnm_write(iris_sink_memory(&memory), &image), IRIS_OK);
        iris_format as = format == IRIS_MASK1 ? IRIS_GRAY8 : format;
        iris_memory_source from = {file, memory.used, 0};
        iris_stream stream;
        iris_pnm_reader reader;
        assert_int_equal(iris_stream_init(&stream, iris_source_memory(&from)), IRIS_OK);
        assert_int_equal(iris_pnm_begin(&reader, &stream), IRIS_OK);
        assert_int_equal(iris_image_wrap(&read, back, sizeof back, size, 0, as), IRIS_OK);
        assert_int_equal(iris_pnm_read(&read, &reader), IRIS_OK);
        for (int y = 0; y < size.h; y++) {
            const uint32_t *bits = iris_image_row(&image, y);
            const uint8_t *row = iris_image_row(&read, y);
            for (int x = 0; x < w && format == IRIS_MASK1; x++) {
                assert_int_equal(row[x], bits[x / 32] >> x % 32 & 1 ? 255 : 0);
            }
            if (format != IRIS_MASK1) {
                assert_memory_equal(row, bits, iris_format_row_bytes(format, w));
            }
        }
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    static const uint8_t file[] = "P5 2 1 255\nab";
    uint32_t words[4] = {0};
    uint8_t bytes[40];
    iris_memory_sink memory = {bytes, sizeof bytes, 0};
    iris_sink sink = iris_sink_memory(&memory);
    awkward_source from;
    iris_stream stream;
    iris_pnm_reader reader = {0};
    iris_pnm_writer writer;
    iris_image image;
    assert_int_equal(iris_pnm_row(words, NULL, &reader, IRIS_GRAY8), IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_finish(&reader), IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_begin(NULL, &stream), IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_begin(&reader, NULL), IRIS_ERR_ARG);
    assert_int_equal(begin(&reader, &stream, &from, file, sizeof file - 1), IRIS_OK);
    assert_int_equal(iris_pnm_row(NULL, NULL, &reader, IRIS_GRAY8), IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_row(words, NULL, &reader, IRIS_MASK1), IRIS_ERR_FORMAT);
    assert_int_equal(iris_pnm_read(NULL, &reader), IRIS_ERR_ARG);
    assert_int_equal(iris_image_wrap(&image, words, 16, (iris_size){2, 2}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_pnm_read(&image, &reader), IRIS_ERR_RANGE);
    assert_int_equal(iris_pnm_write_begin(NULL, sink, (iris_size){1, 1}, IRIS_GRAY8), IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_write_begin(&writer, (iris_sink){0}, (iris_size){1, 1}, IRIS_GRAY8),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_write_begin(&writer, sink, (iris_size){1, 1}, IRIS_GRAY_S16), IRIS_ERR_FORMAT);
    assert_int_equal(iris_pnm_write_begin(&writer, sink, (iris_size){1, 0}, IRIS_GRAY8), IRIS_ERR_RANGE);
    assert_int_equal(iris_pnm_write(sink, NULL), IRIS_ERR_ARG);
    assert_int_equal(memory.used, 0);
    assert_int_equal(iris_pnm_write_begin(&writer, sink, (iris_size){1, 1}, IRIS_MASK1), IRIS_OK);
    assert_int_equal(iris_pnm_write_row(&writer, (uint8_t *)words + 1), IRIS_ERR_ALIGN);
    assert_int_equal(iris_pnm_write_end(&writer), IRIS_ERR_TRUNCATED);
    assert_int_equal(iris_pnm_write_row(&writer, words), IRIS_OK);
    assert_int_equal(iris_pnm_write_row(&writer, words), IRIS_ERR_RANGE);
    assert_int_equal(iris_pnm_write_end(&writer), IRIS_OK);
    assert_int_equal(iris_pnm_write_row(NULL, words), IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_write_end(NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_pnm_write_begin(&writer, sink, (iris_size){1, 1}, IRIS_GRAY_U16), IRIS_OK);
    assert_int_equal(iris_pnm_write_row(&writer, (uint8_t *)words + 1), IRIS_ERR_ALIGN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(headers_are_read_or_refused),
        cmocka_unit_test(headers_end),
        cmocka_unit_test(pixels_by_hand),
        cmocka_unit_test(shared_pictures_are_read),
        cmocka_unit_test(cut_or_failing_anywhere_is_reported),
        cmocka_unit_test(kinds_may_be_mixed_in_a_stream),
        cmocka_unit_test(writer_writes_these_bytes),
        cmocka_unit_test(what_is_written_is_read_back),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("pnm", tests, NULL, NULL);
}
