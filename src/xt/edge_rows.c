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

void iris_edge_row(const iris_row_gradient *to, const uint8_t *const rows[3], iris_edge_operator op,
                   int32_t n)
{
    switch (op) {
    case IRIS_EDGE_SOBEL:
        iris_row_gradient_u8(to, rows, IRIS_EDGE_MORE_SOBEL, n);
        break;
    case IRIS_EDGE_PREWITT:
        iris_row_gradient_u8(to, rows, IRIS_EDGE_MORE_PREWITT, n);
        break;
    case IRIS_EDGE_ISOTROPIC:
        iris_row_gradient_u8(to, rows, IRIS_EDGE_MORE_ISOTROPIC, n);
        break;
    case IRIS_EDGE_ROBERTS:
        row_roberts(to, rows, n);
        break;
    case IRIS_EDGE_LAPLACIAN:
        iris_row_laplacian_u8(to->dx, rows, n);
        break;
    case IRIS_EDGE_LOG:
        break; /* log_rows.h */
    }
}
