#include "json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

json_writer json_to(FILE *out)
{
    return (json_writer){out, 0, 0};
}

static void comma(json_writer *json)
{
    if (json->has_value) {
        fputc(',', json->out);
    }
    json->has_value = 1;
}

void json_open(json_writer *json, char bracket)
{
    comma(json);
    fputc(bracket, json->out);
    json->depth++;
    json->has_value = 0;
}

void json_close(json_writer *json, char bracket)
{
    fputc(bracket, json->out);
    json->depth--;
    json->has_value = 1;
    if (json->depth == 0) {
        fputc('\n', json->out);
        fflush(json->out);
        json->has_value = 0;
    }
}

/* The length of the UTF-8 sequence at text (RFC 3629), 0 when there is none. */
static int utf8_length(const unsigned char *text)
{
    static const struct {
        unsigned char first, last, low, high; /* first byte; limits of the second one */
        int length;
    } forms[] = {{0x00, 0x7F, 0x00, 0xFF, 1}, {0xC2, 0xDF, 0x80, 0xBF, 2}, {0xE0, 0xE0, 0xA0, 0xBF, 3},
                 {0xE1, 0xEC, 0x80, 0xBF, 3}, {0xED, 0xED, 0x80, 0x9F, 3}, {0xEE, 0xEF, 0x80, 0xBF, 3},
                 {0xF0, 0xF0, 0x90, 0xBF, 4}, {0xF1, 0xF3, 0x80, 0xBF, 4}, {0xF4, 0xF4, 0x80, 0x8F, 4}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        if (text[0] < forms[i].first || text[0] > forms[i].last) {
            continue;
        }
        if (forms[i].length > 1 && (text[1] < forms[i].low || text[1] > forms[i].high)) {
            return 0;
        }
        for (int k = 2; k < forms[i].length; k++) {
            if (text[k] < 0x80 || text[k] > 0xBF) {
                return 0;
            }
        }
        return forms[i].length;
    }
    return 0;
}

static void quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (const unsigned char *at = (const unsigned char *)text; *at != '\0';) {
        int length = utf8_length(at);
        if (length == 0) {
            fputs("\\ufffd", out);
            at++;
        } else if (*at < 0x20 || *at == 0x7F) {
            fprintf(out, "\\u%04x", *at++);
        } else {
            if (*at == '"' || *at == '\\') {
                fputc('\\', out);
            }
            fwrite(at, 1, (size_t)length, out);
            at += length;
        }
    }
    fputc('"', out);
}

void json_key(json_writer *json, const char *key)
{
    comma(json);
    quoted(json->out, key);
    fputc(':', json->out);
    json->has_value = 0;
}

void json_string(json_writer *json, const char *text)
{
    if (!text) {
        json_null(json);
        return;
    }
    comma(json);
    quoted(json->out, text);
}

void json_integer(json_writer *json, int64_t number)
{
    comma(json);
    fprintf(json->out, "%" PRId64, number);
}

void json_number(json_writer *json, double number, int decimals)
{
    char text[400]; /* the largest double has 309 digits */
    if (!isfinite(number)) {
        json_null(json);
        return;
    }
    int length = snprintf(text, sizeof text, "%.*f", decimals, number);
    while (decimals > 0 && text[length - 1] == '0') {
        length--;
    }
    length -= text[length - 1] == '.';
    text[length] = '\0';
    comma(json);
    fputs(strcmp(text, "-0") == 0 ? "0" : text, json->out);
}

void json_null(json_writer *json)
{
    comma(json);
    fputs("null", json->out);
}
