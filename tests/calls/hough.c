/* Straight lines: Hough transform and regression. */
#include "iris/xt/hough.h"

#include "calls.h"
#include "iris/xt/hough_segments.h"
#include "iris/xt/regress.h"
#include "iris/xt/votes.h"

static iris_hough_config any_config(void)
{
    iris_hough_config config;
    iris_hough_defaults(&config);
    config.theta_bins = draw_int(1, 40);
    config.rho_step = 1 << draw_below(3);
    config.min_votes = draw_int(1, 30);
    config.full_circle = draw_chance(20) ? draw_int(0, 1) : draw_within(0, 1);
    config.spread = (iris_angle)draw_int(0, IRIS_HOUGH_SPREAD_MAX);
    if (draw_chance(3)) {
        config.angle_min = (iris_angle)draw_int(-16384, 16384);
        config.angle_max = (iris_angle)draw_int(-16384, 16384);
        config.rho_min = draw_int(-50, 0);
        config.rho_max = draw_int(1, 50);
        config.theta_separation = draw_int(0, IRIS_HOUGH_SEPARATION_MAX);
        config.rho_separation = draw_int(0, IRIS_HOUGH_SEPARATION_MAX);
    }
    return config;
}

static void lines(void)
{
    iris_size size = draw_size();
    iris_hough_config config = any_config();
    int32_t capacity = draw_int(0, 5);
    int fits = capacity >= 0 && capacity <= 5;
    iris_hough_line *found = OR_NULL(draw_results((size_t)(fits ? capacity : 5) * sizeof *found));
    capacity = fits || capacity < 0 ? capacity : 5;
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    const iris_hough_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch_up_to(IRIS_HOUGH_SCRATCH_BYTES(70, 70, 40));
    CALL(iris_hough_lines(found, capacity, count, mask, given, scratch));
}

static void begin(void)
{
    iris_hough_config config = any_config();
    iris_hough *hough = OR_NULL(draw_results(sizeof *hough));
    iris_size size = draw_size();
    const iris_hough_config *given = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch_up_to(IRIS_HOUGH_SCRATCH_BYTES(70, 70, 40));
    draw_scratch_is_kept();
    CALL(iris_hough_begin(hough, size, given, scratch));
}

/* A transform that has begun, in memory that calls may change; null when it could not begin. */
static iris_hough *begun(iris_size size)
{
    iris_hough hough;
    iris_scratch scratch;
    iris_hough_config config = any_config();
    size_t bytes = IRIS_HOUGH_SCRATCH_BYTES(70, 70, 40);
    if (iris_scratch_init(&scratch, draw_results(bytes), bytes) != IRIS_OK ||
        iris_hough_begin(&hough, size, &config, &scratch) != IRIS_OK) {
        return NULL;
    }
    for (int i = draw_within(0, 200); i > 0; i--) {
        (void)iris_hough_vote(&hough, draw_within(0, 2 * size.w - 2), draw_within(0, 2 * size.h - 2));
    }
    return OR_NULL(draw_state(&hough, sizeof hough));
}

static void vote(void)
{
    iris_size size = draw_size();
    iris_hough *hough = begun(size);
    int32_t twice_x = draw_int(0, 2 * size.w), twice_y = draw_int(0, 2 * size.h);
    CALL(iris_hough_vote(hough, twice_x, twice_y));
}

static void vote_row(void)
{
    iris_size size = draw_size();
    iris_hough *hough = begun(size);
    const uint32_t *row = OR_NULL(draw_given(NULL, iris_format_row_bytes(IRIS_MASK1, size.w)));
    int32_t y = draw_int(0, size.h);
    CALL(iris_hough_vote_row(hough, row, y));
}

static void vote_mask(void)
{
    iris_size size = draw_size();
    iris_hough *hough = begun(size);
    const iris_image *mask = draw_input(IRIS_MASK1, size);
    CALL(iris_hough_vote_mask(hough, mask));
}

static void vote_edges(void)
{
    iris_edge_point points[20];
    iris_size size = draw_size();
    iris_hough *hough = begun(size);
    int32_t count = draw_int(0, 20), fits = count >= 0 && count <= 20 ? count : 0;
    for (int32_t i = 0; i < fits; i++) {
        int32_t x = draw_chance(200) ? draw_int(0, size.w) : draw_within(0, size.w > 0 ? size.w - 1 : 0);
        int32_t y = draw_chance(200) ? draw_int(0, size.h) : draw_within(0, size.h > 0 ? size.h - 1 : 0);
        points[i] = (iris_edge_point){(int16_t)x, (int16_t)y, (iris_angle)draw_below(65536)};
    }
    const iris_edge_point *given = OR_NULL(draw_given(points, (size_t)fits * sizeof *points));
    CALL(iris_hough_vote_edges(hough, given, count < 0 ? count : fits));
}

static void show(void)
{
    iris_size size = draw_size();
    const iris_image *gray = draw_output(IRIS_GRAY8, size);
    const iris_image *votes = draw_input(IRIS_GRAY_U16, size);
    CALL(iris_votes_show(gray, votes));
}

static void peaks(void)
{
    const iris_hough *hough = begun(draw_size());
    int32_t capacity = draw_within(-1, 5);
    size_t room = capacity > 0 ? (size_t)capacity : 0;
    iris_hough_line *found = OR_NULL(draw_results(room * sizeof *found));
    int32_t *count = OR_NULL(draw_results(sizeof *count));
    CALL(iris_hough_peaks(found, capacity, count, hough));
}

static void accumulator(void)
{
    iris_image *view = OR_NULL(draw_results(sizeof *view));
    const iris_hough *hough = begun(draw_size());
    CALL(iris_hough_accumulator(view, hough));
}

static void clip(void)
{
    iris_hough_line line = {(iris_angle)draw_int(-20000, 20000), draw_int(-3000000, 3000000), 0};
    iris_hough_ends *ends = OR_NULL(draw_results(sizeof *ends));
    const iris_hough_line *given = OR_NULL(draw_given(&line, sizeof line));
    iris_size size = draw_size();
    CALL(iris_hough_clip(ends, given, size));
}

static iris_hough_segment_config any_segment_config(void)
{
    iris_hough_segment_config config;
    iris_hough_segment_defaults(&config);
    config.max_gap = draw_int(0, 10);
    config.min_length = draw_int(1, 30);
    config.reach_q16 = draw_int(0, 3 * 65536);
    config.spread = (iris_angle)draw_int(0, IRIS_HOUGH_SPREAD_MAX);
    config.full_circle = draw_chance(20) ? draw_int(0, 1) : draw_within(0, 1);
    return config;
}

static size_t segment_scratch(iris_size size)
{
    return IRIS_HOUGH_SEGMENT_SCRATCH_BYTES(size.w, size.h);
}

static void segment_of_mask(void)
{
    iris_size size = draw_size();
    iris_hough_line line = {(iris_angle)draw_below(65536), draw_within(-40, 40) * 65536, 0};
    iris_hough_segment_config config = any_segment_config();
    iris_hough_segment *segment = OR_NULL(draw_results(sizeof *segment));
    const iris_image *mask = draw_output(IRIS_MASK1, size);
    const iris_hough_line *given = OR_NULL(draw_given(&line, sizeof line));
    const iris_hough_segment_config *by = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch(segment_scratch(size));
    CALL(iris_hough_segment_of_mask(segment, mask, given, by, scratch));
}

/* Points on and beside the line x = w / 2. */
static void segment_of_edges(void)
{
    iris_edge_point points[60];
    iris_size size = draw_size();
    iris_hough_line line = {(iris_angle)draw_int(-300, 300), draw_within(-3, 3) * 65536, 0};
    iris_hough_segment_config config = any_segment_config();
    int32_t count = draw_within(0, 60), right = size.w > 0 ? size.w - 1 : 0,
            bottom = size.h > 0 ? size.h - 1 : 0;
    for (int32_t i = 0; i < count; i++) {
        int32_t x = draw_chance(3) ? draw_within(0, right) : size.w / 2;
        int32_t y = draw_chance(300) ? draw_int(0, bottom) : draw_within(0, bottom);
        points[i] = (iris_edge_point){(int16_t)(x > right ? right : x), (int16_t)y,
                                      (iris_angle)draw_int(-4000, 4000)};
    }
    iris_edge_list edges = {draw_state(points, (size_t)count * sizeof *points), draw_chance(60) ? -1 : count,
                            size};
    edges.points = OR_NULL(edges.points);
    iris_hough_segment *segment = OR_NULL(draw_results(sizeof *segment));
    iris_edge_list *list = OR_NULL(draw_state(&edges, sizeof edges));
    const iris_hough_line *given = OR_NULL(draw_given(&line, sizeof line));
    const iris_hough_segment_config *by = OR_NULL(draw_given(&config, sizeof config));
    iris_scratch *scratch = draw_scratch_up_to(segment_scratch(size));
    CALL(iris_hough_segment_of_edges(segment, list, given, by, scratch));
}

static void regress_mask(void)
{
    iris_line *line = OR_NULL(draw_results(sizeof *line));
    const iris_image *mask = draw_input(IRIS_MASK1, draw_size());
    CALL(iris_regress_mask(line, mask));
}

static void regress_points(void)
{
    int32_t count = draw_int(0, 50);
    int fits = count >= 0 && count <= 50;
    iris_line *line = OR_NULL(draw_results(sizeof *line));
    const iris_point *points = OR_NULL(draw_given(NULL, (size_t)(fits ? count : 0) * sizeof *points));
    CALL(iris_regress_points(line, points, fits ? count : count < 0 ? count : 0));
}

static void regress_rows(void)
{
    int32_t y0 = draw_int(0, 70), y1 = draw_int(0, 70), trims = draw_int(0, 4);
    iris_line *line = OR_NULL(draw_results(sizeof *line));
    const int16_t *twice_x = OR_NULL(draw_given(NULL, 72 * sizeof *twice_x));
    y1 = y1 > 71 && y1 <= IRIS_REGRESS_ROW_MAX ? 71 : y1;
    CALL(iris_regress_rows(line, twice_x, y0, y1, trims));
}

static void regress_moments(void)
{
    iris_moments moments = {0};
    for (int i = draw_within(0, 6); i > 0; i--) {
        iris_moments_add(&moments, draw_int(-70000, 70000), draw_int(-70000, 70000));
        iris_moments_add_run(&moments, draw_within(-70000, 0), draw_within(0, 70000),
                             draw_int(-70000, 70000));
    }
    iris_line *line = OR_NULL(draw_results(sizeof *line));
    const iris_moments *given = OR_NULL(draw_given(draw_chance(8) ? NULL : &moments, sizeof moments));
    CALL(iris_regress_moments(line, given));
}

const random_call calls_hough[] = {
    {"iris_hough_lines", lines},
    {"iris_hough_clip", clip},
    {"iris_hough_segment_of_mask", segment_of_mask},
    {"iris_hough_segment_of_edges", segment_of_edges},
    {"iris_regress_mask", regress_mask},
    {"iris_regress_points", regress_points},
    {"iris_regress_rows", regress_rows},
    {"iris_regress_moments", regress_moments},
    {"iris_hough_begin", begin},
    {"iris_hough_vote", vote},
    {"iris_hough_vote_row", vote_row},
    {"iris_hough_vote_mask", vote_mask},
    {"iris_hough_vote_edges", vote_edges},
    {"iris_votes_show", show},
    {"iris_hough_peaks", peaks},
    {"iris_hough_accumulator", accumulator},
    {NULL, NULL},
};
