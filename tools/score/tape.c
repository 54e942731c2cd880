/* Black tape on real floors: is the line where people say it is, and nowhere else? One setting, the defaults.
 * */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "change.h"
#include "find.h"
#include "picture.h"

#define FRAMES_MAX 32
#define SEEDS      5
#define NEAR       8.0 /* pixels: this far off is still right */

static const int ROWS[3] = {40, 120, 200};

typedef struct {
    char name[32]; /* without .bmp */
    iris_image gray;
    int left[3], right[3]; /* of the tape; -1 no tape, -2 not scored */
} tape_frame;

typedef struct {
    int lines, right;        /* rows with tape, and those whose center is near */
    int bare, empty;         /* rows without tape, and those that were left empty */
    int floors, lost;        /* frames without any tape, and those where none was found */
    double error, worst_row; /* sum and largest of the right rows' errors, in pixels of the original */
} tape_count;

static int load_frames(tape_frame frames[FRAMES_MAX])
{
    char line[256], path[64];
    int count = 0;
    FILE *list = data_open("line/black_tape/rows.txt");
    while (list && count < FRAMES_MAX && fgets(line, sizeof line, list)) {
        tape_frame *f = &frames[count];
        if (line[0] == '#' ||
            sscanf(line, "%27[^.].bmp | %*[^|] | %d %d | %d %d | %d %d", f->name, &f->left[0], &f->right[0],
                   &f->left[1], &f->right[1], &f->left[2], &f->right[2]) != 7) {
            continue;
        }
        snprintf(path, sizeof path, "line/black_tape/%s.bmp", f->name);
        if (picture_load(&f->gray, path, IRIS_GRAY8) == IRIS_OK) {
            count++;
        }
    }
    if (list) {
        fclose(list);
    }
    return count;
}

/* Scores one row; 0 when it is wrong. */
static int count_row(tape_count *n, const tape_frame *frame, int row, const change *how, const found *result)
{
    double x = (frame->left[row] + frame->right[row]) / 2.0, y = ROWS[row];
    change_point(how, (iris_size){frame->gray.w, frame->gray.h}, &x, &y);
    const iris_span *spans = result->line.state == IRIS_LINE_FOUND ? result->line.rows : NULL;
    const iris_span *span = spans ? &spans[(int)floor(y + 0.5)] : NULL;
    int has_line = span && span->left <= span->right;
    if (frame->left[row] == -2) {
        return 1;
    }
    if (frame->left[row] == -1) {
        n->bare++;
        n->empty += !has_line;
        return !has_line;
    }
    n->lines++;
    double error = has_line ? fabs((span->left + span->right) / 2.0 - x) / change_scale(how) : NEAR + 1;
    if (error > NEAR) {
        return 0;
    }
    n->right++;
    n->error += error;
    n->worst_row = fmax(n->worst_row, error);
    return 1;
}

static void count_frame(tape_count *n, const score *s, const tape_frame *frame, const change *how,
                        uint32_t seed)
{
    double at[3][2];
    int right = 1, points = 0, tapeless = 1;
    iris_image changed = change_frame(how, &frame->gray, seed);
    found result = find_line(&changed, NULL);
    for (int row = 0; row < 3; row++) {
        right &= count_row(n, frame, row, how, &result);
        tapeless &= frame->left[row] == -1;
        if (frame->left[row] >= 0) {
            at[points][0] = (frame->left[row] + frame->right[row]) / 2.0;
            at[points][1] = ROWS[row];
            change_point(how, (iris_size){frame->gray.w, frame->gray.h}, &at[points][0], &at[points][1]);
            points++;
        }
    }
    n->floors += tapeless;
    n->lost += tapeless && result.line.state != IRIS_LINE_FOUND;
    if (how == changes || !right) { /* every picture as it is, and the failures of the others */
        char name[128];
        snprintf(name, sizeof name, "%s, %s.bmp", frame->name, how->name);
        save_found(s, name, &changed, &result, at, points);
    }
    free(changed.data);
}

/* All frames; with noise the worst of several times. */
static tape_count count_frames(const score *s, const tape_frame *frames, int count, const change *how)
{
    tape_count worst = {0};
    int seeds = change_is_random(how) ? SEEDS : 1;
    for (int seed = 0; seed < seeds; seed++) {
        tape_count n = {0};
        for (int i = 0; i < count; i++) {
            count_frame(&n, s, &frames[i], how, (uint32_t)(seed * count + i));
        }
        if (seed == 0 || n.right + n.empty + n.lost < worst.right + worst.empty + worst.lost) {
            worst = n;
        }
    }
    return worst;
}

static void score_rows(score *s, const tape_frame *frames, int count)
{
    for (int i = 0; i < change_count; i++) {
        const change *how = &changes[i];
        char what[96], required[32];
        tape_count n = count_frames(s, frames, count, how);
        snprintf(what, sizeof what, "tape, %s: rows within 8 px", how->name);
        if (i == 0) {
            score_row(s, what, "22 of 23", score_if(n.lines == 23 && n.right >= 22),
                      "%d of %d, error %.1f px on average, at most %.1f", n.right, n.lines,
                      n.right ? n.error / n.right : 0, n.worst_row);
            score_row(s, "no line in rows without tape", "all", score_if(n.empty == n.bare), "%d of %d",
                      n.empty, n.bare);
            score_row(s, "frames without tape never found", "all", score_if(n.lost == n.floors), "%d of %d",
                      n.lost, n.floors);
            continue;
        }
        snprintf(required, sizeof required, "90 %%: %d of %d", (9 * n.lines + 9) / 10, n.lines);
        score_row(s, what, how->required ? required : NULL,
                  how->required ? score_if(10 * n.right >= 9 * n.lines) : SCORE_INFORMATION,
                  "%d of %d%s; bare rows empty %d of %d, floors %d of %d", n.right, n.lines,
                  change_is_random(how) ? " at worst" : "", n.empty, n.bare, n.lost, n.floors);
    }
}

/* Parts of the frames where there is floor only. */
static const struct {
    const char *name;
    iris_rect part;
} FLOORS[] = {
    {"line2_256", {0, 0, 320, 80}},   {"line2_256", {0, 160, 320, 80}},  {"small_138", {0, 0, 320, 80}},
    {"small_108", {0, 0, 90, 240}},   {"small_108", {210, 0, 110, 240}}, {"small_024", {0, 0, 110, 240}},
    {"small_024", {250, 0, 70, 240}},
};
enum { FLOOR_COUNT = sizeof FLOORS / sizeof FLOORS[0] };

/* How many of the crops have a line in them, and how many there are. */
static void count_floors(int *false_lines, int *crops, const score *s, const tape_frame *frames, int count,
                         const change *how)
{
    int seeds = change_is_random(how) ? SEEDS : 1;
    for (int i = 0; i < count * FLOOR_COUNT * seeds; i++) {
        const tape_frame *frame = &frames[i / FLOOR_COUNT % count];
        iris_image crop;
        if (strcmp(frame->name, FLOORS[i % FLOOR_COUNT].name) != 0 ||
            iris_image_crop(&crop, &frame->gray, FLOORS[i % FLOOR_COUNT].part) != IRIS_OK) {
            continue;
        }
        iris_image changed = change_frame(how, &crop, (uint32_t)i);
        found result = find_line(&changed, NULL);
        ++*crops;
        if (result.line.state == IRIS_LINE_FOUND) {
            char name[128];
            snprintf(name, sizeof name, "%s, floor %d, %s.bmp", frame->name, i % FLOOR_COUNT + 1, how->name);
            save_found(s, name, &changed, &result, NULL, 0);
            ++*false_lines;
        }
        free(changed.data);
    }
}

static void score_floors(score *s, const tape_frame *frames, int count)
{
    int all_false = 0, all = 0;
    char what[96];
    for (int i = 0; i < change_count; i++) {
        int false_lines = 0, crops = 0;
        count_floors(&false_lines, &crops, s, frames, count, &changes[i]);
        if (i == 0) {
            score_row(s, "crops without tape: lines found", "none",
                      score_if(crops == FLOOR_COUNT && false_lines == 0), "%d of %d", false_lines, crops);
            continue;
        }
        all_false += false_lines;
        all += crops;
        if (false_lines > 0) {
            snprintf(what, sizeof what, "crops without tape, %s: lines found", changes[i].name);
            score_row(s, what, NULL, SCORE_INFORMATION, "%d of %d", false_lines, crops);
        }
    }
    score_row(s, "crops without tape, all changes: lines found", NULL, SCORE_INFORMATION, "%d of %d",
              all_false, all);
}

void score_tape(score *s)
{
    static tape_frame frames[FRAMES_MAX];
    int count = load_frames(frames);
    if (count == 0) {
        score_row(s, "tape: rows within 8 px", "22 of 23", SCORE_SKIPPED, "no shared data");
        score_row(s, "no line in rows without tape", "all", SCORE_SKIPPED, "no shared data");
        score_row(s, "crops without tape: lines found", "none", SCORE_SKIPPED, "no shared data");
        return;
    }
    score_rows(s, frames, count);
    score_floors(s, frames, count);
    for (int i = 0; i < count; i++) {
        free(frames[i].gray.data);
    }
}
