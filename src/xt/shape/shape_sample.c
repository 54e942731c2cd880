#include "../../foundation/views.h"
#include "../mask/contour_steps.h"
#include "../mask/mask_runs.h"
#include "iris/xt/shape.h"

#define NEVER ((int64_t)1 << 61) /* farther than any picture */

void iris_shape_sampling_defaults(iris_shape_sampling *config)
{
    if (config) {
        *config = (iris_shape_sampling){128, IRIS_SHAPE_FIRST, 0, 0, 0};
    }
}

/* The center of gravity of what is selected: 1, or 0 when nothing is. */
static int find_center(iris_shape_rays *rays, const iris_image *mask)
{
    int64_t n = 0, twice_x = 0, y_sum = 0;
    for (int32_t y = 0; y < mask->h; y++) {
        const uint32_t *row = (const uint32_t *)iris_image_row(mask, y);
        iris_mask_span run = {0, 0};
        while (iris_mask_run(&run, row, run.end, mask->w)) {
            int64_t length = run.end - run.first;
            n += length;
            twice_x += length * (run.first + run.end - 1);
            y_sum += length * y;
        }
    }
    if (n > 0) {
        rays->x_q16 = (iris_q16)((twice_x * 32768 + n / 2) / n);
        rays->y_q16 = (iris_q16)((y_sum * 65536 + n / 2) / n);
    }
    return n > 0;
}

/* One axis of a walk along a ray: from pixel to pixel. */
typedef struct {
    int32_t at, step;
    int64_t next_q16; /* how far along the ray this pixel ends */
    int64_t each_q16; /* how far along the ray a pixel reaches */
} axis;

static axis axis_from(iris_q16 start_q16, iris_q30 slope)
{
    axis a = {iris_q16_to_int(start_q16), slope < 0 ? -1 : 1, NEVER, 0};
    int64_t steepness = (int64_t)slope * a.step;
    if (steepness > 0) {
        int64_t beyond_q16 = (int64_t)start_q16 - (int64_t)a.at * 65536; /* the pixel's middle, -0.5 to 0.5 */
        a.each_q16 = (((int64_t)65536 << 30) + steepness / 2) / steepness;
        a.next_q16 = ((32768 - a.step * beyond_q16) << 30) / steepness;
    }
    return a;
}

/* Where the ray crosses the perimeter; -1: nowhere. It goes over sides from pixel to pixel, so it cannot slip between two
 * that touch by a corner. */
static int64_t crossing(const iris_image *mask, const iris_shape_rays *from, iris_angle angle,
                        iris_shape_crossing which)
{
    axis x = axis_from(from->x_q16, iris_cos_q30(angle)), y = axis_from(from->y_q16, iris_sin_q30(angle));
    int64_t found_q16 = -1;
    int inside = iris_contour_selected(mask, x.at, y.at);
    while ((uint32_t)x.at < (uint32_t)mask->w && (uint32_t)y.at < (uint32_t)mask->h) {
        axis *along = x.next_q16 <= y.next_q16 ? &x : &y;
        int64_t here_q16 = along->next_q16;
        along->at += along->step;
        along->next_q16 += along->each_q16;
        int next = iris_contour_selected(mask, x.at, y.at);
        if (inside && !next) {
            found_q16 = here_q16;
            if (which == IRIS_SHAPE_FIRST) {
                break;
            }
        }
        inside = next;
    }
    return found_q16;
}

static iris_status check(const iris_image *mask, const iris_shape_sampling *c)
{
    if (c->samples < 4 || c->samples > IRIS_SHAPE_SAMPLES_MAX || (unsigned)c->crossing > IRIS_SHAPE_LAST ||
        (c->has_point != 0 && c->has_point != 1)) {
        return IRIS_ERR_ARG;
    }
    return iris_views_check_one(mask, IRIS_MASK1);
}

/* Distances with so many fraction bits that the picture's width and height together fit in 16 bits. */
static int fraction_bits(const iris_image *mask)
{
    int bits = 13; /* for a picture of one pixel */
    while ((int64_t)(mask->w + mask->h + 2) << bits >= IRIS_SHAPE_MISSING) {
        bits--;
    }
    return bits;
}

iris_status iris_shape_sample(uint16_t *distances, iris_shape_rays *rays, const iris_image *mask,
                              const iris_shape_sampling *config)
{
    iris_shape_sampling c;
    iris_shape_sampling_defaults(&c);
    if (config) {
        c = *config;
    }
    if (!distances || !mask) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check(mask, &c);
    if (status != IRIS_OK) {
        return status;
    }
    iris_shape_rays from = {c.x_q16, c.y_q16, 0, 0};
    int32_t x = iris_q16_to_int(c.x_q16), y = iris_q16_to_int(c.y_q16);
    if (c.has_point ? x < 0 || x >= mask->w || y < 0 || y >= mask->h : !find_center(&from, mask)) {
        return IRIS_ERR_RANGE;
    }
    const int bits = fraction_bits(mask);
    uint32_t longest = 0;
    for (int32_t k = 0; k < c.samples; k++) {
        iris_angle angle = iris_angle_wrap((k * 65536 + c.samples / 2) / c.samples);
        int64_t distance_q16 = crossing(mask, &from, angle, c.crossing);
        uint32_t distance = distance_q16 < 0 ? 0 : (uint32_t)iris_round_shift(distance_q16, 16 - bits);
        distances[k] = distance_q16 < 0 ? IRIS_SHAPE_MISSING : (uint16_t)distance;
        from.missing += distance_q16 < 0;
        longest = distance > longest ? distance : longest;
    }
    for (int32_t k = 0; k < c.samples; k++) {
        if (distances[k] != IRIS_SHAPE_MISSING && longest > 0) {
            distances[k] = (uint16_t)((distances[k] * (uint32_t)IRIS_SHAPE_ONE + longest / 2) / longest);
        }
    }
    from.longest_q16 = iris_sat_s32((int64_t)longest << (16 - bits));
    if (rays) {
        *rays = from;
    }
    return IRIS_OK;
}

iris_status iris_shape_table(iris_shape_entry *entries, int32_t *count, const uint16_t *distances,
                             int32_t samples, iris_q16 longest_q16)
{
    if (!entries || !count || !distances || samples < 4 || samples > IRIS_SHAPE_SAMPLES_MAX) {
        return IRIS_ERR_ARG;
    }
    int32_t used = 0;
    for (int32_t k = 0; k < samples; k++) {
        if (distances[k] != IRIS_SHAPE_MISSING) {
            int64_t distance = iris_round_shift((int64_t)longest_q16 * distances[k], 15);
            entries[used++] = (iris_shape_entry){iris_angle_wrap((k * 65536 + samples / 2) / samples),
                                                 iris_sat_s32(distance)};
        }
    }
    *count = used;
    return IRIS_OK;
}
