/* What is measured: cases, one file of them for each module, for a counter of instructions (count.c) and a clock (time.c).
 *
 * A new case: a function that calls the operation once on bench_frame, and its line in the module's table; a prepare
 * function beside it when it needs more than the frame. A new module: a file <module>_cases.c with a table
 * bench_<module>[], and its line in modules.def.
 */
#ifndef IRIS_BENCH_H
#define IRIS_BENCH_H

#include <stddef.h>
#include <stdint.h>

#include "iris/image.h"
#include "iris/scratch.h"

typedef struct {
    const char *name;
    iris_status (*run)(void); /* what the operation returned; an error of its arguments ends the measuring */
    void (*prepare)(void);    /* behind bench_frame_begin, not measured; may be null */
} bench_case;

/* bench_<module>: each ends with a null name. */
#define BENCH_MODULE(module) extern const bench_case bench_##module[];
#include "modules.def"
#undef BENCH_MODULE

extern const bench_case *const bench_modules[]; /* ends with a null pointer */

/* A frame that a floor camera could have sent, made anew for each case: a floor in uneven light, noise, and a dark line that
 * leans to the right. */
typedef struct {
    iris_image gray, rgb;
    iris_image mask;                     /* the line */
    iris_image gray_to, rgb_to, mask_to; /* zeroed, of the same size, for results */
    iris_scratch scratch;                /* all memory that is left */
} bench_pictures;

extern bench_pictures bench_frame;

void bench_frame_begin(iris_size size, void *memory, size_t bytes);

/* One more zeroed picture, out of the memory that is left; of the frame's size, or of any. */
iris_image bench_canvas(iris_format format);
iris_image bench_canvas_of(iris_format format, int32_t w, int32_t h);

/* Was there nothing to measure? */
static inline int bench_refused(iris_status status)
{
    return status >= IRIS_ERR_ARG && status <= IRIS_ERR_SCRATCH;
}

/* Where the counter's lines go. */
void target_print(const char *text);

#endif
