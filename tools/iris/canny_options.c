#include "canny_options.h"

#include "args.h"
#include "complain.h"
#include "iris/xt/canny_adapt.h"

int canny_options_read(iris_canny_config *canny, const canny_texts *given)
{
    iris_canny_defaults(canny);
    canny->low = canny->high = -1;
    const args_whole thresholds[] = {{"--low", given->low, &canny->low, 0, IRIS_CANNY_THRESHOLD_END - 1},
                                     {"--high", given->high, &canny->high, 0, IRIS_CANNY_THRESHOLD_END - 1}};
    if (given->sigma && (!args_q16(&canny->sigma_q16, 0, IRIS_BLUR_SIGMA_MAX, given->sigma) ||
                         (canny->sigma_q16 != 0 && canny->sigma_q16 < IRIS_BLUR_SIGMA_MIN))) {
        complain("--sigma", "0, or 0.1 to 40 pixels, not '%s'", given->sigma);
        return 0;
    }
    if (!args_wholes(thresholds, 2)) {
        return 0;
    }
    if (canny->high >= 0 && canny->low > canny->high) {
        complain("--low", "at most --high, not %d above %d", (int)canny->low, (int)canny->high);
        return 0;
    }
    return 1;
}

void canny_options_complete(iris_canny_config *canny, int32_t usual_low, int32_t usual_high)
{
    int has_high = canny->high >= 0;
    if (!has_high) {
        canny->high = canny->low > usual_high ? canny->low : usual_high;
    }
    if (canny->low < 0) {
        canny->low = has_high ? canny->high * 2 / 5 : usual_low;
    }
}

iris_status canny_options_adapt(iris_canny_config *canny, const iris_image *gray, iris_scratch *scratch)
{
    iris_canny_config found = *canny;
    iris_status status =
        canny->low < 0 || canny->high < 0 ? iris_canny_adapt(&found, gray, scratch) : IRIS_OK;
    if (status == IRIS_OK) {
        canny_options_complete(canny, found.low, found.high);
    }
    return status;
}
