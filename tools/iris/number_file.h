/* Files of decimal numbers, as people and other programs write them. */
#ifndef IRIS_TOOL_NUMBER_FILE_H
#define IRIS_TOOL_NUMBER_FILE_H

#include "iris/wide.h"

typedef struct {
    iris_q32 *numbers; /* `columns` for each row */
    int *lines;        /* where each row stands, from 1; null: of no interest */
    int rows, room;    /* how many there are, and how many fit */
    int columns;
} number_table;

/* Reads rows of numbers such as 1, -2.5, or 3e-2, nearer to 0 than 2^28, with 32 fraction bits. Blanks, tabs, commas, or
 * semicolons stand between them; a line has one row or several; empty lines and what stands behind a # do not count. "-"
 * is standard input. Complains; returns 1, or 0. */
int number_file_read(number_table *table, const char *path);

/* One number of a text, with 32 fraction bits. 1 when text is that, else 0. */
int number_text_read(iris_q32 *number, const char *text);

#endif
