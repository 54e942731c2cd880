#include "iris/osiris/device.h"

#include "iris/wide.h"
#include "rounded.h"

/* Through (x0, y0) and (x1, y1), which differ in x, at x. The product takes up to 66 bits. */
static int32_t on_line(int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t x)
{
    const iris_wide product = iris_wide_mul((int64_t)x - x0, (int64_t)y1 - y0);
    const int64_t rise = iris_wide_div_sat(product, (int64_t)x1 - x0); /* |product| is below 2^65 */
    return rise > INT32_MAX * (int64_t)4   ? INT32_MAX
           : rise < INT32_MIN * (int64_t)4 ? INT32_MIN
                                           : iris_sat_s32(y0 + rise);
}

int32_t osiris_calibration_value(const osiris_calibration *c, int32_t raw)
{
    int32_t i = 0;
    if (c->count < 2) {
        return raw;
    }
    while (i < c->count - 2 && raw > c->raw[i + 1]) {
        i++;
    }
    return on_line(c->raw[i], c->value[i], c->raw[i + 1], c->value[i + 1], raw);
}

int32_t osiris_calibration_raw(const osiris_calibration *c, int32_t value)
{
    if (c->count < 2) {
        return value;
    }
    const int32_t last = c->count - 1;
    for (int32_t i = 0; i < last; i++) {
        const int32_t a = c->value[i], b = c->value[i + 1];
        if (a != b && (a < b ? value >= a && value <= b : value >= b && value <= a)) {
            return on_line(a, c->raw[i], b, c->raw[i + 1], value);
        }
    }
    const int64_t to_first = (int64_t)value - c->value[0], to_last = (int64_t)value - c->value[last];
    return (to_first < 0 ? -to_first : to_first) < (to_last < 0 ? -to_last : to_last) ? c->raw[0]
                                                                                      : c->raw[last];
}
