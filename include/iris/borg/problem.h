/* IRIS - texts of BorgCode, and what is wrong with one.
 */
#ifndef IRIS_BORG_PROBLEM_H
#define IRIS_BORG_PROBLEM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_TEXT_BYTES_MAX 65536

/* Any bytes; a 0 ends nothing. */
typedef struct {
    const char *at;
    size_t length;
} borg_text;

/* Lines and columns from 1, a column for each byte. expected: a sentence in static storage, such as "expected ')'". */
typedef struct {
    int32_t line, column;
    const char *expected;
} borg_problem;

#ifdef __cplusplus
}
#endif

#endif
