/* Osiris - what is wrong with a text that people write.
 */
#ifndef IRIS_OSIRIS_PROBLEM_H
#define IRIS_OSIRIS_PROBLEM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* line: from 1. expected: a sentence in static storage, such as "expected track in mm, 1 to 4000". */
typedef struct {
    int32_t line;
    const char *expected;
} osiris_problem;

#ifdef __cplusplus
}
#endif

#endif
