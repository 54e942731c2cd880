#include "iris/wide.h"

#include "iris/fixed.h"

#define LOW32 0xFFFFFFFFu

static uint64_t magnitude(int64_t value)
{
    return value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
}

iris_wide iris_wide_mul(int64_t a, int64_t b)
{
    uint64_t x = magnitude(a), y = magnitude(b);
    uint64_t x0 = x & LOW32, x1 = x >> 32, y0 = y & LOW32, y1 = y >> 32;
    uint64_t low = x0 * y0;
    uint64_t middle = x1 * y0 + (low >> 32); /* below 2^64: (2^32 - 1)^2 + 2^32 - 1 */
    uint64_t other = x0 * y1 + (middle & LOW32);
    iris_wide product = {(int64_t)(x1 * y1 + (middle >> 32) + (other >> 32)), other << 32 | (low & LOW32)};
    return (a < 0) != (b < 0) ? iris_wide_negate(product) : product;
}

static int bits_of(uint64_t value)
{
    int bits = 0;
    for (int step = 32; step > 0; step /= 2) {
        if (value >> step) {
            value >>= step;
            bits += step;
        }
    }
    return bits + (value != 0);
}

int iris_wide_bits(iris_wide a)
{
    iris_wide m = a.high < 0 ? iris_wide_negate(a) : a;
    return m.high ? 64 + bits_of((uint64_t)m.high) : bits_of(m.low);
}

static int64_t saturated(iris_wide a)
{
    if (a.high == (a.low >> 63 ? -1 : 0)) {
        return (int64_t)a.low;
    }
    return a.high < 0 ? INT64_MIN : INT64_MAX;
}

int64_t iris_wide_round_shift_sat(iris_wide a, int bits)
{
    if (bits == 0) {
        return saturated(a);
    }
    uint64_t half = bits > 64 ? (uint64_t)(a.high >> (bits - 65)) & 1 : a.low >> (bits - 1) & 1;
    iris_wide down = {a.high < 0 ? -1 : 0, (uint64_t)a.high};
    if (bits < 64) {
        down = (iris_wide){a.high >> bits, a.low >> bits | (uint64_t)a.high << (64 - bits)};
    } else if (bits > 64) {
        down.low = (uint64_t)(a.high >> (bits - 64));
    }
    return saturated(iris_wide_add(down, (iris_wide){0, half}));
}

int64_t iris_wide_div_sat(iris_wide a, int64_t b)
{
    if (b == 0) {
        return a.high < 0 ? INT64_MIN : a.high > 0 || a.low > 0 ? INT64_MAX : 0;
    }
    int negative = (a.high < 0) != (b < 0);
    iris_wide m = a.high < 0 ? iris_wide_negate(a) : a;
    uint64_t rest = (uint64_t)m.high, by = magnitude(b), quotient = 0;
    if (rest >= by) {
        return negative ? INT64_MIN : INT64_MAX;
    }
    if (rest == 0) {
        quotient = m.low / by;
        rest = m.low % by;
    } else {
        for (int i = 63; i >= 0; i--) {
            rest = rest << 1 | (m.low >> i & 1); /* below 2^64: rest < by <= 2^63 */
            if (rest >= by) {
                rest -= by;
                quotient |= (uint64_t)1 << i;
            }
        }
    }
    quotient += rest >= by - rest && quotient < UINT64_MAX;
    if (quotient > (uint64_t)INT64_MAX) {
        return negative ? INT64_MIN : INT64_MAX;
    }
    return negative ? -(int64_t)quotient : (int64_t)quotient;
}

/* root^2 > a */
static int above_root(int64_t root, iris_wide a)
{
    return iris_wide_sub(a, iris_wide_mul(root, root)).high < 0;
}

int64_t iris_wide_sqrt(iris_wide a)
{
    int shift = (iris_wide_bits(a) - 61) / 2; /* half of what brings a below 2^63 */
    if (a.high < 0 || (a.high == 0 && a.low == 0)) {
        return 0;
    }
    if (shift <= 0) {
        return (int64_t)iris_sqrt_u64(a.low);
    }
    int64_t top = iris_wide_round_shift_sat(a, 2 * shift);
    int64_t near = (int64_t)iris_sqrt_u64((uint64_t)top) << shift; /* 30 bits of it are right */
    int64_t root = near / 2 + iris_wide_div_sat(a, near) / 2 + 1;  /* twice as many, by Newton */
    while (above_root(root, a)) {
        root--;
    }
    return root;
}
