/* Stereo: disparities of real pairs beside the measured ones. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "iris/3d/stereo.h"
#include "picture.h"
#include "score.h"
#include "stereo_scene.h"

typedef struct {
    const char *name;
    int32_t scale, max_disparity; /* of the truth; asked for */
    iris_image left, right, truth, visible;
} pair;

static int load(pair *p)
{
    const struct {
        iris_image *to;
        const char *name;
    } files[] = {{&p->left, "left.pgm"},
                 {&p->right, "right.pgm"},
                 {&p->truth, "disp.pgm"},
                 {&p->visible, "nonocc.bmp"}};
    int loaded = 1;
    for (int i = 0; i < 4; i++) {
        char path[64];
        snprintf(path, sizeof path, "stereo/%s/%s", p->name, files[i].name);
        loaded = loaded && picture_load(files[i].to, path, IRIS_GRAY8) == IRIS_OK;
    }
    return loaded;
}

static void unload(pair *p)
{
    free(p->left.data);
    free(p->right.data);
    free(p->truth.data);
    free(p->visible.data);
}

/* In pixels; below 0: not known, or not visible in both. */
static double truth_at(const pair *p, int32_t x, int32_t y, int only_visible)
{
    uint8_t truth = ((const uint8_t *)iris_image_row(&p->truth, y))[x];
    int visible = ((const uint8_t *)iris_image_row(&p->visible, y))[x] > 127;
    return truth == 0 || (only_visible && !visible) ? -1 : truth / (double)p->scale;
}

static double found_at(const iris_image *disparity, int32_t x, int32_t y)
{
    return ((const uint16_t *)iris_image_row(disparity, y))[x] / 256.0;
}

/* What share of what both cameras see is off by more than a pixel, in percent; no match is off, too. */
static double bad_percent(const pair *p, const iris_image *disparity)
{
    int32_t bad = 0, all = 0;
    for (int32_t y = 0; y < p->truth.h; y++) {
        for (int32_t x = 0; x < p->truth.w; x++) {
            double truth = truth_at(p, x, y, 1), found = found_at(disparity, x, y);
            all += truth >= 0;
            bad += truth >= 0 && (found == 0 || fabs(found - truth) > 1);
        }
    }
    return 100.0 * bad / (all > 0 ? all : 1);
}

/* How far near things reach over what is right of them: right of each step down by 2 pixels or more, the pixels in a
 * row that look nearer than the middle between the two, on average. There both cameras see what is behind. */
static double corona_px(const pair *p, const iris_image *disparity)
{
    int32_t edges = 0, sum = 0;
    for (int32_t y = 0; y < p->truth.h; y++) {
        for (int32_t x = 1; x < p->truth.w; x++) {
            double near = truth_at(p, x - 1, y, 0), far = truth_at(p, x, y, 1);
            int32_t reach = 0;
            if (near < 0 || far < 0 || near - far < 2) {
                continue;
            }
            while (reach < 30 && x + reach < p->truth.w && fabs(truth_at(p, x + reach, y, 0) - far) <= 1 &&
                   found_at(disparity, x + reach, y) > (near + far) / 2) {
                reach++;
            }
            edges++;
            sum += reach;
        }
    }
    return (double)sum / (edges > 0 ? edges : 1);
}

/* Null data without memory. */
static iris_image block(const pair *p)
{
    iris_image disparity = picture_make(p->left.w, p->left.h, IRIS_GRAY_U16);
    size_t bytes = IRIS_STEREO_BLOCK_SCRATCH_BYTES(p->left.w, p->max_disparity);
    void *memory = malloc(bytes);
    iris_scratch scratch;
    iris_stereo_block_config config;
    iris_stereo_block_defaults(&config);
    config.stereo.max_disparity = p->max_disparity;
    if (disparity.data && iris_scratch_init(&scratch, memory, bytes) == IRIS_OK) {
        (void)iris_stereo_block(&disparity, &p->left, &p->right, &config, &scratch);
    }
    free(memory);
    return disparity;
}

static iris_image semiglobal(const pair *p)
{
    iris_image disparity = picture_make(p->left.w, p->left.h, IRIS_GRAY_U16);
    size_t bytes = IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(p->left.w, p->max_disparity);
    void *memory = malloc(bytes);
    iris_scratch scratch;
    iris_stereo_semiglobal_config config;
    iris_stereo_semiglobal_defaults(&config);
    config.stereo.max_disparity = p->max_disparity;
    if (disparity.data && iris_scratch_init(&scratch, memory, bytes) == IRIS_OK) {
        (void)iris_stereo_semiglobal(&disparity, &p->left, &p->right, &config, &scratch);
    }
    free(memory);
    return disparity;
}

static iris_image quadtree_of(const pair *p, int32_t planes)
{
    iris_image disparity = picture_make(p->left.w, p->left.h, IRIS_GRAY_U16);
    size_t bytes = IRIS_STEREO_QUADTREE_SCRATCH_BYTES(p->left.w, p->left.h, p->max_disparity, 3);
    void *memory = malloc(bytes);
    iris_scratch scratch;
    iris_stereo_quadtree_config config;
    iris_stereo_quadtree_defaults(&config);
    config.max_disparity = p->max_disparity;
    config.planes = planes;
    if (disparity.data && iris_scratch_init(&scratch, memory, bytes) == IRIS_OK) {
        (void)iris_stereo_quadtree(&disparity, &p->left, &p->right, &config, &scratch);
    }
    free(memory);
    return disparity;
}

static iris_image quadtree(const pair *p)
{
    return quadtree_of(p, 0);
}

static iris_image planes_of_quadtree(const pair *p)
{
    return quadtree_of(p, 1);
}

enum { PLANES = 2, METHODS = 4 };

typedef struct {
    const char *name;
    double most[2]; /* percent */
    iris_image (*match)(const pair *p);
} stereo_method;

static void save(const score *s, const iris_image *disparity, const char *name)
{
    iris_image shown = picture_make(disparity->w, disparity->h, IRIS_GRAY8);
    for (int32_t y = 0; y < disparity->h && shown.data; y++) {
        for (int32_t x = 0; x < disparity->w; x++) {
            double level = found_at(disparity, x, y) * (disparity->w > 400 ? 4 : 16);
            ((uint8_t *)iris_image_row(&shown, y))[x] = (uint8_t)(level > 255 ? 255 : level);
        }
    }
    if (shown.data) {
        picture_save(&shown, s->pictures, name);
    }
    free(shown.data);
}

static void score_method(score *s, const stereo_method *method, const pair pairs[2])
{
    double corona[2];
    char what[96], most[32];
    for (int i = 0; i < 2; i++) {
        iris_image disparity = method->match(&pairs[i]);
        double bad = disparity.data ? bad_percent(&pairs[i], &disparity) : 100;
        corona[i] = disparity.data ? corona_px(&pairs[i], &disparity) : 0;
        snprintf(what, sizeof what, "stereo, %s, %s: off by more than a pixel, of what both see",
                 method->name, pairs[i].name);
        snprintf(most, sizeof most, "at most %g %%", method->most[i]);
        score_row(s, what, most, score_if(bad <= method->most[i]), "%.2f %%", bad);
        if (s->pictures && disparity.data) {
            snprintf(what, sizeof what, "stereo_%s_%s.bmp", method->name, pairs[i].name);
            save(s, &disparity, what);
        }
        free(disparity.data);
    }
    snprintf(what, sizeof what, "stereo, %s, %s and %s: corona at depth edges", method->name, pairs[0].name,
             pairs[1].name);
    score_row(s, what, NULL, SCORE_INFORMATION, "%.2f and %.2f pixels", corona[0], corona[1]);
}

/* --- pairs that are drawn --- */

enum { SEEDS = 3 };

typedef struct {
    double bad; /* percent of what both cameras see, off by more than a pixel */
    double off; /* pixels, of the others */
} scene_errors;

static scene_errors errors_of(const stereo_scene *scene, const iris_image *disparity)
{
    int32_t bad = 0, all = 0, count = disparity->data ? disparity->w * disparity->h : 0;
    double sum = 0;
    for (int32_t k = 0; k < count; k++) {
        double apart = fabs(found_at(disparity, k % disparity->w, k / disparity->w) - scene->truth[k]);
        if (scene->visible[k]) {
            all++;
            bad += apart > 1;
            sum += apart > 1 ? 0 : apart;
        }
    }
    return (scene_errors){all > 0 ? 100.0 * bad / all : 100, sum / (all > bad ? all - bad : 1)};
}

/* All kinds of scenes, each a few times; with what the quadtree's method may at most have wrong. */
static void score_scenes(score *s, const stereo_method methods[METHODS])
{
    static const double most[STEREO_SCENES] = {0.2, 3.5, 14, 6.5};
    for (int kind = 0; kind < STEREO_SCENES; kind++) {
        scene_errors mean[METHODS] = {{0, 0}};
        for (uint32_t seed = 0; seed < SEEDS; seed++) {
            stereo_scene scene;
            int drawn = stereo_scene_draw(&scene, (stereo_scene_kind)kind, seed);
            for (int m = 0; m < METHODS; m++) {
                const pair p = {.max_disparity = 63, .left = scene.left, .right = scene.right};
                iris_image disparity = drawn ? methods[m].match(&p) : (iris_image){0};
                scene_errors e = errors_of(&scene, &disparity);
                mean[m].bad += e.bad / SEEDS;
                mean[m].off += e.off / SEEDS;
                free(disparity.data);
            }
            stereo_scene_free(&scene);
        }
        char what[96], required[48];
        snprintf(what, sizeof what, "stereo, drawn, %s: off by more than a pixel; mean error of the others",
                 stereo_scene_name((stereo_scene_kind)kind));
        snprintf(required, sizeof required, "with planes at most %g %%", most[kind]);
        score_row(s, what, required, score_if(mean[PLANES].bad <= most[kind]),
                  "block %.2f, quadtree %.2f, planes %.2f, semiglobal %.2f %%; %.2f, %.2f, %.2f, %.2f pixels",
                  mean[0].bad, mean[1].bad, mean[PLANES].bad, mean[3].bad, mean[0].off, mean[1].off,
                  mean[PLANES].off, mean[3].off);
    }
}

/* Of one call, the least of five: in processor seconds. */
static double seconds(iris_image (*match)(const pair *p), const pair *p)
{
    double least = 1e9;
    for (int i = 0; i < 5; i++) {
        clock_t start = clock();
        iris_image disparity = match(p);
        double took = (double)(clock() - start) / CLOCKS_PER_SEC;
        least = took < least ? took : least;
        free(disparity.data);
    }
    return least;
}

static void score_time(score *s, const pair pairs[2])
{
    double ratio[2];
    for (int i = 0; i < 2; i++) {
        ratio[i] = seconds(quadtree, &pairs[i]) / seconds(block, &pairs[i]);
    }
    score_row(s, "stereo, quadtree beside block, tsukuba and cones: processor time", "at most 0.33",
              ratio[0] <= 0.33 && ratio[1] <= 0.33 ? SCORE_REACHED
              : ratio[0] <= 1 && ratio[1] <= 1     ? SCORE_SHORT
                                                   : SCORE_MISSED,
              "%.2f and %.2f", ratio[0], ratio[1]);
}

void score_stereo(score *s)
{
    static const stereo_method methods[METHODS] = {{"block", {9, 13}, block},
                                                   {"quadtree", {11, 15}, quadtree},
                                                   {"quadtree with planes", {11, 15}, planes_of_quadtree},
                                                   {"semiglobal", {4.5, 6.1}, semiglobal}};
    pair pairs[2] = {{.name = "tsukuba", .scale = 16, .max_disparity = 16},
                     {.name = "cones", .scale = 4, .max_disparity = 63}};
    if (load(&pairs[0]) && load(&pairs[1])) {
        for (size_t i = 0; i < METHODS; i++) {
            score_method(s, &methods[i], pairs);
        }
        score_time(s, pairs);
    } else {
        score_row(s, "stereo: tsukuba and cones", "all", SCORE_SKIPPED, "no shared data");
    }
    score_scenes(s, methods);
    unload(&pairs[0]);
    unload(&pairs[1]);
}
