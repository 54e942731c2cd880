#include "edge_rows.h"

static void row_roberts(const iris_row_gradient *to, const uint8_t *const rows[3], int32_t n)
{
    const uint8_t *here = rows[1], *below = rows[2];
    for (int32_t x = 0; x < n; x++) {
        int32_t dx = below[x + 1] - here[x], dy = below[x] - here[x + 1];
        to->dx[x] = (int16_t)dx;
        to->dy[x] = (int16_t)dy;
        to->size[x] = (int16_t)((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy));
    }
}

static int32_t more_of(iris_edge_operator op)
{
    return op == IRIS_EDGE_SOBEL     ? IRIS_EDGE_MORE_SOBEL
           : op == IRIS_EDGE_PREWITT ? IRIS_EDGE_MORE_PREWITT
                                     : IRIS_EDGE_MORE_ISOTROPIC;
}

void iris_edge_row(const iris_row_gradient *to, const uint8_t *const rows[3], iris_edge_operator op,
                   int32_t n)
{
    if (op == IRIS_EDGE_ROBERTS) {
        row_roberts(to, rows, n);
    } else if (op == IRIS_EDGE_LAPLACIAN) {
        iris_row_laplacian_u8(to->dx, rows, n);
    } else {
        iris_row_gradient_u8(to, rows, more_of(op), n);
    }
}

void iris_edge_row_u8(uint8_t *dst, const uint8_t *const rows[3], iris_edge_operator op, uint32_t gain_q16,
                      int32_t n)
{
    if (op == IRIS_EDGE_LAPLACIAN) {
        iris_row_laplacian_gain_u8(dst, rows, gain_q16, n);
    } else {
        iris_row_gradient_gain_u8(dst, rows, more_of(op), gain_q16, n);
    }
}
