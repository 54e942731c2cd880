/* Points that do not fit the others: see calib_scene.h for the method. */
#include "iris/fixed.h"
#include "scene_parts.h"

#define SETS   128
#define SIX    IRIS_SCENE_POINTS_MIN
#define ROUNDS 6 /* the last of them with all points that are near */
#define LAST   3
#define TIMES  8                      /* the noise: farther off are wrong points */
#define EXACT  (IRIS_Q32_ONE / 65536) /* noise of the picture's spread below which all are right */

/* Distances of all points from where the matrix shows them. */
static void measure(iris_scene_problem *of, const iris_q32 m[IRIS_SCENE_NUMBERS])
{
    for (int32_t i = 0; i < of->count; i++) {
        iris_vec2 at;
        iris_q32 depth;
        of->distances[i] = INT64_MAX;
        if (iris_scene_show(&at, &depth, m, &of->pairs[i])) {
            iris_vec2 is = of->pairs[i].image;
            iris_vec3 off = iris_vec3_sub((iris_vec3){is.x, is.y, 0}, (iris_vec3){at.x, at.y, 0});
            of->distances[i] = iris_vec3_length(off);
        }
    }
}

/* The least number that `wanted` of the distances are not above. */
static iris_q32 quantile(const iris_scene_problem *of, int32_t wanted)
{
    iris_q32 found = 0;
    for (int bit = 62; bit >= 0; bit--) {
        iris_q32 below = found + ((iris_q32)1 << bit) - 1; /* is it above this? */
        int32_t n = 0;
        for (int32_t i = 0; i < of->count; i++) {
            n += of->distances[i] <= below;
        }
        found += n < wanted ? (iris_q32)1 << bit : 0;
    }
    return found;
}

/* Six different points, by a fixed sequence of random numbers. */
static void choose(iris_scene_problem *of, uint64_t *state)
{
    for (int32_t i = 0; i < of->count; i++) {
        of->used[i] = 0;
    }
    for (int chosen = 0; chosen < SIX;) {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        uint8_t *next = &of->used[(*state >> 16) % (uint64_t)of->count];
        chosen += !*next;
        *next = 1;
    }
}

/* Half of the points, and some for those that six points fit in any case. Rousseeuw and Leroy, Robust Regression. */
static int32_t half(const iris_scene_problem *of)
{
    return (of->count + SIX + 1) / 2;
}

/* Uses the nearer half of the points, or in the last rounds those nearer than TIMES the noise. It is told from the
 * half: normally distributed errors have half of their distances below 1.18 of it, and six points fit too well. */
static void use_near(iris_scene_problem *of, int round)
{
    iris_q32 limit = quantile(of, half(of));
    if (round >= ROUNDS - LAST) {
        limit = limit > IRIS_SCENE_FAR ? IRIS_SCENE_FAR : limit;
        limit = limit * (of->count - 1) / (of->count - SIX) * 217 / 256;
        limit = (limit > EXACT ? limit : EXACT) * TIMES;
    }
    for (int32_t i = 0; i < of->count; i++) {
        of->used[i] = of->distances[i] <= limit;
    }
}

int iris_scene_leave_out(iris_scene_problem *of)
{
    iris_q32 m[IRIS_SCENE_NUMBERS], best[IRIS_SCENE_NUMBERS], least = INT64_MAX;
    uint64_t state = 88172645463325252u;
    for (int set = 0; set < SETS; set++) {
        choose(of, &state);
        iris_scene_solve(m, of);
        measure(of, m);
        iris_q32 found = quantile(of, half(of));
        for (int k = 0; k < IRIS_SCENE_NUMBERS && found < least; k++) {
            best[k] = m[k];
        }
        least = found < least ? found : least;
    }
    if (least > IRIS_SCENE_FAR) {
        return 0;
    }
    measure(of, best);
    for (int round = 0; round < ROUNDS; round++) {
        use_near(of, round);
        iris_scene_solve(m, of);
        iris_scene_refine(m, of);
        measure(of, m);
    }
    use_near(of, ROUNDS);
    return 1;
}
