/* A camera that moves without turning: see calib_motion.h. */
#include <string.h>

#include "motion_parts.h"

iris_status iris_translation_focus(iris_translation_fit *fit, const iris_match *matches, int32_t count,
                                   iris_size size)
{
    const iris_motion_pair pair = {.matches = matches, .count = count};
    const iris_motion_config config = {.size = size};
    iris_motion_problem of = {.pairs = &pair, .count = 1, .span = IRIS_Q32_ONE};
    if (!fit || !matches) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_motion_check(&pair, 1, 0, &config);
    if (status != IRIS_OK) {
        return status;
    }
    iris_motion_begin(&of, &config);
    memset(fit, 0, sizeof *fit);
    fit->flaw = iris_motion_find_focus(fit, &of);
    return fit->flaw == IRIS_MOTION_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
