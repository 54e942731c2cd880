/* The refined solution: Levenberg and Marquardt's steps in the twelve numbers. Their length is of no account: the
 * damping keeps it. */
#include "scene_parts.h"

#define ROUNDS   40
#define DAMPING  (IRIS_Q32_ONE / 64)
#define ENDS     ((iris_q32)1 << 42) /* of the damping: no step is small enough */
#define SINGULAR 1
#define STEEP    ((iris_q32)1 << 50) /* of what changes: equations keep within numbers */
#define ENOUGH   40                  /* bits by which the sum is less than what a round gains */

static iris_q32 limited(iris_q32 a)
{
    return a > STEEP ? STEEP : a < -STEEP ? -STEEP : a;
}

/* (X, 1) / depth at the row of `first`, -t (X, 1) / depth at the last one; the error to the right. */
static void add_row(iris_scene_problem *of, const iris_scene_pair *pair, int first, const iris_q32 shown[3])
{
    const iris_q32 at[4] = {pair->world.x, pair->world.y, pair->world.z, IRIS_Q32_ONE};
    iris_q32 row[IRIS_SCENE_NUMBERS + 1] = {0};
    for (int k = 0; k < 4; k++) {
        row[first + k] = limited(iris_q32_div_sat(at[k], shown[1]));
        row[8 + k] = limited(-iris_q32_mul_sat(shown[0], row[first + k]));
    }
    row[IRIS_SCENE_NUMBERS] = shown[2];
    iris_triangle_add(&of->triangle, row);
}

/* The sum of squared distances, and in the triangle the step that makes it less. Returns 0: some point is behind. */
static int linearize(iris_wide *sum, iris_scene_problem *of, const iris_q32 m[IRIS_SCENE_NUMBERS],
                     iris_q32 damping)
{
    iris_triangle_init(&of->triangle, of->triangle.numbers, IRIS_SCENE_NUMBERS);
    *sum = (iris_wide){0, 0};
    for (int32_t i = 0; i < of->count; i++) {
        const iris_scene_pair *pair = &of->pairs[i];
        iris_vec2 at;
        iris_q32 depth;
        if (!of->used[i]) {
            continue;
        }
        if (!iris_scene_show(&at, &depth, m, pair)) {
            return 0;
        }
        iris_q32 right = pair->image.x - at.x, down = pair->image.y - at.y;
        *sum = iris_wide_add(*sum, iris_wide_add(iris_wide_mul(right, right), iris_wide_mul(down, down)));
        add_row(of, pair, 0, (const iris_q32[3]){at.x, depth, right});
        add_row(of, pair, 4, (const iris_q32[3]){at.y, depth, down});
    }
    for (int k = 0; k < IRIS_SCENE_NUMBERS; k++) {
        iris_q32 row[IRIS_SCENE_NUMBERS + 1] = {0};
        row[k] = damping;
        iris_triangle_add(&of->triangle, row);
    }
    return 1;
}

void iris_scene_refine(iris_q32 m[IRIS_SCENE_NUMBERS], iris_scene_problem *of)
{
    iris_q32 step[IRIS_SCENE_NUMBERS], better[IRIS_SCENE_NUMBERS], damping = DAMPING;
    iris_wide least, sum;
    int known = linearize(&least, of, m, damping);
    for (int round = 0; round < ROUNDS && known && damping < ENDS; round++) {
        if (!iris_triangle_solve(step, &of->triangle, SINGULAR)) {
            break;
        }
        for (int k = 0; k < IRIS_SCENE_NUMBERS; k++) {
            better[k] =
                iris_wide_round_shift_sat(iris_wide_add(iris_wide_from(m[k]), iris_wide_from(step[k])), 0);
        }
        iris_numbers_normalize(better, IRIS_SCENE_NUMBERS);
        int good = linearize(&sum, of, better, damping / 8 + 1);
        iris_wide gain = iris_wide_sub(least, sum);
        if (good && gain.high >= 0 && iris_wide_bits(gain) > 0) {
            for (int k = 0; k < IRIS_SCENE_NUMBERS; k++) {
                m[k] = better[k];
            }
            damping = damping / 8 + 1;
            if (iris_wide_bits(gain) + ENOUGH < iris_wide_bits(least)) {
                break;
            }
            least = sum;
        } else {
            damping *= 16;
            known = linearize(&sum, of, m, damping);
        }
    }
}
