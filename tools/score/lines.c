/* Straight lines: those of a road and of a printed grid, whose places were read off the enlarged pictures by eye; and what
 * is found where there is nothing. By the steps and settings of iris lines. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "iris/color.h"
#include "iris/draw.h"
#include "iris/xt/hough_segments.h"
#include "nothing.h"
#include "picture.h"
#include "score.h"

#define SEGMENTS_MAX 500
#define SIDE_MAX     640

typedef struct {
    int32_t count, lines;
    iris_hough_segment of[SEGMENTS_MAX];
} segments;

static iris_edge_point points[SIDE_MAX * 480];
static IRIS_SCRATCH_BUFFER(working, 1 << 21);

static iris_hough_config config_for(iris_size size, int32_t count)
{
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.rho_step = size.w > 344 || size.h > 344 ? 2 : 1;
    config.theta_separation = 3;
    config.rho_separation = 4;
    config.min_votes = iris_hough_votes_beyond_chance(&config, size, count, 1);
    return config;
}

/* Of the best lines, the segments; of a line whose segments have fewer points than a line must have, none. */
static void collect(segments *to, iris_edge_list *edges, const iris_hough *hough, iris_scratch *scratch)
{
    iris_hough_line lines[SEGMENTS_MAX];
    int32_t count = 0;
    (void)iris_hough_peaks(lines, SEGMENTS_MAX, &count, hough);
    for (int32_t i = 0; i < count && i < SEGMENTS_MAX; i++) {
        int32_t before = to->count, supporters = 0;
        while (to->count < SEGMENTS_MAX &&
               iris_hough_segment_of_edges(&to->of[to->count], edges, &lines[i], NULL, scratch) == IRIS_OK) {
            supporters += to->of[to->count++].points;
        }
        to->count = supporters < hough->config.min_votes ? before : to->count;
        to->lines += to->count > before;
    }
}

/* 0 when something fails. */
static int find(segments *to, const iris_image *gray)
{
    iris_scratch scratch;
    iris_hough hough;
    iris_canny_config canny;
    iris_edge_list edges = {points, 0, {gray->w, gray->h}};
    to->count = to->lines = 0;
    iris_canny_defaults(&canny);
    canny.low = 12;
    canny.high = 30;
    iris_scratch_init(&scratch, working.memory, sizeof working.memory);
    if (gray->w > SIDE_MAX || gray->h > 480 ||
        iris_edge_points(points, SIDE_MAX * 480, &edges.count, gray, &canny, &scratch) != IRIS_OK) {
        return 0;
    }
    iris_hough_config config = config_for(edges.size, edges.count);
    if (iris_hough_begin(&hough, edges.size, &config, &scratch) != IRIS_OK ||
        iris_hough_vote_edges(&hough, points, edges.count) != IRIS_OK) {
        return 0;
    }
    collect(to, &edges, &hough, &scratch);
    return 1;
}

/* A line through three places: paper is not flat. */
typedef struct {
    double x[3], y[3];
} truth;

static double distance(const truth *line, double x, double y)
{
    int part =
        (x - line->x[1]) * (line->x[2] - line->x[0]) + (y - line->y[1]) * (line->y[2] - line->y[0]) > 0;
    double dx = line->x[part + 1] - line->x[part], dy = line->y[part + 1] - line->y[part];
    return fabs((x - line->x[1]) * dy - (y - line->y[1]) * dx) / hypot(dx, dy);
}

/* How many of the lines have a segment with both ends no farther away than `most`. */
static int found_of(const truth *lines, int count, const segments *found, double most)
{
    int sum = 0;
    for (int i = 0; i < count; i++) {
        int has = 0;
        for (int32_t k = 0; k < found->count; k++) {
            const iris_hough_ends *e = &found->of[k].ends;
            has |= distance(&lines[i], e->x0, e->y0) <= most && distance(&lines[i], e->x1, e->y1) <= most;
        }
        sum += has;
    }
    return sum;
}

static void save(const score *s, const iris_image *gray, const segments *found, const char *file)
{
    static const iris_color colors[] = {{255, 0, 0},   {0, 255, 0},   {0, 160, 255},
                                        {255, 255, 0}, {255, 0, 255}, {0, 255, 255}};
    iris_image color = picture_make(gray->w, gray->h, IRIS_RGB888);
    if (s->pictures && color.data && iris_color_convert(&color, gray) == IRIS_OK) {
        for (int32_t i = 0; i < found->count; i++) {
            const iris_hough_ends *e = &found->of[i].ends;
            iris_draw_line(&color, e->x0, e->y0, e->x1, e->y1, colors[i % 6]);
        }
        picture_save(&color, s->pictures, file);
    }
    free(color.data);
}

typedef struct {
    const char *what, *file, *overlay;
    const truth *lines;
    int count;
    double most; /* pixels */
} scene;

static void score_scene(score *s, const scene *of)
{
    segments *found = malloc(sizeof *found);
    iris_image gray = {0};
    char required[16];
    snprintf(required, sizeof required, "%d", of->count);
    if (found && picture_load(&gray, of->file, IRIS_GRAY8) == IRIS_OK && find(found, &gray)) {
        int right = found_of(of->lines, of->count, found, of->most);
        score_row(s, of->what, required, score_if(right == of->count),
                  "%d of %d (%d lines in %d segments in all)", right, of->count, (int)found->lines,
                  (int)found->count);
        save(s, &gray, found, of->overlay);
    } else {
        score_row(s, of->what, required, SCORE_SKIPPED, "no shared data");
    }
    free(gray.data);
    free(found);
}

/* Which of the pictures with nothing in them have lines. */
static void score_nothing(score *s)
{
    segments *found = malloc(sizeof *found);
    int pictures = 0, with_lines = 0, lines = 0;
    for (int i = 0; found && i < NOTHING_PICTURES; i++) {
        iris_image gray = nothing_picture(i);
        if (gray.data && find(found, &gray)) {
            pictures++;
            with_lines += found->count > 0;
            lines += found->lines;
        }
        free(gray.data);
    }
    score_row(s, "lines found in pictures with nothing in them", NULL, SCORE_INFORMATION,
              "%d in %d of %d pictures", lines, with_lines, pictures);
    free(found);
}

void score_lines(score *s)
{
    static const truth road[] = {{{84, 117, 150}, {267, 243, 219}}, {{276, 296, 316}, {179, 191, 203}}};
    /* the upright lines at rows 56 and 246, the level ones at columns 45, 140, and 229 */
    static const truth grid[] = {
        {{36, 27.5, 19}, {56, 151, 246}},        {{59, 51.8, 44.6}, {56, 151, 246}},
        {{82.5, 77, 71.5}, {56, 151, 246}},      {{105, 101.5, 98}, {56, 151, 246}},
        {{128.7, 126.85, 125}, {56, 151, 246}},  {{152, 151.7, 151.4}, {56, 151, 246}},
        {{175, 176.5, 178}, {56, 151, 246}},     {{198.6, 201.6, 204.6}, {56, 151, 246}},
        {{222.5, 227.25, 232}, {56, 151, 246}},  {{246.6, 252.7, 258.8}, {56, 151, 246}},
        {{45, 140, 229}, {43.2, 44.2, 37.2}},    {{45, 140, 229}, {63.5, 64, 59.5}},
        {{45, 140, 229}, {85.2, 85.3, 82}},      {{45, 140, 229}, {107, 107, 105.2}},
        {{45, 140, 229}, {130.5, 130.5, 129.5}}, {{45, 140, 229}, {154.3, 154.8, 153.5}},
        {{45, 140, 229}, {179, 179.5, 178.8}},   {{45, 140, 229}, {204.3, 205.3, 205.5}},
        {{45, 140, 229}, {230.8, 231.8, 232.5}}, {{45, 140, 229}, {257.3, 257.8, 259.5}}};
    const scene scenes[] = {
        {"both lane lines of a road, within 4 px", "hough/lane_solidYellowCurve.bmp", "lines-lane.bmp", road,
         2, 4},
        {"the lines of a printed grid, within 3 px", "hough/sudoku_half.pgm", "lines-grid.bmp", grid, 20, 3}};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        score_scene(s, &scenes[i]);
    }
    score_nothing(s);
    score_cost_row(s, "lines with their ends, 90 angles, 2000 edge points",
                   "gray frame to four lines with their ends",
                   IRIS_EDGE_POINTS_SCRATCH_BYTES(160, 120, 91750) + IRIS_HOUGH_SCRATCH_BYTES(160, 120, 90) +
                       2000 * sizeof(iris_edge_point));
}
