/* The port for Cortex-M with MVE, the vector extension (M55), which have the DSP extension too. Included by kernel.h
 * only. */
#ifndef IRIS_PORT_HELIUM_H
#define IRIS_PORT_HELIUM_H

#include "../cortexm/iris_port.h"

#undef IRIS_PORT_NAME
#define IRIS_PORT_NAME "helium"

#endif
