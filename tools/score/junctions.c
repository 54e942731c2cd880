/* Junctions: painted crossings, real floors, and pictures without any. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "crossing.h"
#include "iris/draw.h"
#include "iris/xt/junction.h"
#include "iris/xt/line_mask.h"
#include "nothing.h"
#include "picture.h"
#include "score.h"

enum { PER_KIND = 60, KINDS = 6, NONE = 5, ANGLES_MAX = 4 * PER_KIND * KINDS };

static const char *const names[KINDS] = {"end", "corner", "T", "Y", "crossing", "none"};

/* What was said of one picture. */
typedef struct {
    iris_junction junctions[IRIS_JUNCTIONS_MAX];
    int32_t count;
} said;

static iris_image mask_of; /* of the picture that was looked at last */

static said look(const iris_image *gray, int bright)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_JUNCTION_SCRATCH_BYTES(640, 480));
    static uint32_t words[640 * 480 / 32];
    said s = {.count = 0};
    iris_scratch scratch;
    const iris_line_mask_config config = {bright, 300};
    iris_size size = {gray->w, gray->h};
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (iris_image_wrap(&mask_of, words, sizeof words, size, 0, IRIS_MASK1) == IRIS_OK &&
        iris_line_mask(NULL, &mask_of, gray, &config, &scratch) == IRIS_OK) {
        (void)iris_junctions_find(s.junctions, IRIS_JUNCTIONS_MAX, &s.count, &mask_of, NULL, &scratch);
    }
    return s;
}

/* The line's pixels blue, each junction a cross with its branches. */
static void draw_found(const iris_image *rgb, const said *s)
{
    for (int32_t y = 0; y < rgb->h; y++) {
        const uint32_t *bits = iris_image_row(&mask_of, y);
        for (int32_t x = 0; x < rgb->w; x++) {
            uint8_t *pixel = (uint8_t *)iris_image_row(rgb, y) + 3 * x;
            pixel[2] = bits[x / 32] >> x % 32 & 1 ? 255 : pixel[2];
        }
    }
    for (int32_t i = 0; i < s->count; i++) {
        const iris_junction *j = &s->junctions[i];
        int32_t x = j->x_q4 / 16, y = j->y_q4 / 16;
        for (int32_t k = 0; k < j->branch_count; k++) {
            double angle = j->branches[k] * 3.14159265358979 / 32768, reach = rgb->h / 6.0;
            iris_draw_line(rgb, x, y, x + (int32_t)lround(reach * sin(angle)),
                           y - (int32_t)lround(reach * cos(angle)), (iris_color){255, 255, 0});
        }
        iris_draw_cross(rgb, x, y, 4, (iris_color){255, 0, 200});
        iris_draw_text(rgb, x + 4, y + 4, names[j->type], 1, (iris_color){255, 0, 200});
    }
}

static void keep_picture(const score *s, const char *name, const iris_image *gray, const said *found)
{
    iris_image rgb = s->pictures ? picture_make(gray->w, gray->h, IRIS_RGB888) : (iris_image){0};
    if (rgb.data) {
        for (int32_t y = 0; y < gray->h; y++) {
            const uint8_t *from = iris_image_row(gray, y);
            uint8_t *to = iris_image_row(&rgb, y);
            for (int32_t x = 0; x < 3 * gray->w; x++) {
                to[x] = from[x / 3];
            }
        }
        draw_found(&rgb, found);
        picture_save(&rgb, s->pictures, name);
        free(rgb.data);
    }
}

typedef struct {
    int pictures[KINDS], as[KINDS][KINDS]; /* painted as, said to be */
    int right, false_on_straight, false_on_empty;
    double angle[ANGLES_MAX]; /* how far off each branch is, degrees */
    int angles;
} tally;

static void count_angles(tally *t, const said *found, const crossing_truth *truth)
{
    for (int i = 0; i < truth->arms && t->angles < ANGLES_MAX; i++) {
        double nearest = 180;
        for (int32_t k = 0; k < found->junctions[0].branch_count; k++) {
            double angle = found->junctions[0].branches[k] * 360.0 / 65536;
            nearest = fmin(nearest, fabs(remainder(angle - truth->angle_deg[i], 360)));
        }
        t->angle[t->angles++] = nearest;
    }
}

/* A picture is right when its junction, and no other, is found; of a line and of an empty floor, when there is none. */
static void look_at_crossing(score *s, tally *t, const iris_image *gray, crossing_kind kind, int bright,
                             int seed)
{
    crossing_truth truth;
    crossing_paint(&truth, gray, kind, bright, (uint32_t)seed);
    said found = look(gray, bright);
    int is = kind < CROSSING_STRAIGHT ? (int)kind : NONE, told = NONE;
    if (found.count > 0) {
        told = (int)found.junctions[0].type;
    }
    int right = is == told && found.count <= 1;
    t->pictures[is]++;
    t->as[is][told]++;
    t->right += right;
    t->false_on_straight += kind == CROSSING_STRAIGHT && told != NONE;
    t->false_on_empty += kind == CROSSING_EMPTY && told != NONE;
    if (right && is != NONE) {
        count_angles(t, &found, &truth);
    }
    if (!right || seed % PER_KIND == 0) {
        char name[80];
        snprintf(name, sizeof name, "junction_%s_%d_%s%d%s.bmp", names[is], (int)gray->w,
                 bright ? "bright_" : "", seed, right ? "" : "_wrong");
        keep_picture(s, name, gray, &found);
    }
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void score_painted(score *s, int32_t w, int bright)
{
    static tally t;
    char what[100], confusion[200] = "";
    int all = 0;
    iris_image gray = picture_make(w, w * 3 / 4, IRIS_GRAY8);
    if (!gray.data) {
        return;
    }
    memset(&t, 0, sizeof t);
    for (int kind = 0; kind <= CROSSING_EMPTY; kind++) {
        for (int i = 0; i < PER_KIND; i++) {
            look_at_crossing(s, &t, &gray, (crossing_kind)kind, bright, i + (w > 160 ? 1000 : 0));
        }
    }
    free(gray.data);
    for (int i = 0; i < KINDS; i++) {
        all += t.pictures[i];
        for (int k = 0; k < KINDS; k++) {
            size_t used = strlen(confusion);
            if (i != k && t.as[i][k] > 0) {
                snprintf(confusion + used, sizeof confusion - used, ", %s as %s %d", names[i], names[k],
                         t.as[i][k]);
            }
        }
    }
    qsort(t.angle, (size_t)t.angles, sizeof t.angle[0], by_size);
    snprintf(what, sizeof what, "junction types, %s lines, %dx%d", bright ? "bright" : "dark", (int)w,
             (int)w * 3 / 4);
    score_row(s, what, "95 %", score_if(t.right * 100 >= all * 95), "%.1f %% of %d%s", 100.0 * t.right / all,
              all, confusion);
    snprintf(what, sizeof what, "angles of their branches, %dx%d", (int)w, (int)w * 3 / 4);
    score_row(s, what, NULL, SCORE_INFORMATION, "median %.1f, 95 of 100 within %.1f degrees",
              t.angles ? t.angle[t.angles / 2] : 0, t.angles ? t.angle[t.angles * 95 / 100] : 0);
    snprintf(what, sizeof what, "junctions on straight lines, empty floors, %dx%d", (int)w, (int)w * 3 / 4);
    score_row(s, what, NULL, SCORE_INFORMATION, "%d of %d, %d of %d", t.false_on_straight, PER_KIND,
              t.false_on_empty, PER_KIND);
}

static void score_nothing(score *s)
{
    int wrong = 0, pictures = 0;
    for (int i = 0; i < NOTHING_PICTURES; i++) {
        iris_image gray = nothing_picture(i);
        for (int bright = 0; gray.data && bright < 2; bright++) {
            said found = look(&gray, bright);
            pictures++;
            wrong += found.count > 0;
            if (found.count > 0) {
                char name[60];
                snprintf(name, sizeof name, "junction_nothing_%d_%d.bmp", i, bright);
                keep_picture(s, name, &gray, &found);
            }
        }
        free(gray.data);
    }
    score_row(s, "junctions where nothing is", NULL, SCORE_INFORMATION, "on %d of %d pictures", wrong,
              pictures);
}

/* What is said of the frames of a real camera: the frame's own name for it, and what was found. */
static void score_real(score *s)
{
    static const char *const frames[] = {
        "line2_256 crossing", "line2_392 junction", "small_138 corner",   "line2_080 corner behind a gap",
        "line2_096 corner",   "line2_168 curve",    "line2_000 straight", "line2_072 straight",
        "small_024 straight", "small_108 straight", "line2_304 none"};
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; i++) {
        char path[64], what[80], name[64], text[120] = "none";
        iris_image gray;
        snprintf(path, sizeof path, "line/black_tape/%.9s.bmp", frames[i]);
        if (picture_load(&gray, path, IRIS_GRAY8) == IRIS_OK) {
            said found = look(&gray, 0);
            for (int32_t k = 0; k < found.count; k++) {
                const iris_junction *j = &found.junctions[k];
                size_t used = k > 0 ? strlen(text) : 0;
                snprintf(text + used, sizeof text - used, "%s%s at %d, %d", k > 0 ? "; " : "", names[j->type],
                         (int)j->x_q4 / 16, (int)j->y_q4 / 16);
            }
            snprintf(what, sizeof what, "junctions of a tape: %s", frames[i]);
            score_row(s, what, NULL, SCORE_INFORMATION, "%s", text);
            snprintf(name, sizeof name, "junction_%.9s.bmp", frames[i]);
            keep_picture(s, name, &gray, &found);
        }
        free(gray.data);
    }
}

void score_junctions(score *s)
{
    score_painted(s, 160, 0);
    score_painted(s, 320, 0);
    score_painted(s, 160, 1);
    score_painted(s, 320, 1);
    score_nothing(s);
    score_real(s);
    score_cost_row(s, "a line's mask", "line mask", IRIS_LINE_MASK_SCRATCH_BYTES(160, 120));
    score_cost_row(s, "junctions", "junctions of a crossing", IRIS_JUNCTION_SCRATCH_BYTES(160, 120));
}
