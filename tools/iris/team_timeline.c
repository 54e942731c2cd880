#include "team_timeline.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "complain.h"
#include "file_write.h"
#include "picture_write.h"
#include "team_marks.h"

/* Pixels. */
enum {
    WIDTH = 960,
    LEFT = 84,
    RIGHT = 24,
    TOP = 44,
    ROW = 64,
    BAR = 22,
    AXIS = 44,
    ASIDE_MAX = 60, /* that a sign stands beside its time */
    LEGEND_ROW = 26,
    LEGEND_COLUMNS = 3,
    TEXT = 2,
    CELL = IRIS_TEXT_CELL_W * TEXT
};

static const iris_color paper = {255, 255, 255}, ink = {40, 40, 40}, pale = {222, 222, 222};

/* --- layout --- */

typedef struct {
    const team_record *record;
    smooth_picture picture;
    const iris_image *image;
    int32_t height;
    double step_s; /* of the grid */
    int is_there[BORG_SIGNAL_KINDS];
} drawing;

static double x_of(const drawing *d, uint32_t at_ms)
{
    const double all = d->record->time_ms > 0 ? d->record->time_ms : 1;
    return LEFT + (WIDTH - LEFT - RIGHT) * (double)at_ms / all;
}

/* The middle of a robot's bar. */
static double y_of(int32_t robot)
{
    return TOP + ROW * (double)robot + ROW * 0.66;
}

/* A grid of 1, 2, or 5 times a power of ten seconds, at most 12 lines. */
static double grid_step(double seconds)
{
    double step = 1;
    for (int i = 0; seconds / step > 12; i++) {
        step *= i % 3 == 1 ? 2.5 : 2;
    }
    return step;
}

static int kinds_there(drawing *d)
{
    int count = 0;
    for (int32_t i = 0; i < d->record->signal_count; i++) {
        d->is_there[d->record->signals[i].signal.kind] = 1;
    }
    for (int kind = 0; kind < BORG_SIGNAL_KINDS; kind++) {
        count += d->is_there[kind];
    }
    return count;
}

/* --- shapes --- */

/* What robots do has the tint of their color: none of standing, all of it of what is done. */
static iris_color tint(iris_color color, const char *state)
{
    const int of_8 = strcmp(state, "stopped") == 0 || strcmp(state, "idle") == 0 ? 0
                     : strcmp(state, "going") == 0                               ? 4
                     : strcmp(state, "reached") == 0                             ? 5
                                                                                 : 2;
    const iris_color gray = {236, 236, 236};
    return of_8 == 0 ? gray
                     : (iris_color){(uint8_t)(255 - (255 - color.r) * of_8 / 8),
                                    (uint8_t)(255 - (255 - color.g) * of_8 / 8),
                                    (uint8_t)(255 - (255 - color.b) * of_8 / 8)};
}

/* The next change of the same robot; the end where there is none. */
static uint32_t until(const team_record *record, int32_t change)
{
    for (int32_t i = change + 1; i < record->change_count; i++) {
        if (record->changes[i].robot == record->changes[change].robot) {
            return record->changes[i].at_ms;
        }
    }
    return record->time_ms;
}

static void draw_bars(const drawing *d)
{
    for (int32_t i = 0; i < d->record->change_count; i++) {
        const team_change *change = &d->record->changes[i];
        const double left = x_of(d, change->at_ms), right = x_of(d, until(d->record, i)),
                     y = y_of(change->robot);
        const canvas_point box[4] = {
            {left, y - BAR / 2.0}, {right, y - BAR / 2.0}, {right, y + BAR / 2.0}, {left, y + BAR / 2.0}};
        smooth_polygon(&d->picture, box, 4, tint(team_color(change->robot), change->state));
        smooth_stroke(&d->picture, box[0], box[3], 1, ink);
    }
}

static void draw_grid(const drawing *d)
{
    const double bottom = TOP + ROW * (double)d->record->robot_count, end_s = d->record->time_ms / 1000.0;
    for (int i = 0; i * d->step_s <= end_s; i++) {
        const double x = x_of(d, (uint32_t)(i * d->step_s * 1000));
        smooth_stroke(&d->picture, (canvas_point){x, TOP}, (canvas_point){x, bottom + 6}, 1, pale);
    }
    smooth_stroke(&d->picture, (canvas_point){LEFT, bottom}, (canvas_point){WIDTH - RIGHT, bottom}, 1, ink);
}

static int32_t robot_of(const team_record *record, const borg_signal *signal)
{
    for (int32_t i = 0; i < record->robot_count; i++) {
        if (record->robots[i].ref == signal->ref && record->robots[i].unit == signal->unit) {
            return i;
        }
    }
    return -1;
}

/* What came from another robot: from its bar to this one's. */
static void draw_messages(const drawing *d)
{
    for (int32_t i = 0; i < d->record->signal_count; i++) {
        const team_signal *one = &d->record->signals[i];
        const int32_t from = robot_of(d->record, &one->signal);
        if (from >= 0 && from != one->robot) {
            const double x = x_of(d, one->at_ms);
            smooth_stroke(&d->picture, (canvas_point){x, y_of(from)}, (canvas_point){x, y_of(one->robot)},
                          1.5, team_mark_color(one->signal.kind));
        }
    }
}

/* Above the bar where they came, beside each other where that is at the same time. */
static void draw_marks(const drawing *d, int32_t robot)
{
    double free_from = 0;
    for (int32_t i = 0; i < d->record->signal_count; i++) {
        const team_signal *one = &d->record->signals[i];
        if (one->robot != robot) {
            continue;
        }
        const double x = x_of(d, one->at_ms), y = y_of(robot) - BAR / 2.0;
        const double at = fmin(fmax(x, free_from), WIDTH - TEAM_MARK);
        const canvas_point middle = {at, y - TEAM_MARK - 5};
        if (at > x + ASIDE_MAX) { /* too many: a stroke for each */
            smooth_stroke(&d->picture, (canvas_point){x, y - 6}, (canvas_point){x, y}, 1.5,
                          team_mark_color(one->signal.kind));
            continue;
        }
        smooth_stroke(&d->picture, middle, (canvas_point){x, y}, 1.5, team_mark_color(one->signal.kind));
        team_mark_draw(&d->picture, one->signal.kind, middle);
        free_from = at + 2 * TEAM_MARK + 3;
    }
}

static canvas_point legend_at(const drawing *d, int index)
{
    return (canvas_point){LEFT + index % LEGEND_COLUMNS * ((WIDTH - LEFT - RIGHT) / (double)LEGEND_COLUMNS),
                          TOP + ROW * (double)d->record->robot_count + AXIS + LEGEND_ROW * 0.5 +
                              index / LEGEND_COLUMNS * (double)LEGEND_ROW};
}

static void draw_shapes(drawing *d)
{
    int index = 0;
    draw_grid(d);
    draw_bars(d);
    draw_messages(d);
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        draw_marks(d, i);
    }
    for (int kind = 0; kind < BORG_SIGNAL_KINDS; kind++) {
        if (d->is_there[kind]) {
            team_mark_draw(&d->picture, kind, legend_at(d, index++));
        }
    }
}

/* --- words --- */

static void draw_states(const drawing *d)
{
    for (int32_t i = 0; i < d->record->change_count; i++) {
        const team_change *change = &d->record->changes[i];
        const double left = x_of(d, change->at_ms), room = x_of(d, until(d->record, i)) - left;
        const double length = CELL * (double)strlen(change->state);
        if (length + 8 <= room) {
            iris_draw_text(d->image, (int32_t)left + 6, (int32_t)y_of(change->robot) - 7, change->state, TEXT,
                           ink);
        }
    }
}

static void draw_words(const drawing *d)
{
    char text[160];
    int index = 0;
    const int32_t bottom = TOP + ROW * d->record->robot_count;
    snprintf(text, sizeof text, "%.60s: signals and what robots do", d->record->title);
    iris_draw_text(d->image, LEFT, 14, text, TEXT, ink);
    draw_states(d);
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        team_robot_name(text, &d->record->robots[i]);
        iris_draw_text(d->image, LEFT - 10 - CELL * (int32_t)strlen(text), (int32_t)y_of(i) - 7, text, TEXT,
                       team_color(i));
    }
    for (int i = 0; i * d->step_s <= d->record->time_ms / 1000.0; i++) {
        snprintf(text, sizeof text, "%.0f%s", i * d->step_s, i == 0 ? " s" : "");
        const int32_t x = (int32_t)x_of(d, (uint32_t)(i * d->step_s * 1000));
        iris_draw_text(d->image, x - CELL * (int32_t)strlen(text) / 2, bottom + 12, text, TEXT, ink);
    }
    for (int kind = 0; kind < BORG_SIGNAL_KINDS; kind++) {
        if (d->is_there[kind]) {
            const canvas_point at = legend_at(d, index++);
            iris_draw_text(d->image, (int32_t)at.x + 18, (int32_t)at.y - 7, team_mark_text(kind), TEXT, ink);
        }
    }
}

static int write_picture(const char *path, const team_record *record)
{
    drawing d = {.record = record, .step_s = grid_step(record->time_ms / 1000.0)};
    const int kinds = kinds_there(&d), legend = (kinds + LEGEND_COLUMNS - 1) / LEGEND_COLUMNS;
    d.height = TOP + ROW * record->robot_count + AXIS + LEGEND_ROW * legend + 10;
    const iris_status status = smooth_begin(&d.picture, (iris_size){WIDTH, d.height}, paper);
    int good = status == IRIS_OK;
    if (good) {
        draw_shapes(&d);
        d.image = smooth_end(&d.picture);
        draw_words(&d);
        good = picture_write(path, d.image);
    } else {
        complain(path, "%s", picture_problem(status, (iris_size){WIDTH, d.height}));
    }
    smooth_free(&d.picture);
    return good;
}

/* --- texts --- */

/* Its target is where a signal says where something is. */
static int has_target(const borg_signal *signal)
{
    return signal->kind == BORG_OBJ_DETECT_TRUE || signal->kind == BORG_REACHED;
}

void team_signals_json(json_writer *json, const team_record *record)
{
    json_open(json, '[');
    for (int32_t i = 0; i < record->signal_count; i++) {
        const team_signal *one = &record->signals[i];
        const team_robot *robot = &record->robots[one->robot];
        json_open(json, '{');
        json_key(json, "at_s");
        json_number(json, one->at_ms / 1000.0, 3);
        const struct {
            const char *key;
            int32_t value;
        } numbers[] = {{"unit", robot->unit},           {"ref", robot->ref},     {"from", one->signal.ref},
                       {"from_unit", one->signal.unit}, {"x_mm", one->signal.x}, {"y_mm", one->signal.y}};
        for (int k = 0; k < (has_target(&one->signal) ? 6 : 4); k++) {
            json_key(json, numbers[k].key);
            json_integer(json, numbers[k].value);
        }
        json_key(json, "signal");
        json_string(json, borg_signal_name(one->signal.kind));
        json_close(json, '}');
    }
    json_close(json, ']');
}

static int write_text(FILE *file, const void *user)
{
    const team_record *record = user;
    char name[32];
    for (int32_t i = 0; i < record->signal_count; i++) {
        const team_signal *one = &record->signals[i];
        team_robot_name(name, &record->robots[one->robot]);
        fprintf(file, "%8.3f s  %-8s %s", one->at_ms / 1000.0, name, borg_signal_name(one->signal.kind));
        if (one->signal.ref != 0) {
            fprintf(file, " from %d/%d", one->signal.ref, one->signal.unit);
        }
        if (has_target(&one->signal)) {
            fprintf(file, " at (%d, %d) mm", (int)one->signal.x, (int)one->signal.y);
        }
        fputc('\n', file);
    }
    return fflush(file) == 0 && !ferror(file);
}

static int write_json(FILE *file, const void *user)
{
    json_writer json = json_to(file);
    team_signals_json(&json, user);
    return fflush(file) == 0 && !ferror(file);
}

int team_timeline_write(const char *path, const team_record *record)
{
    const char *dot = strrchr(path, '.');
    const picture_container container = dot ? picture_container_of(path) : CONTAINER_UNKNOWN;
    if (container != CONTAINER_UNKNOWN) {
        return write_picture(path, record);
    }
    return file_write(path, dot && strcmp(dot, ".json") == 0 ? write_json : write_text, record);
}
