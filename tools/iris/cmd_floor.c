#include <math.h>
#include <stdio.h>
#include <string.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "file_write.h"
#include "floor_file.h"
#include "floor_mounting.h"
#include "frame_reader.h"
#include "json.h"
#include "one_line.h"

static const char help[] =
    "usage: iris floor --points FILE (--size WxH | --image IN) [--json] [-o FLOOR]\n"
    "       iris floor --calib CAMERA --height MM --tilt DEG [--pan DEG] [--roll DEG] [--ahead MM]\n"
    "                  [--right MM] [--json] [-o FLOOR]\n\n"
    "From marks on the floor to a floor file: how the camera sees the floor, for iris birdseye and\n"
    "--floor of follow, lines, paths, and blobs. Prints how far the marks are from where the floor would\n"
    "show them, and warns of marks that do not fit. Or from a calibrated camera and how it is mounted:\n"
    "the floor of pictures after iris undistort --calib, if its lens bends. Marks say it more exactly.\n\n"
    "  --points FILE  a mark per line, four at least, not three of four on a line: x y X Y.\n"
    "                 x y: where the picture shows it, pixels, 0 0 is the center of the top left\n"
    "                 one; X Y: where it is on the floor, millimeters, X to the right of, Y ahead\n"
    "                 of a place of your choice (to steer by: the middle of the robot's axle).\n"
    "                 Blanks, tabs, commas, or semicolons stand between numbers (1.5: with a point).\n"
    "                 What stands behind a # does not count. -: standard input\n"
    "  --size WxH     of the pictures that the marks were read off\n"
    "  --image IN     the same, from one of these pictures\n" MOUNTING_OPTION_HELP
    "  --json         one JSON object; of a mounting, near_mm and middle_mm say where on the floor the\n"
    "                 middle of the picture's lower edge is, and its middle; lens_px, how far it bends\n"
    "  -o FLOOR       writes the floor file (a text); -: to standard output, and nothing else\n\n"
    "example: iris floor --points marks.txt --image floor.bmp -o robot.floor\n"
    "         iris floor --calib left.camera --height 240 --tilt 35 -o robot.floor\n";

#define ODD_CHANCE 0.01 /* of a warning of marks that are all good */

#define BYTE_ORDER_MARK "\xEF\xBB\xBF" /* of UTF-8; some editors put it in front of a text */

typedef struct {
    iris_floor_mark marks[IRIS_FLOOR_MARKS_MAX];
    int lines[IRIS_FLOOR_MARKS_MAX];
    int32_t count;
} mark_list;

enum {
    HALF = 32768,   /* a pixel reaches so far to each side */
    BAD_FIT_PX = 5, /* root mean square: marks are read off better */
    ODD_PX = 3      /* a mark that is off by less is none to warn of */
};

typedef struct {
    iris_floor floor;
    iris_floor_quality quality;
    const mark_list *list;
} result;

static int read_mark(iris_floor_mark *mark, char *line)
{
    int32_t values[4];
    int count = 0;
    static const char between[] = " \t\r,;";
    char *rest = line;
    for (char *word = strtok_r(line, between, &rest); word; word = strtok_r(NULL, between, &rest)) {
        if (count == 4 || !args_q16(&values[count++], -INT32_MAX, INT32_MAX, word)) {
            return -1;
        }
    }
    if (count == 4) {
        *mark = (iris_floor_mark){{values[0], values[1]}, {values[2], values[3]}};
    }
    return count == 0 ? 0 : count == 4 ? 1 : -1;
}

/* Reads the marks. Returns an exit code after complaining. */
static int read_marks(mark_list *list, const char *path)
{
    static char text[TEXT_FILE_BYTES];
    size_t length = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return EXIT_BAD_DATA;
    }
    text[length] = '\0';
    int number = 0;
    int has_mark = strncmp(text, BYTE_ORDER_MARK, strlen(BYTE_ORDER_MARK)) == 0;
    for (char *line = has_mark ? text + strlen(BYTE_ORDER_MARK) : text; line; number++) {
        char *end = memchr(line, '\n', (size_t)(text + length - line));
        char *next = end ? end + 1 : NULL;
        if (end) {
            *end = '\0';
        }
        iris_floor_mark mark;
        char *comment = strchr(line, '#');
        if (comment) {
            *comment = '\0';
        }
        int found = read_mark(&mark, line);
        if (found < 0) {
            complain(path,
                     "line %d: expected are x y X_mm Y_mm: four numbers within 32767 with blanks, "
                     "commas, or semicolons between them",
                     number + 1);
            return EXIT_BAD_DATA;
        }
        if (found && list->count == IRIS_FLOOR_MARKS_MAX) {
            complain(path, "line %d: more than %d points", number + 1, IRIS_FLOOR_MARKS_MAX);
            return EXIT_BAD_DATA;
        }
        if (found) {
            list->lines[list->count] = number + 1;
            list->marks[list->count++] = mark;
        }
        line = next;
    }
    return EXIT_DONE;
}

/* How far a mark is from where a floor shows it, in pixels. */
static double distance_px(const iris_floor *floor, const iris_floor_mark *mark)
{
    iris_place put = {0, 0};
    (void)iris_floor_image(&put, floor, mark->floor);
    return hypot((double)put.x_q16 - mark->image.x_q16, (double)put.y_q16 - mark->image.y_q16) / 65536;
}

static double off_px(const result *r, int32_t i)
{
    return distance_px(&r->floor, &r->list->marks[i]);
}

static void warn_outside(const char *path, const result *r)
{
    const int64_t w = r->floor.size.w, h = r->floor.size.h;
    int32_t first = -1, count = 0;
    for (int32_t i = 0; i < r->list->count; i++) {
        iris_place at = r->list->marks[i].image;
        if (at.x_q16 < -HALF || at.y_q16 < -HALF || at.x_q16 > w * 65536 - HALF ||
            at.y_q16 > h * 65536 - HALF) {
            first = count == 0 ? i : first;
            count++;
        }
    }
    if (count > 0) {
        iris_place at = r->list->marks[first].image;
        complain(path, "warning: line %d: %g %g is outside of the picture of %dx%d pixels%s",
                 r->list->lines[first], at.x_q16 / 65536.0, at.y_q16 / 65536.0, (int)w, (int)h,
                 count > 1 ? ", and it is not the only one" : "");
    }
}

/* How probable it is that without one mark the others fit so much better by chance: with errors as they are normally
 * distributed the F test of 2 and 2 (count - 5) degrees of freedom, for the best of `count` marks. */
static double chance(const iris_floor_quality *all, const iris_floor_quality *others, int32_t count)
{
    double before = pow(all->rms_px_q16, 2) * count, after = pow(others->rms_px_q16, 2) * (count - 1);
    return count * pow(after / before, count - 5);
}

/* The mark that does not fit the others, and how far off from these it is; -1: none. It need not be the one that is
 * worst with all of them, as it draws the floor to itself. */
static int32_t odd_one(double *px, const result *r)
{
    static iris_floor_mark others[IRIS_FLOOR_MARKS_MAX];
    int32_t count = r->list->count, odd = -1;
    iris_q16 least = r->quality.rms_px_q16;
    for (int32_t i = 0; i < count && count > 5; i++) { /* five others have something to compare */
        iris_floor floor;
        iris_floor_quality quality;
        memcpy(others, r->list->marks, sizeof others);
        others[i] = others[count - 1];
        if (iris_floor_fit(&floor, &quality, r->floor.size, others, count - 1) == IRIS_OK &&
            quality.rms_px_q16 < least) {
            least = quality.rms_px_q16;
            *px = distance_px(&floor, &r->list->marks[i]);
            odd = *px > ODD_PX && chance(&r->quality, &quality, count) < ODD_CHANCE ? i : -1;
        }
    }
    return odd;
}

/* Says on standard error what is suspicious about the marks. */
static void warn(const char *path, const result *r)
{
    double px = 0;
    int32_t odd = odd_one(&px, r);
    warn_outside(path, r);
    if (odd >= 0) {
        complain(path, "warning: line %d does not fit the others: %.1f pixels from where they put it",
                 r->list->lines[odd], px);
    } else if (r->quality.rms_px_q16 > BAD_FIT_PX * 65536) {
        complain(
            path,
            "warning: the points do not fit each other: off by %.1f pixels (root mean square), line %d the "
            "most, by %.1f",
            r->quality.rms_px_q16 / 65536.0, r->list->lines[r->quality.worst],
            r->quality.max_px_q16 / 65536.0);
    }
}

static int write_floor(FILE *file, const void *user)
{
    const result *r = user;
    char text[IRIS_FLOOR_TEXT_BYTES];
    size_t length = 0;
    (void)iris_floor_write_text(text, sizeof text, &length, &r->floor);
    fputs(text, file);
    fprintf(file, "\n# off by %.2f pixels and %.1f mm (root mean square), at most %.2f pixels and %.1f mm\n",
            r->quality.rms_px_q16 / 65536.0, r->quality.rms_mm_q16 / 65536.0, r->quality.max_px_q16 / 65536.0,
            r->quality.max_mm_q16 / 65536.0);
    for (int32_t i = 0; i < r->list->count; i++) {
        const iris_floor_mark *mark = &r->list->marks[i];
        fprintf(file, "# point %g %g at %g %g mm, off by %.2f pixels\n", mark->image.x_q16 / 65536.0,
                mark->image.y_q16 / 65536.0, mark->floor.x_q16 / 65536.0, mark->floor.y_q16 / 65536.0,
                off_px(r, i));
    }
    return !ferror(file) && fflush(file) == 0;
}

static void complain_flaw(const char *path, iris_floor_flaw flaw, int32_t count)
{
    static const char *const said[] = {
        [IRIS_FLOOR_FINE] = "",
        [IRIS_FLOOR_TOO_FEW] = "four different points are needed at least",
        [IRIS_FLOOR_IN_LINE] = "all points but one are on one line, or nearly: lay two marks beside it",
        [IRIS_FLOOR_HORIZON] = "no camera sees these points so: two may be interchanged, or x and y of one",
        [IRIS_FLOOR_MIRRORED] = "this is a mirror's view: are X (right) and Y (ahead) interchanged?"};
    complain(path, "%s (%d %s)", said[flaw], (int)count, count == 1 ? "point" : "points");
}

static void print_json(const result *r, const char *path, const char *output)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, path);
    json_key(&json, "output");
    json_string(&json, output);
    json_key(&json, "width");
    json_integer(&json, r->floor.size.w);
    json_key(&json, "height");
    json_integer(&json, r->floor.size.h);
    json_key(&json, "rms_px");
    json_number(&json, r->quality.rms_px_q16 / 65536.0, 3);
    json_key(&json, "max_px");
    json_number(&json, r->quality.max_px_q16 / 65536.0, 3);
    json_key(&json, "rms_mm");
    json_number(&json, r->quality.rms_mm_q16 / 65536.0, 2);
    json_key(&json, "max_mm");
    json_number(&json, r->quality.max_mm_q16 / 65536.0, 2);
    json_key(&json, "points");
    json_open(&json, '[');
    for (int32_t i = 0; i < r->list->count; i++) {
        json_open(&json, '{');
        json_key(&json, "line");
        json_integer(&json, r->list->lines[i]);
        json_key(&json, "off_px");
        json_number(&json, off_px(r, i), 3);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_text(const result *r, const char *path)
{
    const iris_floor_quality *q = &r->quality;
    one_line(stdout, path);
    printf(": %d points, off by %.2f pixels and %.1f mm (root mean square)\n", (int)r->list->count,
           q->rms_px_q16 / 65536.0, q->rms_mm_q16 / 65536.0);
    if (r->list->count == 4) {
        printf("four points fit always: a fifth would tell errors\n");
    } else {
        printf("worst: line %d, by %.2f pixels; at most %.1f mm\n", r->list->lines[q->worst],
               q->max_px_q16 / 65536.0, q->max_mm_q16 / 65536.0);
    }
}

static int size_of(iris_size *size, const char *size_text, const char *image)
{
    static frame_reader reader;
    int32_t sides[2];
    if (!size_text == !image) {
        complain(NULL, "the size of the pictures is needed once: --size WxH or --image IN");
        return EXIT_BAD_CALL;
    }
    if (size_text) {
        if (!args_numbers(sides, 2, 'x', size_text) || sides[0] < 1 || sides[0] > IRIS_SIDE_MAX ||
            sides[1] < 1 || sides[1] > IRIS_SIDE_MAX) {
            complain("--size", "WxH in pixels, not '%s'", size_text);
            return EXIT_BAD_CALL;
        }
        *size = (iris_size){sides[0], sides[1]};
        return EXIT_DONE;
    }
    iris_status status = frame_reader_open(&reader, image);
    status = status == IRIS_OK ? frame_reader_begin(&reader) : status;
    *size = reader.size;
    if (status != IRIS_OK) {
        complain(image, "%s", frame_reader_problem(&reader));
    }
    frame_reader_close(&reader);
    return status == IRIS_OK ? EXIT_DONE : EXIT_BAD_DATA;
}

static int run(const char *points, iris_size size, const char *output, int json)
{
    static mark_list list;
    result r = {.list = &list};
    int exit_code = read_marks(&list, points);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    if (iris_floor_fit(&r.floor, &r.quality, size, list.marks, list.count) != IRIS_OK) {
        complain_flaw(points, r.quality.flaw, list.count);
        return EXIT_BAD_DATA;
    }
    warn(points, &r);
    if (output && !file_write(output, write_floor, &r)) {
        return EXIT_BAD_DATA;
    }
    if (json) {
        print_json(&r, points, output);
    } else if (!output || strcmp(output, "-") != 0) {
        print_text(&r, points);
    }
    return EXIT_DONE;
}

static int check_call(const arguments *args, const char *points, const mounting_texts *mounting)
{
    if (args->operand_count > 0) {
        complain(args->operands[0], "no operand is expected: the marks are given by --points");
        return 0;
    }
    if (points && mounting_is_given(mounting)) {
        complain("--points", "not together with --calib and the mounting");
        return 0;
    }
    if (!points && !mounting_is_given(mounting)) {
        complain(NULL, "--points FILE is needed, or --calib, --height, and --tilt (see --help)");
        return 0;
    }
    return 1;
}

int cmd_floor(int argc, char **argv)
{
    const char *points = NULL, *size_text = NULL, *image = NULL, *output = NULL;
    mounting_texts mounting = {NULL};
    int json = 0;
    iris_size size = {0, 0};
    const args_option options[] = {MOUNTING_OPTIONS(mounting),    {"points", 0, NULL, &points},
                                   {"size", 0, NULL, &size_text}, {"image", 0, NULL, &image},
                                   {"json", 0, &json, NULL},      {"output", 'o', NULL, &output}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (!check_call(&args, points, &mounting)) {
        return EXIT_BAD_CALL;
    }
    if (json && output && strcmp(output, "-") == 0) {
        complain("--json", "not together with -o -");
        return EXIT_BAD_CALL;
    }
    if (!points) {
        if (size_text || image) {
            complain(NULL, "the camera file has the size of the pictures: without --size and --image");
            return EXIT_BAD_CALL;
        }
        return floor_from_mounting(&mounting, output, json);
    }
    exit_code = size_of(&size, size_text, image);
    return exit_code == EXIT_DONE ? run(points, size, output, json) : exit_code;
}
