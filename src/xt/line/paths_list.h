/* What both ways of telling lines apart share. Only paths*.c include this. */
#ifndef IRIS_XT_PATHS_LIST_H
#define IRIS_XT_PATHS_LIST_H

#include "iris/xt/paths.h"
#include "iris/xt/regress.h"

typedef struct {
    iris_path *paths;
    int32_t capacity, count;
    const iris_paths_config *config;
    iris_size size; /* of the picture */
} iris_path_list;

/* How far points reach along a line, from its center: pixels with 4 fraction bits. */
typedef struct {
    int32_t low_q4, high_q4;
} iris_path_reach;

int iris_paths_are_valid(const iris_paths_config *config);

void iris_path_reach_add(iris_path_reach *reach, const iris_line *line, int32_t x, int32_t y);

/* Adds the path along the line, the longest first, if it is long and slender enough; `more`: pixels at each end. */
void iris_path_list_add(iris_path_list *list, const iris_line *line, const iris_path_reach *reach,
                        int32_t width, int32_t more);

#endif
