#include "iris/xt/hitmiss.h"

#include "../foundation/rows.h"
#include "../foundation/views.h"
#include "mask_bits.h"

iris_status iris_hitmiss_pattern_read(iris_hitmiss_pattern *pattern, const char *text)
{
    if (!pattern || !text) {
        return IRIS_ERR_ARG;
    }
    iris_hitmiss_pattern read = {0};
    int32_t x = 0;
    for (const char *letter = text;; letter++) {
        if (*letter == '/' || *letter == '\0') {
            if (x == 0 || read.h == IRIS_HITMISS_SIDE_MAX) {
                return IRIS_ERR_RANGE;
            }
            if (read.h > 0 && x != read.w) {
                return IRIS_ERR_DATA;
            }
            read.w = x;
            read.h++;
            x = 0;
            if (*letter == '\0') {
                break;
            }
            continue;
        }
        if (*letter != '0' && *letter != '1' && *letter != '.') {
            return IRIS_ERR_DATA;
        }
        if (x == IRIS_HITMISS_SIDE_MAX || read.h == IRIS_HITMISS_SIDE_MAX) {
            return IRIS_ERR_RANGE;
        }
        read.set[read.h] |= (uint8_t)((*letter == '1') << x);
        read.clear[read.h] |= (uint8_t)((*letter == '0') << x);
        x++;
    }
    *pattern = read;
    return IRIS_OK;
}

static iris_status check(const iris_image *dst, const iris_image *src, const iris_hitmiss_pattern *pattern)
{
    iris_status status = iris_views_check_formats(dst, IRIS_MASK1, src, IRIS_MASK1);
    int fits = pattern->w >= 1 && pattern->w <= IRIS_HITMISS_SIDE_MAX && pattern->h >= 1 &&
               pattern->h <= IRIS_HITMISS_SIDE_MAX;
    return status == IRIS_OK && !fits ? IRIS_ERR_RANGE : status;
}

/* The pixels of 32 whose surroundings agree with row dy of the pattern. around: pixel -32 is in word 0. */
static uint32_t agreeing(const uint32_t around[3], uint32_t set, uint32_t clear, int32_t anchor)
{
    uint32_t hits = ~0u;
    for (int32_t x = 0; (set | clear) >> x != 0; x++) {
        uint32_t pixels = iris_mask_pixels(around, 32 + x - anchor);
        hits &= set >> x & 1 ? pixels : ~0u;
        hits &= clear >> x & 1 ? ~pixels : ~0u;
    }
    return hits;
}

/* Word i of the row that `rows` is at. */
static uint32_t find_word(const iris_rows *rows, const iris_hitmiss_pattern *pattern, int32_t i)
{
    const iris_rows_window *window = &rows->window;
    int32_t last = (rows->src->w + window->right - 1) / 32;
    uint32_t hits = ~0u;
    for (int32_t y = 0; y < pattern->h && hits != 0; y++) {
        const uint32_t *row = (const uint32_t *)(const void *)iris_rows_at(rows, y - window->above);
        uint32_t around[3] = {window->left > 0 ? row[i - 1] : 0, row[i], i < last ? row[i + 1] : 0};
        uint32_t inside = ((uint32_t)1 << pattern->w) - 1;
        hits &= agreeing(around, pattern->set[y] & inside, pattern->clear[y] & inside, window->left);
    }
    return hits;
}

iris_status iris_hitmiss_find(const iris_image *dst, const iris_image *src,
                              const iris_hitmiss_pattern *pattern, iris_border border, iris_scratch *scratch)
{
    if (!pattern || !scratch || (unsigned)border.rule > IRIS_BORDER_SKIP) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check(dst, src, pattern);
    if (status != IRIS_OK) {
        return status;
    }
    iris_rows rows;
    iris_rows_window window = {(pattern->w - 1) / 2, pattern->w / 2, (pattern->h - 1) / 2, pattern->h / 2};
    size_t mark = iris_scratch_mark(scratch);
    status = iris_rows_begin(&rows, src, window, border, scratch);
    for (; status == IRIS_OK && rows.y < src->h; iris_rows_next(&rows)) {
        uint32_t *row = (uint32_t *)iris_image_row(dst, rows.y);
        int32_t first, end;
        if (!iris_rows_span(&first, &end, &rows)) {
            continue;
        }
        for (int32_t i = first / 32; 32 * i < end; i++) {
            uint32_t pixels = iris_mask_range(i, first, end);
            row[i] = (row[i] & ~pixels) | (find_word(&rows, pattern, i) & pixels);
        }
    }
    iris_scratch_release(scratch, mark);
    return status;
}
