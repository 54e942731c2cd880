#include "iris/osiris/telemetry.h"

#include <string.h>

static const char start[] = "$PIRIV";
static const char hex_digits[] = "0123456789ABCDEF";

static char *put_word(char *at, const char *word)
{
    while (*word) {
        *at++ = *word++;
    }
    return at;
}

static char *put_number(char *at, int32_t value)
{
    char digits[10];
    int count = 0;
    uint32_t rest = value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
    *at++ = ',';
    if (value < 0) {
        *at++ = '-';
    }
    do {
        digits[count++] = (char)('0' + rest % 10);
        rest /= 10;
    } while (rest > 0);
    while (count > 0) {
        *at++ = digits[--count];
    }
    return at;
}

static char *put_checksum(char *at, const char *first)
{
    unsigned sum = 0;
    for (const char *c = first; c < at; c++) {
        sum ^= (unsigned char)*c;
    }
    *at++ = '*';
    *at++ = hex_digits[sum >> 4];
    *at++ = hex_digits[sum & 15u];
    return put_word(at, "\r\n");
}

static int is_good(const osiris_telemetry *t)
{
    return t->seq >= 0 && t->seq <= 9999 && t->channel >= 0 && t->channel <= 255 &&
           t->raw.kind > OSIRIS_NOTHING && t->raw.kind < OSIRIS_KINDS &&
           (t->raw.validity == OSIRIS_VALID || t->raw.validity == OSIRIS_BEYOND);
}

iris_status osiris_telemetry_format(char *sentence, size_t capacity, size_t *length,
                                    const osiris_telemetry *telemetry)
{
    if (!sentence || !length || !telemetry || !is_good(telemetry)) {
        return IRIS_ERR_ARG;
    }
    char text[OSIRIS_TELEMETRY_BYTES];
    int last = OSIRIS_VALUES - 1;
    char *at = put_number(put_word(text, start), telemetry->seq);
    *at++ = ',';
    at = put_number(put_word(at, osiris_kind_name(telemetry->raw.kind)), telemetry->channel);
    at = put_word(at, telemetry->raw.validity == OSIRIS_VALID ? ",V" : ",N");
    while (last > 0 && telemetry->raw.values[last] == 0) {
        last--;
    }
    for (int i = 0; i <= last; i++) {
        at = put_number(at, telemetry->raw.values[i]);
    }
    at = put_checksum(at, text + 1);
    *at++ = 0;
    const size_t bytes = (size_t)(at - text);
    if (bytes > capacity) {
        return IRIS_ERR_RANGE;
    }
    memcpy(sentence, text, bytes);
    *length = bytes - 1;
    return IRIS_OK;
}

/* A comma, an optional minus, and up to 10 digits, wrapped to 32 bits. Stops at the first other byte: never behind a '\n'. */
static const char *get_number(int32_t *value, const char *at)
{
    int64_t size = 0;
    at += *at == ',';
    const int negative = *at == '-';
    at += negative;
    for (int digits = 0; digits < 10 && *at >= '0' && *at <= '9'; digits++) {
        size = size * 10 + (*at++ - '0');
    }
    *value = (int32_t)(uint32_t)(uint64_t)(negative ? -size : size);
    return at;
}

static const char *get_kind(osiris_kind *kind, const char *at)
{
    for (int k = OSIRIS_CAMERA; k < OSIRIS_KINDS; k++) {
        const char *name = osiris_kind_name((osiris_kind)k);
        size_t i = 0;
        while (name[i] != 0 && at[i] == name[i]) {
            i++;
        }
        if (name[i] == 0) {
            *kind = (osiris_kind)k;
            return at + i;
        }
    }
    return at;
}

/* What a sentence that ends with '\n' says, without judging its spelling. Never passes the '\n'. */
static osiris_telemetry get_telemetry(const char *at)
{
    osiris_telemetry t;
    memset(&t, 0, sizeof t);
    for (int i = 0; start[i] && *at == start[i]; i++) {
        at++;
    }
    at = get_number(&t.seq, at);
    at += *at == ',';
    at = get_kind(&t.raw.kind, at);
    at = get_number(&t.channel, at);
    at += *at == ',';
    t.raw.validity = *at == 'V' ? OSIRIS_VALID : OSIRIS_BEYOND;
    at += *at == 'V' || *at == 'N';
    for (int i = 0; i < OSIRIS_VALUES && *at == ','; i++) {
        at = get_number(&t.raw.values[i], at);
    }
    return t;
}

/* Good is what formats to the same bytes: one rule for range, spelling, missing and extra fields, and checksum. */
static iris_status read_sentence(osiris_telemetry *telemetry, const char *text, size_t length)
{
    char again[OSIRIS_TELEMETRY_BYTES];
    size_t again_length = 0;
    const osiris_telemetry found = get_telemetry(text);
    if (osiris_telemetry_format(again, sizeof again, &again_length, &found) != IRIS_OK ||
        again_length != length || memcmp(again, text, length) != 0) {
        return IRIS_ERR_DATA;
    }
    *telemetry = found;
    return IRIS_OK;
}

iris_status osiris_telemetry_parse(osiris_telemetry *telemetry, osiris_telemetry_parser *parser, char byte)
{
    if (!telemetry || !parser) {
        return IRIS_ERR_ARG;
    }
    const size_t length = parser->length;
    if (byte == '$') {
        parser->text[0] = byte;
        parser->length = 1;
        return length > 0 ? IRIS_ERR_DATA : IRIS_ERR_TRUNCATED;
    }
    if (length == 0) {
        return IRIS_ERR_TRUNCATED;
    }
    if (length >= sizeof parser->text) {
        parser->length = 0;
        return IRIS_ERR_DATA;
    }
    parser->text[length] = byte;
    parser->length = (uint8_t)(length + 1);
    if (byte != '\n') {
        return IRIS_ERR_TRUNCATED;
    }
    parser->length = 0;
    return read_sentence(telemetry, parser->text, length + 1);
}
