#include "digest.h"

#include "iris/xt/distance.h"

#define W 45
#define H 30

static void distance(iris_distance_metric metric)
{
    iris_image mask = digest_picture(IRIS_MASK1, W, H);
    iris_image result = digest_canvas(IRIS_GRAY_U16, W, H);
    digest_number(iris_distance_transform(&result, &mask, metric));
    digest_view(&result);
}

static void l1(void)
{
    distance(IRIS_DISTANCE_L1);
}

static void chamfer(void)
{
    distance(IRIS_DISTANCE_CHAMFER);
}

const digest_operation digest_distance[] = {
    {"distance.l1", l1},
    {"distance.chamfer", chamfer},
    {NULL, NULL},
};
