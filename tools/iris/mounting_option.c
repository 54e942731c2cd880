#include "mounting_option.h"

#include "complain.h"

int mounting_is_given(const mounting_texts *texts)
{
    return texts->calib || texts->height || texts->tilt || texts->pan || texts->roll || texts->ahead ||
           texts->right;
}

/* Millimeters, or degrees, with 16 fraction bits, as they are in the mounting. */
static iris_q32 length_of(int32_t number_q16)
{
    return (iris_q32)number_q16 * 65536;
}

static iris_q32 radians_of(int32_t number_q16)
{
    return iris_q32_div_sat(iris_q32_mul_sat(length_of(number_q16), IRIS_PI_Q32), 180 * IRIS_Q32_ONE);
}

int mounting_option_read(iris_mounting *mounting, const mounting_texts *texts)
{
    enum { MM = 65536, FAR = 32000 * MM, DEGREE = 65536 };
    struct {
        const char *option, *text;
        iris_q32 *to;
        int32_t least, most;
        int is_angle;
    } all[] = {
        {"--height", texts->height, &mounting->height, MM, FAR, 0},
        {"--tilt", texts->tilt, &mounting->tilt, -90 * DEGREE, 90 * DEGREE, 1},
        {"--pan", texts->pan, &mounting->pan, -180 * DEGREE, 180 * DEGREE, 1},
        {"--roll", texts->roll, &mounting->roll, -180 * DEGREE, 180 * DEGREE, 1},
        {"--ahead", texts->ahead, &mounting->ahead, -FAR, FAR, 0},
        {"--right", texts->right, &mounting->right, -FAR, FAR, 0},
    };
    if (!texts->calib || !texts->height || !texts->tilt) {
        complain(NULL, "%s is needed (see --help)",
                 !texts->calib    ? "--calib CAMERA"
                 : !texts->height ? "--height MM"
                                  : "--tilt DEG");
        return 0;
    }
    *mounting = (iris_mounting){.height = 0};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        int32_t number = 0;
        if (all[i].text && !args_q16(&number, all[i].least, all[i].most, all[i].text)) {
            complain(all[i].option, "%d to %d %s, not '%s'", (int)(all[i].least / 65536),
                     (int)(all[i].most / 65536), all[i].is_angle ? "degrees" : "millimeters", all[i].text);
            return 0;
        }
        *all[i].to = all[i].is_angle ? radians_of(number) : length_of(number);
    }
    return 1;
}
