/* Edges on photographs against the boundaries that people drew: F, with each found pixel and each drawn one counted as met
 * when one of the other kind is within 4 pixels. The thresholds and sigmas that are tried are the same for all pictures. */
#include <stdlib.h>
#include <string.h>

#include "figures.h"
#include "iris/xt/automaton.h"
#include "iris/xt/canny.h"
#include "iris/xt/edge.h"
#include "iris/xt/threshold.h"
#include "picture.h"
#include "score.h"

#define PEOPLE_MAX 8
#define PICTURES   3

typedef struct {
    const char *name, *file;
    double required;
    iris_image gray;
    iris_image drawn[PEOPLE_MAX]; /* masks: each person's boundaries */
    iris_image near;              /* someone drew a boundary within 4 pixels */
    int people;
} photograph;

/* One way to find edges: numbers mean what its `find` takes them for. */
typedef struct {
    double sigma;
    int32_t low, high;
} setting;

typedef iris_status finder(const iris_image *mask, const iris_image *gray, setting by, iris_scratch *scratch);

typedef struct {
    setting by;
    double f, precision, recall;
} result;

/* As OpenCV's blur continues pictures. */
static const iris_border mirrored = {IRIS_BORDER_REFLECT101, 0};

static iris_status find_canny(const iris_image *mask, const iris_image *gray, setting by,
                              iris_scratch *scratch)
{
    iris_canny_config config = {(iris_q16)(by.sigma * 65536 + 0.5), by.low, by.high};
    return iris_canny(mask, gray, &config, mirrored, scratch);
}

static iris_status find_sobel(const iris_image *mask, const iris_image *gray, setting by,
                              iris_scratch *scratch)
{
    iris_edge_config config;
    iris_edge_defaults(&config);
    config.threshold = by.high;
    return iris_edge_mask(mask, gray, &config, mirrored, scratch);
}

/* The automaton at its default of generations. */
static iris_status find_automaton(const iris_image *mask, const iris_image *gray, setting by,
                                  iris_scratch *scratch)
{
    iris_automaton_config config;
    iris_automaton_defaults(&config);
    config.threshold = (uint8_t)by.high;
    return iris_automaton(mask, gray, &config, mirrored, scratch);
}

/* Word `word` of a mask's row of `words`, moved by `by` pixels, -31 to 31; 0 beyond the ends. */
static uint32_t moved(const uint32_t *row, int32_t word, int32_t words, int32_t by)
{
    if (by == 0) {
        return row[word];
    }
    if (by > 0) {
        return row[word] << by | (word > 0 ? row[word - 1] >> (32 - by) : 0);
    }
    return row[word] >> -by | (word + 1 < words ? row[word + 1] << (32 + by) : 0);
}

/* Adds to `to` what is set in mask or not farther than 4 pixels from what is. Bits past w of mask are 0, those of to mean
 * nothing. */
static void set_around(const iris_image *to, const iris_image *mask)
{
    static const int32_t reach[5] = {4, 3, 3, 2, 0};
    const int32_t words = (mask->w + 31) / 32;
    for (int32_t i = 0; i < words * mask->h; i++) {
        const uint32_t *row = iris_image_row(mask, i / words);
        uint32_t wide[5]; /* up to so many pixels to both sides */
        wide[0] = row[i % words];
        for (int32_t by = 1; by <= 4; by++) {
            wide[by] = wide[by - 1] | moved(row, i % words, words, by) | moved(row, i % words, words, -by);
        }
        for (int32_t y = i / words - 4; y <= i / words + 4; y++) {
            if (y >= 0 && y < to->h) {
                ((uint32_t *)iris_image_row(to, y))[i % words] |= wide[reach[abs(y - i / words)]];
            }
        }
    }
}

static long count_both(const iris_image *a, const iris_image *b)
{
    const uint32_t *p = a->data, *q = b->data;
    long count = 0;
    for (int32_t i = 0; i < (a->w + 31) / 32 * a->h; i++) {
        for (uint32_t bits = p[i] & q[i]; bits != 0; bits &= bits - 1) {
            count++;
        }
    }
    return count;
}

/* A person's boundaries as a mask; data is null when there are none of that number. */
static iris_image load_drawn(const photograph *p, int number)
{
    char path[64];
    iris_image edges, mask = {0};
    snprintf(path, sizeof path, "edges/bsds/%s_edge%d.bmp", p->name, number);
    if (picture_load(&edges, path, IRIS_GRAY8) == IRIS_OK && edges.w == p->gray.w && edges.h == p->gray.h) {
        mask = picture_make(edges.w, edges.h, IRIS_MASK1);
        if (mask.data) {
            (void)iris_threshold(&mask, &edges, 127, IRIS_SELECT_BRIGHT);
        }
    }
    free(edges.data);
    return mask;
}

/* Reads a picture and all that was drawn for it. 0: not there. */
static int load(photograph *p)
{
    char path[64];
    snprintf(path, sizeof path, "edges/bsds/%s", p->file);
    if (picture_load(&p->gray, path, IRIS_GRAY8) != IRIS_OK) {
        return 0;
    }
    iris_image all = picture_make(p->gray.w, p->gray.h, IRIS_MASK1);
    p->near = picture_make(p->gray.w, p->gray.h, IRIS_MASK1);
    for (int i = 1; i <= PEOPLE_MAX && all.data && p->near.data; i++) {
        iris_image mask = load_drawn(p, i);
        if (!mask.data) {
            continue;
        }
        for (int32_t k = 0; k < (mask.w + 31) / 32 * mask.h; k++) {
            ((uint32_t *)all.data)[k] |= ((const uint32_t *)mask.data)[k];
        }
        p->drawn[p->people++] = mask;
    }
    if (p->people > 0) {
        set_around(&p->near, &all);
    }
    free(all.data);
    return p->people > 0;
}

static void unload(photograph *p)
{
    free(p->gray.data);
    free(p->near.data);
    for (int i = 0; i < p->people; i++) {
        free(p->drawn[i].data);
    }
}

/* found: its bits past w are 0. */
static result measure(const photograph *p, const iris_image *found, setting by)
{
    long drawn = 0, met = 0, all = count_both(found, found);
    iris_image around = picture_make(found->w, found->h, IRIS_MASK1);
    result r = {.by = by};
    if (!around.data || all == 0) {
        free(around.data);
        return r;
    }
    set_around(&around, found);
    for (int i = 0; i < p->people; i++) {
        drawn += count_both(&p->drawn[i], &p->drawn[i]);
        met += count_both(&p->drawn[i], &around);
    }
    free(around.data);
    r.precision = (double)count_both(found, &p->near) / (double)all;
    r.recall = (double)met / (double)drawn;
    r.f = met > 0 ? 2 * r.precision * r.recall / (r.precision + r.recall) : 0;
    return r;
}

typedef struct {
    photograph photographs[PICTURES];
    result best[PICTURES]; /* each at its own setting */
    result common;         /* the setting whose mean F is greatest, and that mean */
} trial;

static void forget(trial *t)
{
    memset(t->best, 0, sizeof t->best);
    t->common = (result){.f = 0};
}

static void try_setting(trial *t, finder *find, setting by)
{
    double sum = 0;
    for (int i = 0; i < PICTURES; i++) {
        const photograph *p = &t->photographs[i];
        size_t bytes = IRIS_CANNY_SCRATCH_BYTES(p->gray.w, p->gray.h, 3 * 65536);
        iris_image mask = picture_make(p->gray.w, p->gray.h, IRIS_MASK1);
        void *memory = NULL;
        iris_scratch scratch;
        if (mask.data && posix_memalign(&memory, IRIS_SCRATCH_ALIGN, bytes) == 0 &&
            iris_scratch_init(&scratch, memory, bytes) == IRIS_OK &&
            find(&mask, &p->gray, by, &scratch) == IRIS_OK) {
            result r = measure(p, &mask, by);
            sum += r.f;
            t->best[i] = r.f > t->best[i].f ? r : t->best[i];
        }
        free(memory);
        free(mask.data);
    }
    if (sum > t->common.f * PICTURES) {
        t->common = (result){.by = by, .f = sum / PICTURES};
    }
}

static void canny_rows(score *s, trial *t)
{
    static const double sigmas[] = {0, 1, 1.4, 1.8, 2.2, 2.6, 3};
    forget(t);
    for (size_t i = 0; i < sizeof sigmas / sizeof sigmas[0]; i++) {
        for (double high = 16; high < 600; high *= 1.07) {
            for (int fifths = 1; fifths <= 2; fifths++) {
                try_setting(t, find_canny, (setting){sigmas[i], (int32_t)(high * fifths / 5), (int32_t)high});
            }
        }
    }
    for (int i = 0; i < PICTURES; i++) {
        char what[96], required[32];
        const result *r = &t->best[i];
        snprintf(what, sizeof what, "Canny's edges, best F on %s (OpenCV's is required)",
                 t->photographs[i].name);
        snprintf(required, sizeof required, "at least %.2f", t->photographs[i].required);
        score_row(s, what, required, score_if(r->f >= t->photographs[i].required),
                  "%.4f: P %.2f, R %.2f at sigma %.1f, %d to %d", r->f, r->precision, r->recall, r->by.sigma,
                  r->by.low, r->by.high);
    }
    score_row(s, "the same, mean F at one setting for all", NULL, SCORE_INFORMATION,
              "%.4f at sigma %.1f, %d to %d", t->common.f, t->common.by.sigma, t->common.by.low,
              t->common.by.high);
    iris_canny_config config;
    iris_canny_defaults(&config);
    forget(t);
    try_setting(t, find_canny, (setting){config.sigma_q16 / 65536.0, config.low, config.high});
    score_row(s, "the same, F at the defaults", NULL, SCORE_INFORMATION, "%.2f, %.2f, %.2f", t->best[0].f,
              t->best[1].f, t->best[2].f);
}

/* Best F of thresholds alone. */
static void threshold_row(score *s, trial *t, const char *what, finder *find, double most)
{
    forget(t);
    for (double high = 4; high < most; high = high * 1.05 + 1) {
        try_setting(t, find, (setting){0, 0, (int32_t)high});
    }
    score_row(s, what, NULL, SCORE_INFORMATION, "%.2f, %.2f, %.2f above %d, %d, %d", t->best[0].f,
              t->best[1].f, t->best[2].f, t->best[0].by.high, t->best[1].by.high, t->best[2].by.high);
}

/* Cells of the automaton and of Sobel's mask, in thousandths of an even gray picture with Gaussian noise of sigma 8 (a sum
 * of twelve even ones), at thresholds that a step of 32 levels just reaches. */
static void noise_row(score *s)
{
    iris_image gray = picture_make(512, 512, IRIS_GRAY8), mask = picture_make(512, 512, IRIS_MASK1);
    void *memory = NULL;
    const size_t bytes = IRIS_CANNY_SCRATCH_BYTES(512, 512, 0);
    iris_scratch scratch;
    uint32_t random = 1;
    long count[2] = {0, 0};
    if (gray.data && mask.data && posix_memalign(&memory, IRIS_SCRATCH_ALIGN, bytes) == 0) {
        for (int32_t i = 0; i < 512 * 512; i++) {
            double sum = 0;
            for (int k = 0; k < 12; k++) {
                random = random * 1664525u + 1013904223u;
                sum += random / 4294967296.0;
            }
            ((uint8_t *)gray.data)[i] = (uint8_t)(128.5 + 8 * (sum - 6));
        }
        for (int sobel = 0; sobel < 2; sobel++) {
            (void)iris_scratch_init(&scratch, memory, bytes);
            (void)(sobel ? find_sobel : find_automaton)(&mask, &gray, (setting){0, 0, sobel ? 127 : 31},
                                                        &scratch);
            count[sobel] = count_both(&mask, &mask);
        }
        score_row(s, "the automaton's noise on even gray, sigma 8, beside Sobel's", NULL, SCORE_INFORMATION,
                  "%.2f and %.2f pixels of 1000", count[0] / 262.144, count[1] / 262.144);
    }
    free(memory);
    free(gray.data);
    free(mask.data);
}

/* Instructions per pixel that the benchmark counted; 0: none. */
static double cost_of(FILE *file, const char *name)
{
    char line[256];
    double number = 0, cost = 0;
    rewind(file);
    while (fgets(line, sizeof line, file)) {
        if (strstr(line, name) && sscanf(line, "%lf", &number) == 1) {
            cost = number;
        }
    }
    return cost;
}

static void cost_row(score *s)
{
    static const char what[] = "the automaton's instructions/pixel, M4, beside Sobel's mask";
    char why[128];
    FILE *file = figures_open(why, sizeof why, s, "1-M4");
    if (!file) {
        score_row(s, what, "fewer", SCORE_SKIPPED, "%s", why);
        return;
    }
    double automaton = cost_of(file, "cellular automaton"), sobel = cost_of(file, "Sobel mask");
    fclose(file);
    score_row(s, what, "fewer", score_if(automaton > 0 && automaton < sobel), "%.1f and %.1f", automaton,
              sobel);
}

void score_edges(score *s)
{
    trial t = {{{.name = "3063", .file = "3063.bmp", .required = 0.80},
                {.name = "196027", .file = "196027.bmp", .required = 0.81},
                {.name = "69007", .file = "69007.pgm", .required = 0.77}},
               {{.f = 0}},
               {.f = 0}};
    int there = 1;
    for (int i = 0; i < PICTURES; i++) {
        there &= load(&t.photographs[i]);
    }
    if (there) {
        canny_rows(s, &t);
        threshold_row(s, &t, "Sobel's edges, best F on the same", find_sobel, 1000);
        threshold_row(s, &t, "the automaton's edges, best F on the same", find_automaton, 255);
    } else {
        score_row(s, "Canny's edges on photographs", "OpenCV's", SCORE_SKIPPED, "no shared data");
    }
    for (int i = 0; i < PICTURES; i++) {
        unload(&t.photographs[i]);
    }
    noise_row(s);
    cost_row(s);
}
