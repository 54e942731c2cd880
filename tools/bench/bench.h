/* What is measured: a table of cases, for a counter of instructions (count.c) and a clock (time.c).
 * A new case: a run function, a prepare function if pictures must be made first, and a line in the table of cases.c. */
#ifndef IRIS_BENCH_H
#define IRIS_BENCH_H

#include <stdint.h>

typedef struct {
    const char *name;
    int32_t pixels; /* that one run works on */
    void (*prepare)(void);
    void (*run)(void);
} bench_case;

extern const bench_case bench_cases[]; /* ends with a null name */

/* Where the counter's lines go. */
void target_print(const char *text);

#endif
