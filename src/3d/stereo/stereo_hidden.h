/* What one camera alone sees. */
#ifndef IRIS_3D_STEREO_HIDDEN_H
#define IRIS_3D_STEREO_HIDDEN_H

#include "stereo_level.h"

/* Of one row of tiles. */
typedef struct {
    uint16_t *cost, *disparity; /* of what has each place of the other picture: w of the picture each */
    uint8_t *hidden;            /* columns */
} iris_stereo_claims;

/* Takes IRIS_STEREO_CLAIMS_SCRATCH_BYTES. */
iris_status iris_stereo_claims_begin(iris_stereo_claims *claims, const iris_stereo_level *level,
                                     iris_scratch *scratch);

/* Two patches cannot have the same place of the other picture. The tiles of those that match it worse get the plane of
 * what is next to them in their row and has its match; of the two, to the left and to the right, the one farther away. */
void iris_stereo_fill_hidden(const iris_image *map, const iris_stereo_level *level,
                             const iris_stereo_claims *claims, int32_t shift, int32_t most);

#endif
