/* What the commands that are a tone share. */
#ifndef IRIS_TOOL_TONE_STAGE_H
#define IRIS_TOOL_TONE_STAGE_H

#include "iris/xt/tone.h"
#include "operation.h"

/* The whole of apply: the tone on all channels; a mask stays one where its two levels do. */
int tone_stage_apply(iris_image *result, const iris_image *input, operation_stage *stage,
                     const iris_tone *tone);

#endif
