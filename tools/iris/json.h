/* Writes JSON, one value after the other; commas come by themselves.
 *
 *     json_writer json = json_to(stdout);
 *     json_open(&json, '{');
 *     json_key(&json, "file");
 *     json_string(&json, name);
 *     json_close(&json, '}');      the outermost close ends the line and flushes it
 */
#ifndef IRIS_TOOL_JSON_H
#define IRIS_TOOL_JSON_H

#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *out;
    int depth;     /* objects and arrays that are open */
    int has_value; /* a value precedes at this place: a comma is due */
} json_writer;

json_writer json_to(FILE *out);
void json_open(json_writer *json, char bracket);  /* '{' or '[' */
void json_close(json_writer *json, char bracket); /* '}' or ']' */
void json_key(json_writer *json, const char *key);

/* Any bytes: what is not UTF-8 becomes U+FFFD. Null pointer: null. */
void json_string(json_writer *json, const char *text);
void json_integer(json_writer *json, int64_t number);

/* At most `decimals` (0 to 15) digits behind the point, trailing zeros left out; null when not finite. */
void json_number(json_writer *json, double number, int decimals);
void json_null(json_writer *json);

#endif
