#include "iris/osiris/world.h"

#include "rounded.h"

/* Differences of places: below 2^22; cross and scalar products of two below 2^45. */
typedef struct {
    int64_t x, y;
} arrow;

static arrow between(int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    arrow a = {(int64_t)x1 - x0, (int64_t)y1 - y0};
    return a;
}

static int64_t cross(arrow a, arrow b)
{
    return a.x * b.y - a.y * b.x;
}

static int64_t dot(arrow a, arrow b)
{
    return a.x * b.x + a.y * b.y;
}

static int is_place(int32_t mm)
{
    return mm > -OSIRIS_PLACE_MAX_MM && mm < OSIRIS_PLACE_MAX_MM;
}

static int are_segments(const osiris_segment *s, int32_t count)
{
    int good = count >= 0 && (s || count == 0);
    for (int32_t i = 0; good && i < count; i++) {
        good = is_place(s[i].x0_mm) && is_place(s[i].y0_mm) && is_place(s[i].x1_mm) && is_place(s[i].y1_mm);
    }
    return good;
}

iris_status osiris_world_check(const osiris_world *world)
{
    if (!world || !are_segments(world->walls, world->wall_count) ||
        !are_segments(world->lines, world->line_count) || world->object_count < 0 || world->start_count < 0 ||
        (!world->objects && world->object_count > 0) || (!world->starts && world->start_count > 0)) {
        return IRIS_ERR_ARG;
    }
    int good = 1;
    for (int32_t i = 0; i < world->object_count; i++) {
        const osiris_object *o = &world->objects[i];
        good = good && is_place(o->x_mm) && is_place(o->y_mm) && o->radius_mm >= 1 && o->radius_mm <= 10000;
    }
    for (int32_t i = 0; i < world->start_count; i++) {
        good = good && is_place(world->starts[i].x_mm) && is_place(world->starts[i].y_mm);
    }
    return good ? IRIS_OK : IRIS_ERR_ARG;
}

/* Within the range that the products above are for. */
static osiris_pose near_world(osiris_pose pose)
{
    pose.x_mm = osiris_within(pose.x_mm, -OSIRIS_PLACE_MAX_MM, OSIRIS_PLACE_MAX_MM);
    pose.y_mm = osiris_within(pose.y_mm, -OSIRIS_PLACE_MAX_MM, OSIRIS_PLACE_MAX_MM);
    return pose;
}

/* Where along `way`, which begins at (x, y), it crosses a segment: 0 to `length`, or -1. */
static int64_t crossing(int32_t x, int32_t y, arrow way, const osiris_segment *s, int64_t length)
{
    const arrow along = between(s->x0_mm, s->y0_mm, s->x1_mm, s->y1_mm);
    const arrow to = between(x, y, s->x0_mm, s->y0_mm);
    int64_t whole = cross(way, along), part = cross(to, along), on_it = cross(to, way);
    if (whole < 0) {
        whole = -whole;
        part = -part;
        on_it = -on_it;
    }
    if (whole == 0 || part < 0 || part > whole || on_it < 0 || on_it > whole) {
        return -1;
    }
    return osiris_quotient(part * length, whole); /* part is below 2^42, length at most 2^20 */
}

/* Where a ray of unit direction (30 fraction bits) meets a disc: mm, or -1. */
static int64_t meets(arrow to, arrow unit_q30, int64_t radius)
{
    const int64_t along_q4 = iris_round_shift(to.x * unit_q30.x + to.y * unit_q30.y, 26);
    const int64_t aside_q4 = iris_round_shift(to.x * unit_q30.y - to.y * unit_q30.x, 26);
    const int64_t radius_q4 = radius * 16, rest = radius_q4 * radius_q4 - aside_q4 * aside_q4;
    if (dot(to, to) <= radius * radius) {
        return 0;
    }
    if (rest < 0 || along_q4 < 0) {
        return -1;
    }
    return iris_round_shift(along_q4 - iris_sqrt_u64((uint64_t)rest), 4);
}

int32_t osiris_world_range(const osiris_world *world, osiris_pose from, int32_t most_mm)
{
    from = near_world(from);
    const arrow unit = {iris_cos_q30(from.heading), iris_sin_q30(from.heading)};
    /* The ray is made long enough for its end, a whole millimeter, to lie in its direction well. */
    const int64_t most = osiris_within(most_mm, 0, OSIRIS_PLACE_MAX_MM);
    const int64_t reach = most > 131072 ? most : 131072;
    int64_t nearest = most + 1;
    const arrow way = {iris_round_shift(unit.x * reach, 30), iris_round_shift(unit.y * reach, 30)};
    for (int32_t i = 0; i < world->wall_count; i++) {
        const int64_t at = crossing(from.x_mm, from.y_mm, way, &world->walls[i], reach);
        nearest = at >= 0 && at < nearest ? at : nearest;
    }
    for (int32_t i = 0; i < world->object_count; i++) {
        const osiris_object *o = &world->objects[i];
        const int64_t at = meets(between(from.x_mm, from.y_mm, o->x_mm, o->y_mm), unit, o->radius_mm);
        nearest = at >= 0 && at < nearest ? at : nearest;
    }
    return nearest <= most ? (int32_t)nearest : -1;
}

int osiris_world_is_hidden(const osiris_world *world, osiris_pose from, osiris_pose to)
{
    from = near_world(from);
    to = near_world(to);
    const arrow way = between(from.x_mm, from.y_mm, to.x_mm, to.y_mm);
    for (int32_t i = 0; i < world->wall_count; i++) {
        if (crossing(from.x_mm, from.y_mm, way, &world->walls[i], 0) >= 0) {
            return 1;
        }
    }
    return 0;
}

/* The way from a place to the nearest point of a segment. */
static arrow way_to_segment(int32_t x, int32_t y, const osiris_segment *s)
{
    const arrow along = between(s->x0_mm, s->y0_mm, s->x1_mm, s->y1_mm);
    const arrow to = between(s->x0_mm, s->y0_mm, x, y);
    const int64_t whole = dot(along, along);
    int64_t part = dot(to, along);
    part = part < 0 ? 0 : part > whole ? whole : part;
    arrow way = {-to.x, -to.y};
    if (whole > 0) {
        int64_t share_q17 = part, of = whole; /* part * 2^17 is below 2^62 */
        share_q17 = osiris_quotient(share_q17 * 131072, of);
        way.x += iris_round_shift(along.x * share_q17, 17);
        way.y += iris_round_shift(along.y * share_q17, 17);
    }
    return way;
}

int osiris_world_touches(const osiris_world *world, iris_angle *toward, osiris_pose middle, int32_t radius_mm)
{
    middle = near_world(middle);
    int64_t nearest = (int64_t)radius_mm * radius_mm + 1;
    arrow way = {0, 0};
    int touches = 0;
    for (int32_t i = 0; i < world->wall_count; i++) {
        const arrow to = way_to_segment(middle.x_mm, middle.y_mm, &world->walls[i]);
        if (dot(to, to) < nearest) {
            nearest = dot(to, to);
            way = to;
            touches = 1;
        }
    }
    for (int32_t i = 0; i < world->object_count; i++) {
        const osiris_object *o = &world->objects[i];
        const arrow to = between(middle.x_mm, middle.y_mm, o->x_mm, o->y_mm);
        const int64_t least = (int64_t)radius_mm + o->radius_mm;
        if (!touches && dot(to, to) <= least * least) {
            way = to;
            touches = 1;
        }
    }
    if (touches) {
        *toward = iris_atan2_angle((int32_t)way.y, (int32_t)way.x);
    }
    return touches;
}

int osiris_world_line(const osiris_world *world, int32_t *offset_mm, iris_angle *angle, osiris_pose at,
                      int32_t half_mm)
{
    at = near_world(at);
    half_mm = osiris_within(half_mm, 0, OSIRIS_LINE_REACH_MAX_MM);
    const osiris_pose to_left = {0, half_mm, 0}, to_right = {0, -half_mm, 0};
    const osiris_pose left = osiris_pose_after(at, to_left), right = osiris_pose_after(at, to_right);
    const arrow way = between(left.x_mm, left.y_mm, right.x_mm, right.y_mm);
    int found = 0;
    for (int32_t i = 0; i < world->line_count; i++) {
        const osiris_segment *s = &world->lines[i];
        const int64_t where = crossing(left.x_mm, left.y_mm, way, s, 2 * (int64_t)half_mm);
        const int32_t offset = (int32_t)(where - half_mm);
        if (where >= 0 && (!found || osiris_size_of(offset) < osiris_size_of(*offset_mm))) {
            const iris_angle along = iris_atan2_angle(s->y1_mm - s->y0_mm, s->x1_mm - s->x0_mm);
            int32_t lean = iris_angle_wrap(at.heading - along);
            lean = lean > 16384 ? lean - 32768 : lean < -16384 ? lean + 32768 : lean;
            *offset_mm = offset;
            *angle = (iris_angle)lean;
            found = 1;
        }
    }
    return found;
}
