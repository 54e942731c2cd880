/* IRIS-XT - edges by a cellular automaton: at less cost than any convolution.
 *
 * Each pixel of IRIS_GRAY8 is a cell that looks at its neighbors alone, not at itself:
 *
 *     birth     a cell lives when its left and its right neighbor, or its upper and its lower one, differ by more than
 *               `threshold` levels;
 *     and then, in each of `generations` generations, of all cells at once:
 *     solitude  a cell dies when fewer than two of its eight neighbors live.
 *
 * Four pixels are compared where Sobel's operator weighs eight, and the generations work on 32 cells at a time. An edge
 * comes out two pixels wide, as by Sobel's operator at 4 times the threshold, and as well placed. Single noisy pixels
 * come out more often at birth, because nothing is averaged, but solitude removes most of them: `make score` prints
 * both beside Sobel's. Report, section 3.3 (CA_EdgeDetector), where the rule itself is not given.
 */
#ifndef IRIS_XT_AUTOMATON_H
#define IRIS_XT_AUTOMATON_H

#include "iris/border.h"
#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_AUTOMATON_GENERATIONS_MAX 16

typedef struct {
    uint8_t threshold;   /* levels; default 30 */
    int32_t generations; /* 0 to 16; default 1. Each takes a pixel off the ends of thin lines */
} iris_automaton_config;

void iris_automaton_defaults(iris_automaton_config *config);

/* Working memory: the rows around a row, and four rows of a mask. */
#define IRIS_AUTOMATON_SCRATCH_BYTES(w)                                                                      \
    (IRIS_BORDER_ROWS_BYTES(w, 1, 1, 1) + 4u * IRIS_SCRATCH_ROUND(4u * (((size_t)(w) + 31u) / 32u)))

/* mask, IRIS_MASK1: the cells of src, IRIS_GRAY8, that live in the end. config null: the defaults. border is what lies
 * beyond the edge of src; cells beyond it are dead. By IRIS_BORDER_SKIP the outermost rows and columns keep their value
 * and are no neighbors. mask and src are disjoint. Bits past w are kept.
 * IRIS_ERR_ARG: null pointer, unknown border, or a config value outside its range; the errors of iris_image_check;
 * IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes differ; IRIS_ERR_ALIAS; IRIS_ERR_SCRATCH. O(pixels). */
iris_status iris_automaton(const iris_image *mask, const iris_image *src, const iris_automaton_config *config,
                           iris_border border, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
