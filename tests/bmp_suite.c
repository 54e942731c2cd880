/* BMP reading: the conformance suite against its reference pictures, whole, cut, damaged, and one after another. */
#include "bmp_decode.h"

/* Largest difference of a channel where alpha (may have no pixels) is not 0; 999 for another size. */
static inline int difference(const picture *a, const picture *b, const picture *alpha)
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
    char *rest = NULL;
    for (char *name = strtok_r(names, ",", &rest); name; name = strtok_r(NULL, ",", &rest)) {
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
        cmocka_unit_test(files_follow_each_other),
    };
    return cmocka_run_group_tests_name("bmp_suite", tests, load_suite, free_suite);
}
