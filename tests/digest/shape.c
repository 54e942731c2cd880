#include "digest.h"

#include "iris/xt/contour.h"
#include "iris/xt/moments.h"
#include "iris/xt/threshold.h"

#define W 131
#define H 45

/* What is brighter than `value`: a bright half, spots, and a ragged line between them. */
static iris_image bright(uint8_t value)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H);
    iris_image mask = digest_canvas(IRIS_MASK1, W, H);
    (void)iris_threshold(&mask, &gray, value, IRIS_SELECT_BRIGHT);
    return mask;
}

static void contours(void)
{
    iris_image mask = bright(128);
    iris_contour found[12];
    iris_contour_point points[40];
    int32_t count = 0;
    iris_scratch scratch = digest_scratch(IRIS_CONTOUR_SCRATCH_BYTES(W, H));
    digest_number(iris_contour_find(found, 12, &count, &mask, &scratch));
    digest_number(count);
    for (int32_t i = 0; i < 12 && i < count; i++) {
        const iris_contour *c = &found[i];
        const int32_t fields[] = {c->x, c->y, c->is_hole, c->parent, c->area, c->points, c->diagonals};
        digest_bytes(fields, sizeof fields);
        digest_bytes(&c->box, sizeof c->box);
        int32_t length = 0;
        digest_number(iris_contour_points(points, 40, &length, c, &mask));
        digest_bytes(points, (size_t)(length < 40 ? length : 40) * sizeof points[0]);
    }
}

static void moments(void)
{
    iris_image mask = bright(128);
    iris_mask_moments sums = {0};
    iris_invariants v = {0};
    digest_number(iris_mask_moments_sum(&sums, &mask));
    digest_number(iris_moments_invariants(&v, &sums));
    digest_bytes(&sums, sizeof sums);
    digest_number(v.x_q16);
    digest_number(v.y_q16);
    digest_bytes(v.hu_q40, sizeof v.hu_q40);
}

const digest_operation digest_shape[] = {
    {"shape.contours", contours},
    {"shape.moments", moments},
    {NULL, NULL},
};
