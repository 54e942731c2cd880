/* The port for Cortex-M with the DSP extension (M4, M7, M33): four bytes or two halves in a word of a general register.
 * Little-endian; loads may be unaligned. Included by kernel.h only. */
#ifndef IRIS_PORT_H
#define IRIS_PORT_H

#include <stdint.h>

#define IRIS_PORT_NAME      "cortexm"
#define IRIS_PORT_OVERRIDES 1

void iris_row_scan8_u8_cortexm(iris_block8 *block, const uint8_t *src, int32_t n);
#define iris_row_scan8_u8 iris_row_scan8_u8_cortexm

#endif
