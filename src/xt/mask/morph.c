#include "iris/xt/morph.h"

#include "../../foundation/kernel.h"
#include "../../foundation/views.h"
#include "mask_bits.h"
#include "morph_step.h"

typedef enum { DILATE, ERODE, OPEN, CLOSE, GRADIENT, TOPHAT, BLACKHAT } morph_kind;

void iris_morph_element_defaults(iris_morph_element *element)
{
    if (element) {
        *element = (iris_morph_element){3, 3, IRIS_MORPH_SQUARE, 0};
    }
}

static iris_status check_element(const iris_morph_element *element)
{
    if (element->shape != IRIS_MORPH_SQUARE && element->shape != IRIS_MORPH_CROSS) {
        return IRIS_ERR_ARG;
    }
    if (element->w < 1 || element->w > IRIS_MORPH_SIDE_MAX || element->h < 1 ||
        element->h > IRIS_MORPH_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    return element->exclude_center && element->w == 1 && element->h == 1 ? IRIS_ERR_RANGE : IRIS_OK;
}

static iris_status check_pictures(const iris_image *dst, const iris_image *src)
{
    int masks = dst && src && dst->format == IRIS_MASK1 && src->format == IRIS_MASK1;
    return masks ? iris_views_check_formats(dst, IRIS_MASK1, src, IRIS_MASK1)
                 : iris_views_check_levels(dst, src, IRIS_BORDER_NONE);
}

/* dst = a - b, at least 0; of masks, what is set in a alone. */
static void row_minus(uint8_t *dst, const uint8_t *a, const uint8_t *b, int32_t n, int mask)
{
    if (!mask) {
        iris_row_minus_u8(dst, a, b, n);
        return;
    }
    uint32_t *to = (uint32_t *)(void *)dst;
    const uint32_t *p = (const uint32_t *)(const void *)a, *q = (const uint32_t *)(const void *)b;
    for (int32_t i = 0; i < n / 4; i++) {
        to[i] = p[i] & ~q[i];
    }
}

/* The second step's source: the rows of the first. */
static void make_row(void *user, uint8_t *to, int32_t y)
{
    iris_morph_step *first = (iris_morph_step *)user;
    if (y > 0) {
        iris_rows_next(&first->rows);
    }
    iris_morph_step_row(first, to, 0, first->row_bytes);
}

/* An operation on its way down the picture. The result is the second step's, by itself or in a difference. */
typedef struct {
    morph_kind kind;
    iris_morph_step first, second;
} morph_work;

static int is_chain(morph_kind kind)
{
    return kind != DILATE && kind != ERODE && kind != GRADIENT;
}

static iris_status begin(morph_work *work, const iris_image *src, const iris_morph_element *element,
                         iris_border border, iris_scratch *scratch)
{
    morph_kind what = work->kind;
    iris_rows_source image = {.shape = src}, made = {src, make_row, &work->first};
    iris_status status = IRIS_OK;
    work->second.erodes = what == ERODE || what == CLOSE || what == BLACKHAT;
    work->first.erodes = !work->second.erodes;
    if (what != DILATE && what != ERODE) {
        status = iris_morph_step_begin(&work->first, &image, element, border, scratch);
    }
    if (status == IRIS_OK) {
        status =
            iris_morph_step_begin(&work->second, is_chain(what) ? &made : &image, element, border, scratch);
    }
    return status;
}

/* Bytes from..from + n - 1 of row y, to `to`. */
static void make_result(uint8_t *to, morph_work *work, int32_t y, int32_t from, int32_t n)
{
    iris_morph_step *first = &work->first, *second = &work->second;
    int mask = second->rows.src->format == IRIS_MASK1;
    iris_morph_step_row(second, to, from, n);
    if (work->kind == GRADIENT) {
        iris_morph_step_row(first, second->run, from, n);
        iris_rows_next(&first->rows);
        row_minus(to, to, second->run, n, mask);
    } else if (work->kind == TOPHAT || work->kind == BLACKHAT) {
        /* The first step is at most as far ahead as the rows are kept. */
        const uint8_t *row = iris_rows_at(&first->rows, y - first->rows.y) + from;
        int top = work->kind == TOPHAT;
        row_minus(to, top ? row : to, top ? to : row, n, mask);
    }
}

/* The pixels that are to be written, by IRIS_BORDER_SKIP not all. May be empty or less. */
static iris_rect result_rect(const morph_work *work, const iris_image *dst, iris_border_rule rule)
{
    const iris_morph_step *step = &work->second;
    const iris_morph_element *element = &step->element;
    int32_t left = step->left, above = step->above, w = element->w - 1, h = element->h - 1;
    if (rule != IRIS_BORDER_SKIP) {
        return (iris_rect){0, 0, dst->w, dst->h};
    }
    if (work->kind == GRADIENT) {
        left = element->w / 2;
        above = element->h / 2;
        w = 2 * left;
        h = 2 * above;
    } else if (is_chain(work->kind)) {
        left = w;
        above = h;
        w *= 2;
        h *= 2;
    }
    return (iris_rect){left, above, dst->w - w, dst->h - h};
}

/* Pixels x..x + w - 1 of a mask's row y, w at least 1; the others of their words keep their values. */
static void make_mask_result(uint32_t *row, morph_work *work, int32_t y, int32_t x, int32_t w)
{
    int32_t first = x / 32, last = (x + w - 1) / 32;
    uint32_t before = row[first], after = row[last];
    uint32_t first_bits = iris_mask_range(first, x, x + w), last_bits = iris_mask_range(last, x, x + w);
    make_result((uint8_t *)(row + first), work, y, 4 * first, 4 * (last - first + 1));
    row[first] = (row[first] & first_bits) | (before & ~first_bits);
    row[last] = (row[last] & last_bits) | (after & ~last_bits);
}

static iris_status make_picture(const iris_image *dst, const iris_image *src,
                                const iris_morph_element *element, iris_border border, iris_scratch *scratch,
                                morph_kind kind)
{
    morph_work work;
    work.kind = kind;
    iris_status status = begin(&work, src, element, border, scratch);
    if (status != IRIS_OK) {
        return status;
    }
    iris_rect rect = result_rect(&work, dst, border.rule);
    int32_t channels = work.second.rows.channels;
    for (int32_t y = 0; y < dst->h; y++, iris_rows_next(&work.second.rows)) {
        uint8_t *row = (uint8_t *)iris_image_row(dst, y);
        if (rect.w < 1 || y < rect.y || y >= rect.y + rect.h) {
            make_result(row, &work, y, 0, 0);
        } else if (dst->format == IRIS_MASK1) {
            make_mask_result((uint32_t *)(void *)row, &work, y, rect.x, rect.w);
        } else {
            make_result(row + rect.x * channels, &work, y, rect.x * channels, rect.w * channels);
        }
    }
    return IRIS_OK;
}

static iris_status make_near(const iris_image *dst, const iris_image *src, const iris_morph_near *near,
                             iris_border border, iris_scratch *scratch)
{
    uint8_t *level =
        (uint8_t *)iris_scratch_take(scratch, IRIS_MORPH_SCRATCH_BYTES(src->format, src->w, 3, 3));
    if (!level) {
        return IRIS_ERR_SCRATCH;
    }
    iris_morph_near_picture(dst, src, near, border, level);
    return IRIS_OK;
}

static iris_status apply(const iris_image *dst, const iris_image *src, const iris_morph_element *given,
                         iris_border border, iris_scratch *scratch, morph_kind kind)
{
    iris_morph_element element;
    iris_morph_element_defaults(&element);
    if (given) {
        element = *given;
    }
    if (!dst || !src || !scratch || (unsigned)border.rule > IRIS_BORDER_SKIP) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check_element(&element);
    if (status == IRIS_OK) {
        status = check_pictures(dst, src);
    }
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    if ((kind == DILATE || kind == ERODE) && dst->data != src->data && iris_morph_is_near(&element)) {
        iris_morph_near near = iris_morph_near_of(src, &element, kind == ERODE, border);
        status = make_near(dst, src, &near, border, scratch);
    } else {
        status = make_picture(dst, src, &element, border, scratch, kind);
    }
    iris_scratch_release(scratch, mark);
    return status;
}

iris_status iris_morph_dilate(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                              iris_border border, iris_scratch *scratch)
{
    return apply(dst, src, element, border, scratch, DILATE);
}

iris_status iris_morph_erode(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                             iris_border border, iris_scratch *scratch)
{
    return apply(dst, src, element, border, scratch, ERODE);
}

iris_status iris_morph_open(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                            iris_border border, iris_scratch *scratch)
{
    return apply(dst, src, element, border, scratch, OPEN);
}

iris_status iris_morph_close(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                             iris_border border, iris_scratch *scratch)
{
    return apply(dst, src, element, border, scratch, CLOSE);
}

iris_status iris_morph_gradient(const iris_image *dst, const iris_image *src,
                                const iris_morph_element *element, iris_border border, iris_scratch *scratch)
{
    return apply(dst, src, element, border, scratch, GRADIENT);
}

iris_status iris_morph_tophat(const iris_image *dst, const iris_image *src, const iris_morph_element *element,
                              iris_border border, iris_scratch *scratch)
{
    return apply(dst, src, element, border, scratch, TOPHAT);
}

iris_status iris_morph_blackhat(const iris_image *dst, const iris_image *src,
                                const iris_morph_element *element, iris_border border, iris_scratch *scratch)
{
    return apply(dst, src, element, border, scratch, BLACKHAT);
}
