/* --sigma, --low, and --high of the commands that begin with Canny's edges. */
#ifndef IRIS_TOOL_CANNY_OPTIONS_H
#define IRIS_TOOL_CANNY_OPTIONS_H

#include "iris/xt/canny.h"

/* Each null when not given. */
typedef struct {
    const char *sigma, *low, *high;
} canny_texts;

/* The options into *canny, and the default sigma where none is given. A threshold that is not given is -1 until one of
 * the two below. Complains and returns 0 when they are wrong. */
int canny_options_read(iris_canny_config *canny, const canny_texts *given);

/* Thresholds that were not given: low is two fifths of a given high, else as usual; high is as usual, or a given low if
 * that is more. */
void canny_options_complete(iris_canny_config *canny, int32_t usual_low, int32_t usual_high);

/* The same with what iris_canny_adapt finds in the picture. scratch: IRIS_CANNY_ADAPT_SCRATCH_BYTES, all of it free. */
iris_status canny_options_adapt(iris_canny_config *canny, const iris_image *gray, iris_scratch *scratch);

#endif
