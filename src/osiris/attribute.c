#include "attribute.h"

#include <string.h>

#include "iris/osiris/pose.h"
#include "rounded.h"

osiris_reader osiris_reader_of(const char *text, size_t bytes)
{
    const size_t length = bytes > 0 && text[bytes - 1] == 0 ? bytes - 1 : bytes;
    osiris_reader reader;
    memset(&reader, 0, sizeof reader);
    reader.lines.next = text;
    reader.lines.text_end = text + length;
    return reader;
}

int osiris_expect(osiris_reader *reader, const char *expected)
{
    reader->expected = expected;
    return 0;
}

static int is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static void skip_spaces(iris_text_lines *r)
{
    while (r->at < r->end && is_space(*r->at)) {
        r->at++;
    }
}

int osiris_take_name(char *name, size_t bytes, osiris_reader *reader)
{
    iris_text_lines *r = &reader->lines;
    size_t length = 0;
    while (r->at + length < r->end && !is_space(r->at[length])) {
        if (r->at[length] <= ' ' || r->at[length] > '~' || length + 1 >= bytes) {
            return 0;
        }
        length++;
    }
    if (length == 0) {
        return 0;
    }
    memcpy(name, r->at, length);
    memset(name + length, 0, bytes - length);
    r->at += length;
    skip_spaces(r);
    return 1;
}

int osiris_take_thousandths(int64_t *number, osiris_reader *reader)
{
    iris_text_lines *r = &reader->lines;
    const char *at = r->at;
    const int negative = at < r->end && *at == '-';
    int64_t value = 0;
    int digits = 0, places = 0, point = 0;
    for (at += negative; at < r->end && !is_space(*at); at++) {
        if (*at == '.' && !point && digits > 0) {
            point = 1;
        } else if (*at >= '0' && *at <= '9' && digits < 9 && places < 3) {
            value = value * 10 + (*at - '0');
            digits += !point;
            places += point;
        } else {
            return 0;
        }
    }
    if (digits == 0 || (point && places == 0)) {
        return 0;
    }
    for (; places < 3; places++) {
        value *= 10;
    }
    *number = negative ? -value : value;
    r->at = at;
    skip_spaces(r);
    return 1;
}

int osiris_take_place(int32_t *mm, osiris_reader *reader)
{
    int64_t number;
    if (!osiris_take_thousandths(&number, reader) || number % 1000 != 0 ||
        number / 1000 <= -OSIRIS_PLACE_MAX_MM || number / 1000 >= OSIRIS_PLACE_MAX_MM) {
        return 0;
    }
    *mm = (int32_t)(number / 1000);
    return 1;
}

int64_t osiris_units_of(int64_t thousandths)
{
    return osiris_quotient(thousandths * 65536, 360000);
}

/* 0 when a number is not of its unit. */
static int convert(int64_t *number, osiris_unit unit)
{
    switch (unit) {
    case OSIRIS_DEGREES:
        *number = osiris_units_of(*number);
        return 1;
    case OSIRIS_TENTHS:
        *number /= 100;
        return 1;
    case OSIRIS_HERTZ:
        *number = *number > 0 ? osiris_quotient(1000000, *number) : 0;
        return 1;
    default:
        if (*number % 1000 != 0) {
            return 0;
        }
        *number /= 1000;
        return 1;
    }
}

int osiris_take_attribute(int32_t *number, osiris_reader *reader, const osiris_attribute *attribute)
{
    int64_t value;
    if (!osiris_take_thousandths(&value, reader) || !convert(&value, attribute->unit) ||
        value < attribute->least || value > attribute->most) {
        return osiris_expect(reader, attribute->expected);
    }
    *number = (int32_t)value;
    return 1;
}

int osiris_take_one_of(void *object, uint32_t *seen, osiris_reader *reader,
                       const osiris_attribute *attributes, int count)
{
    for (int i = 0; i < count; i++) {
        int32_t number;
        if (!iris_text_take_word(&reader->lines, attributes[i].word)) {
            continue;
        }
        if (*seen >> i & 1) {
            osiris_expect(reader, "expected each word once");
            return -1;
        }
        if (!osiris_take_attribute(&number, reader, &attributes[i])) {
            return -1;
        }
        memcpy((unsigned char *)object + attributes[i].offset, &number, sizeof number);
        *seen |= 1u << i;
        return 1;
    }
    return 0;
}
