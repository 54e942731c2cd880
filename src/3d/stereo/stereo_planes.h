/* What disparities the patches of a level have. */
#ifndef IRIS_3D_STEREO_PLANES_H
#define IRIS_3D_STEREO_PLANES_H

#include "stereo_window.h"

/* One disparity for each patch: that at which the tiles of its window differ least. sums: room for `steps` numbers. */
void iris_stereo_match_flat(const iris_stereo_level *level, iris_stereo_window *window, uint16_t *sums);

/* Planes in their place, where these explain the windows better: that by least squares through the patches around, and
 * then those of the patches around. */
void iris_stereo_match_planes(const iris_stereo_level *level, iris_stereo_window *window);

#endif
