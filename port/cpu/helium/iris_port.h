/* The port for Cortex-M with MVE, the vector extension (M55). It takes the kernels of the DSP extension, which these
 * processors have too, where vectors buy nothing over them. Included by kernel.h only. */
#ifndef IRIS_PORT_HELIUM_H
#define IRIS_PORT_HELIUM_H

#include "../cortexm/iris_port.h"

#undef IRIS_PORT_NAME
#define IRIS_PORT_NAME "helium"

#undef iris_row_scan8_u8
void iris_row_scan8_u8_helium(iris_block8 *block, const uint8_t *src, int32_t n);
#define iris_row_scan8_u8 iris_row_scan8_u8_helium

#endif
