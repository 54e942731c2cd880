/* Otsu's threshold with an exact comparison: the variances are fractions of up to 250 bits. */
#include "iris/xt/threshold.h"

/* A natural number: `count` words, least significant first, without leading zeros. */
typedef struct {
    uint32_t word[8];
    int32_t count;
} natural;

static void natural_trim(natural *a)
{
    while (a->count > 0 && a->word[a->count - 1] == 0) {
        a->count--;
    }
}

static natural natural_make(uint64_t value)
{
    natural a = {{(uint32_t)value, (uint32_t)(value >> 32)}, 2};
    natural_trim(&a);
    return a;
}

/* a * b, which must fit. */
static natural natural_product(const natural *a, const natural *b)
{
    natural result = {{0}, a->count + b->count};
    for (int32_t i = 0; i < a->count; i++) {
        uint64_t carry = 0;
        for (int32_t k = 0; k < b->count; k++) {
            carry += (uint64_t)a->word[i] * b->word[k] + result.word[i + k];
            result.word[i + k] = (uint32_t)carry;
            carry >>= 32;
        }
        result.word[i + b->count] = (uint32_t)carry;
    }
    natural_trim(&result);
    return result;
}

/* Below 0, 0, or above 0, as a is less than, equal to, or greater than b. */
static int natural_compare(const natural *a, const natural *b)
{
    if (a->count != b->count) {
        return a->count < b->count ? -1 : 1;
    }
    for (int32_t i = a->count - 1; i >= 0; i--) {
        if (a->word[i] != b->word[i]) {
            return a->word[i] < b->word[i] ? -1 : 1;
        }
    }
    return 0;
}

/* a - b, for a >= b. */
static natural natural_difference(const natural *a, const natural *b)
{
    natural result = *a;
    uint32_t borrow = 0;
    for (int32_t i = 0; i < a->count; i++) {
        uint64_t less = (uint64_t)(i < b->count ? b->word[i] : 0) + borrow;
        borrow = a->word[i] < less;
        result.word[i] = (uint32_t)(a->word[i] - less);
    }
    natural_trim(&result);
    return result;
}

/* The pixels on one side of a threshold: how many (at most 2^30) and the sum of their levels. */
typedef struct {
    uint32_t count;
    uint64_t sum;
} side;

/* Variance between the two sides, as a fraction: (n0 s1 - n1 s0)^2 / (n0 n1), a common factor left out. */
typedef struct {
    natural numerator, denominator;
} variance;

static variance variance_between(side dark, side bright)
{
    natural dark_count = natural_make(dark.count);
    natural bright_count = natural_make(bright.count);
    natural dark_sum = natural_make(dark.sum);
    natural bright_sum = natural_make(bright.sum);
    natural more = natural_product(&dark_count, &bright_sum);
    natural less = natural_product(&bright_count, &dark_sum);
    natural difference = natural_difference(&more, &less);
    return (variance){natural_product(&difference, &difference), natural_product(&dark_count, &bright_count)};
}

static int variance_greater(const variance *a, const variance *b)
{
    natural left = natural_product(&a->numerator, &b->denominator);
    natural right = natural_product(&b->numerator, &a->denominator);
    return natural_compare(&left, &right) > 0;
}

iris_status iris_otsu_value(uint8_t *value, const uint32_t histogram[256])
{
    if (!value || !histogram) {
        return IRIS_ERR_ARG;
    }
    uint64_t total = 0;
    uint64_t sum = 0;
    int32_t first = 0; /* values first..last divide the pixels in the best way so far */
    int32_t last = 0;
    for (int32_t level = 0; level < 256; level++) {
        total += histogram[level];
        sum += (uint64_t)histogram[level] * (uint32_t)level;
        first = last = histogram[level] > 0 ? level : first;
    }
    if (total == 0 || total > (uint64_t)1 << 30) {
        return IRIS_ERR_RANGE;
    }
    variance best = {{{0}, 0}, {{1}, 1}};
    side dark = {0, 0};
    int is_best = 0;
    for (int32_t level = 0; level < 255; level++) {
        dark.count += histogram[level];
        dark.sum += (uint64_t)histogram[level] * (uint32_t)level;
        if (dark.count == total) {
            break;
        }
        if (histogram[level] > 0) {
            variance here = variance_between(dark, (side){(uint32_t)total - dark.count, sum - dark.sum});
            is_best = variance_greater(&here, &best);
            if (is_best) {
                best = here;
                first = level;
            }
        }
        last = is_best ? level : last;
    }
    *value = (uint8_t)((first + last) / 2);
    return IRIS_OK;
}
