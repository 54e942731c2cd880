/* Where a camera moves to that does not turn: see calib_motion.h. The lines through both places of each match meet at the
 * focus; equations are weighted so that each is the distance of a place from the line through the focus and the other. */
#include "iris/fixed.h"
#include "motion_parts.h"

#define NUMBERS 3
#define ROUNDS  10
#define MOVED   ((iris_q32)1 << 20) /* 2^-12 of half a picture: a match that moves by less says nothing */
#define SECOND  64 /* of the second smallest singular value to the length of all, that many matches */
#define OFF     (IRIS_Q32_ONE / 64) /* so much is left over of a motion that is another one */

static iris_q32 mul(iris_q32 a, iris_q32 b)
{
    return iris_q32_mul_sat(a, b);
}

/* The line through both places: 0 when the match hardly moves. */
static int line_of(iris_vec3 *line, const iris_match *at)
{
    const iris_q32 right = at->to.x - at->from.x, down = at->to.y - at->from.y;
    *line = iris_vec3_cross((iris_vec3){at->from.x, at->from.y, IRIS_Q32_ONE},
                            (iris_vec3){at->to.x, at->to.y, IRIS_Q32_ONE});
    return right > MOVED || right < -MOVED || down > MOVED || down < -MOVED;
}

/* How far the focus is from the first place, times its third number: what a distance from the line is divided by. */
static iris_q32 reach_of(const iris_vec3 *focus, const iris_match *at)
{
    const iris_vec3 to = {focus->x - mul(focus->z, at->from.x), focus->y - mul(focus->z, at->from.y), 0};
    const iris_q32 length = iris_vec3_length(to);
    return length < MOVED ? MOVED : length;
}

/* The focus of all matches by weights that come of the last one. Returns how many move. */
static int32_t solve(iris_vec3 *focus, iris_triangle *triangle, const iris_motion_problem *of, int weighted)
{
    int32_t moving = 0;
    iris_triangle_init(triangle, triangle->numbers, NUMBERS);
    for (int32_t i = 0; i < of->pairs[0].count; i++) {
        const iris_match at = iris_motion_scaled(of, &of->pairs[0].matches[i]);
        iris_vec3 line;
        if (!line_of(&line, &at)) {
            continue;
        }
        const iris_q32 by = weighted ? reach_of(focus, &at) : IRIS_Q32_ONE;
        iris_q32 row[NUMBERS + 1] = {iris_q32_div_sat(line.x, by), iris_q32_div_sat(line.y, by),
                                     iris_q32_div_sat(line.z, by), 0};
        iris_triangle_add(triangle, row);
        moving++;
    }
    iris_q32 v[NUMBERS];
    (void)iris_null_vector(v, triangle);
    *focus = (iris_vec3){v[0], v[1], v[2]};
    return moving;
}

/* The sum of squared distances, and how many matches go away from the focus less those that come nearer. */
static iris_wide squares(int32_t *away, const iris_motion_problem *of, iris_vec3 focus)
{
    iris_wide sum = {0, 0};
    *away = 0;
    for (int32_t i = 0; i < of->pairs[0].count; i++) {
        const iris_match at = iris_motion_scaled(of, &of->pairs[0].matches[i]);
        iris_vec3 line;
        if (line_of(&line, &at)) {
            const iris_q32 off = iris_q32_div_sat(iris_vec3_dot(line, focus), reach_of(&focus, &at));
            const iris_vec3 from = {mul(at.from.x, focus.z) - focus.x, mul(at.from.y, focus.z) - focus.y, 0};
            const iris_vec3 way = {at.to.x - at.from.x, at.to.y - at.from.y, 0};
            const iris_q32 along = iris_vec3_dot(from, way);
            sum = iris_wide_add(sum, iris_wide_mul(off, off));
            *away += (along > 0) - (along < 0);
        }
    }
    return sum;
}

/* Deviations of the place in the frame if noise is 1: of two numbers, with the focus's third one fixed. */
static iris_vec2 deviation_of(const iris_triangle *t, iris_vec3 focus)
{
    const iris_q32 a = *iris_triangle_at(t, 0, 0), b = *iris_triangle_at(t, 0, 1),
                   d = *iris_triangle_at(t, 1, 1);
    const iris_q32 y = iris_q32_div_sat(IRIS_Q32_ONE, d < 0 ? -d : d);
    const iris_q32 x = iris_q32_div_sat(IRIS_Q32_ONE, a < 0 ? -a : a);
    const iris_q32 lean = iris_q32_div_sat(mul(b, y), a == 0 ? 1 : a), z = focus.z < 0 ? -focus.z : focus.z;
    return (iris_vec2){iris_q32_div_sat(iris_vec3_length((iris_vec3){x, lean, 0}), z),
                       iris_q32_div_sat(y, z)};
}

/* The focus in pixels: K t. */
static void take_focus(iris_translation_fit *fit, const iris_motion_problem *of, iris_vec3 focus)
{
    iris_q32 at[NUMBERS] = {mul(focus.x, of->reach) + mul(focus.z, of->middle.x),
                            mul(focus.y, of->reach) + mul(focus.z, of->middle.y), focus.z};
    fit->ahead = focus.z >= 0;
    fit->pixel = (iris_vec2){iris_q32_div_sat(at[0], at[2]), iris_q32_div_sat(at[1], at[2])};
    iris_numbers_normalize(at, NUMBERS);
    fit->focus = (iris_vec3){at[0], at[1], at[2]};
}

iris_motion_flaw iris_motion_find_focus(iris_translation_fit *fit, const iris_motion_problem *of)
{
    iris_q32 numbers[IRIS_TRIANGLE_NUMBERS(NUMBERS)], second[NUMBERS];
    iris_triangle triangle = {numbers, NUMBERS};
    iris_vec3 focus = {0, 0, 0};
    int32_t away;
    if (of->pairs[0].count < IRIS_MOTION_MATCHES_MIN) {
        return IRIS_MOTION_TOO_FEW;
    }
    int32_t moving = solve(&focus, &triangle, of, 0);
    if (moving < IRIS_MOTION_MATCHES_MIN) {
        return IRIS_MOTION_STILL;
    }
    for (int round = 0; round < ROUNDS; round++) {
        moving = solve(&focus, &triangle, of, 1);
    }
    const iris_q32 v[NUMBERS] = {focus.x, focus.y, focus.z};
    const iris_wide sum = squares(&away, of, focus);
    const iris_q32 left = iris_motion_root_mean(sum, moving);
    const iris_q32 noise = iris_motion_root_mean(sum, moving - 2);
    if (iris_null_vector_beside(second, &triangle, v) <= iris_numbers_length(numbers, 9) / SECOND) {
        return IRIS_MOTION_IN_LINE;
    }
    /* everything goes away from where the camera moves to, or comes nearer to where it comes from */
    if (left > OFF || (away < 0 ? -away : away) < moving / 2) {
        return IRIS_MOTION_OTHER;
    }
    const iris_vec2 deviation = deviation_of(&triangle, focus);
    fit->rms = mul(left, of->reach);
    fit->deviation =
        (iris_vec2){mul(mul(deviation.x, noise), of->reach), mul(mul(deviation.y, noise), of->reach)};
    take_focus(fit, of, away < 0 ? iris_vec3_scale(focus, -IRIS_Q32_ONE) : focus);
    return IRIS_MOTION_FINE;
}
