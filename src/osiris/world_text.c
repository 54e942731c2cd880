#include "iris/osiris/world_text.h"

#include "attribute.h"

static const osiris_attribute radius = {
    "radius", 0, 1, 10000, OSIRIS_WHOLE, "expected radius in mm, 1 to 10000"};
static const osiris_attribute facing = {
    "facing", 0, -131072, 131072, OSIRIS_DEGREES, "expected facing in degrees"};

static const struct {
    const char *name;
    uint32_t color;
} colors[] = {{"red", 0xFF0000},  {"orange", 0xFF8000}, {"yellow", 0xFFFF00}, {"green", 0x00FF00},
              {"cyan", 0x00FFFF}, {"blue", 0x0000FF},   {"purple", 0x8000FF}, {"white", 0xFFFFFF},
              {"gray", 0x808080}, {"black", 0x000000}};

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                  : -1;
}

static int take_color(uint32_t *color, osiris_reader *r)
{
    char digits[7];
    uint32_t value = 0;
    for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++) {
        if (iris_text_take_word(&r->lines, colors[i].name)) {
            *color = colors[i].color;
            return 1;
        }
    }
    if (!osiris_take_name(digits, sizeof digits, r)) {
        return 0;
    }
    for (int i = 0; i < 6; i++) {
        if (hex_digit(digits[i]) < 0) {
            return 0;
        }
        value = value << 4 | (uint32_t)hex_digit(digits[i]);
    }
    *color = value;
    return 1;
}

static const char too_many[] = "expected fewer of these: there is no room for more";

/* Pieces from place to place, behind those that are there. */
static int take_pieces(osiris_segment *pieces, int32_t *count, int32_t room, osiris_reader *r)
{
    osiris_segment s;
    int32_t taken = 0;
    if (!osiris_take_place(&s.x0_mm, r) || !osiris_take_place(&s.y0_mm, r)) {
        return osiris_expect(r, "expected two places or more: X Y X Y, mm");
    }
    while (taken == 0 || r->lines.at < r->lines.end) {
        if (!osiris_take_place(&s.x1_mm, r) || !osiris_take_place(&s.y1_mm, r)) {
            return osiris_expect(r, "expected two places or more: X Y X Y, mm");
        }
        if (*count >= room) {
            return osiris_expect(r, too_many);
        }
        pieces[(*count)++] = s;
        s.x0_mm = s.x1_mm;
        s.y0_mm = s.y1_mm;
        taken++;
    }
    return 1;
}

static int take_object(osiris_world_memory *memory, osiris_world *world, osiris_reader *r)
{
    osiris_object o = {0, 0, 50, 0xFF0000};
    if (world->object_count >= OSIRIS_OBJECTS_MAX) {
        return osiris_expect(r, too_many);
    }
    if (!osiris_take_place(&o.x_mm, r) || !osiris_take_place(&o.y_mm, r)) {
        return osiris_expect(r, "expected a place: X Y, mm");
    }
    while (r->lines.at < r->lines.end) {
        if (iris_text_take_word(&r->lines, "radius")) {
            if (!osiris_take_attribute(&o.radius_mm, r, &radius)) {
                return 0;
            }
        } else if (!iris_text_take_word(&r->lines, "color") || !take_color(&o.color, r)) {
            return osiris_expect(r, "expected radius MM, or color with a name or RRGGBB");
        }
    }
    memory->objects[world->object_count++] = o;
    return 1;
}

static int take_start(osiris_world_memory *memory, osiris_world *world, osiris_reader *r)
{
    osiris_pose start = {0, 0, 0};
    int32_t heading = 0;
    if (world->start_count >= OSIRIS_STARTS_MAX) {
        return osiris_expect(r, too_many);
    }
    if (!osiris_take_place(&start.x_mm, r) || !osiris_take_place(&start.y_mm, r)) {
        return osiris_expect(r, "expected a place: X Y, mm");
    }
    if (iris_text_take_word(&r->lines, "facing") && !osiris_take_attribute(&heading, r, &facing)) {
        return 0;
    }
    start.heading = iris_angle_wrap(heading);
    memory->starts[world->start_count++] = start;
    return 1;
}

static int take_line(osiris_world_memory *memory, osiris_world *world, osiris_reader *r)
{
    if (iris_text_take_word(&r->lines, "wall")) {
        return take_pieces(memory->walls, &world->wall_count, OSIRIS_WALLS_MAX, r);
    }
    if (iris_text_take_word(&r->lines, "line")) {
        return take_pieces(memory->lines, &world->line_count, OSIRIS_LINES_MAX, r);
    }
    if (iris_text_take_word(&r->lines, "object")) {
        return take_object(memory, world, r);
    }
    if (iris_text_take_word(&r->lines, "start")) {
        return take_start(memory, world, r);
    }
    return osiris_expect(r, "expected wall, line, object, or start");
}

iris_status osiris_world_read_text(osiris_world *world, osiris_world_memory *memory, osiris_problem *problem,
                                   const char *text, size_t bytes)
{
    if (!world || !memory || !problem || !text) {
        return IRIS_ERR_ARG;
    }
    osiris_world made = {memory->walls, memory->lines, memory->objects, memory->starts, 0, 0, 0, 0};
    osiris_reader reader = osiris_reader_of(text, bytes);
    while (iris_text_next_line(&reader.lines)) {
        if (take_line(memory, &made, &reader) && reader.lines.at < reader.lines.end) {
            osiris_expect(&reader, "expected the end of the line");
        }
        if (reader.expected) {
            const osiris_problem found = {reader.lines.line, reader.expected};
            *problem = found;
            return reader.expected == too_many ? IRIS_ERR_FULL : IRIS_ERR_DATA;
        }
    }
    *world = made;
    return IRIS_OK;
}
