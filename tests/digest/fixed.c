#include "digest.h"

#include "iris/fixed.h"

/* Any size of number, small ones as often as large ones. */
static int32_t number(void)
{
    uint32_t high = digest_random() << 8;
    int32_t bits = (int32_t)(digest_random() % 31);
    return (int32_t)(high | (digest_random() & 255)) >> bits;
}

static void products(void)
{
    for (int i = 0; i < 2000; i++) {
        int32_t a = number();
        int32_t b = number();
        digest_number(iris_q16_mul_sat(a, b));
        digest_number(iris_q30_mul_sat(a, b));
        digest_number(iris_add_sat(a, b));
        digest_number(iris_sub_sat(a, b));
    }
}

static void quotients(void)
{
    for (int i = 0; i < 2000; i++) {
        int32_t a = number();
        int32_t b = number();
        digest_number(iris_q16_div_sat(a, b));
        digest_number(iris_q30_div_sat(a, b));
    }
}

static void roots(void)
{
    for (int i = 0; i < 1000; i++) {
        int32_t a = number();
        int32_t b = number();
        digest_number(iris_sqrt_u32((uint32_t)a));
        digest_number(iris_sqrt_u64((uint64_t)(uint32_t)a << 32 | (uint32_t)b));
        digest_number(iris_hypot(a, b));
    }
}

static void sine(void)
{
    for (int32_t angle = -32768; angle < 32768; angle += 7) {
        digest_number(iris_sin_q30((iris_angle)angle));
        digest_number(iris_cos_q30((iris_angle)angle));
    }
}

static void arc_tangent(void)
{
    for (int i = 0; i < 4000; i++) {
        int32_t y = number();
        int32_t x = number();
        digest_number(iris_atan2_angle(y, x));
    }
}

const digest_operation digest_fixed[] = {
    {"fixed.products", products}, {"fixed.quotients", quotients},     {"fixed.roots", roots},
    {"fixed.sine", sine},         {"fixed.arc_tangent", arc_tangent}, {NULL, NULL},
};
