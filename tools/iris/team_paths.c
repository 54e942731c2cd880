#include "team_paths.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "complain.h"
#include "picture_write.h"
#include "team_marks.h"

/* Pixels. */
enum {
    WIDTH = 960,
    LEFT = 64,
    RIGHT = 20,
    TOP = 44,
    BELOW = 50,
    PLAN_H_MAX = 900,
    LEGEND_ROW = 28,
    LEGEND_COLUMNS = 2,
    MARK = 9,
    NOSE = 24,
    TEXT = 2,
    CELL = IRIS_TEXT_CELL_W * TEXT
};

#define AROUND_MM  200 /* of the world, on each side */
#define DOT_EVERY  5   /* seconds */
#define PATH_WIDTH 3.5
#define LINE_WIDTH 9
#define WALL_WIDTH 6

static const iris_color paper = {255, 255, 255}, ground = {250, 248, 242}, ink = {40, 40, 40},
                        grid = {226, 224, 216}, wall_color = {110, 104, 96}, line_color = {190, 186, 178};

typedef struct {
    const team_record *record;
    const osiris_world *world;
    smooth_picture picture;
    const iris_image *image;
    double left, bottom, right, top; /* of what is shown, in mm */
    double scale;                    /* pixels for a mm */
    int32_t plan_h, height;
    double step;                     /* of the grid, in mm */
    int is_there[BORG_SIGNAL_KINDS]; /* marks */
} drawing;

/* --- layout --- */

static void take_in(drawing *d, team_place place, double around)
{
    d->left = fmin(d->left, place.x - around);
    d->right = fmax(d->right, place.x + around);
    d->bottom = fmin(d->bottom, place.y - around);
    d->top = fmax(d->top, place.y + around);
}

static void lay_out(drawing *d)
{
    const osiris_world *w = d->world;
    d->left = d->bottom = 1e9;
    d->right = d->top = -1e9;
    for (int32_t i = 0; i < w->wall_count + w->line_count; i++) {
        const osiris_segment *s = i < w->wall_count ? &w->walls[i] : &w->lines[i - w->wall_count];
        take_in(d, (team_place){s->x0_mm, s->y0_mm}, AROUND_MM);
        take_in(d, (team_place){s->x1_mm, s->y1_mm}, AROUND_MM);
    }
    for (int32_t i = 0; i < w->object_count; i++) {
        const osiris_object *o = &w->objects[i];
        take_in(d, (team_place){o->x_mm, o->y_mm}, o->radius_mm + AROUND_MM);
    }
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        const team_robot *robot = &d->record->robots[i];
        for (int32_t k = 0; k < robot->path_count; k++) {
            take_in(d, robot->path[k], AROUND_MM);
        }
    }
    const double across = d->right - d->left, up = d->top - d->bottom;
    d->scale = fmin((WIDTH - LEFT - RIGHT) / across, PLAN_H_MAX / up);
    d->plan_h = (int32_t)ceil(up * d->scale);
    for (d->step = 100; d->step * d->scale < 60;) {
        d->step *= d->step * d->scale < 30 && fmod(log10(d->step) + 1e-9, 1) < 1e-6 ? 5 : 2;
    }
}

static canvas_point at(const drawing *d, team_place place)
{
    return (canvas_point){LEFT + (place.x - d->left) * d->scale,
                          TOP + d->plan_h - (place.y - d->bottom) * d->scale};
}

/* --- shapes --- */

static void fill(const drawing *d, canvas_point a, canvas_point b, iris_color color)
{
    const canvas_point corners[4] = {a, {b.x, a.y}, b, {a.x, b.y}};
    smooth_polygon(&d->picture, corners, 4, color);
}

static void draw_ground(const drawing *d)
{
    const double right = LEFT + (d->right - d->left) * d->scale, bottom = TOP + d->plan_h;
    fill(d, (canvas_point){LEFT, TOP}, (canvas_point){right, bottom}, ground);
    for (double x = ceil(d->left / d->step) * d->step; x <= d->right; x += d->step) {
        const double u = LEFT + (x - d->left) * d->scale;
        smooth_stroke(&d->picture, (canvas_point){u, TOP}, (canvas_point){u, bottom + 6}, 1, grid);
    }
    for (double y = ceil(d->bottom / d->step) * d->step; y <= d->top; y += d->step) {
        const double v = bottom - (y - d->bottom) * d->scale;
        smooth_stroke(&d->picture, (canvas_point){LEFT - 6, v}, (canvas_point){right, v}, 1, grid);
    }
}

static void draw_segments(const drawing *d, const osiris_segment *segments, int32_t count, double width,
                          iris_color color)
{
    for (int32_t i = 0; i < count; i++) {
        const osiris_segment *s = &segments[i];
        smooth_stroke(&d->picture, at(d, (team_place){s->x0_mm, s->y0_mm}),
                      at(d, (team_place){s->x1_mm, s->y1_mm}), width, color);
    }
}

static void draw_objects(const drawing *d)
{
    for (int32_t i = 0; i < d->world->object_count; i++) {
        const osiris_object *o = &d->world->objects[i];
        const canvas_point middle = at(d, (team_place){o->x_mm, o->y_mm});
        const double radius = fmax(o->radius_mm * d->scale, 7);
        smooth_disc(&d->picture, middle, radius + 1.5, ink);
        smooth_disc(&d->picture, middle, radius,
                    (iris_color){(uint8_t)(o->color >> 16), (uint8_t)(o->color >> 8), (uint8_t)o->color});
    }
}

/* A dot for every few seconds shows how fast it was. */
static void draw_path(const drawing *d, int32_t robot)
{
    const team_robot *r = &d->record->robots[robot];
    const int32_t every = DOT_EVERY * 1000 / (int32_t)d->record->step_ms;
    for (int32_t k = 1; k < r->path_count; k++) {
        smooth_stroke(&d->picture, at(d, r->path[k - 1]), at(d, r->path[k]), PATH_WIDTH, team_color(robot));
    }
    for (int32_t k = every; k < r->path_count; k += every) {
        smooth_disc(&d->picture, at(d, r->path[k]), PATH_WIDTH, team_color(robot));
    }
}

/* The start is a ring; the end a disc with a nose that shows where the robot looks. */
static void draw_start(const drawing *d, int32_t robot)
{
    const canvas_point start = at(d, d->record->robots[robot].path[0]);
    smooth_disc(&d->picture, start, MARK + 2, paper);
    smooth_disc(&d->picture, start, MARK, team_color(robot));
    smooth_disc(&d->picture, start, MARK - 3, paper);
}

static void draw_end(const drawing *d, int32_t robot)
{
    const team_robot *r = &d->record->robots[robot];
    const canvas_point end = at(d, r->path[r->path_count - 1]);
    const double angle = r->heading_deg * 3.14159265358979323846 / 180;
    const canvas_point ahead = {cos(angle), -sin(angle)}, aside = {sin(angle), cos(angle)};
    for (int pass = 0; pass < 2; pass++) {
        const double more = pass == 0 ? 2 : 0, side = MARK * 0.9 + more, nose = NOSE + 1.5 * more;
        const canvas_point points[3] = {{end.x + ahead.x * nose, end.y + ahead.y * nose},
                                        {end.x + aside.x * side, end.y + aside.y * side},
                                        {end.x - aside.x * side, end.y - aside.y * side}};
        smooth_polygon(&d->picture, points, 3, pass == 0 ? paper : team_color(robot));
        smooth_disc(&d->picture, end, MARK + more, pass == 0 ? paper : team_color(robot));
    }
}

/* Where a robot was when it saw the object, with what it saw, and where it was when it was chosen. */
static int is_marked(const team_signal *one)
{
    return (one->signal.kind == BORG_OBJ_DETECT_TRUE && one->signal.ref == 0) ||
           one->signal.kind == BORG_VOTE_WIN;
}

static canvas_point place_at(const drawing *d, const team_signal *one)
{
    const team_robot *robot = &d->record->robots[one->robot];
    const int32_t k = (int32_t)(one->at_ms / d->record->step_ms);
    return at(d, robot->path[k < robot->path_count ? k : robot->path_count - 1]);
}

static void draw_sights(const drawing *d)
{
    for (int32_t i = 0; i < d->record->signal_count; i++) {
        const team_signal *one = &d->record->signals[i];
        if (is_marked(one) && one->signal.kind == BORG_OBJ_DETECT_TRUE) {
            const canvas_point from = place_at(d, one),
                               to = at(d, (team_place){one->signal.x, one->signal.y});
            const int dashes = 1 + (int)(hypot(to.x - from.x, to.y - from.y) / 12);
            for (int k = 0; k < dashes; k++) {
                const double a = (double)k / dashes, b = (k + 0.5) / dashes;
                smooth_stroke(&d->picture,
                              (canvas_point){from.x + a * (to.x - from.x), from.y + a * (to.y - from.y)},
                              (canvas_point){from.x + b * (to.x - from.x), from.y + b * (to.y - from.y)}, 2,
                              team_mark_color(one->signal.kind));
            }
        }
    }
}

static void draw_marks(drawing *d)
{
    for (int32_t i = 0; i < d->record->signal_count; i++) {
        const team_signal *one = &d->record->signals[i];
        if (is_marked(one)) {
            team_mark_draw(&d->picture, one->signal.kind, place_at(d, one));
            d->is_there[one->signal.kind] = 1;
        }
    }
}

static canvas_point legend_at(const drawing *d, int32_t index)
{
    return (canvas_point){LEFT + index % LEGEND_COLUMNS * ((WIDTH - LEFT - RIGHT) / (double)LEGEND_COLUMNS),
                          TOP + d->plan_h + BELOW + index / LEGEND_COLUMNS * (double)LEGEND_ROW};
}

static void draw_shapes(drawing *d)
{
    int32_t entry = d->record->robot_count;
    draw_ground(d);
    draw_segments(d, d->world->lines, d->world->line_count, LINE_WIDTH, line_color);
    draw_segments(d, d->world->walls, d->world->wall_count, WALL_WIDTH, wall_color);
    draw_sights(d);
    draw_objects(d);
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        draw_path(d, i);
        smooth_stroke(&d->picture, legend_at(d, i), (canvas_point){legend_at(d, i).x + 30, legend_at(d, i).y},
                      2 * PATH_WIDTH, team_color(i));
    }
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        draw_start(d, i);
    }
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        draw_end(d, i);
    }
    draw_marks(d);
    for (int kind = 0; kind < BORG_SIGNAL_KINDS; kind++) {
        if (d->is_there[kind]) {
            team_mark_draw(&d->picture, kind,
                           (canvas_point){legend_at(d, entry).x + 15, legend_at(d, entry).y});
            entry++;
        }
    }
}

/* --- words --- */

/* With a light outline, so that it can be read on anything. */
static void put(const drawing *d, double x, double y, const char *text, iris_color color)
{
    for (int k = 0; k < 9; k++) {
        iris_draw_text(d->image, (int32_t)x + 2 * (k % 3 - 1), (int32_t)y + 2 * (k / 3 - 1), text, TEXT,
                       paper);
    }
    iris_draw_text(d->image, (int32_t)x, (int32_t)y, text, TEXT, color);
}

static void draw_numbers(const drawing *d)
{
    char text[32];
    for (double x = ceil(d->left / d->step) * d->step; x <= d->right; x += d->step) {
        snprintf(text, sizeof text, "%g%s", x / 1000 + 0.0, x == 0 ? " m" : "");
        put(d, LEFT + (x - d->left) * d->scale - CELL * (double)strlen(text) / 2, TOP + d->plan_h + 12, text,
            ink);
    }
    for (double y = ceil(d->bottom / d->step) * d->step; y <= d->top; y += d->step) {
        snprintf(text, sizeof text, "%g", y / 1000 + 0.0);
        put(d, LEFT - 10 - CELL * (double)strlen(text), TOP + d->plan_h - (y - d->bottom) * d->scale - 7,
            text, ink);
    }
}

static double length_of(const team_robot *robot)
{
    double length = 0;
    for (int32_t k = 1; k < robot->path_count; k++) {
        length += hypot(robot->path[k].x - robot->path[k - 1].x, robot->path[k].y - robot->path[k - 1].y);
    }
    return length;
}

/* --- names beside what they name --- */

#define TAKEN_MAX 512
#define LETTER_H  (7 * TEXT)

/* Boxes that no further name is to cover; when there are too many, the last ones are not kept. */
typedef struct {
    double box[TAKEN_MAX][4]; /* left, top, right, bottom */
    int count;
} taken_places;

static void take_place(taken_places *taken, double left, double top, double w, double h)
{
    if (taken->count < TAKEN_MAX) {
        double *box = taken->box[taken->count++];
        box[0] = left, box[1] = top, box[2] = left + w, box[3] = top + h;
    }
}

static int is_free(const taken_places *taken, double left, double top, double w, double h)
{
    int is = 1;
    for (int i = 0; i < taken->count; i++) {
        const double *box = taken->box[i];
        is &= left >= box[2] || left + w <= box[0] || top >= box[3] || top + h <= box[1];
    }
    return is;
}

/* Around a disc, where nothing else is; right of it and below where all is taken. */
static void put_name(const drawing *d, taken_places *taken, canvas_point middle, double radius,
                     const char *name, iris_color color)
{
    const double w = CELL * (double)strlen(name), h = LETTER_H;
    const double places[8][2] = {{radius, radius - 4},      {-radius - w, radius - 4},
                                 {radius, -radius - h + 4}, {-radius - w, -radius - h + 4},
                                 {-w / 2, -radius - h - 2}, {-w / 2, radius + 2},
                                 {2 * radius, -h / 2},      {-2 * radius - w, -h / 2}};
    int k = 0;
    while (k < 8 && !is_free(taken, middle.x + places[k][0], middle.y + places[k][1], w, h)) {
        k++;
    }
    k %= 8;
    put(d, middle.x + places[k][0], middle.y + places[k][1], name, color);
    take_place(taken, middle.x + places[k][0], middle.y + places[k][1], w, h);
}

static void put_names(const drawing *d)
{
    taken_places taken = {.count = 0};
    char name[32];
    for (int32_t i = 0; i < d->world->object_count; i++) {
        const osiris_object *o = &d->world->objects[i];
        const canvas_point middle = at(d, (team_place){o->x_mm, o->y_mm});
        const double radius = fmax(o->radius_mm * d->scale, 7);
        take_place(&taken, middle.x - radius, middle.y - radius, 2 * radius, 2 * radius);
    }
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        const team_robot *robot = &d->record->robots[i];
        const canvas_point end = at(d, robot->path[robot->path_count - 1]);
        take_place(&taken, end.x - MARK, end.y - MARK, 2 * MARK, 2 * MARK);
    }
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        const team_robot *robot = &d->record->robots[i];
        team_robot_name(name, robot);
        put_name(d, &taken, at(d, robot->path[robot->path_count - 1]), MARK + 4, name, team_color(i));
    }
    for (int32_t i = 0; i < d->world->object_count; i++) {
        const osiris_object *o = &d->world->objects[i];
        put_name(d, &taken, at(d, (team_place){o->x_mm, o->y_mm}), fmax(o->radius_mm * d->scale, 7) + 3,
                 "object", ink);
    }
}

static void draw_words(const drawing *d)
{
    char text[160];
    snprintf(text, sizeof text, "%.24s, %.0f s: robots are LINE/UNIT, ring = start, dot = %d s",
             d->record->title, d->record->time_ms / 1000.0, DOT_EVERY);
    put(d, LEFT, 14, text, ink);
    draw_numbers(d);
    put_names(d);
    for (int32_t i = 0; i < d->record->robot_count; i++) {
        const team_robot *robot = &d->record->robots[i];
        const canvas_point legend = legend_at(d, i);
        char name[32];
        team_robot_name(name, robot);
        snprintf(text, sizeof text, "%s %s, %.1f m", name, robot->state, length_of(robot) / 1000);
        put(d, legend.x + 44, legend.y - 7, text, ink);
    }
    for (int kind = 0, entry = d->record->robot_count; kind < BORG_SIGNAL_KINDS; kind++) {
        if (d->is_there[kind]) {
            const canvas_point legend = legend_at(d, entry++);
            put(d, legend.x + 44, legend.y - 7, team_mark_text(kind), ink);
        }
    }
}

static int32_t marked_kinds(const team_record *record)
{
    int is_there[BORG_SIGNAL_KINDS] = {0}, count = 0;
    for (int32_t i = 0; i < record->signal_count; i++) {
        is_there[record->signals[i].signal.kind] |= is_marked(&record->signals[i]);
    }
    for (int kind = 0; kind < BORG_SIGNAL_KINDS; kind++) {
        count += is_there[kind];
    }
    return count;
}

int team_paths_write(const char *path, const team_record *record, const osiris_world *world)
{
    drawing d = {.record = record, .world = world};
    lay_out(&d);
    d.height =
        TOP + d.plan_h + BELOW +
        LEGEND_ROW * ((record->robot_count + marked_kinds(record) + LEGEND_COLUMNS - 1) / LEGEND_COLUMNS);
    const iris_size size = {WIDTH, d.height};
    const iris_status status = smooth_begin(&d.picture, size, paper);
    int good = status == IRIS_OK;
    if (good) {
        draw_shapes(&d);
        d.image = smooth_end(&d.picture);
        draw_words(&d);
        good = picture_write(path, d.image);
    } else {
        complain(path, "%s", picture_problem(status, size));
    }
    smooth_free(&d.picture);
    return good;
}
