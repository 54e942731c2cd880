/* Color signatures and locking on: the thrown ball, taught well and less well; rendered sequences in which the place
 * of the ball is known; and where there is nothing of the color. All with the defaults. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "iris/color.h"
#include "iris/draw.h"
#include "iris/xt/lock.h"
#include "lock_scene.h"
#include "nothing.h"
#include "picture.h"
#include "score.h"

#define NEAR      8 /* pixels */
#define BALLS     32
#define SEQUENCES 8

static const iris_hsl_range RED = {345, 15, 60, 100, 15, 85};

typedef struct {
    iris_lock lock;
    iris_signatures signatures;
    iris_scratch scratch;
    void *memory;
} tracker;

/* 0 without memory. range null: it is to be taught. */
static int begin(tracker *t, iris_size size, const iris_hsl_range *range)
{
    const size_t bytes = IRIS_LOCK_SCRATCH_BYTES(size.w, size.h);
    memset(t, 0, sizeof *t);
    t->memory = malloc(bytes);
    if (range) {
        (void)iris_signature_from_range(&t->signatures, 0, range);
    }
    return t->memory && iris_scratch_init(&t->scratch, t->memory, bytes) == IRIS_OK &&
           iris_lock_init(&t->lock, size, &t->signatures, 0, NULL) == IRIS_OK;
}

/* The rectangle nearest to these numbers that is inside. */
static iris_rect rect_inside(double x, double y, double w, double h, iris_size size)
{
    int32_t left = (int32_t)lround(x), top = (int32_t)lround(y);
    int32_t right = (int32_t)lround(x + w), bottom = (int32_t)lround(y + h);
    left = left < 0 ? 0 : left;
    top = top < 0 ? 0 : top;
    right = right > size.w ? size.w : right;
    bottom = bottom > size.h ? size.h : bottom;
    return (iris_rect){left, top, right - left, bottom - top};
}

/* --- the thrown ball --- */

typedef struct {
    char name[64]; /* of at most 40 letters */
    double x, y, w, h;
} box;

static int read_boxes(box *boxes)
{
    FILE *file = data_open("track/ball_red/boxes.txt");
    char line[160];
    int count = 0;
    while (file && count < BALLS && fgets(line, sizeof line, file)) {
        box *b = &boxes[count];
        count += sscanf(line, "%40s %lf %lf %lf %lf", b->name, &b->x, &b->y, &b->w, &b->h) == 5 && b->w > 0;
    }
    if (file) {
        fclose(file);
    }
    return count;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Of what was found and what is there. */
static double overlap(const iris_rect *found, const box *b)
{
    double w = smaller(found->x + found->w, b->x + b->w) - larger(found->x, b->x);
    double h = smaller(found->y + found->h, b->y + b->h) - larger(found->y, b->y);
    double both = w > 0 && h > 0 ? w * h : 0;
    return both / ((double)found->w * found->h + b->w * b->h - both);
}

static void save(const score *s, const iris_image *image, const iris_lock_result *seen, const char *name)
{
    if (s->pictures) {
        if (seen->state == IRIS_LOCK_FOUND) {
            (void)iris_draw_rect(image, seen->box, (iris_color){0, 255, 0});
        }
        picture_save(image, s->pictures, name);
    }
}

typedef struct {
    double dx, dy, scale; /* of the rectangle that is taught, pixels, and times */
} slip;

/* Frames whose center is right, of `count`; -1: a frame is missing. Adds overlaps. */
static int throw_ball(const score *s, const box *boxes, int count, slip by, double *overlaps)
{
    tracker t = {.memory = NULL};
    int good = 0;
    for (int i = 0; i < count && good >= 0; i++) {
        char path[128], name[96];
        const box *b = &boxes[i];
        iris_image image;
        iris_lock_result seen = {.state = IRIS_LOCK_LOST};
        snprintf(path, sizeof path, "track/ball_red/%.40s", b->name);
        if (picture_load(&image, path, IRIS_RGB888) != IRIS_OK ||
            (i == 0 && !begin(&t, (iris_size){image.w, image.h}, NULL))) {
            good = -1;
        } else if (i == 0) {
            const iris_rect rect = rect_inside(b->x + b->w * (1 - by.scale) / 2 + by.dx,
                                               b->y + b->h * (1 - by.scale) / 2 + by.dy, b->w * by.scale,
                                               b->h * by.scale, (iris_size){image.w, image.h});
            (void)iris_lock_teach(&seen, &t.lock, &image, rect, &t.scratch);
        } else {
            (void)iris_lock_frame(&seen, &t.lock, &image, &t.scratch);
        }
        if (good >= 0 && seen.state == IRIS_LOCK_FOUND) { /* a box's pixel is a square around its center */
            good += hypot(seen.x_q16 / 65536.0 + 0.5 - b->x - b->w / 2,
                          seen.y_q16 / 65536.0 + 0.5 - b->y - b->h / 2) <= NEAR;
            *overlaps += overlap(&seen.box, b);
        }
        if (by.scale == 1 && by.dx == 0 && by.dy == 0 && good >= 0) {
            snprintf(name, sizeof name, "lock-%.40s", b->name);
            save(s, &image, &seen, name);
        }
        free(image.data);
    }
    free(t.memory);
    return good;
}

/* The rectangle shows a part of the ball. */
static void score_parts(score *s, const box *boxes, int count)
{
    static const slip parts[] = {{0, 0, 0.3}, {0, 0, 0.4},  {0, 0, 0.5},
                                 {1, 1, 0.5}, {-1, 2, 0.5}, {0, 0, 0.6}};
    enum { PARTS = sizeof parts / sizeof parts[0] };
    double overlaps = 0;
    int worst = count, sum = 0;
    for (int i = 0; i < PARTS; i++) {
        int right = throw_ball(s, boxes, count, parts[i], &overlaps);
        sum += right;
        worst = right < worst ? right : worst;
    }
    score_row(s, "the same, taught by a part, 0.3 to 0.6 of each side: 6 ways", NULL, SCORE_INFORMATION,
              "%d of %d frames, worst %d of %d; mean IoU %.2f", sum, PARTS * count, worst, count,
              overlaps / (PARTS * count));
}

static void score_ball(score *s)
{
    static const slip slips[] = {{3, 0, 1},   {-3, 0, 1},    {0, 3, 1},    {0, -3, 1},
                                 {2, 2, 1.2}, {-2, -2, 1.2}, {2, -2, 0.8}, {-2, 2, 0.8}};
    enum { SLIPS = sizeof slips / sizeof slips[0] };
    static box boxes[BALLS];
    double overlaps = 0, others = 0;
    int count = read_boxes(boxes), worst = count, sum = 0;
    int good = count > 0 ? throw_ball(s, boxes, count, (slip){0, 0, 1}, &overlaps) : -1;
    if (good < 0) {
        score_row(s, "ball_red: center within 8 px", "at least 90 %", SCORE_SKIPPED, "no shared data");
        return;
    }
    score_row(s, "ball_red: center within 8 px", "at least 90 %", score_if(good * 10 >= count * 9),
              "%d of %d frames; mean intersection over union %.2f", good, count, overlaps / count);
    for (int i = 0; i < SLIPS; i++) {
        int right = throw_ball(s, boxes, count, slips[i], &others);
        sum += right;
        worst = right < worst ? right : worst;
    }
    score_row(s, "the same, taught 2-3 px off, 20 % smaller, larger: 8 ways", NULL, SCORE_INFORMATION,
              "%d of %d frames, worst %d of %d; mean IoU %.2f", sum, SLIPS * count, worst, count,
              others / (SLIPS * count));
    score_parts(s, boxes, count);
}

/* --- rendered sequences --- */

typedef struct {
    int visible, good,
        same;          /* frames with half of the ball or more; center right; and its first identity, too */
    int gone, made_up; /* frames without any of it; found all the same */
    int sequences;     /* with at least 90 % right */
} tally;

static void one_frame(tally *all, const scene_truth *truth, const iris_lock_result *seen)
{
    const int is_found = seen->state == IRIS_LOCK_FOUND;
    if (truth->visible >= 0.5) {
        int is_right =
            is_found && hypot(seen->x_q16 / 65536.0 - truth->x, seen->y_q16 / 65536.0 - truth->y) <= NEAR;
        all->visible++;
        all->good += is_right;
        all->same += is_right && seen->id == 1;
    } else if (truth->visible <= 0.01) {
        all->gone++;
        all->made_up += is_found;
    }
}

static void one_sequence(const score *s, tally *all, scene_kind kind, unsigned seed, const iris_image *image)
{
    tracker t;
    tally its = {0};
    const iris_size size = {SCENE_W, SCENE_H};
    int is_ready = begin(&t, size, NULL);
    for (int frame = 0; is_ready && frame < SCENE_FRAMES; frame++) {
        char name[64];
        iris_lock_result seen = {.state = IRIS_LOCK_LOST};
        const scene_truth truth = scene_frame(image, kind, seed, frame);
        if (frame == 0) {
            const iris_rect rect =
                rect_inside(truth.x - truth.r, truth.y - truth.r, 2 * truth.r + 1, 2 * truth.r + 1, size);
            (void)iris_lock_teach(&seen, &t.lock, image, rect, &t.scratch);
        } else {
            (void)iris_lock_frame(&seen, &t.lock, image, &t.scratch);
        }
        one_frame(&its, &truth, &seen);
        if (frame % 8 == 7 && seed <= 2) {
            snprintf(name, sizeof name, "lock-scene%d-%u-%02d.bmp", (int)kind, seed, frame);
            save(s, image, &seen, name);
        }
    }
    free(t.memory);
    all->visible += its.visible;
    all->good += its.good;
    all->same += its.same;
    all->gone += its.gone;
    all->made_up += its.made_up;
    all->sequences += its.good * 10 >= its.visible * 9;
}

static void score_scenes(score *s)
{
    iris_image image = picture_make(SCENE_W, SCENE_H, IRIS_RGB888);
    for (int kind = 0; image.data && kind < SCENE_KINDS; kind++) {
        tally all = {0};
        char what[96], gone[64] = "";
        for (unsigned seed = 1; seed <= SEQUENCES; seed++) {
            one_sequence(s, &all, (scene_kind)kind, seed, &image);
        }
        if (all.gone > 0) {
            snprintf(gone, sizeof gone, "; found in %d of %d without it", all.made_up, all.gone);
        }
        snprintf(what, sizeof what, "rendered ball, %s: center within 8 px", scene_names[kind]);
        score_row(
            s, what, NULL, SCORE_INFORMATION, "%.1f %% of frames, %.1f %% as the same; %d of %d sequences%s",
            100.0 * all.good / all.visible, 100.0 * all.same / all.visible, all.sequences, SEQUENCES, gone);
    }
    free(image.data);
}

/* --- nothing of the color --- */

/* Is anything locked on in a picture by itself? */
static int finds_red(const iris_image *image)
{
    tracker t;
    iris_lock_result seen = {.state = IRIS_LOCK_LOST};
    if (begin(&t, (iris_size){image->w, image->h}, &RED)) {
        (void)iris_lock_frame(&seen, &t.lock, image, &t.scratch);
    }
    free(t.memory);
    return seen.state == IRIS_LOCK_FOUND;
}

/* Pixels that are red by the exact test. */
static int32_t red_pixels(const iris_image *image)
{
    iris_hsl_range_test test;
    int32_t count = 0;
    (void)iris_hsl_range_prepare(&test, &RED);
    for (int32_t k = 0; k < image->w * image->h; k++) {
        const uint8_t *rgb =
            (const uint8_t *)iris_image_row(image, k / image->w) + (size_t)(3 * (k % image->w));
        count += iris_hsl_range_has(&test, (iris_color){rgb[0], rgb[1], rgb[2]});
    }
    return count;
}

/* In gray pictures nothing but their coding could be red, so these are in color. */
static void score_photographs(score *s)
{
    static const char *const files[] = {"line/black_tape/line2_000.bmp",
                                        "line/black_tape/line2_072.bmp",
                                        "line/black_tape/line2_096.bmp",
                                        "line/black_tape/line2_304.bmp",
                                        "line/black_tape/small_024.bmp",
                                        "line/black_tape/small_108.bmp",
                                        "line/black_tape/small_138.bmp",
                                        "line/tape_lane/video01_005_073.bmp",
                                        "line/tape_lane/video01_060_081.bmp",
                                        "line/yellow_dashes/160.bmp",
                                        "line/yellow_dashes/165.bmp",
                                        "hough/lane_solidYellowCurve.bmp",
                                        "edges/bsds/3063.bmp",
                                        "colour/fruits_256.bmp",
                                        "colour/baboon_256.bmp"};
    int made_up = 0, pictures = 0;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        iris_image image;
        if (picture_load(&image, files[i], IRIS_RGB888) == IRIS_OK && red_pixels(&image) == 0) {
            made_up += finds_red(&image);
            pictures++;
        }
        free(image.data);
    }
    score_row(s, "false finds of red on photographs without a red pixel", NULL, SCORE_INFORMATION, "%d on %d",
              made_up, pictures);
}

static void score_nothing(score *s)
{
    int made_up = 0, pictures = 0;
    for (int i = 0; i < NOTHING_PICTURES; i++) {
        iris_image gray = nothing_picture(i);
        iris_image rgb = gray.data ? picture_make(gray.w, gray.h, IRIS_RGB888) : (iris_image){0};
        if (rgb.data && iris_color_convert(&rgb, &gray) == IRIS_OK) {
            made_up += finds_red(&rgb);
            pictures++;
        }
        free(rgb.data);
        free(gray.data);
    }
    score_row(s, "false finds of red on pictures with nothing", "none", score_if(made_up == 0), "%d on %d",
              made_up, pictures);
}

/* --- cells against the exact test --- */

static void score_cells(score *s)
{
    static const char *const files[] = {"colour/fruits_256.bmp", "colour/baboon_256.bmp",
                                        "edges/bsds/196027.bmp", "track/ball_red/frame0200.bmp"};
    static iris_signatures table;
    double same = 0, all = 0, both = 0, either = 0;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        iris_image image;
        int is_loaded = picture_load(&image, files[i], IRIS_RGB888) == IRIS_OK;
        for (int32_t hue = 0; is_loaded && hue < 360; hue += 30) {
            const iris_hsl_range range = {hue, (hue + 40) % 360, 25, 100, 15, 85};
            iris_hsl_range_test test;
            (void)iris_hsl_range_prepare(&test, &range);
            (void)iris_signature_from_range(&table, 0, &range);
            for (int32_t k = 0; k < image.w * image.h; k++) {
                const uint8_t *rgb =
                    (const uint8_t *)iris_image_row(&image, k / image.w) + (size_t)(3 * (k % image.w));
                uint8_t bits = 0;
                int exact = iris_hsl_range_has(&test, (iris_color){rgb[0], rgb[1], rgb[2]});
                (void)iris_signature_row(&bits, rgb, IRIS_RGB888, 1, &table);
                same += exact == (bits & 1);
                both += exact && (bits & 1);
                either += exact || (bits & 1);
                all++;
            }
        }
        free(image.data);
    }
    if (all > 0) {
        score_row(s, "signatures of 12 ranges on 4 pictures: as the exact test says", NULL, SCORE_INFORMATION,
                  "%.1f %% of pixels; of those that either selects %.0f %%", 100 * same / all,
                  either > 0 ? 100 * both / either : 100.0);
    }
}

void score_lock(score *s)
{
    score_ball(s);
    score_scenes(s);
    score_nothing(s);
    score_photographs(s);
    score_cells(s);
    score_cost_row(s, "8 signatures", "8 signatures, RGB888", sizeof(iris_signatures));
    score_cost_row(s, "locking on, a frame", "lock on: frame",
                   IRIS_LOCK_SCRATCH_BYTES(160, 120) + sizeof(iris_lock) + sizeof(iris_signatures));
}
