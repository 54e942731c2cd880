#include "shape_heights.h"

#define POINTS IRIS_SHAPE_POINTS
#define GROUPS IRIS_SHAPE_HEIGHTS_PER_POINT
#define BAND   (2 * IRIS_SHAPE_GIVE + 1)
#define FAR    ((int32_t)1 << 30)

/* The way to a pair of points: from the pair before in both outlines, in the model alone, or in the shape alone. */
enum { BOTH, MODEL, SHAPE };

static int around(int i)
{
    return i & (POINTS - 1);
}

/* How high the other points are over the tangent of a point, on the inner side, by groups of three along the outline. */
static void heights_of_point(uint8_t *to, const iris_shape *s, int i)
{
    int32_t along_x = s->x[around(i + 1)] - s->x[around(i - 1)];
    int32_t along_y = s->y[around(i + 1)] - s->y[around(i - 1)];
    int32_t length = (int32_t)iris_hypot(along_x, along_y);
    /* 3 points and 8192 units to 256 steps: 96 to 1 */
    int64_t scale_q24 = length == 0 ? 0 : ((int64_t)1 << 24) / (96 * (int64_t)length);
    for (int group = 0, k = i + 1; group < GROUPS; group++, k += 3) {
        int a = around(k), b = around(k + 1), c = around(k + 2);
        int32_t x = s->x[a] + s->x[b] + s->x[c] - 3 * s->x[i];
        int32_t y = s->y[a] + s->y[b] + s->y[c] - 3 * s->y[i];
        int64_t height = iris_round_shift(((int64_t)along_x * y - (int64_t)along_y * x) * scale_q24, 24);
        to[group] = (uint8_t)(height < -128 ? 0 : height > 127 ? 255 : height + 128);
    }
}

void iris_shape_heights_of(iris_shape_heights *heights, const iris_shape *shape)
{
    for (int i = 0; i < POINTS; i++) {
        heights_of_point(heights[i], shape, i);
    }
}

/* The heights of the mirror image, whose outline runs the other way. */
static void mirror(iris_shape_heights *to, iris_shape_heights *from)
{
    for (int i = 0; i < POINTS; i++) {
        for (int group = 0; group < GROUPS; group++) {
            to[i][group] = from[around(-i)][GROUPS - 1 - group];
        }
    }
}

static int32_t difference(const uint8_t *a, const uint8_t *b)
{
    int32_t sum = 0;
    for (int group = 0; group < GROUPS; group++) {
        int32_t d = a[group] - b[group];
        sum += d < 0 ? -d : d;
    }
    return sum;
}

/* The start in the model from which the outlines, point by point, differ least. */
static int best_start(int32_t *least, iris_shape_heights *shape, iris_shape_heights *model)
{
    int best = 0;
    *least = FAR;
    for (int start = 0; start < POINTS; start++) {
        int32_t sum = 0;
        for (int i = 0; i < POINTS && sum < *least; i++) {
            sum += difference(shape[i], model[around(i + start)]);
        }
        if (sum < *least) {
            *least = sum;
            best = start;
        }
    }
    return best;
}

/* Lays the outlines on each other from point 0 to the last, one at most IRIS_SHAPE_GIVE points ahead of the other: the
 * sum of differences along the best way; ways[point][ahead] tells it, back from the end. */
static int32_t warp(uint8_t *ways, iris_shape_heights *shape, iris_shape_heights *model, int start)
{
    int32_t sums[BAND + 2];
    for (int k = 0; k < BAND + 2; k++) {
        sums[k] = FAR;
    }
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < BAND; k++) { /* sums[k + 1] is still of the point before, sums[k] of this one */
            int j = i + k - IRIS_SHAPE_GIVE;
            int32_t least = i == 0 && j == 0 ? 0 : sums[k + 1];
            uint8_t way = BOTH;
            if (sums[k] < least) {
                least = sums[k];
                way = MODEL;
            }
            if (sums[k + 2] < least) {
                least = sums[k + 2];
                way = SHAPE;
            }
            int inside = j >= 0 && j < POINTS && least < FAR;
            sums[k + 1] = inside ? least + difference(shape[i], model[around(j + start)]) : FAR;
            ways[i * BAND + k] = way;
        }
    }
    return sums[IRIS_SHAPE_GIVE + 1];
}

/* The turn that lays the model's points on the shape's best, pairs being those along the way. */
static iris_angle turn_of(const uint8_t *ways, const iris_shape *shape, const iris_shape *model, int start,
                          int mirrored)
{
    int64_t dot = 0, cross = 0;
    int i = POINTS - 1, k = IRIS_SHAPE_GIVE;
    for (int steps = 0; steps < 2 * POINTS && i >= 0; steps++) {
        int j = around(i + k - IRIS_SHAPE_GIVE + start);
        int64_t x = mirrored ? -model->x[around(-j)] : model->x[j];
        int64_t y = mirrored ? model->y[around(-j)] : model->y[j];
        dot += x * shape->x[i] + y * shape->y[i];
        cross += x * shape->y[i] - y * shape->x[i];
        int way = ways[i * BAND + k];
        i -= way != MODEL;
        k += way == SHAPE ? 1 : way == MODEL ? -1 : 0;
    }
    return iris_atan2_angle((int32_t)(cross >> 3), (int32_t)(dot >> 3)); /* 128 pairs of 2^25: below 2^32 */
}

/* How much the heights of an outline vary along it, summed like differences: little of a disc, much of a fork. */
static int32_t variety(iris_shape_heights *heights)
{
    int32_t sum = 0;
    for (int group = 0; group < GROUPS; group++) {
        int32_t mean = POINTS / 2;
        for (int i = 0; i < POINTS; i++) {
            mean += heights[i][group];
        }
        mean /= POINTS;
        for (int i = 0; i < POINTS; i++) {
            int32_t d = heights[i][group] - mean;
            sum += d < 0 ? -d : d;
        }
    }
    return sum;
}

/* 0 when the outlines differ by as much as they vary. */
static int32_t score_of(int32_t sum, int32_t most)
{
    if (sum == 0) {
        return IRIS_Q16_ONE; /* straight lines do not vary at all */
    }
    return sum >= most ? 0 : (int32_t)((int64_t)(most - sum) * IRIS_Q16_ONE / most);
}

iris_shape_likeness iris_shape_heights_compare(const iris_shape_memory *memory, const iris_shape *shape,
                                               const iris_shape *model, int mirrored)
{
    iris_shape_likeness best = {-1, 0, 0};
    iris_shape_heights_of(memory->model, model);
    int32_t most = (variety(memory->shape) + variety(memory->model)) / 2;
    for (int other = 0; other <= mirrored; other++) {
        iris_shape_heights *heights = other ? memory->mirrored : memory->model;
        if (other) {
            mirror(heights, memory->model);
        }
        int32_t least;
        int start = best_start(&least, memory->shape, heights);
        iris_q16 score = score_of(warp(memory->ways, memory->shape, heights, start), most);
        if (score > best.score_q16 + (other ? IRIS_SHAPE_MIRROR_LEAD_Q16 : 0)) {
            best = (iris_shape_likeness){score, turn_of(memory->ways, shape, model, start, other), other};
        }
    }
    return best;
}
