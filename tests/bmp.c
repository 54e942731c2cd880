/* BMP reading: the conformance suite against its reference pictures, hand-made files, damaged files, streams.
 * Writing is in bmp_write.c. */
#include "iris/bmp.h"
#include "picture.h"

typedef struct {
    iris_status status;
    iris_bmp_reader reader;
    picture image; /* null pixels when the header was refused */
    int rows;      /* delivered */
} decoded;

/* Decodes the picture at the stream's position row by row. Rows not delivered are 0xAA. */
static decoded decode_stream(iris_stream *stream, iris_format format)
{
    decoded result = {0};
    result.status = iris_bmp_begin(&result.reader, stream);
    if (result.status != IRIS_OK) {
        return result;
    }
    iris_bmp_reader *reader = &result.reader;
    int channels = format == IRIS_GRAY8 ? 1 : 3;
    size_t row_bytes = (size_t)reader->w * (size_t)channels;
    if (row_bytes * (size_t)reader->h > 4u << 20) {
        result.status = iris_bmp_finish(reader);
        return result;
    }
    result.image = (picture){reader->w, reader->h, channels, malloc(row_bytes * (size_t)reader->h)};
    memset(result.image.pixels, 0xAA, row_bytes * (size_t)reader->h);
    uint8_t *row = malloc(row_bytes);
    while (result.status == IRIS_OK && result.rows < reader->h) {
        int32_t y = -1;
        result.status = iris_bmp_row(row, &y, reader, format);
        if (result.status == IRIS_OK) {
            assert_true(y >= 0 && y < reader->h);
            memcpy(result.image.pixels + (size_t)y * row_bytes, row, row_bytes);
            result.rows++;
        }
    }
    free(row);
    if (result.status == IRIS_OK) {
        assert_int_equal(iris_bmp_row(&channels, NULL, reader, format), IRIS_ERR_END);
        result.status = iris_bmp_finish(reader);
    }
    return result;
}

static decoded decode_from(awkward_source *from, iris_format format)
{
    iris_stream stream;
    assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, from}), IRIS_OK);
    return decode_stream(&stream, format);
}

static decoded decode(const uint8_t *data, size_t bytes, iris_format format)
{
    awkward_source from = {data, bytes, 0, SIZE_MAX, SIZE_MAX, NULL, 0};
    return decode_from(&from, format);
}

/* Largest difference of a channel where alpha (may have no pixels) is not 0; 999 for another size. */
static int difference(const picture *a, const picture *b, const picture *alpha)
{
    int largest = 0;
    if (a->w != b->w || a->h != b->h || a->channels != b->channels) {
        return 999;
    }
    for (int i = 0; i < a->w * a->h * a->channels; i++) {
        int d = abs(a->pixels[i] - b->pixels[i]);
        if (d > largest && (!alpha->pixels || alpha->pixels[i / a->channels] > 0)) {
            largest = d;
        }
    }
    return largest;
}

/* Is the picture within 1 of any reference named in a list with commas? */
static int matches(const picture *image, const char *list)
{
    char names[256];
    snprintf(names, sizeof names, "%s", list);
    for (char *name = strtok(names, ","); name; name = strtok(NULL, ",")) {
        char path[300];
        snprintf(path, sizeof path, "bmp/ref/%s.ppm", name);
        picture reference = load_pnm(data_path(path));
        snprintf(path, sizeof path, "bmp/ref/%s.alpha.pgm", name);
        picture alpha = load_pnm(data_path(path));
        assert_non_null(reference.pixels);
        int d = difference(image, &reference, &alpha);
        free(reference.pixels);
        free(alpha.pixels);
        if (d <= 1) {
            return 1;
        }
    }
    return 0;
}

typedef struct {
    char name[64], references[128];
    uint8_t *data;
    size_t bytes;
} suite_file;

#define SUITE_MAX 64
static suite_file suite[SUITE_MAX];
static int suite_count;

static int load_suite(void **state)
{
    (void)state;
    FILE *manifest = fopen(data_path("bmp/MANIFEST.txt"), "r");
    char line[2048];
    while (manifest && fgets(line, sizeof line, manifest)) {
        suite_file *file = &suite[suite_count];
        char path[80];
        if (line[0] == '#' || sscanf(line, "%63[^\t]\t%127[^\t]", file->name, file->references) != 2) {
            continue;
        }
        snprintf(path, sizeof path, "bmp/%s", file->name);
        file->data = load_file(data_path(path), &file->bytes);
        assert_non_null(file->data);
        suite_count++;
        assert_true(suite_count < SUITE_MAX);
    }
    if (manifest) {
        fclose(manifest);
    }
    return 0;
}

static int free_suite(void **state)
{
    (void)state;
    while (suite_count > 0) {
        free(suite[--suite_count].data);
    }
    return 0;
}

/* The next file of a folder, 'g', 'q', or 'b'; null at the end. Skips the test without the data. */
static suite_file *next_file(char folder, int *i)
{
    if (suite_count == 0) {
        skip();
    }
    while (*i < suite_count && suite[*i].name[0] != folder) {
        (*i)++;
    }
    return *i < suite_count ? &suite[(*i)++] : NULL;
}

static void good_files_match_their_references(void **state)
{
    (void)state;
    int i = 0, right = 0, all = 0;
    for (suite_file *file; (file = next_file('g', &i)) != NULL; all++) {
        decoded result = decode(file->data, file->bytes, IRIS_RGB888);
        int good = result.status == IRIS_OK && matches(&result.image, file->references);
        if (!good) {
            printf("# %s: %s\n", file->name, iris_status_text(result.status));
        }
        right += good;
        free(result.image.pixels);
    }
    printf("# good: %d of %d\n", right, all);
    assert_int_equal(all, 27);
    assert_int_equal(right, 27);
}

/* Not read by design: Huffman, JPEG, 64 bits. */
static void questionable_files_are_right_or_refused(void **state)
{
    (void)state;
    int i = 0, right = 0, refused = 0, wrong = 0;
    for (suite_file *file; (file = next_file('q', &i)) != NULL;) {
        decoded result = decode(file->data, file->bytes, IRIS_RGB888);
        if (result.status == IRIS_OK && matches(&result.image, file->references)) {
            right++;
        } else if (result.status == IRIS_ERR_UNSUPPORTED) {
            refused++;
            assert_null(result.image.pixels);
        } else {
            printf("# %s: %s\n", file->name, iris_status_text(result.status));
            wrong++;
        }
        free(result.image.pixels);
    }
    printf("# questionable: %d right, %d refused, %d wrong\n", right, refused, wrong);
    assert_int_equal(wrong, 0);
    assert_int_equal(right, 19);
}

static void bad_files_are_refused_or_read_partially(void **state)
{
    (void)state;
    const struct {
        const char *name;
        iris_status status;
    } expected[] = {
        {"b/badbitcount.bmp", IRIS_ERR_DATA}, {"b/baddens1.bmp", IRIS_OK},
        {"b/badfilesize.bmp", IRIS_OK},       {"b/badpalettesize.bmp", IRIS_OK},
        {"b/badwidth.bmp", IRIS_ERR_DATA},    {"b/reallybig.bmp", IRIS_ERR_RANGE},
        {"b/rletopdown.bmp", IRIS_ERR_DATA},
    };
    int i = 0, all = 0, read = 0, partial = 0;
    for (suite_file *file; (file = next_file('b', &i)) != NULL; all++) {
        decoded result = decode(file->data, file->bytes, IRIS_RGB888);
        for (size_t k = 0; k < sizeof expected / sizeof expected[0]; k++) {
            if (strcmp(expected[k].name, file->name) == 0) {
                assert_int_equal(result.status, expected[k].status);
            }
        }
        read += result.status == IRIS_OK;
        partial += result.status != IRIS_OK && result.rows > 0;
        free(result.image.pixels);
    }
    printf("# bad: %d read, %d read partially, %d refused\n", read, partial, all - read - partial);
    assert_int_equal(all, 10);
}

/* Gray is luma of the color, and BGR the color with its ends exchanged. */
static void every_output_format_tells_the_same(void **state)
{
    (void)state;
    int i = 0;
    for (suite_file *file; (file = next_file('g', &i)) != NULL;) {
        decoded rgb = decode(file->data, file->bytes, IRIS_RGB888);
        decoded bgr = decode(file->data, file->bytes, IRIS_BGR888);
        decoded gray = decode(file->data, file->bytes, IRIS_GRAY8);
        const uint8_t *color = rgb.image.pixels;
        int all_gray = 1;
        for (int k = 0; k < rgb.image.w * rgb.image.h; k++, color += 3) {
            assert_int_equal(bgr.image.pixels[3 * k], color[2]);
            assert_int_equal(bgr.image.pixels[3 * k + 1], color[1]);
            assert_int_equal(bgr.image.pixels[3 * k + 2], color[0]);
            double luma = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
            assert_true(gray.image.pixels[k] > luma - 1.2 && gray.image.pixels[k] < luma + 1.2);
            all_gray &= color[0] == color[1] && color[1] == color[2];
        }
        assert_true(!rgb.reader.is_gray || all_gray);
        if (strstr(file->name, "gs") || strstr(file->name, "pal1.") || strstr(file->name, "pal1wb")) {
            assert_int_equal(rgb.reader.is_gray, 1);
        }
        free(rgb.image.pixels);
        free(bgr.image.pixels);
        free(gray.image.pixels);
    }
}

/* A whole image into views of any stride says the same as the rows. */
static void whole_image_equals_its_rows(void **state)
{
    (void)state;
    int i = 0;
    for (suite_file *file; (file = next_file('g', &i)) != NULL;) {
        decoded rows = decode(file->data, file->bytes, IRIS_RGB888);
        iris_size size = {rows.image.w, rows.image.h};
        ptrdiff_t stride = i % 2 ? -400 : 416;
        static uint8_t buffer[416 * 64];
        iris_memory_source memory = {file->data, file->bytes, 0};
        iris_stream stream;
        iris_bmp_reader reader;
        iris_image image;
        assert_int_equal(iris_stream_init(&stream, iris_source_memory(&memory)), IRIS_OK);
        assert_int_equal(iris_bmp_begin(&reader, &stream), IRIS_OK);
        assert_int_equal(iris_image_wrap(&image, buffer, sizeof buffer, size, stride, IRIS_RGB888), IRIS_OK);
        assert_int_equal(iris_bmp_read(&image, &reader), IRIS_OK);
        for (int y = 0; y < size.h; y++) {
            size_t row_bytes = 3 * (size_t)size.w;
            assert_memory_equal(iris_image_row(&image, y), rows.image.pixels + (size_t)y * row_bytes,
                                row_bytes);
        }
        assert_int_equal(memory.position, file->bytes);
        assert_int_equal(iris_bmp_finish(&reader), IRIS_ERR_END);
        free(rows.image.pixels);
    }
}

static void sources_may_give_single_bytes(void **state)
{
    (void)state;
    int i = 0;
    for (suite_file *file; (file = next_file('g', &i)) != NULL;) {
        decoded whole = decode(file->data, file->bytes, IRIS_RGB888);
        awkward_source single = {file->data, file->bytes, 0, 1, SIZE_MAX, NULL, 0};
        decoded bytes = decode_from(&single, IRIS_RGB888);
        assert_int_equal(bytes.status, IRIS_OK);
        assert_int_equal(difference(&whole.image, &bytes.image, &(picture){0}), 0);
        free(whole.image.pixels);
        free(bytes.image.pixels);
    }
}

/* The rows delivered must be those of the whole file, in file order. */
static void assert_rows_agree(const decoded *part, const decoded *whole)
{
    size_t row_bytes = 3 * (size_t)whole->image.w;
    for (int k = 0; k < part->rows; k++) {
        int y = whole->reader.top_down ? k : whole->image.h - 1 - k;
        assert_memory_equal(part->image.pixels + (size_t)y * row_bytes,
                            whole->image.pixels + (size_t)y * row_bytes, row_bytes);
    }
}

static void cut_anywhere_keeps_the_rows_before(void **state)
{
    (void)state;
    int i = 0;
    for (suite_file *file; (file = next_file('g', &i)) != NULL;) {
        decoded whole = decode(file->data, file->bytes, IRIS_RGB888);
        size_t header = whole.reader.pixels;
        for (size_t bytes = 0; bytes < file->bytes;
             bytes += bytes < header + 8 || bytes + 8 > file->bytes ? 1 : 173) {
            decoded part = decode(file->data, bytes, IRIS_RGB888);
            if (bytes == 0) {
                assert_int_equal(part.status, IRIS_ERR_END);
            } else if (part.status != IRIS_OK || bytes + 4 < file->bytes) {
                assert_int_equal(part.status,
                                 IRIS_ERR_TRUNCATED); /* only padding and end marks may be missing */
            }
            assert_true(bytes >= header || !part.image.pixels);
            assert_rows_agree(&part, &whole);
            free(part.image.pixels);
        }
        free(whole.image.pixels);
    }
}

static void failing_sources_are_reported(void **state)
{
    (void)state;
    int i = 0;
    for (suite_file *file; (file = next_file('g', &i)) != NULL;) {
        decoded whole = decode(file->data, file->bytes, IRIS_RGB888);
        for (size_t n = 0; n < file->bytes; n += n < whole.reader.pixels + 8 ? 1 : 211) {
            awkward_source from = {file->data, file->bytes, 0, 50, n, NULL, 0};
            decoded part = decode_from(&from, IRIS_RGB888);
            assert_int_equal(part.status, IRIS_ERR_IO);
            assert_rows_agree(&part, &whole);
            uint8_t row[400];
            if (part.image.pixels) {
                assert_int_equal(iris_bmp_row(row, NULL, &part.reader, IRIS_RGB888), IRIS_ERR_IO);
            }
            free(part.image.pixels);
        }
        free(whole.image.pixels);
    }
}

static void damaged_headers_do_no_harm(void **state)
{
    (void)state;
    int i = 0, ended[IRIS_ERR_END + 1] = {0};
    uint32_t random = 7;
    for (suite_file *file;
         (file = next_file(i < suite_count && suite[i].name[0] == 'g' ? 'g' : 'q', &i)) != NULL;) {
        uint8_t *data = malloc(file->bytes);
        for (int round = 0; round < 300; round++) {
            memcpy(data, file->data, file->bytes);
            for (int flips = 1 + round % 3; flips > 0; flips--) {
                uint32_t at = next_random(&random) % (round % 4 == 3 ? 200 : 60);
                data[at] =
                    (uint8_t)(round % 2 ? next_random(&random) : data[at] ^ 1u << next_random(&random) % 8);
            }
            decoded result = decode(data, file->bytes, round % 5 ? IRIS_RGB888 : IRIS_GRAY8);
            ended[result.status]++;
            free(result.image.pixels);
        }
        free(data);
    }
    printf("# damaged: %d read, %d truncated, %d refused\n", ended[IRIS_OK], ended[IRIS_ERR_TRUNCATED],
           ended[IRIS_ERR_DATA] + ended[IRIS_ERR_RANGE] + ended[IRIS_ERR_UNSUPPORTED]);
    assert_int_equal(ended[IRIS_ERR_ARG] + ended[IRIS_ERR_FORMAT] + ended[IRIS_ERR_IO] + ended[IRIS_ERR_END],
                     0);
}

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

/* The declared file size is followed a little, never far. */
static void files_follow_each_other(void **state)
{
    (void)state;
    if (suite_count == 0) {
        skip();
    }
    size_t total = 0, at = 0;
    for (int i = 0; i < suite_count; i++) {
        total += suite[i].bytes;
    }
    uint8_t *data = malloc(total);
    const char *left_out = "q/pal1huffmsb.bmp q/rgb24jpeg.bmp q/rgba64.bmp"; /* not read */
    for (int i = 0; i < suite_count; i++) {
        if (suite[i].name[0] != 'b' && !strstr(left_out, suite[i].name)) {
            memcpy(data + at, suite[i].data, suite[i].bytes);
            at += suite[i].bytes;
        }
    }
    for (int skipping = 0; skipping < 2; skipping++) {
        awkward_source from = {data, at, 0, SIZE_MAX, SIZE_MAX, NULL, 0};
        iris_stream stream;
        iris_picture_kind kind;
        int count = 0;
        assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, &from}), IRIS_OK);
        while (iris_stream_kind(&kind, &stream) == IRIS_OK) {
            assert_int_equal(kind, IRIS_PICTURE_BMP);
            if (skipping) {
                iris_bmp_reader reader;
                assert_int_equal(iris_bmp_begin(&reader, &stream), IRIS_OK);
                assert_int_equal(iris_bmp_finish(&reader), IRIS_OK);
            } else {
                decoded result = decode_stream(&stream, IRIS_GRAY8);
                assert_int_equal(result.status, IRIS_OK);
                free(result.image.pixels);
            }
            count++;
        }
        assert_int_equal(iris_stream_kind(&kind, &stream), IRIS_ERR_END);
        assert_int_equal(count, 27 + 19);
        assert_int_equal(stream.position, at);
    }
    free(data);
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
        cmocka_unit_test(good_files_match_their_references),
        cmocka_unit_test(questionable_files_are_right_or_refused),
        cmocka_unit_test(bad_files_are_refused_or_read_partially),
        cmocka_unit_test(every_output_format_tells_the_same),
        cmocka_unit_test(whole_image_equals_its_rows),
        cmocka_unit_test(sources_may_give_single_bytes),
        cmocka_unit_test(cut_anywhere_keeps_the_rows_before),
        cmocka_unit_test(failing_sources_are_reported),
        cmocka_unit_test(damaged_headers_do_no_harm),
        cmocka_unit_test(run_lengths_by_hand),
        cmocka_unit_test(run_lengths_cannot_go_on_forever),
        cmocka_unit_test(bit_fields_by_hand),
        cmocka_unit_test(absurd_headers_are_refused),
        cmocka_unit_test(files_follow_each_other),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("bmp", tests, load_suite, free_suite);
}
