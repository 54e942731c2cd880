/* Texts of lines that people can read, with a check at their end: what writes and reads them. Empty lines, spaces, and
 * what stands behind a # do not count.
 */
#ifndef IRIS_TEXT_LINES_H
#define IRIS_TEXT_LINES_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#define IRIS_TEXT_CHECK 2166136261u /* of nothing yet */

/* FNV-1a over numbers, as bytes of 64 bits, the lowest first. */
uint32_t iris_text_check(uint32_t check, const int64_t *numbers, int count);

/* Each writes at `at` and returns where it ends. Numbers have `behind` behind them; those with 32 fraction bits, which
 * are below 2^62, ten digits behind the point, by which they are read again as they were. */
char *iris_text_put_word(char *at, const char *word);
char *iris_text_put_number(char *at, int64_t value, char behind);
char *iris_text_put_q32(char *at, int64_t q32, char behind);
char *iris_text_put_check(char *at, uint32_t check); /* the whole line */

/* The rest of a line, and of the text behind it. */
typedef struct {
    const char *at, *end; /* of the line */
    const char *next, *text_end;
    int32_t line;
} iris_text_lines;

/* Goes to the next line that has something in it. 0 when there is none. */
int iris_text_next_line(iris_text_lines *r);

/* Each steps over what it names, and the spaces behind it. 0 when something else stands there. */
int iris_text_take_word(iris_text_lines *r, const char *word);
int iris_text_take_number(int64_t *number, iris_text_lines *r); /* within 2^62 */
int iris_text_take_q32(int64_t *q32, iris_text_lines *r);       /* within a thousand million */
int iris_text_take_check(uint32_t *check, iris_text_lines *r);

/* Ends the text that was made from `made` up to `at`, where there is room for 16 bytes more: with the line of its check and a
 * 0 it goes to `text`, and its length without the 0 to *length. IRIS_ERR_RANGE: more than `capacity` bytes. */
typedef struct {
    char *made, *at;
    uint32_t check;
} iris_text_made;

iris_status iris_text_finish(char *text, size_t capacity, size_t *length, const iris_text_made *of);

/* A kind of text: "iris KIND 1", lines of its own, and the check, which a text that people write need not have. */
typedef struct {
    const char *kind;
    int lines;                                             /* of its own, of those that count */
    int (*take)(void *content, iris_text_lines *r, int i); /* line i of them, from 0; 0 when it is wrong */
} iris_text_form;

typedef struct {
    const char *text;
    size_t bytes;
    uint32_t check; /* what its last line says, for the caller to compare */
    int has_check;  /* 0: there is no such line, and the one before ends with a line break: it is whole */
    int32_t line;   /* that was looked at last, from 1 */
} iris_text_source;

/* Reads a whole text of any content; a 0 at its end is no part of it. Sets check, has_check, and line. IRIS_ERR_UNSUPPORTED: a later
 * version; IRIS_ERR_TRUNCATED: the text ends early; IRIS_ERR_DATA: anything else. */
iris_status iris_text_read(void *content, iris_text_source *source, const iris_text_form *form);

#endif
