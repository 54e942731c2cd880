#include <string.h>

#include "canny_options.h"
#include "canvas.h"
#include "commands.h"
#include "iris/copy.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/hough_circle.h"
#include "iris/xt/votes.h"
#include "operation.h"
#include "picture_write.h"

static const char help[] =
    "usage: iris circles --radius A-B [--polarity NAME] [--share N] [--votes N] [--distance N]\n"
    "                    [--count N] [--low L] [--high H] [--sigma S] [--cell N]\n"
    "                    [--accumulator OUT] [--roi x,y,w,h] [--json] IN... [-o OUT]\n\n"
    "Circles by Hough transform: edges vote for centers in their direction, and what many agree\n"
    "on is tested against the edges. Color counts by its luma. Centers are inside the picture; of\n"
    "circles around one center the best is shown.\n\n"
    "  --radius A-B       radii, 3 to 1023 pixels; A alone: one radius, give or take a pixel\n"
    "  --polarity NAME    bright or dark discs, or either (the default)\n"
    "  --share N          the least part of the circumference that is seen, 1 to 1000 permil;\n"
    "                     default 300\n"
    "  --votes N          the least number of edge points, whatever the radius; default 0\n"
    "  --distance N       of circles whose centers are nearer than N pixels only the best is\n"
    "                     shown; default A\n"
    "  --count N          the best N circles at most\n"
    "  --low L, --high H  thresholds of edges: |dx| + |dy| of Sobel's operator, 0 to 32767;\n"
    "                     default: from the picture, H 24 to 100 and L two fifths of it\n"
    "  --sigma S          smooths first, by a Gaussian of S pixels, 0.1 to 40; 0 does not;\n"
    "                     default 1.4\n"
    "  --cell N           side of the accumulator's cells, 1 to 16 pixels; default 2\n"
    "  --accumulator OUT  writes the votes of all radii as a gray picture, too: a pixel for each\n"
    "                     cell, bright where centers are\n" OPERATION_OPTIONS "\n"
    "JSON has circles, best first (votes times share of the circumference): x, y, and r in pixels,\n"
    "and votes, the edge points along the circle. With -o they are drawn in color.\n\n"
    "example: iris circles --radius 10-50 --json coins.pgm -o found.bmp\n";

#define CIRCLES_MAX IRIS_CIRCLE_HYPOTHESES_MAX

typedef struct {
    iris_canny_config canny; /* low and high -1: from the picture */
    iris_circle_config circle;
    int32_t count;
    const char *accumulator; /* null: not written */
} settings;

/* What apply leaves for report, at the front of the room. */
typedef struct {
    int32_t count;
    iris_circle circles[CIRCLES_MAX];
} finding;

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* The edge points of gray into edges->points, which have room for all of its pixels. */
static iris_status find_edges(iris_edge_list *edges, iris_edge_point *points, const iris_image *gray,
                              operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_canny_config canny = by->canny;
    iris_scratch *scratch =
        stage_scratch(stage, larger(IRIS_EDGE_POINTS_SCRATCH_BYTES(gray->w, gray->h, canny.sigma_q16),
                                    IRIS_CANNY_ADAPT_SCRATCH_BYTES(gray->w, canny.sigma_q16)));
    *edges = (iris_edge_list){points, 0, {gray->w, gray->h}};
    if (!scratch) {
        return IRIS_ERR_SCRATCH;
    }
    iris_status status = canny_options_adapt(&canny, gray, scratch);
    return status == IRIS_OK
               ? iris_edge_points(points, gray->w * gray->h, &edges->count, gray, &canny, scratch)
               : status;
}

/* The most votes of each cell over all radii, as a picture. */
static int write_accumulator(const iris_edge_list *edges, operation_stage *stage)
{
    const settings *by = stage->settings;
    const iris_size cells = {(int32_t)IRIS_CIRCLE_CELLS(edges->size.w, by->circle.cell),
                             (int32_t)IRIS_CIRCLE_CELLS(edges->size.h, by->circle.cell)};
    const iris_image *most = stage_picture(stage, cells, IRIS_GRAY_U16);
    const iris_image *slice = most ? stage_picture(stage, cells, IRIS_GRAY_U16) : NULL;
    const iris_image *gray = slice ? stage_picture(stage, cells, IRIS_GRAY8) : NULL;
    iris_scratch *scratch = gray ? stage_scratch(stage, IRIS_CIRCLE_VOTE_SCRATCH_BYTES) : NULL;
    if (!scratch) {
        return 0;
    }
    (void)iris_fill(most, 0);
    for (int32_t radius = by->circle.radius_min; radius <= by->circle.radius_max; radius++) {
        (void)iris_fill(slice, 0);
        iris_status status = iris_circle_vote(slice, edges, radius, &by->circle, scratch);
        if (status != IRIS_OK) {
            return stage_exit(stage, status) == EXIT_DONE;
        }
        for (int32_t y = 0; y < cells.h; y++) {
            const uint16_t *from = iris_image_row(slice, y);
            uint16_t *to = iris_image_row(most, y);
            for (int32_t x = 0; x < cells.w; x++) {
                to[x] = from[x] > to[x] ? from[x] : to[x];
            }
        }
    }
    return stage_exit(stage, iris_votes_show(gray, most)) == EXIT_DONE &&
           picture_write(by->accumulator, gray);
}

static iris_status find_circles(finding *found, const iris_edge_list *edges, operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_scratch *scratch =
        stage_scratch(stage, IRIS_CIRCLE_SCRATCH_BYTES(edges->size.w, edges->size.h, edges->count,
                                                       by->circle.cell, by->circle.max_hypotheses));
    if (!scratch) {
        return IRIS_ERR_SCRATCH;
    }
    iris_status status =
        iris_hough_circles(found->circles, by->count, &found->count, edges, &by->circle, scratch);
    found->count = found->count > by->count ? by->count : found->count;
    return status == IRIS_ERR_FULL ? IRIS_OK : status;
}

static const iris_image *overlay(const iris_image *input, const finding *found, operation_stage *stage)
{
    const iris_image *color = stage_color(stage, input);
    color = color ? stage_copy(stage, color) : NULL;
    if (color) {
        canvas on = canvas_plain(color);
        for (int32_t i = found->count - 1; i >= 0; i--) {
            const iris_circle *c = &found->circles[i];
            const canvas_point center = {c->x_q16 / 65536.0, c->y_q16 / 65536.0};
            canvas_circle(&on, center, c->r_q16 / 65536.0, canvas_color(i));
            canvas_cross(&on, center, 3, canvas_color(i));
        }
    }
    return color;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const settings *by = stage->settings;
    const size_t pixels = (size_t)input->w * (size_t)input->h;
    const iris_image *gray = stage_gray(stage, input);
    finding *found = gray ? stage_room(stage, sizeof *found + pixels * sizeof(iris_edge_point)) : NULL;
    if (!found) {
        return EXIT_BAD_DATA;
    }
    iris_edge_list edges;
    iris_status status = find_edges(&edges, (iris_edge_point *)(found + 1), gray, stage);
    if (status != IRIS_OK) {
        return stage_exit(stage, status);
    }
    if (by->accumulator && !write_accumulator(&edges, stage)) {
        return EXIT_BAD_DATA;
    }
    status = find_circles(found, &edges, stage);
    const iris_image *drawn = status == IRIS_OK ? overlay(input, found, stage) : NULL;
    if (!drawn) {
        return status == IRIS_OK ? EXIT_BAD_DATA : stage_exit(stage, status);
    }
    stage->finding = found;
    *result = *drawn;
    return EXIT_DONE;
}

static void report_number(json_writer *json, const char *key, double number)
{
    json_key(json, key);
    json_number(json, number, 2);
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    json_key(json, "circles");
    json_open(json, '[');
    for (int32_t i = 0; i < found->count; i++) {
        const iris_circle *c = &found->circles[i];
        json_open(json, '{');
        report_number(json, "x", x + c->x_q16 / 65536.0);
        report_number(json, "y", y + c->y_q16 / 65536.0);
        report_number(json, "r", c->r_q16 / 65536.0);
        json_key(json, "votes");
        json_integer(json, c->votes);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void print(FILE *out, const operation_stage *stage)
{
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    fprintf(out, "%s: %d circle%s\n", stage->file, (int)found->count, found->count == 1 ? "" : "s");
    for (int32_t i = 0; i < found->count; i++) {
        const iris_circle *c = &found->circles[i];
        fprintf(out, "  center %.2f,%.2f, radius %.2f, %d votes\n", x + c->x_q16 / 65536.0,
                y + c->y_q16 / 65536.0, c->r_q16 / 65536.0, (int)c->votes);
    }
}

/* --- options --- */

static int read_radius(iris_circle_config *config, const char *text)
{
    int32_t read[2];
    if (!text) {
        complain("--radius", "missing: how large the circles are in pixels, such as 10-50");
        return 0;
    }
    if (args_numbers(read, 1, '-', text)) {
        read[1] = read[0];
    } else if (!args_numbers(read, 2, '-', text)) {
        read[0] = -1;
    }
    if (read[0] < IRIS_CIRCLE_RADIUS_MIN || read[1] < read[0] || read[1] > IRIS_CIRCLE_RADIUS_MAX) {
        complain("--radius", "a radius or A-B, %d to %d pixels, such as 10-50, not '%s'",
                 IRIS_CIRCLE_RADIUS_MIN, IRIS_CIRCLE_RADIUS_MAX, text);
        return 0;
    }
    config->radius_min = read[0];
    config->radius_max = read[1];
    config->min_distance = read[0];
    return 1;
}

static int read_polarity(iris_circle_polarity *polarity, const char *text)
{
    static const char *const names[] = {"either", "bright", "dark"};
    for (int i = 0; text && i < 3; i++) {
        if (strcmp(text, names[i]) == 0) {
            *polarity = (iris_circle_polarity)i;
            return 1;
        }
    }
    if (text) {
        complain("--polarity", "bright, dark, or either, not '%s'", text);
    }
    return text == NULL;
}

static int fit_together(const settings *by, const operation_words *words)
{
    if (by->accumulator && words->arguments.operand_count > 1) {
        complain("--accumulator", "only with one picture");
        return 0;
    }
    return 1;
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    const char *radius = NULL, *polarity = NULL, *share = NULL, *votes = NULL, *distance = NULL,
               *count = NULL;
    const char *cell = NULL;
    canny_texts edges = {NULL, NULL, NULL};
    const args_option options[] = {{"radius", 0, NULL, &radius},
                                   {"polarity", 0, NULL, &polarity},
                                   {"share", 0, NULL, &share},
                                   {"votes", 0, NULL, &votes},
                                   {"distance", 0, NULL, &distance},
                                   {"count", 0, NULL, &count},
                                   {"low", 0, NULL, &edges.low},
                                   {"high", 0, NULL, &edges.high},
                                   {"sigma", 0, NULL, &edges.sigma},
                                   {"cell", 0, NULL, &cell},
                                   {"accumulator", 0, NULL, &by->accumulator}};
    iris_circle_defaults(&by->circle);
    by->circle.max_hypotheses = 1024;
    by->count = CIRCLES_MAX;
    if (!operation_options(words, options, sizeof options / sizeof options[0]) ||
        !read_radius(&by->circle, radius)) {
        return 0;
    }
    const args_whole numbers[] = {{"--share", share, &by->circle.min_share_permil, 1, 1000},
                                  {"--votes", votes, &by->circle.min_votes, 0, 65535},
                                  {"--distance", distance, &by->circle.min_distance, 0, IRIS_SIDE_MAX},
                                  {"--count", count, &by->count, 1, CIRCLES_MAX},
                                  {"--cell", cell, &by->circle.cell, 1, IRIS_CIRCLE_CELL_MAX}};
    return args_wholes(numbers, sizeof numbers / sizeof numbers[0]) &&
           read_polarity(&by->circle.polarity, polarity) && canny_options_read(&by->canny, &edges) &&
           fit_together(by, words);
}

const operation operation_circles = {.name = "circles",
                                     .summary = "circles: centers and radii, by Hough transform",
                                     .help = help,
                                     .parse = parse,
                                     .apply = apply,
                                     .report = report,
                                     .print = print,
                                     .reports_alone = 1};
