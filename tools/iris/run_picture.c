#include "run_picture.h"

#include <math.h>

#include "canvas.h"
#include "complain.h"
#include "picture_write.h"

enum { LONG_SIDE = 900, AROUND_MM = 300, EVERY = 5 };

typedef struct {
    iris_image image;
    double left, top, scale; /* mm at the first pixel, and pixels for a mm */
} view;

static void take_in(double box[4], double x, double y)
{
    box[0] = fmin(box[0], x - AROUND_MM);
    box[1] = fmin(box[1], y - AROUND_MM);
    box[2] = fmax(box[2], x + AROUND_MM);
    box[3] = fmax(box[3], y + AROUND_MM);
}

static void box_of(double box[4], const run_session *s)
{
    const osiris_world *w = &s->body.world;
    box[0] = box[1] = 1e9;
    box[2] = box[3] = -1e9;
    for (int32_t i = 0; i < w->wall_count + w->line_count; i++) {
        const osiris_segment *segment = i < w->wall_count ? &w->walls[i] : &w->lines[i - w->wall_count];
        take_in(box, segment->x0_mm, segment->y0_mm);
        take_in(box, segment->x1_mm, segment->y1_mm);
    }
    for (int32_t i = 0; i < w->object_count; i++) {
        take_in(box, w->objects[i].x_mm, w->objects[i].y_mm);
    }
    for (int32_t i = 0; i < s->path_count; i++) {
        take_in(box, s->path[i].x_mm, s->path[i].y_mm);
    }
}

static canvas_point at(const view *v, double x_mm, double y_mm)
{
    return (canvas_point){(x_mm - v->left) * v->scale, (v->top - y_mm) * v->scale};
}

static void stroke(const view *v, canvas_point from, canvas_point to, int32_t reach, iris_color color)
{
    const int32_t ends[4] = {(int32_t)lround(from.x), (int32_t)lround(from.y), (int32_t)lround(to.x),
                             (int32_t)lround(to.y)};
    canvas_thick(&v->image, ends, reach, color);
}

/* What is known to be free, and occupied. */
static void draw_map(const view *v, const run_session *s)
{
    const iris_color free_color = {255, 255, 255}, occupied = {90, 90, 100}, unknown = {216, 216, 210};
    for (int32_t y = 0; y < v->image.h; y++) {
        for (int32_t x = 0; x < v->image.w; x++) {
            const int32_t odds =
                iris_grid_at(&s->behaviors.floor.grid, (int32_t)floor(v->left + x / v->scale),
                             (int32_t)floor(v->top - y / v->scale));
            const iris_color c = !s->behaviors.is_mapping || odds < 0 ? free_color
                                 : odds >= IRIS_ODDS_OCCUPIED         ? occupied
                                                                      : unknown;
            uint8_t *pixel = (uint8_t *)v->image.data + y * v->image.stride + 3 * (ptrdiff_t)x;
            pixel[0] = c.r;
            pixel[1] = c.g;
            pixel[2] = c.b;
        }
    }
}

static void draw_world(const view *v, const osiris_world *w)
{
    const iris_color wall = {30, 30, 30}, line = {120, 150, 190};
    for (int32_t i = 0; i < w->wall_count + w->line_count; i++) {
        const int is_wall = i < w->wall_count;
        const osiris_segment *segment = is_wall ? &w->walls[i] : &w->lines[i - w->wall_count];
        stroke(v, at(v, segment->x0_mm, segment->y0_mm), at(v, segment->x1_mm, segment->y1_mm),
               is_wall ? 2 : 3, is_wall ? wall : line);
    }
    for (int32_t i = 0; i < w->object_count; i++) {
        const osiris_object *o = &w->objects[i];
        const iris_color color = {(uint8_t)(o->color >> 16), (uint8_t)(o->color >> 8), (uint8_t)o->color};
        const canvas_point middle = at(v, o->x_mm, o->y_mm);
        const int32_t reach = (int32_t)lround(fmax(o->radius_mm * v->scale, 3));
        for (int32_t y = -reach; y <= reach; y++) {
            const double half = sqrt((double)reach * reach - (double)y * y);
            stroke(v, (canvas_point){middle.x - half, middle.y + y},
                   (canvas_point){middle.x + half, middle.y + y}, 0, color);
        }
    }
}

static void draw_path(const view *v, const run_session *s)
{
    const iris_color begin = {0, 140, 60}, end = {200, 30, 30}, path = {220, 100, 20};
    const canvas c = canvas_plain(&v->image);
    for (int32_t i = EVERY; i < s->path_count; i += EVERY) {
        stroke(v, at(v, s->path[i - EVERY].x_mm, s->path[i - EVERY].y_mm),
               at(v, s->path[i].x_mm, s->path[i].y_mm), 1, path);
    }
    if (s->path_count > 0) {
        const osiris_pose last = s->path[s->path_count - 1];
        const double angle = last.heading * 3.14159265358979323846 / 32768;
        const double front = robot_front_mm(&s->senses);
        canvas_circle(&c, at(v, s->path[0].x_mm, s->path[0].y_mm), 6, begin);
        canvas_circle(&c, at(v, last.x_mm, last.y_mm), 6, end);
        stroke(v, at(v, last.x_mm, last.y_mm),
               at(v, last.x_mm + front * cos(angle), last.y_mm + front * sin(angle)), 1, end);
    }
}

int run_picture_write(const char *path, const run_session *s)
{
    double box[4];
    picture_buffer picture = {.memory = NULL};
    box_of(box, s);
    const double across = box[2] - box[0], up = box[3] - box[1];
    view v = {.left = box[0], .top = box[3], .scale = LONG_SIDE / fmax(across, up)};
    const iris_size size = {(int32_t)ceil(across * v.scale) + 1, (int32_t)ceil(up * v.scale) + 1};
    const iris_status status = picture_reserve(&picture, size, IRIS_RGB888);
    if (status != IRIS_OK) {
        complain(path, "%s", picture_problem(status, size));
        return 0;
    }
    v.image = picture.image;
    draw_map(&v, s);
    draw_world(&v, &s->body.world);
    draw_path(&v, s);
    const int done = picture_write(path, &picture.image);
    picture_free(&picture);
    return done;
}
