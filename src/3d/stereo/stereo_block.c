#include "stereo_costs.h"
#include "stereo_pick.h"

void iris_stereo_block_defaults(iris_stereo_block_config *config)
{
    if (config) {
        *config = (iris_stereo_block_config){{63, IRIS_STEREO_CENSUS, 1, 0, 1, 1}, 13};
    }
}

/* All rows; the scratch is given back by the caller. */
static iris_status match(const iris_image *disparity, const iris_image *left, const iris_image *right,
                         const iris_stereo_block_config *config, iris_scratch *scratch)
{
    iris_stereo_costs costs;
    iris_stereo_pick pick;
    iris_status status = iris_stereo_costs_begin(&costs, left, right, &config->stereo, config->side, scratch);
    if (status == IRIS_OK) {
        status = iris_stereo_pick_begin(&pick, &config->stereo, left->w, scratch);
    }
    size_t mark = iris_scratch_mark(scratch);
    if (status != IRIS_OK || !iris_scratch_take(scratch, IRIS_STEREO_SMOOTH_SCRATCH_BYTES(left->w))) {
        return IRIS_ERR_SCRATCH;
    }
    iris_scratch_release(scratch, mark);
    for (int32_t y = 0; y < left->h; y++) {
        uint16_t *row = iris_image_row(disparity, y);
        iris_stereo_costs_begin_row(&costs, y);
        iris_stereo_pick_begin_row(&pick);
        for (int32_t x = 0; x < left->w; x += IRIS_STEREO_PIECE) {
            int32_t count = left->w - x < IRIS_STEREO_PIECE ? left->w - x : IRIS_STEREO_PIECE;
            iris_stereo_pick_piece(row, &pick, iris_stereo_costs_piece(&costs, x, count), x, count);
        }
        iris_stereo_pick_end_row(row, &pick);
    }
    return config->stereo.smooth ? iris_stereo_smooth(disparity, scratch) : IRIS_OK;
}

iris_status iris_stereo_block(const iris_image *disparity, const iris_image *left, const iris_image *right,
                              const iris_stereo_block_config *config, iris_scratch *scratch)
{
    iris_stereo_block_config defaults;
    iris_stereo_block_defaults(&defaults);
    config = config ? config : &defaults;
    if (!disparity || !left || !right || !scratch || config->side < 1 ||
        config->side > IRIS_STEREO_SIDE_MAX || config->side % 2 == 0) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_stereo_check(disparity, left, right, &config->stereo);
    if (status == IRIS_OK) {
        size_t mark = iris_scratch_mark(scratch);
        status = match(disparity, left, right, config, scratch);
        iris_scratch_release(scratch, mark);
    }
    return status;
}
