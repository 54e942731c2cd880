/* One dilation or erosion, row by row.
 *
 * The pixels of the element are those of its anchor's row and, above and below, rows that are all alike. Each source row
 * is joined over their width once ("line"); then lines are joined down the column, and with the anchor's row. n pixels
 * or lines that lie side by side are joined three runs at a time: runs of 1 give runs of 3, these runs of 9 and so on, and
 * two or three of the longest that fit overlap to the n.
 */
#ifndef IRIS_XT_MORPH_STEP_H
#define IRIS_XT_MORPH_STEP_H

#include "../../foundation/rows.h"
#include "iris/xt/morph.h"
#include "morph_near.h"

/* Longest run: 3^5 = 243 <= (IRIS_MORPH_SIDE_MAX - 1) / 2 < 3^6. */
#define IRIS_MORPH_LEVELS 6

typedef struct {
    iris_rows rows; /* of the source, around row rows.y */

    /* Private. */
    iris_morph_element element;
    int erodes;
    int32_t left, right, above, below; /* of the element as it is looked at */

    /* The largest or smallest (any or all) of three rows of n bytes, of masks whole words. dst may be one of them; those that
     * are not dst may also overlap it from behind. */
    void (*join)(uint8_t *dst, const uint8_t *a, const uint8_t *b, const uint8_t *c, int32_t n);
    int is_near; /* joined at once, without lines */
    iris_morph_near near;
    int32_t row_bytes;  /* of a row without what is beyond its edges */
    int32_t line_bytes; /* of a line in its ring */
    int32_t longest;    /* 3^top */
    int32_t top;        /* level of the longest runs of lines */
    int32_t lines;      /* so many have been made */
    struct {
        uint8_t *ring; /* the latest runs of 3^level lines */
        int32_t slots;
        int32_t last; /* slot of the run that ends with the latest line */
    } levels[IRIS_MORPH_LEVELS];
    uint8_t *run; /* room for a row's runs */
} iris_morph_step;

/* Ready at row 0. step->erodes is given: 1 for an erosion, 0 for a dilation. element: checked. Takes IRIS_MORPH_SCRATCH_BYTES.
 * IRIS_ERR_SCRATCH. */
iris_status iris_morph_step_begin(iris_morph_step *step, const iris_rows_source *source,
                                  const iris_morph_element *element, iris_border border,
                                  iris_scratch *scratch);

/* Bytes from..from + n - 1 of the result's row rows.y; of a mask whole words. Once for each row, from 0 on, with
 * iris_rows_next(&step->rows) in between. to may be of the source's image. */
void iris_morph_step_row(iris_morph_step *step, uint8_t *to, int32_t from, int32_t n);

/* Pixels x + first..x + last of a mask's row are joined to pixel x of `to`, w pixels. run: room for w + last - first
 * pixels and another word; to may be run. row is readable at pixels first..w + last - 1. */
typedef struct {
    int32_t w, first, last;
    int all; /* 1: and; 0: or */
} iris_mask_span;
void iris_mask_join_span(uint32_t *to, const uint32_t *row, iris_mask_span span, uint32_t *run);

#endif
