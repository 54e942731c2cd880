/* --floor of operations that report places: the same in millimeters on the floor, with true angles. */
#ifndef IRIS_TOOL_FLOOR_OPTION_H
#define IRIS_TOOL_FLOOR_OPTION_H

#include "iris/xt/floor.h"
#include "operation.h"

#define FLOOR_OPTION_HELP                                                                                    \
    "  --floor FLOOR     on the floor too, in millimeters: what iris floor has made for pictures\n"          \
    "                    of this size\n"

typedef struct {
    int used; /* 0: no --floor */
    iris_floor floor;
} floor_option;

/* path null: not given. Returns 1, or 0 after complaining: the data is bad then. */
int floor_option_read(floor_option *by, const char *path, operation_words *words);

/* Is the whole picture, whatever --roi says, of the size that the floor was made for? Returns 1, or 0 after complaining. */
int floor_option_fits(const floor_option *by, const operation_stage *stage);

/* A number with one decimal, or null. */
void floor_json_mm(json_writer *json, const char *key, int exists, iris_q16 mm);

/* Members x0_mm, y0_mm, x1_mm, y1_mm, length_mm, and true_deg of a piece of a line from a to b, pixels of the whole
 * picture; null where it is beyond the horizon. Nothing without --floor. */
void floor_option_json_line(json_writer *json, const floor_option *by, iris_place a, iris_place b);

/* The same in words, with a comma before. */
void floor_option_print_line(FILE *out, const floor_option *by, iris_place a, iris_place b);

#endif
