#include "log_rows.h"

#include "iris/xt/blur.h"

iris_status iris_log_rows_begin(iris_log_rows *log, const iris_image *src, iris_q16 sigma_q16,
                                iris_border border, iris_scratch *scratch)
{
    const size_t row_bytes = IRIS_SCRATCH_ROUND(2u * ((size_t)src->w + 2u));
    *log = (iris_log_rows){.w = src->w, .h = src->h, .border = border, .row_step = row_bytes / 2};
    log->margin = border.rule == IRIS_BORDER_SKIP ? IRIS_BLUR_RADIUS(sigma_q16) + 1 : 0;
    int16_t *memory = (int16_t *)iris_scratch_take(scratch, 4 * row_bytes);
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    for (size_t i = 0; i < log->row_step; i++) {
        memory[i] = (int16_t)(border.value * 64);
    }
    log->rows = memory + 1;
    return iris_blur_rows_begin(&log->blur, src, sigma_q16, border, scratch);
}

static int16_t *row_at(const iris_log_rows *log, int32_t y)
{
    int32_t index = iris_border_index(y, log->h, log->border.rule);
    return log->rows + (index < 0 ? 0 : (size_t)(index % 3 + 1)) * log->row_step;
}

static void load_next(iris_log_rows *log)
{
    int16_t *row = row_at(log, log->loaded++);
    iris_blur_rows_next_q6(&log->blur, row);
    int32_t left = iris_border_index(-1, log->w, log->border.rule);
    int32_t right = iris_border_index(log->w, log->w, log->border.rule);
    row[-1] = left < 0 ? log->rows[0] : row[left];
    row[log->w] = right < 0 ? log->rows[0] : row[right];
}

int iris_log_rows_next(iris_log_rows *log, int16_t *dst, int32_t *first, int32_t *end)
{
    const int32_t y = log->y++;
    while (log->loaded < log->h && log->loaded <= y + 1) {
        load_next(log);
    }
    *first = log->margin;
    *end = log->w - log->margin;
    if (*first >= *end || y < log->margin || y >= log->h - log->margin) {
        return 0;
    }
    const int16_t *above = row_at(log, y - 1), *here = row_at(log, y), *below = row_at(log, y + 1);
    for (int32_t x = *first; x < *end; x++) {
        int32_t sum = above[x] + below[x] + here[x - 1] + here[x + 1] - 4 * here[x];
        dst[x] = (int16_t)((sum + 1) >> 1);
    }
    return 1;
}
