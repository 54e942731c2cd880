/* Generalized Hough: silhouettes pasted into clutter and noise, a third hidden; and pictures without them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "iris/copy.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/hough_shape.h"
#include "iris/xt/threshold.h"
#include "nothing.h"
#include "picture.h"
#include "score.h"
#include "shape_scene.h"

#define SHAPES     10
#define SCENES     10 /* of each shape */
#define ENTRIES    256
#define POINTS_MAX 60000

static const char *const names[SHAPES] = {"apple", "bell",   "bone",   "bottle", "camel",
                                          "fork",  "guitar", "hammer", "heart",  "key"};
static scene_template templates[SHAPES];
static uint8_t tables[SHAPES][IRIS_HOUGH_SHAPE_TABLE_BYTES(ENTRIES)];
static size_t table_bytes[SHAPES];
static double turns[SHAPES]; /* degrees by which a shape, turned, is itself; 360: none */
static iris_edge_point points[POINTS_MAX];

/* Half a turn is no turn for a shape whose outline then lies on itself, within 2 pixels. */
static double symmetry_of(int32_t count, double x, double y)
{
    int32_t alike = 0;
    for (int32_t i = 0; i < count; i++) {
        double nearest = 1e9;
        for (int32_t k = 0; k < count; k++) {
            nearest = fmin(nearest, hypot(2 * x - points[i].x / 2.0 - points[k].x / 2.0,
                                          2 * y - points[i].y / 2.0 - points[k].y / 2.0));
        }
        alike += nearest < 2;
    }
    return alike > 0.9 * count ? 180 : 360;
}

/* 1: template and table of a shape. */
static int teach(int i)
{
    iris_image gray;
    char name[64];
    int32_t count, entries;
    iris_q16 x, y;
    const iris_hough_shape_teaching by = {.fraction_bits = 1, .entries = ENTRIES};
    snprintf(name, sizeof name, "shapes/mpeg7/%s-01.bmp", names[i]);
    if (picture_load(&gray, name, IRIS_GRAY8) != IRIS_OK) {
        free(gray.data);
        return 0;
    }
    scene_template *t = &templates[i];
    t->mask = picture_make(gray.w, gray.h, IRIS_MASK1);
    int done =
        t->mask.data && iris_threshold(&t->mask, &gray, 127, IRIS_SELECT_BRIGHT) == IRIS_OK &&
        iris_hough_shape_silhouette(points, POINTS_MAX, &count, &t->mask) == IRIS_OK &&
        iris_hough_shape_teach(tables[i], sizeof tables[i], &table_bytes[i], points, count, &by) == IRIS_OK &&
        iris_hough_shape_table(&entries, &x, &y, tables[i], table_bytes[i]) == IRIS_OK;
    if (done) {
        t->x = x / 65536.0;
        t->y = y / 65536.0;
        turns[i] = symmetry_of(count, t->x, t->y);
    }
    free(gray.data);
    return done;
}

/* The shapes `i` in a picture, as iris shape find does it. Returns how many; -1 without memory. */
static int32_t find(iris_hough_shape_found *found, iris_hough_shape *shape, const iris_image *gray, int i)
{
    static void *memory;
    iris_hough_shape_config config;
    iris_scratch scratch;
    int32_t edges = 0, count = 0;
    iris_canny_config canny;
    iris_canny_defaults(&canny);
    size_t bytes = IRIS_EDGE_POINTS_SCRATCH_BYTES(gray->w, gray->h, canny.sigma_q16) +
                   IRIS_HOUGH_SHAPE_SCRATCH_BYTES(gray->w, gray->h, 4, ENTRIES, POINTS_MAX);
    free(memory);
    memory = malloc(bytes);
    iris_scratch_init(&scratch, memory, memory ? bytes : 0);
    iris_hough_shape_defaults(&config);
    config.scale_min_q16 = 45875; /* 0.7 to 1.4 by 0.1 */
    config.scale_max_q16 = 91750;
    config.points = POINTS_MAX;
    iris_status status = iris_canny_adapt(&canny, gray, &scratch);
    if (status == IRIS_OK) {
        status = iris_edge_points(points, POINTS_MAX, &edges, gray, &canny, &scratch);
    }
    edges = edges < POINTS_MAX ? edges : POINTS_MAX;
    if ((status != IRIS_OK && status != IRIS_ERR_FULL) ||
        iris_hough_shape_begin(shape, tables[i], table_bytes[i], (iris_size){gray->w, gray->h}, &config,
                               &scratch) != IRIS_OK ||
        iris_hough_shape_find(found, IRIS_HOUGH_SHAPE_PLACES, &count, shape, points, edges) != IRIS_OK) {
        return -1;
    }
    return count;
}

/* How far a shape that was found is from the truth. */
typedef struct {
    double pixels, degrees, scale;
} offset;

static int is_within(offset o, double pixels, double degrees, double scale)
{
    return o.pixels <= pixels && o.degrees <= degrees && o.scale <= scale;
}

static offset offset_of(const iris_hough_shape_found *f, const scene_truth *truth, double turn)
{
    return (offset){hypot(f->x_q16 / 65536.0 - truth->x, f->y_q16 / 65536.0 - truth->y),
                    fabs(remainder(f->angle * 360.0 / 65536 - truth->angle_deg, turn)),
                    fabs(f->scale_q16 / 65536.0 / truth->scale - 1)};
}

/* The outlines in gray 255 on the darkened scene. */
static void save(const score *s, const iris_image *gray, const iris_hough_shape *shape,
                 const iris_hough_shape_found *found, int32_t count, const char *name)
{
    iris_image shown = picture_make(gray->w, gray->h, IRIS_RGB888);
    for (int32_t i = 0; shown.data && i < gray->w * gray->h; i++) {
        memset((uint8_t *)shown.data + (size_t)i * 3, ((const uint8_t *)gray->data)[i], 3);
    }
    for (int32_t k = count - 1; shown.data && k >= 0; k--) {
        for (int32_t i = 0; i < shape->entries; i++) {
            iris_q16 x, y;
            iris_angle direction;
            (void)iris_hough_shape_outline(&x, &y, &direction, shape, &found[k], i);
            int32_t column = iris_q16_to_int(x), row = iris_q16_to_int(y);
            if (column >= 0 && row >= 0 && column < gray->w && row < gray->h) {
                uint8_t *to = (uint8_t *)iris_image_row(&shown, row) + (size_t)column * 3;
                to[0] = k == 0 ? 0 : 255;
                to[1] = k == 0 ? 255 : 0;
                to[2] = 0;
            }
        }
    }
    if (shown.data) {
        picture_save(&shown, s->pictures, name);
    }
    free(shown.data);
}

typedef struct {
    int scenes, found, closely, first, wrong;
} tally;

static void try_scene(tally *t, const score *s, int i, int k)
{
    static iris_hough_shape_found found[IRIS_HOUGH_SHAPE_PLACES];
    iris_hough_shape shape;
    scene_truth truth;
    iris_image gray = scene_make(&truth, &templates[i], templates, SHAPES, (uint32_t)(i * SCENES + k));
    int32_t count = gray.data ? find(found, &shape, &gray, i) : -1;
    int hits = 0, close = 0;
    for (int32_t n = 0; n < count; n++) {
        offset o = offset_of(&found[n], &truth, turns[i]);
        int hit = is_within(o, 4, 4, 0.05);
        hits += hit;
        close |= is_within(o, 3, 3, 0.05);
        t->first += hit && n == 0;
        t->wrong += !hit;
    }
    t->scenes += count >= 0;
    t->found += hits > 0;
    t->closely += close;
    if (s->pictures && count >= 0) {
        char name[64];
        snprintf(name, sizeof name, "shape-%s-%d%s.bmp", names[i], k, hits ? "" : "-missed");
        save(s, &gray, &shape, found, count, name);
    }
    free(gray.data);
}

/* The number of shapes found in a picture without any; the picture is given back. */
static int32_t made_up(iris_image gray, int i)
{
    static iris_hough_shape_found found[IRIS_HOUGH_SHAPE_PLACES];
    iris_hough_shape shape;
    int32_t count = gray.data ? find(found, &shape, &gray, i) : 0;
    free(gray.data);
    return count > 0 ? count : 0;
}

static void score_nothing(score *s)
{
    static const char *const real[] = {"edges/bsds/3063.bmp",        "edges/bsds/196027.bmp",
                                       "edges/bsds/69007.pgm",       "edges/classic/camera_256.pgm",
                                       "edges/classic/moon_256.pgm", "line/black_tape/line2_168.bmp"};
    int empty = 0, cluttered = 0, photographs = 0, shown = 0;
    for (int i = 0; i < NOTHING_PICTURES; i++) {
        empty += made_up(nothing_picture(i), i % SHAPES) > 0;
    }
    for (int i = 0; i < SHAPES; i++) {
        scene_truth none;
        cluttered += made_up(scene_make(&none, NULL, templates, SHAPES, (uint32_t)(5000 + i)), i) > 0;
    }
    for (size_t i = 0; i < sizeof real / sizeof real[0]; i++) {
        iris_image gray;
        if (picture_load(&gray, real[i], IRIS_GRAY8) == IRIS_OK) {
            shown++;
            photographs += made_up(gray, (int)i) > 0;
        }
    }
    score_row(s, "generalized Hough: finds in empty pictures", "none", score_if(empty == 0), "in %d of %d",
              empty, NOTHING_PICTURES);
    score_row(s, "generalized Hough: finds in clutter and in photographs without the shape", NULL,
              SCORE_INFORMATION, "in %d of %d, %d of %d", cluttered, SHAPES, photographs, shown);
}

void score_shapes_found(score *s)
{
    const char *what = "generalized Hough: a third hidden, in clutter: 4 px, 4 degrees, 5 %";
    tally t = {0};
    int taught = 0;
    for (int i = 0; i < SHAPES; i++) {
        taught += teach(i);
    }
    if (taught < SHAPES) {
        score_row(s, what, "90 %", SCORE_SKIPPED, "no shared data");
        return;
    }
    for (int i = 0; i < SHAPES * SCENES; i++) {
        try_scene(&t, s, i / SCENES, i % SCENES);
    }
    score_row(s, what, "90 %", score_if(t.found >= 0.9 * SHAPES * SCENES), "%d of %d", t.found, t.scenes);
    score_row(s, "... within 3 px, 3 degrees, 5 %", "95 %",
              t.closely >= 0.95 * SHAPES * SCENES ? SCORE_REACHED : SCORE_SHORT, "%d of %d", t.closely,
              t.scenes);
    score_row(s, "... the best find is right; false finds in all scenes", NULL, SCORE_INFORMATION,
              "%d of %d; %d", t.first, t.scenes, t.wrong);
    score_nothing(s);
    score_cost_row(s, "generalized Hough, 128 entries, 36 angles, 3 scales, 2000 edge points",
                   "shapes, 36 angles, 3 scales", IRIS_HOUGH_SHAPE_SCRATCH_BYTES(160, 120, 4, 128, 2000));
    for (int i = 0; i < SHAPES; i++) {
        free(templates[i].mask.data);
    }
}
