/* IRIS - sines, cosines, and arc tangents with 32 fraction bits, of angles in radians: for what an iris_angle is too
 * coarse, such as a camera's pose. In integers, without tables. Every function takes every input.
 */
#ifndef IRIS_RADIANS_H
#define IRIS_RADIANS_H

#include "iris/wide.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_PI_Q32 ((iris_q32)13493037705)

/* Sine and cosine of an angle in radians, any number of turns. The error is at most 0.51 units (1.2e-10) for up to a
 * thousand turns, and grows to 1 unit at the largest angles. Exact at 0. Taylor's series in an eighth of a turn: 17
 * products of 128 bits. */
void iris_q32_sin_cos(iris_q32 *sine, iris_q32 *cosine, iris_q32 radians);

/* The angle of the vector (x, y), from -pi to pi: 0 along +x, growing towards +y. x and y are numbers of any one
 * kind. 0 for (0, 0). The error is at most 0.51 units. iris_atan2_angle, and a series for the rest: about 20 products
 * of 128 bits. */
iris_q32 iris_q32_atan2(int64_t y, int64_t x);

#ifdef __cplusplus
}
#endif

#endif
