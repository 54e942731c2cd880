/* Every picture operation, in the order of iris --help. */
#include <string.h>

#include "commands.h"

const operation *const operations[] = {
    &operation_convert,
    &operation_gray,
    &operation_pyramid,
    &operation_threshold,
    &operation_negative,
    &operation_adjust,
    &operation_compress,
    &operation_stretch,
    &operation_gamma,
    &operation_histogram,
    &operation_equalize,
    &operation_convolve,
    &operation_blur,
    &operation_median,
    &operation_unsharp,
    &operation_edge,
    &operation_dilate,
    &operation_erode,
    &operation_open,
    &operation_close,
    &operation_gradient,
    &operation_tophat,
    &operation_blackhat,
    &operation_hitmiss,
    &operation_distance,
    &operation_skeleton,
    &operation_quadtree,
    NULL,
};

const operation *operation_find(const char *name)
{
    for (size_t i = 0; operations[i]; i++) {
        if (strcmp(operations[i]->name, name) == 0) {
            return operations[i];
        }
    }
    return NULL;
}
