/* Lines by the blocks of a quadtree. */
#include "paths_list.h"

enum { WIDTHS_ACROSS = 3 }; /* that a line bends to the side at most; what reaches farther is several lines */

static int stands_out(const iris_paths_config *config, iris_color floor, iris_color mean)
{
    int32_t whole = config->bright ? mean.g : floor.g,
            away = config->bright ? mean.g - floor.g : floor.g - mean.g;
    return away > 0 && away * 1000 >= whole * config->contrast_permil;
}

static void fit(iris_path_list *list, const iris_quadtree *tree, const int32_t *labels, int32_t region)
{
    iris_moments moments = {0};
    iris_line line;
    iris_path_reach reach = {INT32_MAX, INT32_MIN};
    int64_t area = 0;
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        for (int32_t y = leaf->y; labels[i] == region && y < leaf->y + leaf->h; y++) {
            iris_moments_add_run(&moments, leaf->x, leaf->x + leaf->w - 1, y);
        }
        area += labels[i] == region ? (int64_t)leaf->w * leaf->h : 0;
    }
    if (iris_regress_moments(&line, &moments) != IRIS_OK) {
        return;
    }
    iris_path_reach across = reach;
    iris_line turned = line;
    turned.dx = -line.dy;
    turned.dy = line.dx;
    for (int32_t i = 0; i < tree->count; i++) {
        const iris_quadtree_leaf *leaf = &tree->leaves[i];
        if (labels[i] == region) {
            iris_path_reach_add(&across, &turned, leaf->x + leaf->w / 2, leaf->y + leaf->h / 2);
            iris_path_reach_add(&reach, &line, leaf->x + leaf->w / 2, leaf->y + leaf->h / 2);
        }
    }
    int32_t length = (reach.high_q4 - reach.low_q4) / 16 + 1;
    int32_t width = (int32_t)((area + length / 2) / length);
    if ((across.high_q4 - across.low_q4) / 16 <= WIDTHS_ACROSS * width) {
        iris_path_list_add(list, &line, &reach, width, 0);
    }
}

iris_status iris_paths_of_regions(iris_path *paths, int32_t capacity, int32_t *count,
                                  const iris_quadtree *tree, const iris_region_table *table,
                                  const iris_paths_config *config)
{
    iris_paths_config used;
    iris_paths_defaults(&used);
    used = config ? *config : used;
    if ((!paths && capacity != 0) || capacity < 0 || !count || !tree || !table || !table->regions ||
        !table->labels || table->count < 1 || table->capacity < table->count ||
        !iris_paths_are_valid(&used)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_quadtree_check(tree);
    if (status != IRIS_OK) {
        return status;
    }
    iris_path_list list = {paths, capacity, 0, &used, tree->size};
    for (int32_t i = 1; i < table->count; i++) {
        if (stands_out(&used, table->regions[0].mean, table->regions[i].mean)) {
            fit(&list, tree, table->labels, i);
        }
    }
    *count = list.count;
    return list.count > capacity ? IRIS_ERR_FULL : IRIS_OK;
}
