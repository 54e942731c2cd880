/* A script of timed orders: lines of SECONDS and an order (order.h), in the order of time; # begins a comment.
 */
#ifndef IRIS_TOOL_RUN_SCRIPT_H
#define IRIS_TOOL_RUN_SCRIPT_H

#include "iris/runtime/order.h"

typedef struct {
    uint32_t at_ms;
    iris_order order;
} run_script_line;

typedef struct {
    run_script_line *lines; /* for free() */
    int32_t count;
} run_script;

/* Complains, with the line and column; returns 1, or 0. */
int run_script_read(run_script *script, const char *path);

#endif
