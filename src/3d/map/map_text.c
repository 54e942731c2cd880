/* A map's text: see map_text.h for the format. */
#include "iris/3d/map_text.h"

#include <string.h>

#include "../../foundation/text_lines.h"
#include "map_parts.h"

#define MILLION 1000000

/* --- writing --- */

/* value / 10^decimals. */
static char *put_decimal(char *at, int64_t value, int decimals, char behind)
{
    int64_t scale = 1;
    for (int i = 0; i < decimals; i++) {
        scale *= 10;
    }
    if (value < 0) {
        *at++ = '-';
        value = -value;
    }
    at = iris_text_put_number(at, value / scale, '.');
    for (scale /= 10; scale > 0; scale /= 10) {
        *at++ = (char)('0' + value / scale % 10);
    }
    *at++ = behind;
    return at;
}

static iris_q16 from_millionths(int64_t value)
{
    return (iris_q16)((value * IRIS_Q16_ONE + MILLION / 2) / MILLION);
}

/* With three digits where these are read again as they were, else with five. */
static char *put_share(char *at, iris_q16 share)
{
    const int64_t thousandths = iris_round_shift((int64_t)share * 1000, 16);
    if (from_millionths(thousandths * 1000) == share) {
        return put_decimal(at, thousandths, 3, '\n');
    }
    return put_decimal(at, iris_round_shift((int64_t)share * 100000, 16), 5, '\n');
}

static int is_name(const char *name)
{
    size_t length = 0;
    for (; length < IRIS_MAP_IMAGE_BYTES && name[length] != '\0'; length++) {
        const unsigned char c = (unsigned char)name[length];
        if (c < ' ' || c == 127 || c == '#' || c == '"' || c == '\'') {
            return 0;
        }
    }
    return length > 0 && length < IRIS_MAP_IMAGE_BYTES && name[0] != ' ' && name[length - 1] != ' ';
}

static int is_sound(const iris_map_text *map)
{
    const iris_grid_shades *s = &map->shades;
    return iris_grid_is_laid_out((iris_size){1, 1}, map->cell_mm, map->left_mm, map->bottom_mm) &&
           s->free_q16 >= 0 && s->free_q16 <= s->occupied_q16 && s->occupied_q16 <= IRIS_Q16_ONE;
}

iris_status iris_map_write_text(char *text, size_t capacity, size_t *length, const iris_map_text *map)
{
    char made[IRIS_MAP_TEXT_BYTES], *at = made;
    if (!text || !length || !map) {
        return IRIS_ERR_ARG;
    }
    if (!is_name(map->image) || !is_sound(map)) {
        return IRIS_ERR_RANGE;
    }
    at = iris_text_put_word(at, "image: ");
    at = iris_text_put_word(at, map->image);
    at = iris_text_put_word(at, "\nresolution: ");
    at = put_decimal(at, map->cell_mm, 3, '\n');
    at = iris_text_put_word(at, "origin: [");
    at = put_decimal(at, map->left_mm, 3, ',');
    *at++ = ' ';
    at = put_decimal(at, map->bottom_mm, 3, ',');
    at = iris_text_put_word(at, " 0.000]\nnegate: ");
    at = iris_text_put_number(at, map->shades.negate != 0, '\n');
    at = iris_text_put_word(at, "occupied_thresh: ");
    at = put_share(at, map->shades.occupied_q16);
    at = iris_text_put_word(at, "free_thresh: ");
    at = put_share(at, map->shades.free_q16);
    *at++ = '\0';
    const size_t bytes = (size_t)(at - made);
    if (bytes > capacity) {
        return IRIS_ERR_RANGE;
    }
    memcpy(text, made, bytes);
    *length = bytes - 1;
    return IRIS_OK;
}

/* --- reading --- */

enum { IMAGE, RESOLUTION, ORIGIN, NEGATE, OCCUPIED, FREE, MODE, KEYS };

static const char *const keys[KEYS] = {
    "image:", "resolution:", "origin:", "negate:", "occupied_thresh:", "free_thresh:", "mode:"};

/* One character, with blanks behind it. */
static int take_mark(iris_text_lines *r, char mark)
{
    if (r->at >= r->end || *r->at != mark) {
        return 0;
    }
    for (r->at++; r->at < r->end && (*r->at == ' ' || *r->at == '\t' || *r->at == '\r'); r->at++) {
    }
    return 1;
}

/* A decimal number in millionths, rounded to nearest: below 10^9, with `behind` behind it, or at the line's end for 0. */
static int take_decimal(int64_t *millionths, iris_text_lines *r, char behind)
{
    const int negative = take_mark(r, '-');
    int64_t value = 0;
    int digits = 0, places = -1;
    for (; r->at < r->end && ((*r->at >= '0' && *r->at <= '9') || (*r->at == '.' && places < 0)); r->at++) {
        if (*r->at == '.') {
            places = 0;
            continue;
        }
        digits++;
        if (places < 7) { /* one digit more, to round by */
            value = value * 10 + (*r->at - '0');
            places += places >= 0;
        }
        if (places < 0 && value >= 1000000000) {
            return 0;
        }
    }
    for (places = places < 0 ? 0 : places; places < 7; places++) {
        value *= 10;
    }
    value = (value + 5) / 10;
    *millionths = negative ? -value : value;
    if (digits == 0 || value >= (int64_t)1000000000 * MILLION) {
        return 0;
    }
    while (take_mark(r, ' ') || take_mark(r, '\t') || take_mark(r, '\r')) {
    }
    return behind ? take_mark(r, behind) : r->at == r->end;
}

/* The rest of the line, without quotes around it. */
static int take_name(char name[IRIS_MAP_IMAGE_BYTES], iris_text_lines *r)
{
    const char *from = r->at, *to = r->end;
    while (to > from && (to[-1] == ' ' || to[-1] == '\t' || to[-1] == '\r')) {
        to--;
    }
    if (to - from >= 2 && (*from == '"' || *from == '\'') && to[-1] == *from) {
        from++;
        to--;
    }
    if (to - from >= IRIS_MAP_IMAGE_BYTES) {
        return 0;
    }
    memset(name, 0, IRIS_MAP_IMAGE_BYTES);
    memcpy(name, from, (size_t)(to - from));
    return is_name(name);
}

static int take_origin(int64_t origin[3], iris_text_lines *r)
{
    return take_mark(r, '[') && take_decimal(&origin[0], r, ',') && take_decimal(&origin[1], r, ',') &&
           take_decimal(&origin[2], r, ']') && r->at == r->end;
}

static int32_t to_mm(int64_t millionths)
{
    return iris_sat_s32((millionths + (millionths < 0 ? -500 : 500)) / 1000);
}

static iris_status take_share(iris_q16 *share, iris_text_lines *r)
{
    int64_t value;
    if (!take_decimal(&value, r, 0) || value < 0 || value > MILLION) {
        return IRIS_ERR_DATA;
    }
    *share = from_millionths(value);
    return IRIS_OK;
}

static iris_status take_value(iris_map_text *map, int key, iris_text_lines *r)
{
    int64_t value[3];
    switch (key) {
    case IMAGE:
        return take_name(map->image, r) ? IRIS_OK : IRIS_ERR_DATA;
    case RESOLUTION:
        if (!take_decimal(value, r, 0)) {
            return IRIS_ERR_DATA;
        }
        map->cell_mm = to_mm(value[0]);
        value[0] -= (int64_t)map->cell_mm * 1000;
        return value[0] > 1 || value[0] < -1 ? IRIS_ERR_UNSUPPORTED : IRIS_OK;
    case ORIGIN:
        if (!take_origin(value, r)) {
            return IRIS_ERR_DATA;
        }
        map->left_mm = to_mm(value[0]);
        map->bottom_mm = to_mm(value[1]);
        return value[2] > 1 || value[2] < -1 ? IRIS_ERR_UNSUPPORTED : IRIS_OK;
    case NEGATE:
        map->shades.negate = iris_text_take_word(r, "1") || iris_text_take_word(r, "true");
        return map->shades.negate || iris_text_take_word(r, "0") || iris_text_take_word(r, "false")
                   ? IRIS_OK
                   : IRIS_ERR_DATA;
    case OCCUPIED:
        return take_share(&map->shades.occupied_q16, r);
    case FREE:
        return take_share(&map->shades.free_q16, r);
    default:
        return iris_text_take_word(r, "trinary") ? IRIS_OK : IRIS_ERR_UNSUPPORTED;
    }
}

static iris_status read(iris_map_text *map, iris_text_lines *r)
{
    unsigned seen = 0;
    while (iris_text_next_line(r)) {
        int key = 0;
        while (key < KEYS && !iris_text_take_word(r, keys[key])) {
            key++;
        }
        if (key == KEYS) {
            continue;
        }
        const iris_status status = seen >> key & 1u ? IRIS_ERR_DATA : take_value(map, key, r);
        if (status != IRIS_OK) {
            return status;
        }
        seen |= 1u << key;
    }
    const unsigned needed = 1u << IMAGE | 1u << RESOLUTION | 1u << ORIGIN;
    return (seen & needed) != needed ? IRIS_ERR_TRUNCATED : is_sound(map) ? IRIS_OK : IRIS_ERR_DATA;
}

iris_status iris_map_read_text(iris_map_text *map, int32_t *line, const char *text, size_t bytes)
{
    iris_map_text made = {.cell_mm = 0};
    if (!map || !line || (!text && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    if (bytes > 0 && text[bytes - 1] == 0) {
        bytes--;
    }
    iris_grid_shades_defaults(&made.shades);
    iris_text_lines r = {.next = text, .text_end = bytes > 0 ? text + bytes : text};
    const iris_status status = read(&made, &r);
    if (status == IRIS_OK) {
        *map = made;
    } else {
        *line = r.line > 0 ? r.line : 1; /* no text at all */
    }
    return status;
}
