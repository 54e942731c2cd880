#include "shape_teach.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "canny_options.h"
#include "complain.h"
#include "file_write.h"
#include "frame_reader.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/hough_shape.h"
#include "iris/xt/threshold.h"
#include "json.h"
#include "one_line.h"

static const char help[] =
    "usage: iris shape teach [--reference X,Y] [--entries N] [--sigma S] [--low L] [--high H]\n"
    "                        [--json] OUT.rtable TEMPLATE\n\n"
    "Makes the table by which iris shape find knows a shape: of the edges of TEMPLATE, a silhouette\n"
    "or any picture of the shape alone.\n\n"
    "  --reference X,Y   the point whose place is reported, pixels; default: the centroid of the\n"
    "                    outline\n"
    "  --entries N       outline points that are kept, 8 to 1024, default 256\n"
    "  --sigma S         of the Gaussian before Canny's edges, 0.1 to 40 pixels; 0: none.\n"
    "                    Default 1.4\n"
    "  --low L, --high H Canny's thresholds, 0 to 32767. Default: from the picture, by its noise, at\n"
    "                    most 40 and 100. A silhouette needs none\n"
    "  --json            one JSON object: file, output, x and y of the reference point, points of\n"
    "                    the outline, entries, and bytes\n\n"
    "example: iris shape teach key.rtable key.bmp\n";

#define POINTS_MAX 32767 /* of a template */

typedef struct {
    uint8_t bytes[IRIS_HOUGH_SHAPE_TABLE_BYTES(IRIS_HOUGH_SHAPE_ENTRIES_MAX)];
    size_t count;
} table;

typedef struct {
    const char *output, *file;
    int json;
    iris_canny_config canny;
    iris_hough_shape_teaching teaching;
} teaching;

/* x,y in pixels with fractions. */
static int read_reference(iris_hough_shape_teaching *by, const char *text)
{
    char x[32];
    const char *comma = strchr(text, ',');
    size_t length = comma ? (size_t)(comma - text) : sizeof x;
    if (length < sizeof x) {
        memcpy(x, text, length);
        x[length] = '\0';
        by->is_chosen = 1;
        if (args_q16(&by->x_q16, INT32_MIN, INT32_MAX, x) &&
            args_q16(&by->y_q16, INT32_MIN, INT32_MAX, comma + 1)) {
            return 1;
        }
    }
    complain("--reference", "x,y in pixels, not '%s'", text);
    return 0;
}

/* Returns ARGS_GO or an exit code. */
static int parse(teaching *t, int argc, char **argv)
{
    canny_texts edges = {NULL, NULL, NULL};
    const char *reference = NULL, *entries = NULL;
    const args_option options[] = {{"reference", 0, NULL, &reference}, {"entries", 0, NULL, &entries},
                                   {"sigma", 0, NULL, &edges.sigma},   {"low", 0, NULL, &edges.low},
                                   {"high", 0, NULL, &edges.high},     {"json", 0, &t->json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int code = args_parse(&args, argc, argv);
    if (code != ARGS_GO) {
        return code;
    }
    iris_hough_shape_teaching_defaults(&t->teaching);
    if (args.operand_count != 2) {
        complain(NULL, "teach takes two files, OUT.rtable and TEMPLATE (see iris shape teach --help)");
        return EXIT_BAD_CALL;
    }
    t->output = args.operands[0];
    t->file = args.operands[1];
    if (entries && (!args_numbers(&t->teaching.entries, 1, ',', entries) ||
                    t->teaching.entries < IRIS_HOUGH_SHAPE_ENTRIES_MIN ||
                    t->teaching.entries > IRIS_HOUGH_SHAPE_ENTRIES_MAX)) {
        complain("--entries", "a whole number from %d to %d, not '%s'", IRIS_HOUGH_SHAPE_ENTRIES_MIN,
                 IRIS_HOUGH_SHAPE_ENTRIES_MAX, entries);
        return EXIT_BAD_CALL;
    }
    return (!reference || read_reference(&t->teaching, reference)) && canny_options_read(&t->canny, &edges)
               ? ARGS_GO
               : EXIT_BAD_CALL;
}

/* Only black and white? *background: the level that most pixels of the frame's edge have. */
static int is_silhouette(uint8_t *background, const iris_image *gray)
{
    int32_t white = 0, all = 0;
    for (int32_t y = 0; y < gray->h; y++) {
        const uint8_t *row = iris_image_row(gray, y);
        for (int32_t x = 0; x < gray->w; x++) {
            if (row[x] != 0 && row[x] != 255) {
                return 0;
            }
            if (y == 0 || x == 0 || y == gray->h - 1 || x == gray->w - 1) {
                white += row[x] != 0;
                all++;
            }
        }
    }
    *background = 2 * white > all ? 255 : 0;
    return 1;
}

/* The template in gray. Returns 0 after complaining. */
static int load(picture_buffer *gray, const char *path)
{
    static frame_reader reader;
    iris_status status = frame_reader_open(&reader, path);
    status = status == IRIS_OK ? frame_reader_next(&reader, gray, IRIS_GRAY8) : status;
    frame_reader_close(&reader);
    if (status != IRIS_OK) {
        complain(path, "%s", frame_reader_problem(&reader));
    }
    return status == IRIS_OK;
}

/* The mean of the pixels along the inside of the outline. */
static void find_centroid(iris_hough_shape_teaching *by, const iris_image *gray, int on_white)
{
    int64_t sum_x = 0, sum_y = 0, count = 0;
    for (int32_t y = 0; y < gray->h; y++) {
        const uint8_t *row = iris_image_row(gray, y);
        const uint8_t *above = iris_image_row(gray, y > 0 ? y - 1 : 0);
        const uint8_t *below = iris_image_row(gray, y + 1 < gray->h ? y + 1 : y);
        for (int32_t x = 0; x < gray->w; x++) {
            int at_edge = x == 0 || y == 0 || x == gray->w - 1 || y == gray->h - 1;
            if ((row[x] == 0) == on_white && (at_edge || row[x - 1] != row[x] || row[x + 1] != row[x] ||
                                              above[x] != row[x] || below[x] != row[x])) {
                sum_x += x;
                sum_y += y;
                count++;
            }
        }
    }
    if (count > 0 && !by->is_chosen) {
        by->is_chosen = 1;
        by->x_q16 = (iris_q16)(sum_x * 65536 / count);
        by->y_q16 = (iris_q16)(sum_y * 65536 / count);
    }
}

/* The points of a silhouette; on white, those of its inside. */
static iris_status find_outline(iris_edge_point *points, int32_t most, int32_t *count, const iris_image *gray,
                                int on_white)
{
    picture_buffer mask = {0};
    iris_status status = picture_reserve(&mask, (iris_size){gray->w, gray->h}, IRIS_MASK1);
    if (status == IRIS_OK) {
        status = iris_threshold(&mask.image, gray, 127, on_white ? IRIS_SELECT_DARK : IRIS_SELECT_BRIGHT);
    }
    if (status == IRIS_OK) {
        status = iris_hough_shape_silhouette(points, most, count, &mask.image);
    }
    picture_free(&mask);
    for (int32_t i = 0; status == IRIS_OK && on_white && i < *count; i++) {
        points[i].angle = iris_angle_wrap(points[i].angle + 32768);
    }
    return status;
}

static iris_status find_canny(iris_edge_point *points, int32_t most, int32_t *count, const iris_image *gray,
                              const teaching *t)
{
    iris_canny_config canny = t->canny;
    iris_scratch scratch;
    size_t bytes = IRIS_EDGE_POINTS_SCRATCH_BYTES(gray->w, gray->h, canny.sigma_q16);
    size_t adapt_bytes = IRIS_CANNY_ADAPT_SCRATCH_BYTES(gray->w, canny.sigma_q16);
    bytes = bytes > adapt_bytes ? bytes : adapt_bytes;
    void *memory = malloc(bytes);
    (void)iris_scratch_init(&scratch, memory, memory ? bytes : 0);
    iris_status status = canny_options_adapt(&canny, gray, &scratch);
    if (status == IRIS_OK) {
        status = iris_edge_points(points, most, count, gray, &canny, &scratch);
    }
    free(memory);
    return status;
}

/* Edge points of the template. Null after complaining; given back with free. */
static iris_edge_point *find_points(int32_t *count, teaching *t)
{
    picture_buffer picture = {0};
    uint8_t background = 0;
    if (!load(&picture, t->file)) {
        picture_free(&picture);
        return NULL;
    }
    const iris_image *gray = &picture.image;
    int silhouette = is_silhouette(&background, gray);
    int32_t most = 2 * gray->w * gray->h + gray->w + gray->h; /* all sides of pixels */
    iris_edge_point *points = malloc((size_t)most * sizeof *points);
    iris_status status = !points      ? IRIS_ERR_SCRATCH
                         : silhouette ? find_outline(points, most, count, gray, background != 0)
                                      : find_canny(points, most, count, gray, t);
    if (status != IRIS_OK) {
        complain(t->file, "not enough memory");
        free(points);
        points = NULL;
    }
    if (silhouette) {
        find_centroid(&t->teaching, gray, background != 0);
        t->teaching.fraction_bits = 1;
    }
    picture_free(&picture);
    return points;
}

static int write_table(FILE *file, const void *user)
{
    const table *made = user;
    return fwrite(made->bytes, 1, made->count, file) == made->count && fflush(file) == 0;
}

static void say(const teaching *t, const table *made, int32_t points)
{
    iris_q16 x, y;
    int32_t entries;
    (void)iris_hough_shape_table(&entries, &x, &y, made->bytes, made->count);
    if (t->json) {
        json_writer json = json_to(stdout);
        json_open(&json, '{');
        json_key(&json, "file");
        json_string(&json, t->file);
        json_key(&json, "output");
        json_string(&json, t->output);
        json_key(&json, "x");
        json_number(&json, x / 65536.0, 2);
        json_key(&json, "y");
        json_number(&json, y / 65536.0, 2);
        json_key(&json, "points");
        json_integer(&json, points);
        json_key(&json, "entries");
        json_integer(&json, entries);
        json_key(&json, "bytes");
        json_integer(&json, (int64_t)made->count);
        json_close(&json, '}');
    } else if (strcmp(t->output, "-") != 0) {
        one_line(stdout, t->file);
        printf(": outline of %d points, %d kept; reference point %.1f, %.1f; %d bytes\n", (int)points,
               (int)entries, x / 65536.0, y / 65536.0, (int)made->count);
    }
}

/* Why points make no table. */
static void say_why(const teaching *t, int32_t points)
{
    if (points < IRIS_HOUGH_SHAPE_ENTRIES_MIN) {
        complain(t->file, "%d edge points, %d are needed: no shape to teach", (int)points,
                 IRIS_HOUGH_SHAPE_ENTRIES_MIN);
    } else if (points > POINTS_MAX) {
        complain(t->file, "%d edge points, more than %d: no shape to teach; make the picture smaller",
                 (int)points, POINTS_MAX);
    } else {
        complain(t->file,
                 "the outline is farther than %d pixels from the reference point: choose a nearer "
                 "--reference, or make the picture smaller",
                 IRIS_HOUGH_SHAPE_REACH_MAX);
    }
}

int shape_teach(int argc, char **argv)
{
    static teaching t;
    static table made;
    int32_t count = 0;
    int code = parse(&t, argc, argv);
    iris_edge_point *points = code == ARGS_GO ? find_points(&count, &t) : NULL;
    if (!points) {
        return code == ARGS_GO ? EXIT_BAD_DATA : code;
    }
    iris_status status =
        iris_hough_shape_teach(made.bytes, sizeof made.bytes, &made.count, points, count, &t.teaching);
    free(points);
    if (status != IRIS_OK) {
        say_why(&t, count);
        return EXIT_BAD_DATA;
    }
    if (!file_write(t.output, write_table, &made)) {
        return EXIT_BAD_DATA;
    }
    say(&t, &made, count);
    return EXIT_DONE;
}
