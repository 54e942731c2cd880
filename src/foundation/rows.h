/* The rows around a row, as they move down a picture: each of its rows is copied once, continued to both sides by a
 * border rule, and kept as long as it is looked at. What an operation writes to a row that it has passed does
 * not matter, so its dst may be its src.
 *
 *     status = iris_rows_begin(&rows, src, window, border, scratch);
 *     for (; status == IRIS_OK && rows.y < src->h; iris_rows_next(&rows)) {
 *         ... iris_rows_at(&rows, -1), iris_rows_at(&rows, 0), iris_rows_at(&rows, 1) ...
 *     }
 *     iris_scratch_release(scratch, mark);      a mark from before
 *
 * Takes IRIS_BORDER_ROWS_BYTES(w * channels, left * channels, right * channels, the larger of above and below); of a mask
 * IRIS_BORDER_ROWS_BYTES(4 * ceil((w + right) / 32), ceil(left / 8), 0, the larger of above and below).
 */
#ifndef IRIS_FOUNDATION_ROWS_H
#define IRIS_FOUNDATION_ROWS_H

#include "iris/border.h"
#include "iris/image.h"

/* How far around a pixel is looked at, in pixels, each at least 0. */
typedef struct {
    int32_t left, right, above, below;
} iris_rows_window;

/* Where rows come from that lie in no image: what the step before makes of its rows. */
typedef struct {
    const iris_image *shape; /* their size and format; its pixels are not looked at */

    /* Writes row y, whole (of a mask whole words). Called for each row once, from 0 to h - 1, and the first time
     * before iris_rows_begin_from returns. */
    void (*make)(void *user, uint8_t *to, int32_t y);
    void *user;
} iris_rows_source;

typedef struct {
    const iris_image *src;
    iris_rows_window window;
    iris_border border;
    int32_t channels; /* samples of a pixel in the window's rows: 3 for RGB888 and BGR888, else 1 */
    int32_t y;        /* the row that the window is around */

    /* Private. */
    iris_rows_source source;
    int32_t loaded; /* rows of src that have been copied */
    int32_t last;   /* slot of the latest of them */
    int32_t reach, slots;
    size_t row_bytes, slot_bytes;
    uint8_t *ring;  /* pixel 0 of slot 0; row i is in slot i modulo slots */
    uint8_t *level; /* pixel 0 of a row of border.value */
} iris_rows;

/* Ready at row 0. src: a checked view, IRIS_GRAY8, IRIS_RGB888, IRIS_BGR888, IRIS_MASK1 (a border value that is not 0
 * counts as 1), or IRIS_HSL24, of which only the lightness is taken; it must outlive rows. Each side of the window is at
 * most IRIS_SIDE_MAX.
 * IRIS_ERR_SCRATCH. O(reach * w). */
iris_status iris_rows_begin(iris_rows *rows, const iris_image *src, iris_rows_window window,
                            iris_border border, iris_scratch *scratch);

/* The same of rows that are made as they are needed. */
iris_status iris_rows_begin_from(iris_rows *rows, const iris_rows_source *source, iris_rows_window window,
                                 iris_border border, iris_scratch *scratch);

/* The next row; may be called at the last one. O(w). */
void iris_rows_next(iris_rows *rows);

/* The first sample of row y + dy, dy from -above to below; readable from -left * channels up to below
 * (w + right) * channels. Of a mask the word with pixel 0, readable to the words with pixels -left and w + right - 1, of
 * which the bits beyond these pixels are undefined. Pixel 0 is aligned to IRIS_SCRATCH_ALIGN. O(1). */
const uint8_t *iris_rows_at(const iris_rows *rows, int32_t dy);

/* The pixels of row y that are to be evaluated: x from *first up to below *end. All, except by IRIS_BORDER_SKIP; returns 0
 * when there are none. O(1). */
int iris_rows_span(int32_t *first, int32_t *end, const iris_rows *rows);

#endif
