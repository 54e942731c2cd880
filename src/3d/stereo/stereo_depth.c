#include "iris/3d/stereo.h"

iris_q32 iris_stereo_depth(uint16_t disparity, iris_q32 baseline, iris_q32 focal)
{
    if (disparity == 0) {
        return IRIS_STEREO_INFINITY;
    }
    /* (b f / 2^32) / (disparity / 256), rounded at the end alone */
    iris_wide product = iris_wide_mul(baseline, focal);
    return iris_wide_div_sat(product, (int64_t)disparity << 24);
}
