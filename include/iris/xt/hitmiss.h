/* IRIS-XT - hit-or-miss: where does a pattern of set and clear pixels occur in a mask?
 *
 * Ends of lines, corners, single dots, branches: what a pixel's surroundings say bit by bit. J. Serra 1982.
 */
#ifndef IRIS_XT_HITMISS_H
#define IRIS_XT_HITMISS_H

#include "iris/border.h"
#include "iris/image.h"
#include "iris/scratch.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_HITMISS_SIDE_MAX 8

/* Bit x of byte y is pixel (x, y) of the pattern. In set: the pixel must be set; in clear: it must be clear; in neither:
 * no matter; in both: the pattern occurs nowhere. Bits past w and rows past h do not matter. Pixel
 * ((w - 1) / 2, (h - 1) / 2), rounded down, lies on the pixel that is asked about. */
typedef struct {
    int32_t w, h; /* pixels, 1 to IRIS_HITMISS_SIDE_MAX */
    uint8_t set[IRIS_HITMISS_SIDE_MAX], clear[IRIS_HITMISS_SIDE_MAX];
} iris_hitmiss_pattern;

/* A pattern from text: rows from the top, '1' set, '0' clear, '.' no matter, '/' between rows, such as "000/.1./111".
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_DATA: another letter, or rows of different lengths; IRIS_ERR_RANGE: a side outside
 * 1..IRIS_HITMISS_SIDE_MAX. *pattern is untouched then. O(letters). */
iris_status iris_hitmiss_pattern_read(iris_hitmiss_pattern *pattern, const char *text);

/* Working memory for a mask w pixels wide and a pattern of pattern_w * pattern_h. */
#define IRIS_HITMISS_SCRATCH_BYTES(w, pattern_w, pattern_h)                                                  \
    IRIS_BORDER_ROWS_BYTES(((size_t)(w) + (pattern_w) / 2u + 31u) / 32u * 4u,                                \
                           ((pattern_w)-1u) / 2u > 0 ? 1u : 0u, 0, (pattern_h) / 2u)

/* dst = where the pattern occurs. Both IRIS_MASK1 of one size; dst may be src, else they are disjoint. Bits past w are
 * kept. border: what counts beyond the edge (a value that is not 0 is set); by IRIS_BORDER_SKIP pixels whose pattern leaves
 * the picture are not written.
 * IRIS_ERR_ARG: null pointer or unknown border rule; the errors of iris_image_check; IRIS_ERR_FORMAT: not masks;
 * IRIS_ERR_RANGE: sizes differ, or a side of the pattern is out of range; IRIS_ERR_ALIAS: partial overlap;
 * IRIS_ERR_SCRATCH. O(words * pixels of the pattern that matter). */
iris_status iris_hitmiss_find(const iris_image *dst, const iris_image *src,
                              const iris_hitmiss_pattern *pattern, iris_border border, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
