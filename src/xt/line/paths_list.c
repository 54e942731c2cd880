#include "paths_list.h"

void iris_paths_defaults(iris_paths_config *config)
{
    if (config) {
        *config = (iris_paths_config){
            .length_permil = 150, .slender_permil = 2000, .straight = 4551, .contrast_permil = 250};
    }
}

static int within(int32_t value, int32_t low, int32_t high)
{
    return value >= low && value <= high;
}

int iris_paths_are_valid(const iris_paths_config *config)
{
    return within(config->length_permil, 0, 1000) && within(config->slender_permil, 1000, 100000) &&
           within(config->straight, 0, 8192) && within(config->bright, 0, 1) &&
           within(config->contrast_permil, 50, 900);
}

void iris_path_reach_add(iris_path_reach *reach, const iris_line *line, int32_t x, int32_t y)
{
    int64_t x_q4 = (int64_t)x * 16 - (line->x_q16 >> 12), y_q4 = (int64_t)y * 16 - (line->y_q16 >> 12);
    int32_t along = (int32_t)((x_q4 * line->dx + y_q4 * line->dy) >> 30);
    reach->low_q4 = along < reach->low_q4 ? along : reach->low_q4;
    reach->high_q4 = along > reach->high_q4 ? along : reach->high_q4;
}

static int32_t within_side(int32_t at, int32_t side)
{
    return at < 0 ? 0 : at < side ? at : side - 1;
}

static void insert(iris_path_list *list, const iris_path *path)
{
    int32_t kept = list->count < list->capacity ? list->count : list->capacity, at = kept;
    list->count++;
    if (kept == list->capacity) {
        if (kept == 0 || list->paths[kept - 1].length_px >= path->length_px) {
            return;
        }
        at--;
    }
    for (; at > 0 && list->paths[at - 1].length_px < path->length_px; at--) {
        list->paths[at] = list->paths[at - 1];
    }
    list->paths[at] = *path;
}

void iris_path_list_add(iris_path_list *list, const iris_line *line, const iris_path_reach *reach,
                        int32_t width, int32_t more)
{
    int64_t low = reach->low_q4 - more * 16, high = reach->high_q4 + more * 16;
    int32_t length = (int32_t)((high - low + 8) >> 4);
    int32_t shorter = list->size.w < list->size.h ? list->size.w : list->size.h;
    if ((int64_t)length * 1000 < (int64_t)shorter * list->config->length_permil ||
        (int64_t)length * 1000 < (int64_t)width * list->config->slender_permil || length < 2) {
        return;
    }
    int64_t x_q4 = line->x_q16 >> 12, y_q4 = line->y_q16 >> 12;
    iris_path path = {.width_px = width, .length_px = length, .angle = line->angle};
    path.x0 = within_side((int32_t)((x_q4 + ((low * line->dx) >> 30) + 8) >> 4), list->size.w);
    path.y0 = within_side((int32_t)((y_q4 + ((low * line->dy) >> 30) + 8) >> 4), list->size.h);
    path.x1 = within_side((int32_t)((x_q4 + ((high * line->dx) >> 30) + 8) >> 4), list->size.w);
    path.y1 = within_side((int32_t)((y_q4 + ((high * line->dy) >> 30) + 8) >> 4), list->size.h);
    if (path.y0 == path.y1 && path.x0 > path.x1) {
        int32_t x = path.x0;
        path.x0 = path.x1;
        path.x1 = x;
    }
    insert(list, &path);
}
