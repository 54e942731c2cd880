/* The inputs of a command: files, "-", and folders, which stand for the pictures in them by name. */
#ifndef IRIS_TOOL_INPUTS_H
#define IRIS_TOOL_INPUTS_H

typedef struct {
    char **paths;
    int count;
    int has_folder; /* a folder was among the operands */
} input_list;

/* Folders give their .bmp, .pgm, .ppm, and .pnm files in the order of their names. Complains about folders that cannot
 * be read or hold no picture and goes on; returns EXIT_DONE or EXIT_BAD_DATA. */
int inputs_expand(input_list *inputs, int count, char **operands);

void inputs_free(input_list *inputs);

#endif
