#include "iris/xt/floor.h"

#include "floor_parts.h"

#define ENTRY_BITS 46 /* of to_floor's numbers: a product of one of them and a place stays below 2^78 */

iris_wide iris_floor_row(const int64_t row[3], iris_place at)
{
    iris_wide sum = iris_wide_mul(row[2], IRIS_Q16_ONE);
    sum = iris_wide_add(sum, iris_wide_mul(row[0], at.x_q16));
    return iris_wide_add(sum, iris_wide_mul(row[1], at.y_q16));
}

/* a / b with 16 fraction bits, for 0 < b < 2^46 and |a| < 2^15 b. */
static iris_q16 quotient(int64_t a, int64_t b)
{
    int64_t whole = a / b, rest = a - whole * b;
    return (iris_q16)(whole * 65536 + iris_round_shift((rest * 131072) / b, 1));
}

int iris_floor_divide(iris_place *to, iris_wide x, iris_wide y, iris_wide w)
{
    int shift = iris_wide_bits(w) - 45;
    shift = shift < 0 ? 0 : shift;
    int64_t by = iris_wide_round_shift_sat(w, shift);
    int64_t most = by * 32767;
    int64_t right = iris_wide_round_shift_sat(x, shift), down = iris_wide_round_shift_sat(y, shift);
    if (by <= 0 || right > most || right < -most || down > most || down < -most) {
        return 0;
    }
    *to = (iris_place){quotient(right, by), quotient(down, by)};
    return 1;
}

static int project(iris_place *to, const int64_t m[9], iris_place at)
{
    return iris_floor_divide(to, iris_floor_row(m, at), iris_floor_row(m + 3, at), iris_floor_row(m + 6, at));
}

/* Where the rows and columns of the cofactor of each entry of the transposed matrix are. */
static const uint8_t other[3][2] = {{1, 2}, {2, 0}, {0, 1}};

/* Entry i of the adjugate. */
static iris_wide cofactor(const int64_t m[9], int i)
{
    const uint8_t *r = other[i % 3], *c = other[i / 3];
    return iris_wide_sub(iris_wide_mul(m[3 * r[0] + c[0]], m[3 * r[1] + c[1]]),
                         iris_wide_mul(m[3 * r[0] + c[1]], m[3 * r[1] + c[0]]));
}

/* The adjugate: as good an inverse as any, its scale does not matter. Returns the sign of the determinant. */
static int invert(int64_t inverse[9], const int64_t m[9])
{
    int bits = 0;
    for (int i = 0; i < 9; i++) {
        int needed = iris_wide_bits(cofactor(m, i));
        bits = needed > bits ? needed : bits;
    }
    int shift = bits > ENTRY_BITS ? bits - ENTRY_BITS : 0;
    iris_wide determinant = {0, 0};
    for (int i = 0; i < 9; i++) {
        inverse[i] = iris_wide_round_shift_sat(cofactor(m, i), shift);
    }
    for (int i = 0; i < 3; i++) {
        determinant = iris_wide_add(determinant, iris_wide_mul(m[i], inverse[3 * i]));
    }
    int sign = determinant.high < 0 ? -1 : determinant.high > 0 || determinant.low > 0;
    for (int i = 0; i < 9; i++) {
        inverse[i] *= sign;
    }
    return sign;
}

iris_status iris_floor_init(iris_floor *floor, iris_size size, const iris_q32 to_image_q32[9])
{
    if (!floor || !to_image_q32) {
        return IRIS_ERR_ARG;
    }
    if (size.w < 1 || size.w > IRIS_SIDE_MAX || size.h < 1 || size.h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    iris_floor made = {.size = size};
    for (int i = 0; i < 9; i++) {
        if (to_image_q32[i] > IRIS_FLOOR_ENTRY_MAX || to_image_q32[i] < -IRIS_FLOOR_ENTRY_MAX) {
            return IRIS_ERR_RANGE;
        }
        made.to_image_q32[i] = to_image_q32[i];
    }
    /* y is down in the picture and ahead on the floor: seen from above, the determinant is negative */
    if (invert(made.to_floor, made.to_image_q32) >= 0) {
        return IRIS_ERR_DATA;
    }
    *floor = made;
    return IRIS_OK;
}

iris_status iris_floor_point(iris_place *mm, const iris_floor *floor, iris_place image)
{
    if (!mm || !floor) {
        return IRIS_ERR_ARG;
    }
    return project(mm, floor->to_floor, image) ? IRIS_OK : IRIS_ERR_RANGE;
}

iris_status iris_floor_image(iris_place *image, const iris_floor *floor, iris_place mm)
{
    if (!image || !floor) {
        return IRIS_ERR_ARG;
    }
    return project(image, floor->to_image_q32, mm) ? IRIS_OK : IRIS_ERR_RANGE;
}

/* The angle of the vector (right, ahead), halves of it until both fit 31 bits. */
static iris_angle direction_of(int64_t right, int64_t ahead)
{
    while (right > INT32_MAX || right < -INT32_MAX || ahead > INT32_MAX || ahead < -INT32_MAX) {
        right /= 2;
        ahead /= 2;
    }
    return iris_atan2_angle((int32_t)right, (int32_t)ahead);
}

iris_status iris_floor_angle(iris_angle *angle, const iris_floor *floor, iris_place image,
                             iris_angle direction)
{
    iris_place mm;
    if (!angle || !floor) {
        return IRIS_ERR_ARG;
    }
    if (!project(&mm, floor->to_floor, image)) {
        return IRIS_ERR_RANGE;
    }
    /* d(x / w) = (dx - x / w dw) / w, and w is above 0 */
    iris_q30 right = iris_sin_q30(direction), down = -iris_cos_q30(direction);
    int64_t change[3];
    for (int i = 0; i < 3; i++) {
        const int64_t *row = floor->to_floor + 3 * i;
        change[i] = iris_wide_round_shift_sat(
            iris_wide_add(iris_wide_mul(row[0], right), iris_wide_mul(row[1], down)), 30);
    }
    iris_wide x = iris_wide_sub(iris_wide_mul(change[0], IRIS_Q16_ONE), iris_wide_mul(change[2], mm.x_q16));
    iris_wide y = iris_wide_sub(iris_wide_mul(change[1], IRIS_Q16_ONE), iris_wide_mul(change[2], mm.y_q16));
    int bits = iris_wide_bits(x) > iris_wide_bits(y) ? iris_wide_bits(x) : iris_wide_bits(y);
    int shift = bits > 62 ? bits - 62 : 0;
    *angle = direction_of(iris_wide_round_shift_sat(x, shift), iris_wide_round_shift_sat(y, shift));
    return IRIS_OK;
}

iris_status iris_floor_segment(iris_floor_line *line, const iris_floor *floor, iris_place a, iris_place b)
{
    if (!line || !floor) {
        return IRIS_ERR_ARG;
    }
    iris_floor_line made;
    if (!project(&made.a, floor->to_floor, a) || !project(&made.b, floor->to_floor, b)) {
        return IRIS_ERR_RANGE;
    }
    int64_t right = (int64_t)made.b.x_q16 - made.a.x_q16, ahead = (int64_t)made.b.y_q16 - made.a.y_q16;
    /* at most 2^32 each: halved twice, so that their squares can be added */
    uint64_t square = (uint64_t)((right / 4) * (right / 4)) + (uint64_t)((ahead / 4) * (ahead / 4));
    uint64_t length = square >> 58 ? 4 * (uint64_t)iris_sqrt_u64(square)
                                   : iris_sqrt_u64((uint64_t)(right * right) + (uint64_t)(ahead * ahead));
    if (length > INT32_MAX) {
        return IRIS_ERR_RANGE;
    }
    made.length_q16 = (iris_q16)length;
    made.angle = direction_of(right, ahead);
    *line = made;
    return IRIS_OK;
}

iris_status iris_floor_foot(iris_place *mm, const iris_floor *floor, iris_rect box)
{
    if (!mm || !floor) {
        return IRIS_ERR_ARG;
    }
    if (box.x < 0 || box.y < 0 || box.w < 1 || box.h < 1 || box.x > IRIS_SIDE_MAX - box.w ||
        box.y > IRIS_SIDE_MAX - box.h) {
        return IRIS_ERR_RANGE;
    }
    iris_place foot = {box.x * 65536 + (box.w - 1) * 32768, (box.y + box.h) * 65536 - 32768};
    return iris_floor_point(mm, floor, foot);
}
