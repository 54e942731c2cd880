/* Silhouettes: nearest prototype of real shapes, as they are, and turned and scaled; and what is like none of them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "iris/draw.h"
#include "iris/xt/shape.h"
#include "iris/xt/threshold.h"
#include "nothing.h"
#include "picture.h"
#include "score.h"

#define CLASSES  10
#define EACH     3
#define SHAPES   (CLASSES * EACH)
#define TURNS    6  /* of each shape */
#define BLOBS    50 /* of each kind */
#define SIDE_MAX 480
#define TURN     6.283185307179586

static const char *const classes[CLASSES] = {"apple", "bell",   "bone",   "bottle", "camel",
                                             "fork",  "guitar", "hammer", "heart",  "key"};
static const char *const methods[] = {"height functions", "radial signature", "Hu's moments"};

static iris_image pictures[SHAPES]; /* gray */
static iris_shape models[SHAPES];
static uint8_t pixels[SIDE_MAX * SIDE_MAX];
static uint32_t words[SIDE_MAX * ((SIDE_MAX + 31) / 32)];
static IRIS_SCRATCH_BUFFER(memory, IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(SIDE_MAX, SIDE_MAX) +
                                       IRIS_SHAPE_MATCH_SCRATCH_BYTES);
static uint32_t state;

static uint32_t below(uint32_t end)
{
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % end;
}

static iris_scratch arena(void)
{
    iris_scratch scratch;
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    return scratch;
}

/* The largest part of what is brighter than 127: 1, or 0 when there is none. */
static int describe(iris_shape *shape, const iris_image *gray)
{
    iris_image mask;
    iris_contour outline;
    int32_t count = 0;
    iris_scratch scratch = arena();
    iris_image_wrap(&mask, words, sizeof words, (iris_size){gray->w, gray->h}, 0, IRIS_MASK1);
    iris_threshold(&mask, gray, 127, IRIS_SELECT_BRIGHT);
    (void)iris_contour_find(&outline, 1, &count, &mask, &scratch);
    return count > 0 && iris_shape_describe(shape, &outline, &mask, &scratch) == IRIS_OK;
}

/* except: a model that is left out; -1: none. least: 1 for the default, 0 for none. */
static iris_shape_found match(const iris_shape *shape, int method, int except, int least)
{
    iris_shape_matching config;
    iris_shape_found found = {IRIS_SHAPE_UNKNOWN, -1, 0, 0, 0};
    iris_scratch scratch = arena();
    iris_shape_matching_defaults(&config, (iris_shape_method)method);
    config.except = except;
    config.least_q16 = least ? config.least_q16 : 0;
    (void)iris_shape_match(&found, shape, &(iris_shape_library){models, SHAPES}, &config, &scratch);
    return found;
}

static int load(void)
{
    char name[64];
    for (int i = 0; i < SHAPES; i++) {
        snprintf(name, sizeof name, "shapes/mpeg7/%s-0%d.bmp", classes[i / EACH], 1 + i % EACH * 4);
        if (picture_load(&pictures[i], name, IRIS_GRAY8) != IRIS_OK || !pictures[i].data ||
            pictures[i].w > SIDE_MAX || pictures[i].h > SIDE_MAX || !describe(&models[i], &pictures[i])) {
            return 0;
        }
        models[i].class_index = i / EACH;
    }
    return 1;
}

/* Adds " key-1 (bell)" or " key-1 (unknown)". */
static void confuse(char *text, size_t bytes, int i, int as)
{
    size_t used = strlen(text);
    snprintf(text + used, bytes - used, "%s%s-%d (%s)", used ? ", " : "", classes[i / EACH], 1 + i % EACH * 4,
             as < 0 ? "unknown" : classes[as]);
}

static void score_nearest(score *s, int method, int required)
{
    char what[96], limit[32], confused[400] = "";
    int right = 0, known = 0;
    for (int i = 0; i < SHAPES; i++) {
        iris_shape_found found = match(&models[i], method, i, 0);
        right += found.class_index == i / EACH;
        known += match(&models[i], method, i, 1).class_index == i / EACH;
        if (found.class_index != i / EACH) {
            confuse(confused, sizeof confused, i, found.class_index);
        }
    }
    snprintf(what, sizeof what, "shapes, %s: nearest of %d, leave one out", methods[method], SHAPES);
    snprintf(limit, sizeof limit, ">= %d", required);
    score_row(s, what, required ? limit : NULL, required ? score_if(right >= required) : SCORE_INFORMATION,
              "%d; with the default least score %d; confused: %s", right, known,
              *confused ? confused : "none");
}

/* The shape, turned clockwise and scaled, in a picture of its own. */
static iris_image turned(int i, double degrees, double scale)
{
    const iris_image *from = &pictures[i];
    int side = (int)(scale * hypot(from->w, from->h)) + 4;
    side = side > SIDE_MAX ? SIDE_MAX : side;
    double c = cos(degrees / 360 * TURN) / scale, sine = sin(degrees / 360 * TURN) / scale;
    for (int k = 0; k < side * side; k++) {
        double x = k % side + 0.5 - side * 0.5, y = (int)(k / side) + 0.5 - side * 0.5;
        int from_x = (int)floor(c * x + sine * y + from->w / 2.0);
        int from_y = (int)floor(c * y - sine * x + from->h / 2.0);
        int inside = from_x >= 0 && from_y >= 0 && from_x < from->w && from_y < from->h;
        pixels[k] = inside ? ((const uint8_t *)iris_image_row(from, from_y))[from_x] : 0;
    }
    return (iris_image){pixels, side, side, side, IRIS_GRAY8};
}

/* What was turned, with the class and the angle that were found. */
static void save_turned(const score *s, const iris_image *gray, const iris_shape *shape, int i, int degrees)
{
    char name[64], text[64];
    iris_shape_found found = match(shape, IRIS_SHAPE_HEIGHTS, -1, 0);
    double turn = found.angle / 65536.0 * TURN, reach = shape->diameter_q16 / 65536.0 / 3;
    int32_t x = shape->x_q16 / 65536, y = shape->y_q16 / 65536;
    const iris_color red = {128, 128, 128}, dim = {200, 200, 200};
    snprintf(name, sizeof name, "shape_%s_%d.bmp", classes[i / EACH], 1 + i % EACH * 4);
    snprintf(text, sizeof text, "%s %.2f, %.1f of %d", classes[found.class_index], found.score_q16 / 65536.0,
             found.angle * 360 / 65536.0, degrees);
    iris_draw_line(gray, x, y, x + (int32_t)(reach * cos(turn)), y + (int32_t)(reach * sin(turn)), red);
    iris_draw_text(gray, 2, 2, text, 1, dim);
    (void)picture_save(gray, s->pictures, name);
}

static void score_turned(score *s, int method)
{
    char what[96];
    int right = 0, same = 0, upright = 0;
    double worst = 0;
    state = 1;
    for (int i = 0; i < SHAPES; i++) {
        for (int round = 0; round < TURNS; round++) {
            int degrees = (int)below(360);
            double scale = 0.6 + below(91) / 100.0;
            iris_shape shape;
            iris_image gray = turned(i, degrees, scale);
            if (!describe(&shape, &gray)) {
                continue;
            }
            iris_shape_found found = match(&shape, method, -1, 0);
            right += match(&shape, method, i, 0).class_index == i / EACH;
            if (found.index == i) {
                double error = fabs(remainder(found.angle * 360 / 65536.0 - degrees, 360));
                same++;
                worst = i / EACH == 4 && error > worst ? error : worst; /* camels have no symmetry */
                upright += error < 5;
            }
            if (s->pictures && round == 0 && method == IRIS_SHAPE_HEIGHTS) {
                save_turned(s, &gray, &shape, i, degrees);
            }
        }
    }
    snprintf(what, sizeof what, "shapes, %s: turned, scaled 0.6 to 1.5", methods[method]);
    if (method == IRIS_SHAPE_MOMENTS) {
        score_row(s, what, NULL, SCORE_INFORMATION, "without its own model %d of %d, itself with it %d",
                  right, SHAPES * TURNS, same);
    } else {
        score_row(s, what, NULL, SCORE_INFORMATION,
                  "without its own model %d of %d, itself with it %d, angle within 5 degrees %d, camels %.1f",
                  right, SHAPES * TURNS, same, upright, worst);
    }
}

/* 0: a smooth star; 1: discs in a heap; 2: three thick strokes; 3: noise. */
static int in_blob(int kind, double x, double y, const double *r)
{
    double angle = atan2(y, x), edge = 40;
    switch (kind) {
    case 0:
        for (int k = 1; k < 6; k++) {
            edge += 18 * r[k] / k * cos(k * angle + 6 * r[k + 5]);
        }
        return hypot(x, y) < edge;
    case 1:
        for (int k = 0; k < 5; k++) {
            if (hypot(x - 100 * r[k] + 50, y - 100 * r[k + 5] + 50) < 6 + 24 * r[k + 10]) {
                return 1;
            }
        }
        return 0;
    case 2:
        for (int k = 0; k < 3; k++) {
            double to_x = 120 * r[k] - 60, to_y = 120 * r[k + 5] - 60;
            double t = (x * to_x + y * to_y) / (to_x * to_x + to_y * to_y + 1e-9);
            t = fmin(1, fmax(0, t));
            if (hypot(x - t * to_x, y - t * to_y) < 3 + 8 * r[k + 10]) {
                return 1;
            }
        }
        return 0;
    default:
        return below(100) < 62;
    }
}

static void score_blobs_of_no_class(score *s, int method)
{
    char what[96];
    int known[4] = {0, 0, 0, 0};
    state = 2;
    for (int i = 0; i < 4 * BLOBS; i++) {
        double r[15];
        iris_shape shape;
        for (int k = 0; k < 15; k++) {
            r[k] = below(1000) / 1000.0;
        }
        for (int k = 0; k < 160 * 160; k++) {
            int y = k / 160;
            pixels[k] = in_blob(i % 4, k % 160 - 80, y - 80, r) ? 255 : 0;
        }
        if (describe(&shape, &(iris_image){pixels, 160, 160, 160, IRIS_GRAY8})) {
            known[i % 4] += match(&shape, method, -1, 1).class_index >= 0;
        }
    }
    snprintf(what, sizeof what, "shapes, %s: blobs of no class that get one", methods[method]);
    score_row(s, what, NULL, SCORE_INFORMATION,
              "of %d each: smooth %d, heaps of discs %d, strokes %d, noise %d", BLOBS, known[0], known[1],
              known[2], known[3]);
}

static void score_empty(score *s)
{
    int known = 0;
    for (int i = 0; i < NOTHING_PICTURES; i++) {
        iris_image gray = nothing_picture(i);
        iris_shape shape;
        if (gray.data && gray.w <= SIDE_MAX && gray.h <= SIDE_MAX && describe(&shape, &gray)) {
            known += match(&shape, IRIS_SHAPE_HEIGHTS, -1, 1).class_index >= 0;
        }
        free(gray.data);
    }
    score_row(s, "shapes, height functions: found in empty pictures", NULL, SCORE_INFORMATION,
              "%d of %d, cut at level 127", known, NOTHING_PICTURES);
}

void score_shapes(score *s)
{
    static const int required[] = {26, 22, 0};
    if (!load()) {
        score_row(s, "shapes: nearest prototype", ">= 26", SCORE_SKIPPED, "no shared data");
    } else {
        for (int method = 0; method < 3; method++) {
            score_nearest(s, method, required[method]);
            score_turned(s, method);
            score_blobs_of_no_class(s, method);
        }
        score_empty(s);
    }
    for (int i = 0; i < SHAPES; i++) {
        free(pictures[i].data);
        pictures[i].data = NULL;
    }
    score_cost_row(s, "contours, 16 kept", "contours of a mask", IRIS_CONTOUR_SCRATCH_BYTES(160, 120));
    score_cost_row(s, "shape described", "shape described", IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(160, 120));
    score_cost_row(s, "shape against one model, heights", "shape against one model, heights",
                   IRIS_SHAPE_MATCH_SCRATCH_BYTES);
    score_cost_row(s, "shape against one model, radial", "shape against one model, radial",
                   IRIS_SHAPE_MATCH_SCRATCH_BYTES);
}
