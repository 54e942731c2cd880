/* How Unity speaks here: character by character, without stdio; and without floating point. */
#ifndef IRIS_UNITY_CONFIG_H
#define IRIS_UNITY_CONFIG_H

#include "target.h"

#define UNITY_OUTPUT_CHAR(c) target_putc(c)
#define UNITY_SUPPORT_64
#define UNITY_EXCLUDE_FLOAT
#define UNITY_EXCLUDE_DOUBLE

#endif
