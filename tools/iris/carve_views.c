#include "carve_views.h"

#include <math.h>
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

/* The rest of the text from the second word on; complains. */
static int read_cameras(carve_views *views, char *rest, const char *path)
{
    for (int i = 0; i < views->count; i++) {
        iris_q32 numbers[NUMBERS];
        carve_view *view = &views->views[i];
        const char *word = strtok_r(NULL, between, &rest);
        if (!word || strlen(word) >= CARVE_NAME_MAX) {
            complain(path, "camera %d of %d: its name is %s", i + 1, views->count,
                     word ? "too long" : "missing");
            return 0;
        }
        memcpy(view->name, word, strlen(word) + 1);
        for (int n = 0; n < NUMBERS; n++) {
            word = strtok_r(NULL, between, &rest);
            if (!word || !number_text_read(&numbers[n], word)) {
                complain(path, "camera %d of %d (%s): expected are 21 numbers: K and R row by row, and t",
                         i + 1, views->count, view->name);
                return 0;
            }
        }
        view->silhouette = view->photo = NULL;
        if (!multiply(view->m, numbers)) {
            complain(path, "camera %d of %d (%s): its numbers are too large", i + 1, views->count,
                     view->name);
            return 0;
        }
    }
    if (strtok_r(NULL, between, &rest)) {
        complain(path, "more stands behind the last of %d cameras", views->count);
        return 0;
    }
    return 1;
}

int carve_views_read(carve_views *views, const char *path)
{
    static char text[4 * TEXT_FILE_BYTES];
    size_t length = 0;
    char *rest = text;
    int32_t count = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    text[length] = '\0';
    const char *word = strtok_r(text, between, &rest);
    char *end = NULL;
    count = word ? (int32_t)strtol(word, &end, 10) : 0;
    if (!word || *end != '\0' || count < 1 || count > CARVE_VIEWS_MAX) {
        complain(path, "its first line is to say how many cameras there are, 1 to %d", CARVE_VIEWS_MAX);
        return 0;
    }
    views->count = count;
    return read_cameras(views, rest, path);
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
