/* How far out a lens's polynomial is what a lens does. */
#ifndef IRIS_LENS_FOLD_H
#define IRIS_LENS_FOLD_H

#include "iris/3d/camera.h"

/* Has the radial polynomial only grown from the center to `square`, a distance squared? Beyond the first place where
 * r (1 + k1 r^2 + k2 r^4 + k3 r^6) turns back it shows a second time what it has shown before. Near the center, or
 * where no term is below 0, 3 products; elsewhere a root and a division more. `square` is not below 0. */
int iris_lens_grows(const iris_lens *lens, iris_q32 square);

/* iris_lens_bend, and whether the lens shows the place at all: IRIS_ERR_RANGE: it does not; *seen is set. */
iris_status iris_lens_show(iris_vec2 *seen, const iris_lens *lens, iris_vec2 p);

#endif
