/* Runs operations, one after the other, over all inputs of a call: each is read, worked on, and written. A bad input is
 * complained about, and the others go on.
 */
#ifndef IRIS_TOOL_CHAIN_H
#define IRIS_TOOL_CHAIN_H

#include "operation.h"
#include "raw_picture.h"

typedef struct {
    const char *command;
    operation_stage *stages; /* parsed */
    int count;
    const char *output; /* of -o: a file, a folder, "-"; null: standard output unless it is a terminal */
    raw_layout raw;     /* what the inputs are; zeroed: pictures */
    int json; /* one object per picture on standard output, with the members of the last stage's report */
} operation_chain;

/* Runs the chain over all operands and returns the exit code of the command. */
int chain_run(operation_chain *chain, const arguments *args);

/* `count` stages, zeroed. Null after complaining. */
operation_stage *chain_stages(size_t count);
void chain_free(operation_stage *stages, int count);

/* The whole command of one operation; returns its exit code. */
int chain_command(const operation *run, int argc, char **argv);

#endif
