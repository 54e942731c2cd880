/* A range of colors as people write it: H0-H1,S0-S1,L0-L1, hue in degrees, the others in percent; colons
 * may stand for the commas. */
#ifndef IRIS_TOOL_HSL_TEXT_H
#define IRIS_TOOL_HSL_TEXT_H

#include "iris/color.h"

#define HSL_TEXT "H0-H1,S0-S1,L0-L1"

/* Reads what is behind "hsl:" of an option's value. 1, or 0 after complaining about the option. */
int hsl_text_read(iris_hsl_range *range, const char *option, const char *text);

#endif
