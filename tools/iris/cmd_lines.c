#include "canny_options.h"
#include "canvas.h"
#include "commands.h"
#include "floor_option.h"
#include "iris/color.h"
#include "iris/copy.h"
#include "iris/xt/hough_segments.h"
#include "iris/xt/votes.h"
#include "operation.h"
#include "picture_write.h"

static const char help[] =
    "usage: iris lines [--low L] [--high H] [--sigma S] [--mask] [--votes N] [--angles LO,HI]\n"
    "                  [--theta-bins N] [--rho-step N] [--gap N] [--min-length N] [--count N]\n"
    "                  [--full-circle] [--accumulator OUT] [--floor FLOOR] [--roi x,y,w,h] [--json] IN...\n"
    "                  [-o OUT]\n\n"
    "Straight lines by Hough transform. In gray and color pictures Canny's edges vote for the\n"
    "lines along them, in masks (1-bit files) each white pixel for all lines through it. A stroke has\n"
    "two edges; of a thin one only the better is told (both with --full-circle).\n\n"
    "  --low L, --high H thresholds of edges: |dx| + |dy| of Sobel's operator, 0 to 32767;\n"
    "                    default 12 and 30; with H alone L is two fifths of it\n"
    "  --sigma S         smooths first, by a Gaussian of S pixels, 0.1 to 40; 0 does not;\n"
    "                    default 1.4\n"
    "  --mask            takes gray and color pictures as masks, white above 127\n"
    "  --votes N         the least votes of a line, 1 to 65535; default more than a line gets by\n"
    "                    chance, at least 25. Its segments have as many points\n"
    "  --angles LO,HI    only lines at LO to HI degrees: 0 upright, positive when leaning right,\n"
    "                    -90 to 90 (0 to 360 with --full-circle); LO above HI: through the\n"
    "                    level lines\n"
    "  --theta-bins N    angles that are told apart, 1 to 4096; default 180, and more for sides\n"
    "                    above 688 pixels (twice as many with --full-circle)\n"
    "  --rho-step N      1, 2, 4 to 64 pixels; default by the picture's size\n"
    "  --gap N           the longest gap in a segment, pixels; default 8\n"
    "  --min-length N    the shortest segment, pixels; default 20\n"
    "  --count N         the best N lines at most, 1 to 1024; default 256\n"
    "  --full-circle     theta from 0 to 360 degrees: where it gets brighter, so that the two\n"
    "                    sides of a stripe differ; of a mask: with rho not below 0\n"
    "  --accumulator OUT writes the votes as a gray picture, too: a row for each angle, from LO\n"
    "                    down, and a column for each rho\n" FLOOR_OPTION_HELP OPERATION_OPTIONS "\n"
    "JSON has lines, each a segment: rho and theta_deg are those of its line,\n"
    "x cos theta + y sin theta = rho, with x and y counted from the middle of the picture (of the\n"
    "part with --roi): rho is signed. Then votes, and its ends x0, y0 (the lower one), x1, y1.\n"
    "points and voting are the numbers of edge points (of white pixels of a mask) and of those that\n"
    "vote: of more than 1048576 edge points an even selection.\n"
    "With --floor also x0_mm, y0_mm, x1_mm, y1_mm, length_mm, and true_deg, the direction from x0, y0\n"
    "to x1, y1 on the floor (0 straight ahead, right positive); null beyond the horizon.\n"
    "With -o the segments are drawn in color.\n\n"
    "example: iris lines --json --votes 60 road.bmp -o found.bmp\n";

#define LINES_MAX     1024
#define LINES_DEFAULT 256
#define SEGMENTS_MAX  65536
#define POINTS_MAX    1048576 /* lines, each of which looks at all points, take seconds then */

typedef struct {
    iris_canny_config canny;
    iris_hough_config hough;
    iris_hough_segment_config segments;
    int is_mask;
    int32_t votes, rho_step; /* 0: by the picture's size, as hough.theta_bins */
    int32_t count;           /* most lines */
    const char *accumulator; /* null: not written */
    floor_option floor;
} settings;

/* What apply leaves for report, at the front of the room. */
typedef struct {
    int32_t count, lines;
    int32_t points, voting;
    int full_circle;
    iris_hough_segment *segments;
} finding;

/* A picture on its way. */
typedef struct {
    const settings *by;
    const iris_image *mask; /* null: edges vote */
    iris_edge_list edges;
    iris_hough hough;
    iris_hough_line *lines;
    int32_t line_count;
    finding *found;
} search;

/* 3 degrees. Little, as the points of a line vote for no other once they are in a segment. */
static int32_t theta_separation(const iris_hough_config *config)
{
    int32_t turn = config->full_circle ? 65536 : 32768;
    int32_t span = (config->angle_max - config->angle_min) & (turn - 1);
    int32_t bins = 546 * config->theta_bins / (span == 0 ? turn : span);
    return bins < 1 ? 1 : bins > IRIS_HOUGH_SEPARATION_MAX ? IRIS_HOUGH_SEPARATION_MAX : bins;
}

/* Bins that fit each other (hough.h): an angle moves a line's ends by 1 to 3 steps of rho. Steps stay at 2 pixels, as a
 * line has to be as near to its points as its segments reach, until there are 1440 angles in half a turn. */
static void fit_bins(iris_hough_config *config, const settings *by, iris_size size)
{
    int32_t longer = size.w > size.h ? size.w : size.h, side = 344;
    int has_bins = by->hough.theta_bins > 0;
    if (!has_bins) {
        config->theta_bins = config->full_circle ? 360 : 180;
    }
    int32_t most_bins = has_bins ? 0 : 8 * config->theta_bins;
    config->rho_step = 1;
    for (; longer > side && config->rho_step < IRIS_HOUGH_RHO_STEP_MAX; side *= 2) {
        if (config->rho_step == 1 || config->theta_bins >= most_bins) {
            config->rho_step *= 2;
        } else {
            config->theta_bins *= 2;
        }
    }
    config->rho_step = by->rho_step > 0 ? by->rho_step : config->rho_step;
}

static iris_hough_config config_of(const settings *by, iris_size size, int32_t points, int is_mask)
{
    iris_hough_config config = by->hough;
    fit_bins(&config, by, size);
    config.min_votes =
        by->votes > 0 ? by->votes : iris_hough_votes_beyond_chance(&config, size, points, !is_mask);
    config.theta_separation = theta_separation(&config);
    config.rho_separation = 4;
    config.rho_min = is_mask && config.full_circle ? 0 : config.rho_min;
    return config;
}

static int32_t selected_pixels(const iris_image *mask)
{
    int32_t sum = 0;
    for (int32_t y = 0; y < mask->h; y++) {
        const uint32_t *row = iris_image_row(mask, y);
        for (int32_t x = 0; x < mask->w; x++) {
            sum += (int32_t)(row[x / 32] >> x % 32 & 1);
        }
    }
    return sum;
}

static int32_t lesser(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* Room for results and points. Of a mask's pixels at least one in a segment each. */
static int make_room(search *in, operation_stage *stage)
{
    int32_t selected = in->mask ? selected_pixels(in->mask) : 0;
    int32_t most = in->mask ? selected : lesser(in->edges.size.w * in->edges.size.h, POINTS_MAX);
    size_t segments = (size_t)lesser(most, SEGMENTS_MAX), points = in->mask ? 0 : (size_t)most;
    char *room = stage_room(stage, sizeof *in->found + segments * sizeof *in->found->segments +
                                       LINES_MAX * sizeof *in->lines + points * sizeof *in->edges.points);
    if (!room) {
        return 0;
    }
    in->found = (finding *)(void *)room;
    in->found->points = in->found->voting = selected;
    in->found->segments = (iris_hough_segment *)(void *)(in->found + 1);
    in->lines = (iris_hough_line *)(void *)(in->found->segments + segments);
    in->edges.points = (iris_edge_point *)(void *)(in->lines + LINES_MAX);
    return 1;
}

/* All points vote. */
static iris_status vote(search *in, const iris_image *gray, iris_scratch *scratch)
{
    const settings *by = in->by;
    iris_size size = in->edges.size;
    iris_status status = IRIS_OK;
    if (gray) {
        int32_t most = lesser(size.w * size.h, POINTS_MAX);
        status = iris_edge_points(in->edges.points, most, &in->found->points, gray, &by->canny, scratch);
        status = status == IRIS_ERR_FULL ? IRIS_OK : status;
        in->edges.count = in->found->voting = lesser(in->found->points, most);
    }
    iris_hough_config config = config_of(by, size, in->found->voting, in->mask != NULL);
    if (status == IRIS_OK) {
        status = iris_hough_begin(&in->hough, size, &config, scratch);
    }
    if (status == IRIS_OK) {
        status = in->mask ? iris_hough_vote_mask(&in->hough, in->mask)
                          : iris_hough_vote_edges(&in->hough, in->edges.points, in->edges.count);
    }
    if (status == IRIS_OK) {
        status = iris_hough_peaks(in->lines, LINES_MAX, &in->line_count, &in->hough);
    }
    return status == IRIS_ERR_FULL ? IRIS_OK : status;
}

/* Moves the edge points that are far from the line to the front; returns how many. Segments then look at the others
 * alone. */
static int32_t set_far_apart(const iris_edge_list *edges, const iris_hough_line *line)
{
    int32_t w = edges->size.w, h = edges->size.h, far = 0;
    int64_t most = ((int64_t)(w > h ? w : h) / 64 + 6) * 65536;
    iris_q30 cosine = iris_cos_q30(line->angle), sine = iris_sin_q30(line->angle);
    for (int32_t i = 0; i < edges->count; i++) {
        iris_edge_point point = edges->points[i];
        int64_t rho_q16 =
            ((int64_t)(2 * point.x - w + 1) * cosine + (int64_t)(2 * point.y - h + 1) * sine) / 32768;
        if (rho_q16 - line->rho_q16 > most || line->rho_q16 - rho_q16 > most) {
            edges->points[i] = edges->points[far];
            edges->points[far++] = point;
        }
    }
    return far;
}

static iris_status next_segment(iris_hough_segment *segment, search *in, int32_t line, iris_scratch *scratch)
{
    iris_hough_segment_config config = in->by->segments;
    config.full_circle = in->by->hough.full_circle;
    return in->mask ? iris_hough_segment_of_mask(segment, in->mask, &in->lines[line], &config, scratch)
                    : iris_hough_segment_of_edges(segment, &in->edges, &in->lines[line], &config, scratch);
}

/* The best lines that have segments, with all of these. A line of votes that do not lie in its segments is none. */
static iris_status collect(search *in, iris_scratch *scratch)
{
    finding *found = in->found;
    int32_t lines = in->line_count < LINES_MAX ? in->line_count : LINES_MAX;
    iris_status status = IRIS_ERR_END;
    for (int32_t i = 0; i < lines && found->lines < in->by->count && status == IRIS_ERR_END; i++) {
        int32_t before = found->count, points = 0;
        int32_t far = in->mask ? 0 : set_far_apart(&in->edges, &in->lines[i]);
        in->edges.points += far;
        in->edges.count -= far;
        int has_too_few = !in->mask && in->edges.count < in->hough.config.min_votes;
        do {
            iris_hough_segment segment;
            status = has_too_few ? IRIS_ERR_END : next_segment(&segment, in, i, scratch);
            if (status == IRIS_OK && found->count == SEGMENTS_MAX) {
                return IRIS_ERR_FULL;
            }
            if (status == IRIS_OK) {
                found->segments[found->count++] = segment;
                points += segment.points;
            }
        } while (status == IRIS_OK);
        in->edges.points -= far;
        in->edges.count += far;
        if (points < in->hough.config.min_votes) {
            found->count = before;
        }
        found->lines += found->count > before;
    }
    return status == IRIS_ERR_END ? IRIS_OK : status;
}

static int write_accumulator(const search *in, operation_stage *stage)
{
    iris_image votes;
    iris_hough_accumulator(&votes, &in->hough);
    const iris_image *gray = stage_picture(stage, (iris_size){votes.w, votes.h}, IRIS_GRAY8);
    return gray && stage_exit(stage, iris_votes_show(gray, &votes)) == EXIT_DONE &&
           picture_write(in->by->accumulator, gray);
}

static const iris_image *overlay(const iris_image *input, const finding *found, operation_stage *stage)
{
    const iris_image *color = stage_color(stage, input);
    color = color ? stage_copy(stage, color) : NULL;
    if (color) {
        canvas on = canvas_plain(color);
        for (int32_t i = 0; i < found->count; i++) {
            const iris_hough_ends *e = &found->segments[i].ends;
            canvas_line(&on, (canvas_point){e->x0, e->y0}, (canvas_point){e->x1, e->y1}, canvas_color(i));
        }
    }
    return color;
}

static size_t scratch_bytes(const search *in)
{
    const iris_size size = in->edges.size;
    iris_hough_config config = in->by->hough;
    fit_bins(&config, in->by, size);
    return IRIS_EDGE_POINTS_SCRATCH_BYTES(size.w, size.h, in->by->canny.sigma_q16) +
           IRIS_HOUGH_SCRATCH_BYTES(size.w, size.h, config.theta_bins) +
           IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(size.w, size.h);
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    search in = {.by = stage->settings, .edges.size = {input->w, input->h}};
    const iris_image *gray = NULL;
    if (!floor_option_fits(&in.by->floor, stage)) {
        return EXIT_BAD_DATA;
    }
    if (in.by->is_mask || input->format == IRIS_MASK1) {
        const iris_image *mask = stage_mask(stage, input);
        in.mask = mask ? stage_copy(stage, mask) : NULL;
    } else {
        gray = stage_gray(stage, input);
    }
    iris_scratch *scratch =
        (in.mask || gray) && make_room(&in, stage) ? stage_scratch(stage, scratch_bytes(&in)) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    iris_status status = vote(&in, gray, scratch);
    if (status == IRIS_OK && in.by->accumulator && !write_accumulator(&in, stage)) {
        return EXIT_BAD_DATA;
    }
    status = status == IRIS_OK ? collect(&in, scratch) : status;
    if (status != IRIS_OK) {
        return stage_exit(stage, status);
    }
    in.found->full_circle = in.by->hough.full_circle;
    stage->finding = in.found;
    const iris_image *drawn = overlay(input, in.found, stage);
    if (!drawn) {
        return EXIT_BAD_DATA;
    }
    *result = *drawn;
    return EXIT_DONE;
}

static double theta_degrees(const finding *found, const iris_hough_segment *segment)
{
    double degrees = segment->line.angle * 360.0 / 65536;
    return found->full_circle && degrees < 0 ? degrees + 360 : degrees;
}

static void report(json_writer *json, const operation_stage *stage)
{
    static const char *const names[] = {"x0", "y0", "x1", "y1"};
    const settings *by = stage->settings;
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    json_key(json, "lines");
    json_open(json, '[');
    for (int32_t i = 0; i < found->count; i++) {
        const iris_hough_segment *segment = &found->segments[i];
        const int32_t ends[] = {segment->ends.x0 + x, segment->ends.y0 + y, segment->ends.x1 + x,
                                segment->ends.y1 + y};
        json_open(json, '{');
        json_key(json, "rho");
        json_number(json, segment->line.rho_q16 / 65536.0, 2);
        json_key(json, "theta_deg");
        json_number(json, theta_degrees(found, segment), 2);
        json_key(json, "votes");
        json_integer(json, segment->line.votes);
        for (int k = 0; k < 4; k++) {
            json_key(json, names[k]);
            json_integer(json, ends[k]);
        }
        floor_option_json_line(json, &by->floor, iris_place_of(ends[0], ends[1]),
                               iris_place_of(ends[2], ends[3]));
        json_close(json, '}');
    }
    json_close(json, ']');
    json_key(json, "points");
    json_integer(json, found->points);
    json_key(json, "voting");
    json_integer(json, found->voting);
}

static void print(FILE *out, const operation_stage *stage)
{
    const settings *by = stage->settings;
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    fprintf(out, "%s: %d lines in %d segments", stage->file, (int)found->lines, (int)found->count);
    if (found->voting < found->points) {
        fprintf(out, " (%d of %d edge points voted)", (int)found->voting, (int)found->points);
    }
    fputc('\n', out);
    for (int32_t i = 0; i < found->count; i++) {
        const iris_hough_segment *s = &found->segments[i];
        fprintf(out, "  rho %.1f, theta %.1f degrees, %d votes: %d,%d to %d,%d", s->line.rho_q16 / 65536.0,
                theta_degrees(found, s), (int)s->line.votes, (int)(s->ends.x0 + x), (int)(s->ends.y0 + y),
                (int)(s->ends.x1 + x), (int)(s->ends.y1 + y));
        floor_option_print_line(out, &by->floor, iris_place_of(s->ends.x0 + x, s->ends.y0 + y),
                                iris_place_of(s->ends.x1 + x, s->ends.y1 + y));
        fputc('\n', out);
    }
}

static int read_angles(iris_hough_config *hough, const char *text)
{
    int32_t degrees[2], low = hough->full_circle ? -360 : -90, high = hough->full_circle ? 360 : 90;
    hough->angle_min = hough->full_circle ? 0 : hough->angle_min;
    hough->angle_max = hough->full_circle ? 0 : hough->angle_max;
    if (!text) {
        return 1;
    }
    if (!args_numbers(degrees, 2, ',', text) || degrees[0] < low || degrees[0] > high || degrees[1] < low ||
        degrees[1] > high) {
        complain("--angles", "LO,HI, whole degrees from %d to %d, not '%s'", (int)low, (int)high, text);
        return 0;
    }
    hough->angle_min = iris_angle_wrap((degrees[0] * 65536 + (degrees[0] < 0 ? -180 : 180)) / 360);
    hough->angle_max = iris_angle_wrap((degrees[1] * 65536 + (degrees[1] < 0 ? -180 : 180)) / 360);
    return 1;
}

static void set_defaults(settings *by)
{
    iris_hough_defaults(&by->hough);
    by->hough.theta_bins = 0;
    iris_hough_segment_defaults(&by->segments);
    by->count = LINES_DEFAULT;
}

static int check(settings *by, const operation_words *words)
{
    canny_options_complete(&by->canny, 12, 30); /* low: votes by chance are known, and lines may be faint */
    if ((by->rho_step & (by->rho_step - 1)) != 0) {
        complain("--rho-step", "1, 2, 4, 8, 16, 32, or 64 pixels, not %d", (int)by->rho_step);
        return 0;
    }
    if (by->accumulator && words->arguments.operand_count > 1) {
        complain("--accumulator", "only with one picture");
        return 0;
    }
    return 1;
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    canny_texts edges = {NULL, NULL, NULL};
    const char *votes = NULL, *angles = NULL, *theta = NULL, *rho = NULL;
    const char *gap = NULL, *length = NULL, *count = NULL, *floor = NULL;
    int full_circle = 0;
    const args_option options[] = {
        {"low", 0, NULL, &edges.low},     {"high", 0, NULL, &edges.high},
        {"sigma", 0, NULL, &edges.sigma}, {"mask", 0, &by->is_mask, NULL},
        {"votes", 0, NULL, &votes},       {"angles", 0, NULL, &angles},
        {"theta-bins", 0, NULL, &theta},  {"rho-step", 0, NULL, &rho},
        {"gap", 0, NULL, &gap},           {"min-length", 0, NULL, &length},
        {"count", 0, NULL, &count},       {"full-circle", 0, &full_circle, NULL},
        {"floor", 0, NULL, &floor},       {"accumulator", 0, NULL, &by->accumulator}};
    set_defaults(by);
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    by->hough.full_circle = full_circle;
    const args_whole numbers[] = {
        {"--votes", votes, &by->votes, 1, 65535},
        {"--theta-bins", theta, &by->hough.theta_bins, 1, IRIS_HOUGH_THETA_BINS_MAX},
        {"--rho-step", rho, &by->rho_step, 1, IRIS_HOUGH_RHO_STEP_MAX},
        {"--gap", gap, &by->segments.max_gap, 0, IRIS_SIDE_MAX},
        {"--min-length", length, &by->segments.min_length, 1, IRIS_SIDE_MAX},
        {"--count", count, &by->count, 1, LINES_MAX}};
    return args_wholes(numbers, sizeof numbers / sizeof numbers[0]) && read_angles(&by->hough, angles) &&
           canny_options_read(&by->canny, &edges) && check(by, words) &&
           floor_option_read(&by->floor, floor, words);
}

const operation operation_lines = {.name = "lines",
                                   .summary = "straight lines and their ends, by Hough transform",
                                   .help = help,
                                   .parse = parse,
                                   .apply = apply,
                                   .report = report,
                                   .print = print,
                                   .reports_alone = 1};
