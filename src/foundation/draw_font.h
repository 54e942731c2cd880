/* The 5x7 font of draw.c: glyph i is the character 32 + i; the last one stands for everything that is not
 * printable. */
#ifndef IRIS_DRAW_FONT_H
#define IRIS_DRAW_FONT_H

#include <stdint.h>

#define IRIS_DRAW_GLYPHS     96
#define IRIS_DRAW_GLYPH_ROWS 7

extern const uint8_t iris_draw_font[IRIS_DRAW_GLYPHS][IRIS_DRAW_GLYPH_ROWS];

#endif
