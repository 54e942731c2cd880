#include "iris/xt/hitmiss.h"

#include <string.h>

#include "../../foundation/kernel.h"
#include "../../foundation/rows.h"
#include "../../foundation/views.h"
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

/* Of the pixels set in some words those stay whose neighbor `at` farther on in row is set, or with turn = ~0 clear; no word
 * of row behind `last` is looked at. */
static void keep_agreeing(uint32_t *to, int32_t words, const uint32_t *row, int32_t at, uint32_t turn,
                          int32_t last)
{
    int32_t end = 32 * (words - 1) + at, whole = end >> 5 < last ? words : words - 1;
    iris_row_agree_mask(to, row, at, turn, whole);
    if (whole < words) {
        to[whole] &= row[end >> 5] >> (end & 31) ^ turn;
    }
}

/* The pixels where the pattern occurs in the row that `rows` is at, of its first words. */
static void find_in_row(uint32_t *to, int32_t words, const iris_rows *rows,
                        const iris_hitmiss_pattern *pattern)
{
    const iris_rows_window *window = &rows->window;
    int32_t last = (rows->src->w + window->right - 1) / 32;
    memset(to, 255, 4 * (size_t)words);
    for (int32_t y = 0; y < pattern->h; y++) {
        const uint32_t *row = (const uint32_t *)(const void *)iris_rows_at(rows, y - window->above);
        for (int32_t x = 0; x < pattern->w; x++) {
            if (pattern->set[y] >> x & 1) {
                keep_agreeing(to, words, row, x - window->left, 0, last);
            }
            if (pattern->clear[y] >> x & 1) {
                keep_agreeing(to, words, row, x - window->left, ~0u, last);
            }
        }
    }
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
        int32_t last = (end - 1) / 32; /* first is in word 0 */
        uint32_t before = row[0], after = row[last];
        uint32_t first_bits = iris_mask_range(0, first, end), last_bits = iris_mask_range(last, first, end);
        find_in_row(row, last + 1, &rows, pattern);
        row[0] = (row[0] & first_bits) | (before & ~first_bits);
        row[last] = (row[last] & last_bits) | (after & ~last_bits);
    }
    iris_scratch_release(scratch, mark);
    return status;
}
