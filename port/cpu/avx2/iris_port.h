/* The AVX2 port: x86-64-v3. It takes the SSE port's kernels, compiled anew for this processor, where vectors of 32 bytes
 * buy nothing over them. Included by kernel.h only. */
#ifndef IRIS_PORT_AVX2_H
#define IRIS_PORT_AVX2_H

#include "../sse/iris_port.h"

#undef IRIS_PORT_NAME
#define IRIS_PORT_NAME "avx2"

#endif
