/* The linear solution: see calib_scene.h for the method. */
#include "iris/fixed.h"
#include "scene_parts.h"

#define THIN   4096                /* flat: a variance across of 1/4096 of that along, or less */
#define SECOND 4096                /* the second smallest singular value is above that share of all */
#define NEAR   ((iris_q32)1 << 12) /* 2^-20: a depth below is none */

/* Mean of a coordinate of the points used. */
static iris_q32 mean(iris_wide sum, int32_t n)
{
    return iris_wide_div_sat(sum, n);
}

static void middle_of(iris_scene_problem *of, int32_t *n)
{
    iris_wide sums[5] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}};
    *n = 0;
    for (int32_t i = 0; i < of->count; i++) {
        const iris_scene_point *p = &of->points[i];
        const iris_q32 at[5] = {p->world.x, p->world.y, p->world.z, p->image.x, p->image.y};
        for (int k = 0; k < 5 && of->used[i]; k++) {
            sums[k] = iris_wide_add(sums[k], iris_wide_from(at[k]));
        }
        *n += of->used[i];
    }
    of->middle = (iris_vec3){mean(sums[0], *n), mean(sums[1], *n), mean(sums[2], *n)};
    of->image_middle = (iris_vec2){mean(sums[3], *n), mean(sums[4], *n)};
}

static iris_vec2 beside(const iris_scene_problem *of, int32_t i)
{
    iris_vec2 at = of->points[i].image;
    return (iris_vec2){at.x - of->image_middle.x, at.y - of->image_middle.y};
}

/* The root of a sum of squares divided by n. */
static iris_q32 root_mean(iris_wide sum, int32_t n)
{
    return iris_wide_div_sat(iris_wide_mul(iris_wide_sqrt(sum), 65536), iris_sqrt_u64((uint64_t)n << 32));
}

int iris_scene_normalize(iris_scene_problem *of)
{
    int32_t n;
    iris_wide space = {0, 0}, image = {0, 0};
    middle_of(of, &n);
    for (int32_t i = 0; i < of->count; i++) {
        iris_vec3 off = iris_vec3_sub(of->points[i].world, of->middle);
        iris_vec2 at = beside(of, i);
        iris_q32 far = of->used[i] ? iris_vec3_length(off) : 0;
        iris_q32 wide = of->used[i] ? iris_vec3_length((iris_vec3){at.x, at.y, 0}) : 0;
        far = iris_wide_round_shift_sat(iris_wide_from(far), 6); /* squares of a thousand fit */
        wide = iris_wide_round_shift_sat(iris_wide_from(wide), 6);
        space = iris_wide_add(space, iris_wide_mul(far, far));
        image = iris_wide_add(image, iris_wide_mul(wide, wide));
    }
    of->reach = root_mean(space, n) * 64;
    of->image_reach = root_mean(image, n) * 64;
    if (of->reach == 0 || of->image_reach == 0) {
        return 0;
    }
    for (int32_t i = 0; i < of->count; i++) {
        iris_vec3 off = iris_vec3_sub(of->points[i].world, of->middle);
        iris_vec2 at = beside(of, i);
        of->pairs[i].world =
            (iris_vec3){iris_q32_div_sat(off.x, of->reach), iris_q32_div_sat(off.y, of->reach),
                        iris_q32_div_sat(off.z, of->reach)};
        of->pairs[i].image =
            (iris_vec2){iris_q32_div_sat(at.x, of->image_reach), iris_q32_div_sat(at.y, of->image_reach)};
    }
    return 1;
}

/* Sums over pairs: how many, their coordinates, and the products of two. */
typedef struct {
    int32_t n;
    iris_q32 first[3], second[3][3];
} moments;

static void moments_add(moments *sums, iris_vec3 at, int32_t times)
{
    const iris_q32 p[3] = {at.x, at.y, at.z};
    sums->n += times;
    for (int i = 0; i < 3; i++) {
        sums->first[i] += times * p[i];
        for (int k = 0; k < 3; k++) {
            sums->second[i][k] += times * iris_q32_mul_sat(p[i], p[k]);
        }
    }
}

/* Is the smallest variance in any direction that small a share of all? It is about the determinant of the covariances
 * divided by the sum of the determinants of two of them. */
static int is_thin(const moments *sums)
{
    iris_q32 c[3][3], trace = 0;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            iris_q32 means = iris_q32_mul_sat(sums->first[i] / sums->n, sums->first[k]);
            c[i][k] = (sums->second[i][k] - means) / sums->n;
        }
        trace += c[i][i];
    }
    iris_vec3 x = {c[0][0], c[0][1], c[0][2]}, y = {c[1][0], c[1][1], c[1][2]},
              z = {c[2][0], c[2][1], c[2][2]};
    iris_vec3 yz = iris_vec3_cross(y, z), zx = iris_vec3_cross(z, x), xy = iris_vec3_cross(x, y);
    iris_q32 pairs = yz.x + zx.y + xy.z, all = iris_vec3_dot(x, yz);
    return all <= iris_q32_mul_sat(pairs, trace) / THIN;
}

int iris_scene_is_flat(const iris_scene_problem *of)
{
    moments all = {0, {0, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    int thin = 0;
    for (int32_t i = 0; i < of->count; i++) {
        if (of->used[i]) {
            moments_add(&all, of->pairs[i].world, 1);
        }
    }
    for (int32_t i = 0; i < of->count && !thin; i++) {
        moments rest = all;
        if (of->used[i]) {
            moments_add(&rest, of->pairs[i].world, -1);
            thin = is_thin(&rest);
        }
    }
    return thin;
}

int iris_scene_is_line(const iris_scene_problem *of)
{
    iris_q32 xx = 0, xy = 0, yy = 0; /* of a spread of 1 about 0, together: no more than a thousand */
    for (int32_t i = 0; i < of->count; i++) {
        iris_vec2 at = of->pairs[i].image;
        if (of->used[i]) {
            xx += iris_q32_mul_sat(at.x, at.x);
            xy += iris_q32_mul_sat(at.x, at.y);
            yy += iris_q32_mul_sat(at.y, at.y);
        }
    }
    iris_wide across = iris_wide_sub(iris_wide_mul(xx, yy), iris_wide_mul(xy, xy));
    return iris_wide_sub(across, iris_wide_mul((xx + yy) / THIN, xx + yy)).high < 0;
}

/* Of a row of the matrix with the place of a pair. */
static iris_q32 product(const iris_q32 row[4], iris_vec3 at)
{
    iris_wide sum = iris_wide_add(iris_wide_mul(row[0], at.x), iris_wide_mul(row[1], at.y));
    sum = iris_wide_add(sum, iris_wide_add(iris_wide_mul(row[2], at.z), iris_wide_mul(row[3], IRIS_Q32_ONE)));
    return iris_wide_round_shift_sat(sum, 32);
}

int iris_scene_show(iris_vec2 *at, iris_q32 *depth, const iris_q32 m[IRIS_SCENE_NUMBERS],
                    const iris_scene_pair *pair)
{
    *depth = product(m + 8, pair->world);
    if (*depth < NEAR) {
        return 0;
    }
    *at = (iris_vec2){iris_q32_div_sat(product(m, pair->world), *depth),
                      iris_q32_div_sat(product(m + 4, pair->world), *depth)};
    return at->x < IRIS_SCENE_FAR && at->x > -IRIS_SCENE_FAR && at->y < IRIS_SCENE_FAR &&
           at->y > -IRIS_SCENE_FAR;
}

/* (X, 1) at the row of `first`, and -t (X, 1) at the last one. */
static void add_equation(iris_scene_problem *of, const iris_scene_pair *pair, int first, iris_q32 t)
{
    const iris_q32 at[4] = {pair->world.x, pair->world.y, pair->world.z, IRIS_Q32_ONE};
    iris_q32 row[IRIS_SCENE_NUMBERS + 1] = {0};
    for (int k = 0; k < 4; k++) {
        row[first + k] = at[k];
        row[8 + k] = -iris_q32_mul_sat(t, at[k]);
    }
    iris_triangle_add(&of->triangle, row);
}

void iris_scene_solve(iris_q32 m[IRIS_SCENE_NUMBERS], iris_scene_problem *of)
{
    int32_t ahead = 0;
    iris_triangle_init(&of->triangle, of->triangle.numbers, IRIS_SCENE_NUMBERS);
    for (int32_t i = 0; i < of->count; i++) {
        if (of->used[i]) {
            add_equation(of, &of->pairs[i], 0, of->pairs[i].image.x);
            add_equation(of, &of->pairs[i], 4, of->pairs[i].image.y);
        }
    }
    (void)iris_null_vector(m, &of->triangle);
    for (int32_t i = 0; i < of->count; i++) {
        iris_q32 depth = of->used[i] ? product(m + 8, of->pairs[i].world) : 0;
        ahead += (depth > 0) - (depth < 0);
    }
    for (int k = 0; k < IRIS_SCENE_NUMBERS && ahead < 0; k++) {
        m[k] = -m[k];
    }
}

int iris_scene_is_single(const iris_scene_problem *of)
{
    iris_q32 m[IRIS_SCENE_NUMBERS], second[IRIS_SCENE_NUMBERS];
    iris_q32 least = iris_null_vector(m, &of->triangle);
    iris_q32 next = iris_null_vector_beside(second, &of->triangle, m);
    iris_q32 all = iris_numbers_length(of->triangle.numbers, IRIS_TRIANGLE_NUMBERS(IRIS_SCENE_NUMBERS));
    return next > all / SECOND && least < next / 2;
}
