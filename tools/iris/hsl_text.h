/* A range of colors as people write it: H0-H1:S0-S1:L0-L1, hue in degrees, the others in percent. */
#ifndef IRIS_TOOL_HSL_TEXT_H
#define IRIS_TOOL_HSL_TEXT_H

#include "iris/color.h"

/* Reads what is behind "hsl:" of an option's value. The three parts have `separator` between them. 1, or 0 after
 * complaining about the option. */
int hsl_text_read(iris_hsl_range *range, const char *option, char separator, const char *text);

#endif
