/* IRIS - fixed-point numbers and trigonometry. */
#ifndef IRIS_FIXED_H
#define IRIS_FIXED_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef int32_t iris_q16;   /* 16 fraction bits: 65536 = 1.0 */
typedef int32_t iris_q30;   /* 30 fraction bits: sines, unit vectors */
typedef int16_t iris_angle; /* 65536 = one turn: -180 degrees up to below 180; wraps */

#define IRIS_Q16_ONE ((iris_q16)65536)
#define IRIS_Q30_ONE ((iris_q30)1073741824)

#ifdef __cplusplus
}
#endif

#endif
