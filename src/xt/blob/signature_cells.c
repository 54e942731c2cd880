#include "signature_cells.h"

#include "../../foundation/yuv.h"

static int is_level(int32_t channel)
{
    return channel >= -256 && channel < 257 * 256;
}

static int32_t between(int32_t first, int32_t last, int32_t quarters)
{
    return first + (last - first) * quarters / 4;
}

iris_color iris_signature_color_of(int32_t cell, iris_signature_yuv along, int *is_color)
{
    const int32_t level = cell % IRIS_SIGNATURE_LEVELS, steps = cell / IRIS_SIGNATURE_LEVELS;
    const iris_signature_band u = iris_signature_bands[steps / IRIS_SIGNATURE_STEPS];
    const iris_signature_band v = iris_signature_bands[steps % IRIS_SIGNATURE_STEPS];
    const iris_yuv_tint tint = iris_yuv_tint_of((uint8_t)(128 + between(u.first, u.last, along.u)),
                                                (uint8_t)(128 + between(v.first, v.last, along.v)));
    const int32_t y = between((level * 2048 + 83) / 84, ((level + 1) * 2048 - 1) / 84, along.y);
    const int32_t luma = iris_yuv_luma((uint8_t)(16 + (y < 219 ? y : 219)));
    if (is_color) {
        *is_color = is_level(luma + tint.r) && is_level(luma + tint.g) && is_level(luma + tint.b);
    }
    return (iris_color){iris_yuv_channel(luma + tint.r), iris_yuv_channel(luma + tint.g),
                        iris_yuv_channel(luma + tint.b)};
}

/* `step` bytes from pixel to pixel; red is the first byte, or blue. */
static void cells_of_bytes(uint16_t *cells, const uint8_t *from, int32_t n, int32_t step, int red_first)
{
    const uint8_t *red = from + (red_first ? 0 : 2), *blue = from + (red_first ? 2 : 0);
    for (int32_t i = 0; i < n; i++) {
        const int32_t at = i * step;
        cells[i] = (uint16_t)iris_signature_cell_of_rgb(red[at], from[at + 1], blue[at]);
    }
}

static void cells_of_565(uint16_t *cells, const uint8_t *from, int32_t n, int high)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t pixel = from[2 * i + high] << 8 | from[2 * i + 1 - high];
        int32_t r = pixel >> 11, g = pixel >> 5 & 63, b = pixel & 31;
        cells[i] = (uint16_t)iris_signature_cell_of_rgb(r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2);
    }
}

/* `luma` is the place of Y0 among the four bytes of two pixels. */
static void cells_of_422(uint16_t *cells, const uint8_t *from, int32_t n, int luma)
{
    for (int32_t i = 0; i < n; i += 2, from += 4) {
        int32_t u = from[1 - luma], v = from[3 - luma];
        cells[i] = (uint16_t)iris_signature_cell_of_yuv(from[luma], u, v);
        cells[i + 1] = (uint16_t)iris_signature_cell_of_yuv(from[luma + 2], u, v);
    }
}

static void cells_of_gray(uint16_t *cells, const uint8_t *from, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        cells[i] = (uint16_t)iris_signature_cell_of_rgb(from[i], from[i], from[i]);
    }
}

void iris_signature_cells_row(uint16_t *cells, const void *row, iris_format format, int32_t x, int32_t n)
{
    const uint8_t *from = (const uint8_t *)row + (x > 0 ? iris_format_row_bytes(format, x) : 0);
    switch (format) {
    case IRIS_RGB888:
    case IRIS_BGR888:
        cells_of_bytes(cells, from, n, 3, format == IRIS_RGB888);
        break;
    case IRIS_RGBA8888:
        cells_of_bytes(cells, from, n, 4, 1);
        break;
    case IRIS_RGB565:
    case IRIS_RGB565_SWAP:
        cells_of_565(cells, from, n, format == IRIS_RGB565);
        break;
    case IRIS_YUYV:
    case IRIS_UYVY:
        cells_of_422(cells, from, n, format == IRIS_UYVY);
        break;
    default:
        cells_of_gray(cells, from, n);
        break;
    }
}
