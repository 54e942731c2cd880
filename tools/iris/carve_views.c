#include "carve_views.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "floor_file.h"
#include "number_file.h"
#include "system.h"

#define NUMBERS 21

/* K [R | t]. */
static int multiply(iris_q32 m[12], const iris_q32 numbers[NUMBERS])
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            double sum = 0;
            for (int i = 0; i < 3; i++) {
                const iris_q32 right = column < 3 ? numbers[9 + 3 * i + column] : numbers[18 + i];
                sum += (double)numbers[3 * row + i] / 4294967296.0 * (double)right;
            }
            if (fabs(sum) > 4294967296.0 * 1073741824.0) {
                return 0;
            }
            m[4 * row + column] = (iris_q32)llround(sum);
        }
    }
    return 1;
}

static const char between[] = " \t\r\n";

/* A text word by word; line: where the last one stands. */
typedef struct {
    char *at;
    int line, line_over;
} text_words;

static char *next_word(text_words *words)
{
    words->line += words->line_over;
    words->line_over = 0;
    for (; *words->at && strchr(between, *words->at); words->at++) {
        words->line += *words->at == '\n';
    }
    char *word = words->at;
    if (*word == '\0') {
        return NULL;
    }
    words->at += strcspn(word, between);
    if (*words->at) {
        words->line_over = *words->at == '\n';
        *words->at++ = '\0';
    }
    return word;
}

/* Texts round their numbers: R may be off by so much. */
#define TOLERANCE 1e-3

static double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

static int is_rotation(const iris_q32 *numbers)
{
    double r[9];
    for (int i = 0; i < 9; i++) {
        r[i] = real(numbers[i]);
    }
    for (int i = 0; i < 3; i++) {
        for (int k = i; k < 3; k++) {
            const double product =
                r[3 * i] * r[3 * k] + r[3 * i + 1] * r[3 * k + 1] + r[3 * i + 2] * r[3 * k + 2];
            if (fabs(product - (i == k)) > TOLERANCE) {
                return 0;
            }
        }
    }
    return r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
               r[2] * (r[3] * r[7] - r[4] * r[6]) >
           0;
}

/* What keeps the numbers from being those of a camera; null: nothing. */
static const char *flaw_of(const iris_q32 numbers[NUMBERS])
{
    if (numbers[0] <= 0 || numbers[4] <= 0) {
        return "focal lengths, the first and fifth number of K, are to be above 0";
    }
    if (numbers[3] != 0 || numbers[6] != 0 || numbers[7] != 0 || fabs(real(numbers[8]) - 1) > TOLERANCE) {
        return "K is to be fx s u0, 0 fy v0, 0 0 1: do K, R, and t stand row by row, in this order?";
    }
    if (!is_rotation(numbers + 9)) {
        return "R is no rotation: its rows are to have length 1, be perpendicular, and not mirror. Do K, R, "
               "and t "
               "stand row by row, in this order?";
    }
    return NULL;
}

static int read_camera(carve_view *view, text_words *words, const char *which, const char *path)
{
    iris_q32 numbers[NUMBERS];
    const char *word = next_word(words);
    const int line = words->line;
    if (!word || strlen(word) >= CARVE_NAME_MAX) {
        complain(path, "%s: its name is %s", which, word ? "too long" : "missing");
        return 0;
    }
    memcpy(view->name, word, strlen(word) + 1);
    for (int n = 0; n < NUMBERS; n++) {
        word = next_word(words);
        if (!word || !number_text_read(&numbers[n], word)) {
            complain(path, "%s (%s): expected are 21 numbers: K and R row by row, and t", which, view->name);
            return 0;
        }
    }
    const char *flaw = flaw_of(numbers);
    if (flaw) {
        complain(path, "line %d: %s (%s): %s", line, which, view->name, flaw);
        return 0;
    }
    view->silhouette = view->photo = NULL;
    view->shows = 0;
    if (!multiply(view->m, numbers)) {
        complain(path, "%s (%s): its numbers are too large", which, view->name);
        return 0;
    }
    return 1;
}

/* The rest of the text from the second word on; complains. */
static int read_cameras(carve_views *views, text_words *words, const char *path)
{
    for (int i = 0; i < views->count; i++) {
        char which[64];
        snprintf(which, sizeof which, "camera %d of %d", i + 1, views->count);
        if (!read_camera(&views->views[i], words, which, path)) {
            return 0;
        }
    }
    if (next_word(words)) {
        complain(path, "more stands behind the last of %d cameras", views->count);
        return 0;
    }
    return 1;
}

int carve_views_read(carve_views *views, const char *path)
{
    static char text[4 * TEXT_FILE_BYTES];
    size_t length = 0;
    text_words words = {text, 1, 0};
    int32_t count = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    text[length] = '\0';
    const char *word = next_word(&words);
    char *end = NULL;
    count = word ? (int32_t)strtol(word, &end, 10) : 0;
    if (!word || *end != '\0' || count < 1 || count > CARVE_VIEWS_MAX) {
        complain(path, "its first line is to say how many cameras there are, 1 to %d", CARVE_VIEWS_MAX);
        return 0;
    }
    views->count = count;
    return read_cameras(views, &words, path);
}

static const char *base_of(const char *path)
{
    const char *base = path;
    for (const char *c = path; *c; c++) {
        base = system_is_separator(*c) ? c + 1 : base;
    }
    return base;
}

static size_t stem_length(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot && dot != name ? (size_t)(dot - name) : strlen(name);
}

/* The camera that the picture is named after; null: none. */
static carve_view *named(carve_views *views, const char *picture)
{
    const char *base = base_of(picture);
    carve_view *best = NULL;
    size_t longest = 0;
    for (int i = 0; i < views->count; i++) {
        const size_t length = stem_length(views->views[i].name);
        if (length > longest && strncmp(base, views->views[i].name, length) == 0) {
            best = &views->views[i];
            longest = length;
        }
    }
    return best;
}

int carve_views_match(carve_views *views, carve_kind kind, char **pictures, int count, const char *path)
{
    int by_name = 0;
    for (int i = 0; i < count; i++) {
        by_name += named(views, pictures[i]) != NULL;
    }
    views->by_name = by_name > 0;
    if (by_name == 0 && count != views->count) {
        complain(path, "%d cameras, but %d %s, which are not named after them", views->count, count,
                 kind == CARVE_PHOTOS ? "photos" : "silhouettes");
        return 0;
    }
    for (int i = 0; i < count; i++) {
        carve_view *view = by_name > 0 ? named(views, pictures[i]) : &views->views[i];
        if (!view) {
            complain(pictures[i], "named after no camera of %s, as others are", path);
            return 0;
        }
        const char **to = kind == CARVE_PHOTOS ? &view->photo : &view->silhouette;
        if (*to) {
            complain(pictures[i], "%s is of the same camera: %s", *to, view->name);
            return 0;
        }
        *to = pictures[i];
    }
    return 1;
}
