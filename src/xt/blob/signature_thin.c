#include <string.h>

#include "signature_cells.h"

static void count_row(uint16_t *counts, const iris_image *image, int32_t y)
{
    for (int32_t x = 0; x < image->w; x += IRIS_SIGNATURE_PIECE) {
        uint16_t cells[IRIS_SIGNATURE_PIECE];
        int32_t n = image->w - x < IRIS_SIGNATURE_PIECE ? image->w - x : IRIS_SIGNATURE_PIECE;
        iris_signature_cells_row(cells, iris_image_row(image, y), image->format, x, n);
        for (int32_t i = 0; i < n; i++) {
            counts[cells[i]] = (uint16_t)(counts[cells[i]] + (counts[cells[i]] < UINT16_MAX));
        }
    }
}

iris_status iris_signature_thin(int32_t *cleared, iris_signatures *signatures, uint32_t bit,
                                const iris_signature_crowd *crowd, iris_scratch *scratch)
{
    const size_t start = iris_scratch_mark(scratch);
    uint16_t *counts = (uint16_t *)iris_scratch_take(scratch, sizeof *counts * IRIS_SIGNATURE_CELLS);
    if (!counts) {
        return IRIS_ERR_SCRATCH;
    }
    memset(counts, 0, sizeof *counts * IRIS_SIGNATURE_CELLS);
    for (int32_t y = 0; y < crowd->image->h; y++) {
        count_row(counts, crowd->image, y);
    }
    *cleared = 0;
    for (int32_t cell = 0; cell < IRIS_SIGNATURE_CELLS; cell++) {
        if (counts[cell] > crowd->most && (signatures->cells[cell] & bit) != 0) {
            signatures->cells[cell] = (uint8_t)(signatures->cells[cell] & ~bit);
            (*cleared)++;
        }
    }
    iris_scratch_release(scratch, start);
    return IRIS_OK;
}

void iris_signature_keep(uint8_t *kept, const iris_signatures *signatures, uint32_t bit)
{
    for (int32_t cell = 0; cell < IRIS_SIGNATURE_CELLS; cell++) {
        const uint32_t at = 1u << cell % 8, has = (signatures->cells[cell] & bit) != 0 ? at : 0;
        kept[cell / 8] = (uint8_t)((kept[cell / 8] & ~at) | has);
    }
}

void iris_signature_restore(iris_signatures *signatures, uint32_t bit, const uint8_t *kept)
{
    for (int32_t cell = 0; cell < IRIS_SIGNATURE_CELLS; cell++) {
        const uint32_t had = (kept[cell / 8] >> cell % 8 & 1) != 0 ? bit : 0;
        signatures->cells[cell] = (uint8_t)((signatures->cells[cell] & ~bit) | had);
    }
}
