/* iris shape: teach (shape_teach.c), and find, which is an operation on pictures. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "canny_options.h"
#include "canvas.h"
#include "chain.h"
#include "commands.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/hough_shape.h"
#include "one_line.h"
#include "shape_teach.h"

static const char help[] =
    "usage: iris shape teach OUT.rtable TEMPLATE    (iris shape teach --help)\n"
    "       iris shape find TEMPLATE.rtable IMAGE...    (iris shape find --help)\n\n"
    "A shape that is taught once is found in pictures wherever it is, turned, larger or smaller,\n"
    "in clutter and noise, and when a third of its outline is hidden.\n\n"
    "example: iris shape teach key.rtable key.bmp\n"
    "         iris shape find key.rtable desk.bmp --scales 0.7-1.4:0.1 -o seen.bmp\n";

static const char find_help[] =
    "usage: iris shape find [--angles STEP] [--scales A-B:STEP] [--score S] [--count N]\n"
    "                       [--polarity P] [--sigma S] [--low L] [--high H]\n"
    "                       [--roi x,y,w,h] [--json] TEMPLATE.rtable IMAGE... [-o OUT]\n\n"
    "Where the shape of a table made by iris shape teach is, best first.\n\n"
    "  --angles STEP     of all directions, each so many degrees, 0.5 to 360; default 5\n"
    "  --scales A-B:STEP sizes from A to B times the template's, 0.1 to 8; default 0.7-1.4:0.1.\n"
    "                    STEP may be left out: 0.1. One number alone is the only size\n"
    "  --score S         the least share of the outline that is clearly seen, 0.001 to 1; default 0.4\n"
    "  --count N         the best N at most, 1 to 32; default 32\n"
    "  --polarity P      either (the default); same: the shape is as bright or dark against its\n"
    "                    surroundings as the template; reversed: the other way round\n"
    "  --sigma S         of the Gaussian before Canny's edges, 0.1 to 40 pixels; 0: none.\n"
    "                    Default 1.4\n"
    "  --low L, --high H Canny's thresholds, 0 to 32767. Default: from the picture, by its noise, at\n"
    "                    most 40 and 100\n" OPERATION_OPTIONS "\n"
    "JSON has shapes, a list of x, y (where the template's reference point lies, pixels), angle_deg\n"
    "(clockwise as seen), scale, and score (the share of the outline that is clearly seen).\n"
    "OUT is the picture with the outlines drawn in.\n\n"
    "example: iris shape find key.rtable desk.bmp --scales 0.7-1.4:0.1 -o seen.bmp\n";

typedef struct {
    iris_hough_shape_config config;
    iris_canny_config canny;
    int32_t count;
    size_t bytes;
    uint8_t table[IRIS_HOUGH_SHAPE_TABLE_BYTES(IRIS_HOUGH_SHAPE_ENTRIES_MAX)];
} settings;

/* What apply leaves for report and print. */
typedef struct {
    int32_t count, x, y; /* x, y: where the picture that was worked on begins */
    iris_hough_shape_found shapes[IRIS_HOUGH_SHAPE_PLACES];
} finding;

/* Edge points in the stage's memory; *found behind it is zeroed. Null after complaining. */
static iris_edge_point *edges_of(int32_t *count, finding **found, operation_stage *stage,
                                 const iris_image *gray)
{
    const settings *by = stage->settings;
    iris_canny_config canny = by->canny;
    size_t bytes = IRIS_EDGE_POINTS_SCRATCH_BYTES(gray->w, gray->h, canny.sigma_q16);
    size_t adapt_bytes = IRIS_CANNY_ADAPT_SCRATCH_BYTES(gray->w, canny.sigma_q16);
    iris_scratch *scratch = stage_scratch(stage, bytes > adapt_bytes ? bytes : adapt_bytes);
    int32_t most =
        gray->w * gray->h < IRIS_HOUGH_SHAPE_POINTS_MAX ? gray->w * gray->h : IRIS_HOUGH_SHAPE_POINTS_MAX;
    char *room = scratch ? stage_room(stage, sizeof **found + (size_t)most * sizeof(iris_edge_point)) : NULL;
    if (!room) {
        return NULL;
    }
    *found = (finding *)(void *)room;
    iris_edge_point *points = (iris_edge_point *)(void *)(room + sizeof **found);
    iris_status status = canny_options_adapt(&canny, gray, scratch);
    if (status == IRIS_OK) {
        status = iris_edge_points(points, most, count, gray, &canny, scratch);
    }
    *count = *count < most ? *count : most;
    return stage_exit(stage, status == IRIS_ERR_FULL ? IRIS_OK : status) == EXIT_DONE ? points : NULL;
}

static void draw(const iris_image *image, const iris_hough_shape *shape, const finding *found)
{
    canvas c = canvas_plain(image);
    for (int32_t i = found->count - 1; i >= 0; i--) {
        const iris_hough_shape_found *at = &found->shapes[i];
        double arm = 4 + (double)canvas_stroke(&c);
        for (int32_t k = 0; k < shape->entries; k++) {
            iris_q16 x, y;
            iris_angle direction;
            (void)iris_hough_shape_outline(&x, &y, &direction, shape, at, k);
            /* a short piece along the edge */
            double along_x = -sin(direction * M_PI / 32768), along_y = cos(direction * M_PI / 32768);
            canvas_line(&c, (canvas_point){x / 65536.0 - along_x, y / 65536.0 - along_y},
                        (canvas_point){x / 65536.0 + along_x, y / 65536.0 + along_y}, canvas_color(i));
        }
        canvas_cross(&c, (canvas_point){at->x_q16 / 65536.0, at->y_q16 / 65536.0}, arm, canvas_color(i));
    }
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_size size = {input->w, input->h};
    const iris_image *gray = stage_gray(stage, input);
    finding *found = NULL;
    int32_t points_count = 0;
    iris_edge_point *points = gray ? edges_of(&points_count, &found, stage, gray) : NULL;
    if (!points) {
        return EXIT_BAD_DATA;
    }
    iris_hough_shape shape;
    iris_hough_shape_config config = by->config;
    config.points = points_count > 0 ? points_count : 1;
    size_t entries = (by->bytes - IRIS_HOUGH_SHAPE_TABLE_BYTES(0)) / 6;
    iris_scratch *scratch = stage_scratch(
        stage, IRIS_HOUGH_SHAPE_SCRATCH_BYTES(size.w, size.h, config.cell, entries, config.points));
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    iris_status status = iris_hough_shape_begin(&shape, by->table, by->bytes, size, &config, scratch);
    if (status == IRIS_OK) {
        status = iris_hough_shape_find(found->shapes, by->count, &found->count, &shape, points, points_count);
    }
    if (status == IRIS_ERR_FULL) {
        found->count = by->count;
        status = IRIS_OK;
    }
    const iris_image *color = status == IRIS_OK ? stage_color(stage, input) : NULL;
    const iris_image *overlay = color ? stage_copy(stage, color) : NULL;
    if (!overlay) {
        return status == IRIS_OK ? EXIT_BAD_DATA : stage_exit(stage, status);
    }
    stage_origin(&found->x, &found->y, stage);
    draw(overlay, &shape, found);
    stage->finding = found;
    *result = *overlay;
    return EXIT_DONE;
}

static double degrees_of(iris_angle angle)
{
    return angle * 360.0 / 65536;
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    json_key(json, "shapes");
    json_open(json, '[');
    for (int32_t i = 0; i < found->count; i++) {
        const iris_hough_shape_found *at = &found->shapes[i];
        json_open(json, '{');
        json_key(json, "x");
        json_number(json, found->x + at->x_q16 / 65536.0, 2);
        json_key(json, "y");
        json_number(json, found->y + at->y_q16 / 65536.0, 2);
        json_key(json, "angle_deg");
        json_number(json, degrees_of(at->angle), 2);
        json_key(json, "scale");
        json_number(json, at->scale_q16 / 65536.0, 4);
        json_key(json, "score");
        json_number(json, at->score / 1000.0, 3);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void print(FILE *out, const operation_stage *stage)
{
    const finding *found = stage->finding;
    one_line(out, stage->file);
    fprintf(out, found->count == 1 ? ": 1 shape\n" : ": %d shapes\n", (int)found->count);
    for (int32_t i = 0; i < found->count; i++) {
        const iris_hough_shape_found *at = &found->shapes[i];
        fprintf(out, "  at %.1f, %.1f  angle %.1f  scale %.3f  score %.2f\n", found->x + at->x_q16 / 65536.0,
                found->y + at->y_q16 / 65536.0, degrees_of(at->angle), at->scale_q16 / 65536.0,
                at->score / 1000.0);
    }
}

/* A-B:STEP, A-B, or one number. */
static int read_scales(iris_hough_shape_config *config, const char *text)
{
    char copy[96];
    int32_t *numbers[3] = {&config->scale_min_q16, &config->scale_max_q16, &config->scale_step_q16};
    size_t length = strlen(text);
    if (length < sizeof copy) {
        memcpy(copy, text, length + 1);
        char *dash = strchr(copy, '-'), *colon = strchr(copy, ':');
        const char *parts[3] = {copy, dash ? dash + 1 : copy, colon ? colon + 1 : "0.1"};
        int fits = !colon || (dash && dash < colon);
        if (dash) {
            *dash = '\0';
        }
        if (colon) {
            *colon = '\0';
        }
        for (int i = 0; i < 3; i++) {
            fits = fits && args_q16(numbers[i], i < 2 ? IRIS_HOUGH_SHAPE_SCALE_MIN : 66,
                                    IRIS_HOUGH_SHAPE_SCALE_MAX, parts[i]);
        }
        if (fits && *numbers[0] <= *numbers[1] &&
            (*numbers[1] - *numbers[0]) / *numbers[2] < IRIS_HOUGH_SHAPE_SCALES_MAX) {
            return 1;
        }
    }
    complain("--scales", "A-B:STEP with sizes from 0.1 to 8 and at most 256 steps, not '%s'", text);
    return 0;
}

static int read_polarity(iris_hough_shape_polarity *polarity, const char *text)
{
    static const char *const names[] = {"same", "reversed", "either"};
    for (int i = IRIS_HOUGH_SHAPE_SAME; i <= IRIS_HOUGH_SHAPE_EITHER; i++) {
        if (strcmp(text, names[i]) == 0) {
            *polarity = (iris_hough_shape_polarity)i;
            return 1;
        }
    }
    complain("--polarity", "either, same, or reversed, not '%s'", text);
    return 0;
}

static int read_table(settings *by, const char *path)
{
    int32_t entries;
    iris_q16 x, y;
    FILE *file = fopen(path, "rb");
    if (!file) {
        complain(path, "%s", strerror(errno));
        return 0;
    }
    by->bytes = fread(by->table, 1, sizeof by->table, file);
    int failed = ferror(file), more = fgetc(file) != EOF;
    (void)fclose(file);
    iris_status status = iris_hough_shape_table(&entries, &x, &y, by->table, by->bytes);
    if (failed || more || status != IRIS_OK || by->bytes != IRIS_HOUGH_SHAPE_TABLE_BYTES(entries)) {
        complain(path, "%s (iris shape teach makes tables)",
                 failed                           ? "cannot be read"
                 : status == IRIS_ERR_UNSUPPORTED ? "a table of another version"
                                                  : "no table of a shape, or a damaged one");
        return 0;
    }
    return 1;
}

typedef struct {
    const char *angles, *scales, *score, *count, *polarity;
    canny_texts edges;
} texts;

static int read_numbers(settings *by, const texts *given)
{
    int32_t degrees_q16, score_q16;
    if (given->angles) {
        if (!args_q16(&degrees_q16, 32768, 360 * 65536, given->angles)) {
            complain("--angles", "a step of 0.5 to 360 degrees, not '%s'", given->angles);
            return 0;
        }
        by->config.angle_step = (degrees_q16 + 180) / 360;
    }
    if (given->score) {
        if (!args_q16(&score_q16, 65, 65536, given->score)) {
            complain("--score", "0.001 to 1, not '%s'", given->score);
            return 0;
        }
        by->config.min_score = (score_q16 * 125 + 4096) / 8192;
    }
    if (given->count && (!args_numbers(&by->count, 1, ',', given->count) || by->count < 1 ||
                         by->count > IRIS_HOUGH_SHAPE_PLACES)) {
        complain("--count", "a whole number from 1 to %d, not '%s'", IRIS_HOUGH_SHAPE_PLACES, given->count);
        return 0;
    }
    return 1;
}

static int parse(void *into, operation_words *words)
{
    settings *by = into;
    texts given = {.scales = "0.7-1.4:0.1", .polarity = "either"};
    const args_option options[] = {
        {"angles", 0, NULL, &given.angles},     {"scales", 0, NULL, &given.scales},
        {"score", 0, NULL, &given.score},       {"count", 0, NULL, &given.count},
        {"polarity", 0, NULL, &given.polarity}, {"sigma", 0, NULL, &given.edges.sigma},
        {"low", 0, NULL, &given.edges.low},     {"high", 0, NULL, &given.edges.high}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    iris_hough_shape_defaults(&by->config);
    by->count = IRIS_HOUGH_SHAPE_PLACES;
    if (!read_scales(&by->config, given.scales) || !read_polarity(&by->config.polarity, given.polarity) ||
        !read_numbers(by, &given) || !canny_options_read(&by->canny, &given.edges)) {
        return 0;
    }
    arguments *args = &words->arguments;
    if (args->operand_count < 2) {
        complain(NULL, "find takes a table and pictures (see iris shape find --help)");
        return 0;
    }
    if (!read_table(by, args->operands[0])) {
        words->exit_code = EXIT_BAD_DATA;
        return 0;
    }
    args->operands++;
    args->operand_count--;
    return 1;
}

static const operation find = {.name = "shape",
                               .summary = "a taught shape",
                               .help = find_help,
                               .parse = parse,
                               .apply = apply,
                               .report = report,
                               .print = print,
                               .reports_alone = 1};

int cmd_shape(int argc, char **argv)
{
    const char *verb = argc > 1 ? argv[1] : "";
    if (strcmp(verb, "teach") == 0) {
        return shape_teach(argc - 1, argv + 1);
    }
    if (strcmp(verb, "find") == 0) {
        return chain_command(&find, argc - 1, argv + 1);
    }
    if (strcmp(verb, "--help") == 0 || strcmp(verb, "-h") == 0) {
        fputs(help, stdout);
        return EXIT_DONE;
    }
    complain(*verb ? verb : NULL, "teach or find is to stand behind shape (see iris shape --help)");
    return EXIT_BAD_CALL;
}
