#include "text_lines.h"

#include <string.h>

#define LARGEST ((int64_t)1 << 62)

static const char hex[] = "0123456789ABCDEF";

uint32_t iris_text_check(uint32_t check, const int64_t *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 64; k += 8) {
            check = (check ^ (uint32_t)((uint64_t)numbers[i] >> k & 255)) * 16777619u;
        }
    }
    return check;
}

char *iris_text_put_word(char *at, const char *word)
{
    while (*word) {
        *at++ = *word++;
    }
    return at;
}

char *iris_text_put_number(char *at, int64_t value, char behind)
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

int iris_text_next_line(iris_text_lines *r)
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

int iris_text_take_word(iris_text_lines *r, const char *word)
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

int iris_text_take_number(int64_t *number, iris_text_lines *r)
{
    int negative = r->at < r->end && *r->at == '-', digits = 0;
    int64_t value = 0;
    r->at += negative;
    for (; r->at < r->end && *r->at >= '0' && *r->at <= '9'; r->at++, digits++) {
        int digit = *r->at - '0';
        if (value > (LARGEST - digit) / 10) {
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

int iris_text_take_check(uint32_t *check, iris_text_lines *r)
{
    uint32_t value = 0;
    if (!iris_text_take_word(r, "check")) {
        return 0;
    }
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

char *iris_text_put_check(char *at, uint32_t check)
{
    at = iris_text_put_word(at, "check ");
    for (int shift = 28; shift >= 0; shift -= 4) {
        *at++ = hex[check >> shift & 15];
    }
    *at++ = '\n';
    return at;
}

char *iris_text_put_q32(char *at, int64_t q32, char behind)
{
    uint64_t size = q32 < 0 ? 0u - (uint64_t)q32 : (uint64_t)q32;
    uint64_t whole = size >> 32, rest = size & 0xFFFFFFFFu; /* rest 10^10 is below 2^66: in two steps */
    uint64_t high = rest * 100000, low = (high & 0xFFFFFFFFu) * 100000;
    uint64_t fraction = (high >> 32) * 100000 + (low >> 32) + (low >> 31 & 1);
    if (fraction == 10000000000u) {
        fraction = 0;
        whole++;
    }
    if (q32 < 0) {
        *at++ = '-';
    }
    at = iris_text_put_number(at, (int64_t)whole, '.');
    for (uint64_t place = 1000000000; place > 0; place /= 10) {
        *at++ = (char)('0' + fraction / place % 10);
    }
    *at++ = behind;
    return at;
}

int iris_text_take_q32(int64_t *q32, iris_text_lines *r)
{
    int negative = r->at < r->end && *r->at == '-', digits = 0, places = 0;
    uint64_t whole = 0, fraction = 0;
    r->at += negative;
    for (; r->at < r->end && *r->at >= '0' && *r->at <= '9' && whole < 1000000000; r->at++, digits++) {
        whole = whole * 10 + (uint64_t)(*r->at - '0');
    }
    if (r->at < r->end && *r->at == '.') {
        for (r->at++; r->at < r->end && *r->at >= '0' && *r->at <= '9' && places < 10; r->at++, places++) {
            fraction = fraction * 10 + (uint64_t)(*r->at - '0');
        }
    }
    if (digits == 0 || whole >= 1000000000 || (r->at < r->end && !is_space(*r->at))) {
        return 0;
    }
    for (; places < 10; places++) {
        fraction *= 10;
    }
    uint64_t high = (fraction << 29) / 10000000000u; /* below 2^63: the other three bits from what is left */
    uint64_t left = (fraction << 29) % 10000000000u;
    uint64_t size = (whole << 32) + (high << 3) + ((left << 3) + 5000000000u) / 10000000000u;
    *q32 = negative ? -(int64_t)size : (int64_t)size;
    skip_spaces(r);
    return 1;
}

iris_status iris_text_finish(char *text, size_t capacity, size_t *length, const iris_text_made *of)
{
    char *at = iris_text_put_check(of->at, of->check);
    *at++ = 0;
    size_t bytes = (size_t)(at - of->made);
    if (bytes > capacity) {
        return IRIS_ERR_RANGE;
    }
    memcpy(text, of->made, bytes);
    *length = bytes - 1;
    return IRIS_OK;
}

/* Line i of those that count: the first one has the kind and the version, the last one the check. */
static int take_line(void *content, int64_t *version, uint32_t *check, const iris_text_form *form,
                     iris_text_lines *r, int i)
{
    if (i == 0) {
        return iris_text_take_word(r, "iris") && iris_text_take_word(r, form->kind) &&
               iris_text_take_number(version, r) && *version > 0;
    }
    return i <= form->lines ? form->take(content, r, i - 1) : iris_text_take_check(check, r);
}

iris_status iris_text_read(void *content, iris_text_source *source, const iris_text_form *form)
{
    const char *text = source->text;
    size_t bytes = source->bytes > 0 && text[source->bytes - 1] == 0 ? source->bytes - 1 : source->bytes;
    iris_text_lines r = {.next = text, .text_end = bytes > 0 ? text + bytes : text};
    int64_t version = 1;
    iris_status status = IRIS_OK;
    source->has_check = 1;
    for (int i = 0; i < form->lines + 2 && status == IRIS_OK && source->has_check; i++) {
        const int whole = i == form->lines + 1 && r.next > text && r.next[-1] == '\n'; /* but for the check */
        const int found = iris_text_next_line(&r);
        if (!found && whole) {
            source->has_check = 0;
        } else if (!found) {
            r.line += r.line < INT32_MAX;
            status = IRIS_ERR_TRUNCATED;
        } else if (!take_line(content, &version, &source->check, form, &r, i)) {
            status = IRIS_ERR_DATA;
        } else if (version > 1) {
            status = IRIS_ERR_UNSUPPORTED;
        } else if (r.at < r.end) {
            status = IRIS_ERR_DATA;
        }
    }
    source->line = r.line;
    if (status == IRIS_OK && iris_text_next_line(&r)) {
        source->line = r.line;
        status = IRIS_ERR_DATA;
    }
    return status;
}
