/* Sentences about what is wrong, put together in a buffer that may be too short: the end is cut off then. */
#ifndef PROBLEM_TEXT_H
#define PROBLEM_TEXT_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    char *bytes; /* always ends with a 0 */
    size_t capacity, length;
} problem_text;

/* An empty text in `capacity` bytes, at least 1. */
problem_text problem_text_in(char *bytes, size_t capacity);
void problem_text_add(problem_text *text, const char *words);
void problem_text_add_number(problem_text *text, int64_t number);

/* Copies a text of the kernel's, which may lack its 0, into capacity bytes: printable ASCII, without spaces at the end. */
void problem_text_copy(char *to, size_t capacity, const void *from, size_t bytes);

#endif
