/* A floor as text: see floor.h for the format. */
#include <string.h>

#include "floor_parts.h"

#define LINES 7 /* of a floor's text that count */

static const char hex[] = "0123456789ABCDEF";

/* FNV-1a over the size and the numbers, as bytes of 64-bit numbers, the lowest first. */
static uint32_t check_of(iris_size size, const iris_q32 m[9])
{
    uint32_t sum = 2166136261u;
    for (int i = 0; i < 11; i++) {
        uint64_t value = (uint64_t)(i == 0 ? size.w : i == 1 ? size.h : m[i - 2]);
        for (int k = 0; k < 64; k += 8) {
            sum = (sum ^ (uint32_t)(value >> k & 255)) * 16777619u;
        }
    }
    return sum;
}

static char *put_bytes(char *at, const char *text, size_t bytes)
{
    memcpy(at, text, bytes);
    return at + bytes;
}

static char *put_number(char *at, int64_t value, char behind)
{
    char digits[20];
    int count = 0;
    uint64_t rest = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
    do {
        digits[count++] = (char)('0' + rest % 10);
        rest /= 10;
    } while (rest > 0);
    if (value < 0) {
        *at++ = '-';
    }
    while (count > 0) {
        *at++ = digits[--count];
    }
    *at++ = behind;
    return at;
}

iris_status iris_floor_write_text(char *text, size_t capacity, size_t *length, const iris_floor *floor)
{
    iris_floor good;
    if (!text || !length || !floor) {
        return IRIS_ERR_ARG;
    }
    if (iris_floor_init(&good, floor->size, floor->to_image_q32) != IRIS_OK) {
        return IRIS_ERR_RANGE;
    }
    char made[IRIS_FLOOR_TEXT_BYTES];
    char *at = put_bytes(made, "iris floor 1\nsize ", sizeof "iris floor 1\nsize " - 1);
    at = put_number(at, good.size.w, ' ');
    at = put_number(at, good.size.h, '\n');
    at = put_bytes(at, "image_from_floor_q32\n", sizeof "image_from_floor_q32\n" - 1);
    for (int i = 0; i < 9; i++) {
        at = put_number(at, good.to_image_q32[i], i % 3 == 2 ? '\n' : ' ');
    }
    at = put_bytes(at, "check ", sizeof "check " - 1);
    uint32_t check = check_of(good.size, good.to_image_q32);
    for (int shift = 28; shift >= 0; shift -= 4) {
        *at++ = hex[check >> shift & 15];
    }
    *at++ = '\n';
    *at++ = 0;
    size_t bytes = (size_t)(at - made);
    if (bytes > capacity) {
        return IRIS_ERR_RANGE;
    }
    memcpy(text, made, bytes);
    *length = bytes - 1;
    return IRIS_OK;
}

/* The rest of a line, and of the text behind it. */
typedef struct {
    const char *at, *end; /* of the line */
    const char *next, *text_end;
    int32_t line;
} reader;

static int is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static void skip_spaces(reader *r)
{
    while (r->at < r->end && is_space(*r->at)) {
        r->at++;
    }
}

/* Goes to the next line that has something in it. 0 when there is none. */
static int next_line(reader *r)
{
    while (r->next < r->text_end) {
        int comment = 0;
        r->line += r->line < INT32_MAX;
        r->at = r->end = r->next;
        while (r->next < r->text_end && *r->next != '\n') {
            comment |= *r->next == '#';
            r->next++;
            r->end += !comment;
        }
        r->next += r->next < r->text_end;
        skip_spaces(r);
        if (r->at < r->end) {
            return 1;
        }
    }
    return 0;
}

/* Steps over a word, and the spaces behind it. 0 when another one stands there. */
static int take_word(reader *r, const char *word)
{
    const char *at = r->at;
    while (*word && at < r->end && *at == *word) {
        at++;
        word++;
    }
    if (*word || (at < r->end && !is_space(*at))) {
        return 0;
    }
    r->at = at;
    skip_spaces(r);
    return 1;
}

static int take_number(int64_t *number, reader *r)
{
    int negative = r->at < r->end && *r->at == '-', digits = 0;
    int64_t value = 0;
    r->at += negative;
    for (; r->at < r->end && *r->at >= '0' && *r->at <= '9'; r->at++, digits++) {
        int digit = *r->at - '0';
        if (value > (IRIS_FLOOR_ENTRY_MAX - digit) / 10) {
            return 0;
        }
        value = value * 10 + digit;
    }
    if (digits == 0 || (r->at < r->end && !is_space(*r->at))) {
        return 0;
    }
    *number = negative ? -value : value;
    skip_spaces(r);
    return 1;
}

static int take_check(uint32_t *check, reader *r)
{
    uint32_t value = 0;
    for (int i = 0; i < 8; i++, r->at++) {
        int digit = 0;
        while (digit < 16 && (r->at >= r->end || hex[digit] != *r->at)) {
            digit++;
        }
        if (digit == 16) {
            return 0;
        }
        value = value << 4 | (uint32_t)digit;
    }
    *check = value;
    skip_spaces(r);
    return 1;
}

/* What the lines said so far. */
typedef struct {
    int64_t version, w, h;
    iris_q32 m[9];
    uint32_t check;
} content;

/* Line `i` of those that count. */
static int take_line(content *c, reader *r, int i)
{
    switch (i) {
    case 0:
        return take_word(r, "iris") && take_word(r, "floor") && take_number(&c->version, r);
    case 1:
        return take_word(r, "size") && take_number(&c->w, r) && take_number(&c->h, r) && c->w > 0 &&
               c->w <= IRIS_SIDE_MAX && c->h > 0 && c->h <= IRIS_SIDE_MAX;
    case 2:
        return take_word(r, "image_from_floor_q32");
    case 6:
        return take_word(r, "check") && take_check(&c->check, r);
    default:
        for (int k = 0; k < 3; k++) {
            if (!take_number(&c->m[3 * (i - 3) + k], r)) {
                return 0;
            }
        }
        return 1;
    }
}

static iris_status read(iris_floor *floor, reader *r)
{
    content c = {.version = 1};
    for (int i = 0; i < LINES; i++) {
        if (!next_line(r)) {
            r->line += r->line < INT32_MAX;
            return IRIS_ERR_TRUNCATED;
        }
        if (!take_line(&c, r, i) || c.version < 1 || (c.version == 1 && r->at < r->end)) {
            return IRIS_ERR_DATA;
        }
        if (c.version > 1) {
            return IRIS_ERR_UNSUPPORTED;
        }
    }
    iris_size size = {(int32_t)c.w, (int32_t)c.h};
    if (c.check != check_of(size, c.m) || iris_floor_init(floor, size, c.m) != IRIS_OK || next_line(r)) {
        return IRIS_ERR_DATA;
    }
    return IRIS_OK;
}

iris_status iris_floor_read_text(iris_floor *floor, int32_t *line, const char *text, size_t bytes)
{
    if (!floor || !line || (!text && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    if (bytes > 0 && text[bytes - 1] == 0) {
        bytes--;
    }
    iris_floor made;
    reader r = {.next = text, .text_end = bytes > 0 ? text + bytes : text};
    iris_status status = read(&made, &r);
    if (status == IRIS_OK) {
        *floor = made;
    } else {
        *line = r.line;
    }
    return status;
}
