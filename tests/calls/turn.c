/* Turning. */
#include "iris/turn.h"

#include "calls.h"

static void turn(void)
{
    iris_turning turning = (iris_turning)draw_int(IRIS_TURN_NONE, IRIS_TRANSVERSE);
    iris_format format = draw_format();
    iris_size size = draw_size();
    if (format == IRIS_YUYV || format == IRIS_UYVY) {
        size.w += size.w % 2;
        turning = draw_chance(2) ? IRIS_FLIP_VERTICAL : turning;
    }
    iris_size turned = turning >= IRIS_TRANSPOSE ? (iris_size){size.h, size.w} : size;
    const iris_image *dst = draw_output(iris_turn_format(format, size, turning), turned);
    const iris_image *src = draw_input(format, size);
    CALL(iris_turn(dst, src, turning));
}

const random_call calls_turn[] = {
    {"iris_turn", turn},
    {NULL, NULL},
};
