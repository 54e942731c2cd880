#include "iris/xt/shape.h"

/* Two sequences, and what one shift of them comes to. */
typedef struct {
    const uint16_t *a, *b;
    int32_t samples;
    const iris_shape_tolerance *tolerance;
    int64_t both; /* the sum of all samples of a and b: no signal is larger */
} sequences;

typedef struct {
    int64_t error, signal; /* error / signal is what counts */
    int32_t compared;
} measure;

void iris_shape_tolerance_defaults(iris_shape_tolerance *tolerance)
{
    if (tolerance) {
        *tolerance = (iris_shape_tolerance){256, IRIS_Q16_ONE / 2, IRIS_Q16_ONE / 3, 1};
    }
}

static int is_share(iris_q16 value)
{
    return value >= 0 && value <= IRIS_Q16_ONE;
}

static int are_samples(const uint16_t *samples, int32_t count)
{
    int good = 1;
    for (int32_t i = 0; i < count; i++) {
        good &= samples[i] <= IRIS_SHAPE_ONE || samples[i] == IRIS_SHAPE_MISSING;
    }
    return good;
}

static int64_t sum_of(const uint16_t *samples, int32_t count)
{
    int64_t sum = 0;
    for (int32_t i = 0; i < count; i++) {
        sum += samples[i] == IRIS_SHAPE_MISSING ? 0 : samples[i];
    }
    return sum;
}

/* b turned by `shift` steps against a; mirrored, b runs backwards. Left with signal 0 once its error is above `most`. */
static measure measure_at(const sequences *s, int32_t shift, int mirrored, int64_t most)
{
    measure m = {0, 0, 0};
    int32_t at = shift;
    for (int32_t i = 0; i < s->samples && m.error <= most; i++) {
        int32_t a = s->a[at], b = s->b[i];
        if (a != IRIS_SHAPE_MISSING && b != IRIS_SHAPE_MISSING) {
            int32_t larger = a > b ? a : b, difference = a > b ? a - b : b - a;
            m.signal += larger;
            m.error += difference > s->tolerance->tolerance ? difference - s->tolerance->tolerance : 0;
            m.compared++;
        }
        at += mirrored ? -1 : 1;
        at = at == s->samples ? 0 : at < 0 ? s->samples - 1 : at;
    }
    int64_t missing = s->samples - m.compared;
    if (m.error > most || missing * IRIS_Q16_ONE > (int64_t)s->samples * s->tolerance->missing_q16 ||
        m.error * IRIS_Q16_ONE > m.signal * s->tolerance->cumulative_q16) {
        m.signal = 0;
    }
    return m;
}

static iris_q16 degree_of(const measure *m)
{
    return m->signal == 0 ? 0
                          : (iris_q16)(((m->signal - m->error) * IRIS_Q16_ONE + m->signal / 2) / m->signal);
}

/* The turn between the steps: errors grow alike on both sides of the best shift. */
static iris_angle angle_of(const sequences *s, const iris_shape_correlation *best)
{
    int32_t n = s->samples, before = best->shift == 0 ? n - 1 : best->shift - 1;
    measure m[3] = {measure_at(s, before, best->mirrored, s->both),
                    measure_at(s, best->shift, best->mirrored, s->both),
                    measure_at(s, best->shift == n - 1 ? 0 : best->shift + 1, best->mirrored, s->both)};
    int32_t left = degree_of(&m[0]), right = degree_of(&m[2]), top = degree_of(&m[1]);
    int32_t low = left < right ? left : right, fall = top - low, part_q8 = 0;
    if (left > 0 && right > 0 && fall > 0) {
        part_q8 = (right - left) * 128 / fall;
    }
    /* mirrored: a at angle t lies where b at half a turn less t, turned by the angle, does */
    int32_t turn = (best->shift * 256 + part_q8) * 256 / n;
    return iris_angle_wrap(turn - (best->mirrored ? 32768 : 0));
}

iris_status iris_shape_correlate(iris_shape_correlation *best, const uint16_t *a, const uint16_t *b,
                                 int32_t samples, const iris_shape_tolerance *tolerance)
{
    iris_shape_tolerance t;
    iris_shape_tolerance_defaults(&t);
    if (tolerance) {
        t = *tolerance;
    }
    if (!best || !a || !b || samples < 4 || samples > IRIS_SHAPE_SAMPLES_MAX || t.tolerance < 0 ||
        t.tolerance > IRIS_SHAPE_ONE || !is_share(t.cumulative_q16) || !is_share(t.missing_q16) ||
        (t.mirrored != 0 && t.mirrored != 1)) {
        return IRIS_ERR_ARG;
    }
    if (!are_samples(a, samples) || !are_samples(b, samples)) {
        return IRIS_ERR_RANGE;
    }
    const sequences s = {a, b, samples, &t, sum_of(a, samples) + sum_of(b, samples)};
    measure least = {1, 0, 0};
    iris_shape_correlation found = {0, 0, 0, 0, 0};
    int64_t most = s.both * t.cumulative_q16 / IRIS_Q16_ONE;
    for (int32_t k = 0; k < samples << t.mirrored; k++) {
        int mirrored = k >= samples;
        measure m = measure_at(&s, mirrored ? k - samples : k, mirrored, most);
        if (m.signal > 0 && (least.signal == 0 || m.error * least.signal < least.error * m.signal)) {
            least = m;
            most = m.error * s.both / m.signal; /* who is above cannot be better with any signal */
            found.shift = mirrored ? k - samples : k;
            found.mirrored = mirrored;
        }
    }
    if (least.signal > 0) {
        found.degree_q16 = degree_of(&least);
        found.compared = least.compared;
        found.angle = angle_of(&s, &found);
    }
    *best = found;
    return IRIS_OK;
}
