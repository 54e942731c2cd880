/* IRIS-XT - accumulators of votes as pictures to look at: bright spots where many agree. Report, figures 5.3b and 5.4b.
 */
#ifndef IRIS_XT_VOTES_H
#define IRIS_XT_VOTES_H

#include "iris/image.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* gray, IRIS_GRAY8, of votes, IRIS_GRAY_U16 of the same size: the most votes become 255, none 0, and half as many half
 * as bright. All black when there are no votes. The two are disjoint.
 * IRIS_ERR_ARG: null pointer; the errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE: sizes differ;
 * IRIS_ERR_ALIAS. O(bins), a division for each. */
iris_status iris_votes_show(const iris_image *gray, const iris_image *votes);

#ifdef __cplusplus
}
#endif

#endif
