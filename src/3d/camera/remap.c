#include "iris/3d/remap.h"

#include "../../foundation/kernel.h"
#include "../../xt/floor/runs.h"

#define FAR_Q32 ((iris_q32)32600 << 32)

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

/* a + part of the way to b, to a 4096th. */
static inline iris_q16 on_the_way(iris_q16 a, iris_q16 b, const map_row *row)
{
    int64_t more = (((int64_t)b - a) * row->part + ((int64_t)8 << row->step_bits)) >> row->step_bits;
    return (iris_q16)((a + more) >> 4) * 16;
}

static inline iris_place place_in(const map_row *row, int32_t column)
{
    iris_place a = row->above[column], b = row->below[column];
    if (row->part == 0) {
        b = a;
    }
    if (a.x_q16 == INT32_MIN || b.x_q16 == INT32_MIN) {
        return nowhere;
    }
    return (iris_place){on_the_way(a.x_q16, b.x_q16, row), on_the_way(a.y_q16, b.y_q16, row)};
}

/* Places of a piece of a row: of so many steps of the map, and the one behind. */
#define PIECE 16

typedef struct {
    iris_place at[PIECE + 1];
    int32_t count; /* steps */
    int step_bits;
} row_piece;

static int exists(iris_place place)
{
    return place.x_q16 != INT32_MIN;
}

/* As iris_row_bends_step, of any numbers. */
static iris_q16 step_to(iris_q16 from, iris_q16 to, int bits)
{
    return (iris_q16)(divided(((int64_t)to - from) >> 4, bits) * 16);
}

/* A step of the map, as far as there are n pixels. */
static void draw_step(uint8_t *to, const row_piece *p, int32_t step, const iris_image *src,
                      const iris_remap *remap, int32_t n)
{
    iris_place a = p->at[step], b = p->at[step + 1];
    iris_run run = {.n = n < 1 << p->step_bits ? n : 1 << p->step_bits,
                    .exists = exists(a) && exists(b),
                    .x = a.x_q16,
                    .y = a.y_q16};
    if (run.exists) {
        run.dx = step_to(a.x_q16, b.x_q16, p->step_bits);
        run.dy = step_to(a.y_q16, b.y_q16, p->step_bits);
    }
    iris_run_draw(to, &run, src, src->format == IRIS_GRAY8 ? 1 : 3, remap->fill);
}

/* How many steps from this one on are inside of the picture with all their neighbors. */
static int32_t steps_inside(const row_piece *p, int32_t first, const iris_image *src)
{
    int32_t step = first;
    while (step <= p->count && exists(p->at[step]) && iris_run_is_inside(p->at[step], src)) {
        step++;
    }
    return step - first - 1;
}

/* Of n pixels. */
static void draw_piece(uint8_t *to, const row_piece *p, const iris_image *src, const iris_remap *remap,
                       int32_t n)
{
    const int channels = src->format == IRIS_GRAY8 ? 1 : 3, bits = p->step_bits;
    for (int32_t step = 0; step < p->count;) {
        int32_t drawn = channels == 1 ? steps_inside(p, step, src) : 0, left = n - (step << bits);
        if (drawn > 0) {
            int32_t places[2 * PIECE + 2];
            for (int32_t k = 0; k <= drawn; k++) {
                places[2 * k] = p->at[step + k].x_q16 + 128;
                places[2 * k + 1] = p->at[step + k].y_q16 + 128;
            }
            const iris_row_bends way = {src->data, src->stride, src->w, bits, places};
            iris_row_bends_u8(to + (step << bits), &way, drawn << bits < left ? drawn << bits : left);
        } else {
            drawn = 1;
            draw_step(to + (step << bits) * channels, p, step, src, remap, left);
        }
        step += drawn;
    }
}

static void draw_row(uint8_t *to, const void *user, const iris_image *src, int32_t y)
{
    const iris_remap *remap = user;
    const int channels = src->format == IRIS_GRAY8 ? 1 : 3, bits = remap->step_bits;
    const int32_t w = remap->size.w, columns = places_of(w, bits);
    const iris_place *above = remap->places + (size_t)(y >> bits) * (size_t)columns;
    const map_row row = {above, above + columns, y & ((1 << bits) - 1), bits};
    for (int32_t column = 0; column < columns - 1; column += PIECE) {
        row_piece piece = {.count = columns - 1 - column < PIECE ? columns - 1 - column : PIECE,
                           .step_bits = bits};
        for (int32_t k = 0; k <= piece.count; k++) {
            piece.at[k] = place_in(&row, column + k);
        }
        draw_piece(to + (column << bits) * channels, &piece, src, remap, w - (column << bits));
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
