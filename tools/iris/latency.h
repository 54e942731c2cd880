/* How long frames take until their command: counted without a list, so that it may go on for days. */
#ifndef IRIS_TOOL_LATENCY_H
#define IRIS_TOOL_LATENCY_H

#include <stdint.h>
#include <stdio.h>

/* Negative times count as 0. */
void latency_add(int64_t us);

/* Prints how many there were, the time that half of them, 90, and 99 of 100 do not exceed (exact up to 127 us, beyond that
 * within 2 percent), and the largest: a line of text, or a JSON object. Nothing when there was none. */
void latency_print(FILE *out, int json);

#endif
