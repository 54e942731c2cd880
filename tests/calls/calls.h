/* Random calls of public operations: what draws their arguments, and what watches them.
 *
 * One file per module with one table of operations, listed in modules.def. A function there draws arguments, some of them
 * wrong, and makes one call inside CALL. All memory that the call gets is drawn here, and afterwards looked at:
 * what it may not have changed, it has not. Under AddressSanitizer, what it may not read cannot be read.
 */
#ifndef IRIS_TEST_CALLS_H
#define IRIS_TEST_CALLS_H

#include <stddef.h>
#include <stdint.h>

#include "iris/border.h"
#include "iris/image.h"
#include "iris/scratch.h"

typedef struct {
    const char *name; /* of the function called */
    void (*call)(void);
} random_call;

/* calls_<module>: each ends with a null name. */
#define CALLS_MODULE(module) extern const random_call calls_##module[];
#include "modules.def"
#undef CALLS_MODULE

/* 0 to end - 1; one time in so many; low to high; and the same, sometimes at or beyond the ends or extreme. */
uint32_t draw_below(uint32_t end);
int draw_chance(uint32_t one_in);
int32_t draw_within(int32_t low, int32_t high);
int32_t draw_int(int32_t low, int32_t high);

/* Sides of 1 to 70, rarely 0. */
iris_size draw_size(void);

/* Any format; of two that both may do, one. */
iris_format draw_format(void);
iris_format draw_either(iris_format a, iris_format b);
iris_format draw_gray_or_color(void); /* GRAY8, RGB888, or BGR888 */

iris_border draw_border(void);

/* Views of this format and size, mostly: a few are of others, invalid, or null, and some share memory with one drawn before.
 * An output's pixels may change, unless the call is refused. */
const iris_image *draw_input(iris_format format, iris_size size);
const iris_image *draw_output(iris_format format, iris_size size);

/* For operations that look only at parts of their views: overlapping ones may be accepted. */
void draw_overlap_is_fine(void);

/* Memory beside views: `given` copies `bytes` bytes of data (of noise when null), `results` may be changed as outputs
 * are, and `state` always. Aligned to 16. Never null. */
void *draw_given(const void *data, size_t bytes);
void *draw_results(size_t bytes);
void *draw_state(const void *data, size_t bytes);

/* The pointer, or rarely null. */
#define OR_NULL(pointer) (draw_chance(60) ? NULL : (pointer))

/* Working memory of mostly `needed` bytes, else of more, of one byte less, of none, or null. Exactly enough must do,
 * and one byte less must not, when all views are as they were asked for. */
iris_scratch *draw_scratch(size_t needed);

/* The same where it is not known how much is needed exactly: nothing is asked. */
iris_scratch *draw_scratch_up_to(size_t most);

/* What is taken of it stays taken when the call succeeds. */
void draw_scratch_is_kept(void);

/* The call itself, and what it returned. */
#define CALL(expression) (calls_begin(), calls_end(expression))
void calls_begin(void);
void calls_end(iris_status status);

/* For tests/random_calls.c: the call of this number begins; 1 when what CALL made was done, 0 when refused. For
 * tests/fuzz/calls.c: what is drawn, two bytes each time; behind their end it is random again. */
void calls_start(uint32_t number, const char *name);
void calls_choose(const uint8_t *choices, size_t bytes);
int calls_accepted(void);

#endif
