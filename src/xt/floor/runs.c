#include "runs.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"

/* Pixels that are drawn at once: without looking for the picture's edge when it is not there. */
#define PIECE 16

iris_place iris_run_place(const iris_run *r, int32_t i)
{
    return (iris_place){(iris_q16)(r->x + (int64_t)i * r->dx), (iris_q16)(r->y + (int64_t)i * r->dy)};
}

/* 256 steps between the pixels; 0 outside of the picture's pixels, whose edges are half a pixel around their centers. */
static int sample_at(int32_t *whole, int32_t *next, uint32_t *part, iris_q16 position, int32_t side)
{
    int64_t at = (int64_t)position + 128;
    if (at < -32768 || at >= (int64_t)side * 65536 - 32768) {
        return 0;
    }
    int32_t last = (side - 1) * 65536;
    int32_t inside = at < 0 ? 0 : at > last ? last : (int32_t)at;
    *whole = inside >> 16;
    *next = *whole + (*whole < side - 1);
    *part = (uint32_t)(inside >> 8) & 255;
    return 1;
}

static uint8_t blend(uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint32_t right, uint32_t down)
{
    uint32_t top = a * (256 - right) + b * right, bottom = c * (256 - right) + d * right;
    return (uint8_t)((top * (256 - down) + bottom * down + 32768) >> 16);
}

/* Any run that exists. */
static void draw_edge(uint8_t *to, const iris_run *r, const iris_image *src, int channels, uint8_t fill)
{
    for (int32_t i = 0; i < r->n; i++, to += channels) {
        int32_t x, y, x_next, y_next;
        uint32_t right, down;
        iris_place at = iris_run_place(r, i);
        if (!sample_at(&x, &x_next, &right, at.x_q16, src->w) ||
            !sample_at(&y, &y_next, &down, at.y_q16, src->h)) {
            memset(to, fill, (size_t)channels);
            continue;
        }
        const uint8_t *above = iris_image_row(src, y), *below = iris_image_row(src, y_next);
        for (int c = 0; c < channels; c++) {
            to[c] = blend(above[x * channels + c], above[x_next * channels + c], below[x * channels + c],
                          below[x_next * channels + c], right, down);
        }
    }
}

/* A run that is inside of the picture with all its neighbors. */
static void draw_gray(uint8_t *to, const iris_run *r, const iris_image *src)
{
    const iris_row_way way = {src->data, src->stride, r->x + 128, r->y + 128, r->dx, r->dy};
    iris_row_along_u8(to, &way, r->n);
}

static void draw_color(uint8_t *to, const iris_run *r, const iris_image *src)
{
    int32_t x = r->x + 128, y = r->y + 128;
    const int32_t dx = r->dx, dy = r->dy, n = r->n;
    const uint8_t *pixels = src->data;
    const ptrdiff_t stride = src->stride;
    for (int32_t i = 0; i < n; i++, x += dx, y += dy, to += 3) {
        const uint8_t *above = pixels + (y >> 16) * stride + (x >> 16) * 3, *below = above + stride;
        uint32_t right = (uint32_t)(x >> 8) & 255, down = (uint32_t)(y >> 8) & 255;
        for (int c = 0; c < 3; c++) {
            to[c] = blend(above[c], above[3 + c], below[c], below[3 + c], right, down);
        }
    }
}

/* Are all positions between these two beyond one side of the picture? */
static int is_outside(iris_place a, iris_place b, const iris_image *src)
{
    int32_t right = src->w * 65536 - 32768, bottom = src->h * 65536 - 32768;
    return (a.x_q16 < -33000 && b.x_q16 < -33000) || (a.y_q16 < -33000 && b.y_q16 < -33000) ||
           (a.x_q16 > right && b.x_q16 > right) || (a.y_q16 > bottom && b.y_q16 > bottom);
}

/* Part of a run: inside, outside, or across the edge. */
static void draw_part(uint8_t *to, const iris_run *part, const iris_image *src, int channels, uint8_t fill)
{
    iris_place at = {part->x, part->y}, end = iris_run_place(part, part->n - 1);
    if (!part->exists || is_outside(at, end, src)) {
        memset(to, fill, (size_t)part->n * (size_t)channels);
    } else if (!iris_run_is_inside(at, src) || !iris_run_is_inside(end, src)) {
        draw_edge(to, part, src, channels, fill);
    } else {
        (channels == 1 ? draw_gray : draw_color)(to, part, src);
    }
}

/* A run that is inside at both ends is inside all the way. */
void iris_run_draw(uint8_t *to, const iris_run *r, const iris_image *src, int channels, uint8_t fill)
{
    iris_place at = {r->x, r->y};
    int inside =
        r->exists && iris_run_is_inside(at, src) && iris_run_is_inside(iris_run_place(r, r->n - 1), src);
    int32_t most = inside ? r->n : PIECE;
    for (int32_t first = 0; first < r->n; first += most, to += most * channels) {
        at = iris_run_place(r, first);
        const iris_run part = {
            r->n - first < most ? r->n - first : most, r->exists, at.x_q16, at.y_q16, r->dx, r->dy};
        draw_part(to, &part, src, channels, fill);
    }
}

int iris_run_sees(iris_place at, iris_size source)
{
    int32_t whole, next;
    uint32_t part;
    return sample_at(&whole, &next, &part, at.x_q16, source.w) &&
           sample_at(&whole, &next, &part, at.y_q16, source.h);
}

static iris_status check_source(const iris_image *src, iris_size size)
{
    iris_status status = iris_image_check(src);
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_format_is_levels(src->format)) {
        return IRIS_ERR_FORMAT;
    }
    return src->w != size.w || src->h != size.h ? IRIS_ERR_RANGE : IRIS_OK;
}

iris_status iris_run_picture_draw(const iris_image *dst, const iris_image *src,
                                  const iris_run_picture *picture)
{
    iris_status status = iris_image_check(dst);
    status = status == IRIS_OK ? check_source(src, picture->source) : status;
    if (status != IRIS_OK) {
        return status;
    }
    if (dst->format != src->format) {
        return IRIS_ERR_FORMAT;
    }
    if (dst->w != picture->size.w || dst->h != picture->size.h) {
        return IRIS_ERR_RANGE;
    }
    if (iris_image_overlaps(dst, src)) {
        return IRIS_ERR_ALIAS;
    }
    for (int32_t y = 0; y < dst->h; y++) {
        picture->row(iris_image_row(dst, y), picture->user, src, y);
    }
    return IRIS_OK;
}

iris_status iris_run_picture_row(void *pixels, const iris_image *src, const iris_run_picture *picture,
                                 int32_t y)
{
    iris_status status = check_source(src, picture->source);
    if (status == IRIS_OK && (y < 0 || y >= picture->size.h)) {
        status = IRIS_ERR_RANGE;
    }
    if (status == IRIS_OK) {
        picture->row(pixels, picture->user, src, y);
    }
    return status;
}
