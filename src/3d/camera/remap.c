#include "iris/3d/remap.h"

#include "../../xt/floor/runs.h"

#define JOIN_BITS 3    /* 2^JOIN_BITS steps are a run at most */
#define BENT      1024 /* 1/64 of a pixel: so far off is a run at its quarters at most */
#define FAR_Q32   ((iris_q32)32600 << 32)

void iris_remap_view_defaults(iris_remap_view *view, const iris_intrinsics *intrinsics, iris_size size)
{
    view->size = size;
    view->intrinsics = *intrinsics;
    iris_mat3_identity(&view->turn);
    view->fill = 0;
    view->step_bits = 3;
}

static const iris_place nowhere = {INT32_MIN, INT32_MIN};

/* Where the pixel of the view is in the camera's picture. */
static iris_place place_of(const iris_remap_view *view, const iris_sensor *camera, int32_t x, int32_t y)
{
    iris_vec2 pixel = {(iris_q32)x << 32, (iris_q32)y << 32}, p, seen;
    iris_sensor alone = {.intrinsics = camera->intrinsics, .lens = camera->lens};
    iris_mat3_identity(&alone.pose.turn);
    if (iris_intrinsics_plane(&p, &view->intrinsics, pixel) != IRIS_OK) {
        return nowhere;
    }
    iris_vec3 ray = iris_mat3_transposed_vector(&view->turn, (iris_vec3){p.x, p.y, IRIS_Q32_ONE});
    if (iris_sensor_project(&seen, NULL, &alone, ray) != IRIS_OK || seen.x > FAR_Q32 || seen.x < -FAR_Q32 ||
        seen.y > FAR_Q32 || seen.y < -FAR_Q32) {
        return nowhere;
    }
    return (iris_place){(iris_q16)iris_round_shift(seen.x, 16), (iris_q16)iris_round_shift(seen.y, 16)};
}

/* How many places of a map it takes for so many pixels. */
static int32_t places_of(int32_t pixels, int step_bits)
{
    return ((pixels - 1) >> step_bits) + 2;
}

iris_status iris_remap_init(iris_remap *remap, iris_place *places, const iris_remap_view *view,
                            const iris_sensor *camera, iris_size source)
{
    if (!remap || !places || !view || !camera) {
        return IRIS_ERR_ARG;
    }
    if (view->size.w < 1 || view->size.w > IRIS_SIDE_MAX || view->size.h < 1 ||
        view->size.h > IRIS_SIDE_MAX || source.w < 1 || source.w > IRIS_REMAP_SOURCE_MAX || source.h < 1 ||
        source.h > IRIS_REMAP_SOURCE_MAX || view->step_bits < 0 ||
        view->step_bits > IRIS_REMAP_STEP_BITS_MAX || view->intrinsics.alpha_u <= 0 ||
        view->intrinsics.alpha_v <= 0 || camera->intrinsics.alpha_u <= 0 || camera->intrinsics.alpha_v <= 0) {
        return IRIS_ERR_RANGE;
    }
    const int bits = view->step_bits;
    const int32_t columns = places_of(view->size.w, bits), rows = places_of(view->size.h, bits);
    for (int32_t row = 0; row < rows; row++) {
        for (int32_t column = 0; column < columns; column++) {
            places[(size_t)row * (size_t)columns + (size_t)column] =
                place_of(view, camera, column << bits, row << bits);
        }
    }
    *remap = (iris_remap){view->size, source, places, bits, view->fill};
    return IRIS_OK;
}

/* The places of a row of the view: between two rows of the map. */
typedef struct {
    const iris_place *above, *below;
    int32_t part; /* of the lower one, 2^step_bits of it */
    int step_bits;
} map_row;

/* value / 2^bits, rounded; bits may be 0. */
static int64_t divided(int64_t value, int bits)
{
    return iris_round_shift(value * 2, bits + 1);
}

static iris_place place_in(const map_row *row, int32_t column)
{
    iris_place a = row->above[column], b = row->below[column];
    if (a.x_q16 == INT32_MIN || b.x_q16 == INT32_MIN) {
        return row->part == 0 ? a : nowhere;
    }
    int64_t right = (int64_t)b.x_q16 - a.x_q16, down = (int64_t)b.y_q16 - a.y_q16;
    return (iris_place){(iris_q16)(a.x_q16 + divided(right * row->part, row->step_bits)),
                        (iris_q16)(a.y_q16 + divided(down * row->part, row->step_bits))};
}

/* Is the place, quarters of the way from a to b, off the line between them? */
static int is_off(int32_t a, int32_t b, int32_t place, int quarters)
{
    int64_t four_times = (int64_t)a * (4 - quarters) + (int64_t)b * quarters - 4 * (int64_t)place;
    return four_times > 4 * BENT || four_times < -4 * BENT;
}

/* May the 2^bits steps from the column be one run, that is straight? The middle alone would not see an S. */
static int may_join(const map_row *row, int32_t column, int bits, int32_t last)
{
    if (column + (1 << bits) > last) {
        return 0;
    }
    iris_place a = place_in(row, column), b = place_in(row, column + (1 << bits));
    int good = a.x_q16 != INT32_MIN && b.x_q16 != INT32_MIN;
    for (int quarters = bits > 1 ? 1 : 2; quarters < 4 && good; quarters += bits > 1 ? 1 : 2) {
        iris_place place = place_in(row, column + ((quarters << bits) >> 2));
        good = place.x_q16 != INT32_MIN && !is_off(a.x_q16, b.x_q16, place.x_q16, quarters) &&
               !is_off(a.y_q16, b.y_q16, place.y_q16, quarters);
    }
    return good;
}

static iris_run run_at(const map_row *row, int32_t column, int bits)
{
    iris_place a = place_in(row, column), b = place_in(row, column + (1 << bits));
    iris_run made = {.n = 1 << (bits + row->step_bits),
                     .exists = a.x_q16 != INT32_MIN && b.x_q16 != INT32_MIN,
                     .x = a.x_q16,
                     .y = a.y_q16};
    if (made.exists) {
        made.dx = (iris_q16)divided((int64_t)b.x_q16 - a.x_q16, bits + row->step_bits);
        made.dy = (iris_q16)divided((int64_t)b.y_q16 - a.y_q16, bits + row->step_bits);
    }
    return made;
}

static void draw_row(uint8_t *to, const void *user, const iris_image *src, int32_t y)
{
    const iris_remap *remap = user;
    const int channels = src->format == IRIS_GRAY8 ? 1 : 3;
    const int step_bits = remap->step_bits;
    const int32_t columns = places_of(remap->size.w, step_bits), w = remap->size.w;
    const iris_place *above = remap->places + (size_t)(y >> step_bits) * (size_t)columns;
    const map_row row = {above, above + columns, y & ((1 << step_bits) - 1), step_bits};
    int bits = JOIN_BITS;
    for (int32_t column = 0, x = 0; x < w; column += 1 << bits, bits += bits < JOIN_BITS) {
        while (bits > 0 && !may_join(&row, column, bits, columns - 1)) {
            bits--;
        }
        iris_run run = run_at(&row, column, bits);
        run.n = run.n < w - x ? run.n : w - x;
        iris_run_draw(to, &run, src, channels, remap->fill);
        to += run.n * channels;
        x += run.n;
    }
}

static iris_run_picture picture_of(const iris_remap *remap)
{
    return (iris_run_picture){remap->size, remap->source, remap, draw_row};
}

iris_status iris_remap_draw(const iris_image *dst, const iris_image *src, const iris_remap *remap)
{
    if (!dst || !src || !remap) {
        return IRIS_ERR_ARG;
    }
    const iris_run_picture picture = picture_of(remap);
    return iris_run_picture_draw(dst, src, &picture);
}

iris_status iris_remap_row(void *pixels, const iris_remap *remap, const iris_image *src, int32_t y)
{
    if (!pixels || !remap || !src) {
        return IRIS_ERR_ARG;
    }
    const iris_run_picture picture = picture_of(remap);
    return iris_run_picture_row(pixels, src, &picture, y);
}
