#include "edge_rows.h"

static int16_t weighed(int32_t one, int32_t middle, int32_t other, int32_t more)
{
    return (int16_t)(one + middle + other + ((more * middle + 64) >> 7));
}

static void row_3x3(int16_t *dx, int16_t *dy, const uint8_t *const rows[3], int32_t more, int32_t first,
                    int32_t end)
{
    const uint8_t *above = rows[0], *here = rows[1], *below = rows[2];
    for (int32_t x = first; x < end; x++) {
        dx[x] = weighed(above[x + 1] - above[x - 1], here[x + 1] - here[x - 1], below[x + 1] - below[x - 1],
                        more);
        dy[x] = weighed(below[x - 1] - above[x - 1], below[x] - above[x], below[x + 1] - above[x + 1], more);
    }
}

static void row_roberts(int16_t *dx, int16_t *dy, const uint8_t *const rows[3], int32_t first, int32_t end)
{
    const uint8_t *here = rows[1], *below = rows[2];
    for (int32_t x = first; x < end; x++) {
        dx[x] = (int16_t)(below[x + 1] - here[x]);
        dy[x] = (int16_t)(below[x] - here[x + 1]);
    }
}

static void row_laplacian(int16_t *value, const uint8_t *const rows[3], int32_t first, int32_t end)
{
    const uint8_t *above = rows[0], *here = rows[1], *below = rows[2];
    for (int32_t x = first; x < end; x++) {
        value[x] = (int16_t)(above[x] + below[x] + here[x - 1] + here[x + 1] - 4 * here[x]);
    }
}

void iris_edge_row(int16_t *dx, int16_t *dy, const uint8_t *const rows[3], iris_edge_operator op,
                   int32_t first, int32_t end)
{
    switch (op) {
    case IRIS_EDGE_SOBEL:
        row_3x3(dx, dy, rows, IRIS_EDGE_MORE_SOBEL, first, end);
        break;
    case IRIS_EDGE_PREWITT:
        row_3x3(dx, dy, rows, IRIS_EDGE_MORE_PREWITT, first, end);
        break;
    case IRIS_EDGE_ISOTROPIC:
        row_3x3(dx, dy, rows, IRIS_EDGE_MORE_ISOTROPIC, first, end);
        break;
    case IRIS_EDGE_ROBERTS:
        row_roberts(dx, dy, rows, first, end);
        break;
    case IRIS_EDGE_LOG:
        break; /* log_rows.h */
    case IRIS_EDGE_LAPLACIAN:
        row_laplacian(dx, rows, first, end);
        break;
    }
}
