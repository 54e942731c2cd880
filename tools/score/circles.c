/* Circles: the coins, rendered discs whose centers and radii are known exactly, and pictures without circles. All with one
 * setting, that of `iris circles --radius A-B`; only the radii asked for differ. */
#include <math.h>
#include <stdlib.h>

#include "iris/color.h"
#include "iris/draw.h"
#include "iris/xt/canny_adapt.h"
#include "iris/xt/hough_circle.h"
#include "nothing.h"
#include "picture.h"
#include "score.h"

#define CIRCLES_MAX 512
#define W           320
#define H           240

typedef struct {
    double x, y, r;
} disc;

typedef struct {
    iris_circle circles[CIRCLES_MAX];
    int32_t count;
} finding;

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* count is -1 when that failed. */
static void find(finding *found, const iris_image *gray, int32_t radius_min, int32_t radius_max)
{
    const int32_t pixels = gray->w * gray->h;
    iris_canny_config canny;
    iris_circle_config config;
    iris_scratch scratch;
    iris_canny_defaults(&canny);
    iris_circle_defaults(&config);
    config.radius_min = config.min_distance = radius_min;
    config.radius_max = radius_max;
    config.max_hypotheses = 1024;
    size_t bytes = larger(IRIS_EDGE_POINTS_SCRATCH_BYTES(gray->w, gray->h, canny.sigma_q16),
                          larger(IRIS_CANNY_ADAPT_SCRATCH_BYTES(gray->w, canny.sigma_q16),
                                 IRIS_CIRCLE_SCRATCH_BYTES(gray->w, gray->h, pixels, config.cell, 1024)));
    iris_edge_point *points = malloc((size_t)pixels * sizeof *points);
    void *memory = malloc(bytes);
    iris_edge_list edges = {points, 0, {gray->w, gray->h}};
    iris_scratch_init(&scratch, memory, memory ? bytes : 0);
    found->count = -1;
    if (points && iris_canny_adapt(&canny, gray, &scratch) == IRIS_OK &&
        iris_edge_points(points, pixels, &edges.count, gray, &canny, &scratch) == IRIS_OK) {
        (void)iris_hough_circles(found->circles, CIRCLES_MAX, &found->count, &edges, &config, &scratch);
    }
    free(points);
    free(memory);
}

/* --- what is right --- */

typedef struct {
    int right, found, there;
    double center, radius; /* sums of distances, of those that are right */
} tally;

/* A found circle is right when center and radius are within these of a true one that no better circle has taken. */
static void compare(tally *t, const finding *found, const disc *discs, int count, const double most[2])
{
    char taken[CIRCLES_MAX] = {0};
    for (int32_t i = 0; i < found->count && i < CIRCLES_MAX; i++) {
        const iris_circle *c = &found->circles[i];
        for (int k = 0; k < count; k++) {
            double off = hypot(c->x_q16 / 65536.0 - discs[k].x, c->y_q16 / 65536.0 - discs[k].y);
            double wide = fabs(c->r_q16 / 65536.0 - discs[k].r);
            if (!taken[k] && off <= most[0] && wide <= most[1]) {
                taken[k] = 1;
                t->right++;
                t->center += off;
                t->radius += wide;
                break;
            }
        }
    }
    t->found += found->count > 0 ? found->count : 0;
    t->there += count;
}

static double f_measure(const tally *t)
{
    return t->found + t->there > 0 ? 2.0 * t->right / (t->found + t->there) : 0;
}

static void save(const score *s, const char *name, const iris_image *gray, const finding *found)
{
    iris_image color = s->pictures ? picture_make(gray->w, gray->h, IRIS_RGB888) : (iris_image){0};
    if (!color.data) {
        return;
    }
    iris_color_convert(&color, gray);
    for (int32_t i = 0; i < found->count && i < CIRCLES_MAX; i++) {
        const iris_circle *c = &found->circles[i];
        for (int k = 0; k < 64; k++) {
            const double turn = 6.283185307179586 / 64, r = c->r_q16;
            iris_draw_line(&color, (int32_t)lround((c->x_q16 + r * cos(k * turn)) / 65536),
                           (int32_t)lround((c->y_q16 + r * sin(k * turn)) / 65536),
                           (int32_t)lround((c->x_q16 + r * cos((k + 1) * turn)) / 65536),
                           (int32_t)lround((c->y_q16 + r * sin((k + 1) * turn)) / 65536),
                           (iris_color){255, 0, 0});
        }
    }
    picture_save(&color, s->pictures, name);
    free(color.data);
}

/* --- the coins --- */

static void score_coins(score *s)
{
    static finding found;
    const char *what = "coins, radius 10-50: F of circles, center within 5 px, radius within 4";
    iris_image gray = {0};
    FILE *truth = data_open("hough/coins_circles.txt");
    if (!truth || picture_load(&gray, "hough/coins.pgm", IRIS_GRAY8) != IRIS_OK) {
        score_row(s, what, "at least 0.95", SCORE_SKIPPED, "no shared data");
    } else {
        disc coins[64];
        int count = 0;
        char line[200];
        while (count < 64 && fgets(line, sizeof line, truth)) {
            count += sscanf(line, "%lf %lf %lf", &coins[count].x, &coins[count].y, &coins[count].r) == 3;
        }
        tally t = {0};
        find(&found, &gray, 10, 50);
        compare(&t, &found, coins, count, (const double[2]){5, 4});
        score_row(s, what, "at least 0.95", score_if(f_measure(&t) >= 0.95),
                  "%.3f: precision %d of %d, recall %d of %d", f_measure(&t), t.right, t.found, t.right,
                  t.there);
        save(s, "circles-coins.bmp", &gray, &found);
    }
    free(gray.data);
    if (truth) {
        fclose(truth);
    }
}

/* --- rendered discs --- */

typedef struct {
    const char *name;
    int32_t radius_min, radius_max; /* asked for; and drawn */
    int discs;                      /* in each picture */
    double noise;                   /* standard deviation in levels */
    double ground, level, levels;   /* of the ground; discs are `level` to level + levels brighter */
    double overlap;                 /* centers are as near as 1 - overlap times the sum of radii */
    double cut;                     /* so much of the radius may be outside the picture */
    double line;                    /* a line so wide is drawn along the circle; 0: a disc */
} scene;

static const scene scenes[] = {
    {"in heavy noise", 10, 50, 7, 40, 70, 70, 70, -0.1, 0, 0},
    {"in noise, cut by the edge", 10, 50, 7, 20, 70, 70, 70, -0.1, 0.6, 0},
    {"in noise, overlapping", 10, 50, 7, 20, 70, 40, 110, 0.25, 0, 0},
    {"faint, 12 to 20 levels", 10, 50, 7, 2, 100, 12, 8, -0.1, 0, 0},
    {"small, in noise", 4, 10, 25, 20, 70, 70, 70, -0.2, 0, 0},
    {"large, in heavy noise", 50, 100, 2, 40, 70, 70, 70, -0.1, 0.3, 0},
    {"lines 2 px wide", 10, 50, 7, 5, 200, -150, 30, -0.1, 0, 2},
};

static uint32_t state;

static double random_between(double low, double high)
{
    state = state * 1664525u + 1013904223u;
    return low + (high - low) * (state >> 8) / 16777216.0;
}

static double random_bell(void)
{
    double sum = -6;
    for (int k = 0; k < 12; k++) {
        sum += random_between(0, 1);
    }
    return sum;
}

static int place(disc *discs, const scene *of)
{
    int count = 0;
    for (int tries = 0; count < of->discs && tries < 20000; tries++) {
        disc d = {0, 0, random_between(of->radius_min, of->radius_max)};
        double inside = d.r * (1 - of->cut) + 1;
        d.x = random_between(inside, W - 1 - inside);
        d.y = random_between(inside, H - 1 - inside);
        int fits = inside * 2 < H;
        for (int k = 0; k < count; k++) {
            fits = fits &&
                   hypot(d.x - discs[k].x, d.y - discs[k].y) > (d.r + discs[k].r) * (1 - of->overlap) + 2;
        }
        if (fits) {
            discs[count++] = d;
        }
    }
    return count;
}

/* Pixels at the rim are covered in part; later discs are in front. */
static int render(const iris_image *gray, disc *discs, const scene *of)
{
    int count = place(discs, of);
    double levels[64];
    for (int k = 0; k < count; k++) {
        levels[k] = of->ground + of->level + random_between(0, of->levels);
    }
    for (int32_t i = 0; i < W * H; i++) {
        double level = of->ground;
        for (int k = 0; k < count; k++) {
            double beyond = hypot(i % W - discs[k].x, i / W - discs[k].y) - discs[k].r;
            double covered = .5 + (of->line > 0 ? of->line / 2 - fabs(beyond) : -beyond);
            level += (levels[k] - level) * fmin(fmax(covered, 0), 1);
        }
        level += of->noise * random_bell();
        ((uint8_t *)gray->data)[i] = (uint8_t)lround(fmin(fmax(level, 0), 255));
    }
    return count;
}

static void score_scene(score *s, const scene *of, const iris_image *gray)
{
    static finding found;
    char what[120], file[64];
    tally t = {0};
    state = 77;
    for (int i = 0; i < 10; i++) {
        disc discs[64];
        int count = render(gray, discs, of);
        find(&found, gray, of->radius_min, of->radius_max);
        compare(&t, &found, discs, count, (const double[2]){2, 2});
        if (i == 0) {
            snprintf(file, sizeof file, "circles-scene-%d.bmp", (int)(of - scenes));
            save(s, file, gray, &found);
        }
    }
    snprintf(what, sizeof what, "discs %s, radius %d-%d: F, within 2 px", of->name, (int)of->radius_min,
             (int)of->radius_max);
    score_row(s, what, "at least 0.95", score_if(f_measure(&t) >= 0.95),
              "%.3f: %d of %d, %d false; center off by %.2f px, radius by %.2f", f_measure(&t), t.right,
              t.there, t.found - t.right, t.right ? t.center / t.right : 0, t.right ? t.radius / t.right : 0);
}

/* --- pictures without circles --- */

static const int32_t asked[3][2] = {{4, 10}, {10, 50}, {50, 100}};

static void score_nothing(score *s)
{
    static finding found;
    int made_up[3] = {0}, pictures = 0;
    for (int i = 0; i < NOTHING_PICTURES; i++) {
        iris_image gray = nothing_picture(i);
        for (int k = 0; gray.data && k < 3; k++) {
            find(&found, &gray, asked[k][0], asked[k][1]);
            made_up[k] += found.count;
        }
        pictures += gray.data != NULL;
        free(gray.data);
    }
    score_row(s, "false circles on pictures with nothing, radius 10-50", "none", score_if(made_up[1] == 0),
              "%d on %d; radius 4-10: %d, 50-100: %d", made_up[1], pictures, made_up[0], made_up[2]);
}

static void score_real(score *s)
{
    static const char *const files[] = {"hough/sudoku_half.pgm",         "hough/lane_solidYellowCurve.bmp",
                                        "edges/bsds/69007.pgm",          "edges/bsds/196027.bmp",
                                        "line/black_tape/line2_072.bmp", "edges/classic/camera_256.pgm"};
    static finding found;
    int made_up[3] = {0}, pictures = 0;
    for (int i = 0; i < 6; i++) {
        iris_image gray;
        if (picture_load(&gray, files[i], IRIS_GRAY8) == IRIS_OK) {
            for (int k = 0; k < 3; k++) {
                find(&found, &gray, asked[k][0], asked[k][1]);
                made_up[k] += found.count;
            }
            pictures++;
        }
        free(gray.data);
    }
    const char *what = "false circles on photographs without any, radius 10-50";
    if (pictures == 0) {
        score_row(s, what, "none", SCORE_SKIPPED, "no shared data");
    } else {
        score_row(s, what, "none", score_if(made_up[1] == 0),
                  "%d on %d; radius 4-10 (loops of digits): %d, 50-100: %d", made_up[1], pictures, made_up[0],
                  made_up[2]);
    }
}

void score_circles(score *s)
{
    iris_image gray = picture_make(W, H, IRIS_GRAY8);
    score_coins(s);
    for (size_t i = 0; gray.data && i < sizeof scenes / sizeof scenes[0]; i++) {
        score_scene(s, &scenes[i], &gray);
    }
    free(gray.data);
    score_nothing(s);
    score_real(s);
    score_cost_row(s, "circles, radius 7-30, with their edges", "Hough circles of a picture",
                   IRIS_EDGE_POINTS_SCRATCH_BYTES(160, 120, 91750) +
                       IRIS_CIRCLE_SCRATCH_BYTES(160, 120, 1500, 2, 256) + 1500 * sizeof(iris_edge_point));
}
