/* From packed pixels of any depth to rows of gray or color. */
#include "bmp_reader.h"
#include "kernel.h"

#include <string.h>

int32_t iris_bmp_piece_pixels(const iris_bmp_reader *reader)
{
    return reader->bits <= 8 ? IRIS_BMP_PIECE : IRIS_BMP_PIECE / 4;
}

static void unpack_indices(uint8_t *indices, const uint8_t *packed, int32_t bits, int32_t n)
{
    uint32_t largest = (1u << bits) - 1;
    for (int32_t i = 0; i < n; i++) {
        int32_t at = i * bits;
        indices[i] = (uint8_t)((uint32_t)packed[at / 8] >> (8 - bits - at % 8) & largest);
    }
}

static void put_indices(iris_bmp_row_out out, int32_t x, const uint8_t palette[][4], const uint8_t *indices,
                        int32_t n)
{
    if (out.format == IRIS_GRAY8) {
        for (int32_t i = 0; i < n; i++) {
            out.pixels[x + i] = palette[indices[i]][3];
        }
        return;
    }
    int red = out.format == IRIS_BGR888 ? 2 : 0;
    uint8_t *dst = out.pixels + 3 * (size_t)x;
    for (int32_t i = 0; i < n; i++, dst += 3) {
        const uint8_t *color = palette[indices[i]];
        dst[red] = color[0];
        dst[1] = color[1];
        dst[2 - red] = color[2];
    }
}

static void put_bgr(iris_bmp_row_out out, int32_t x, const uint8_t *bgr, int32_t n)
{
    if (out.format == IRIS_GRAY8) {
        iris_row_luma_bgr888(out.pixels + x, bgr, n);
    } else if (out.format == IRIS_RGB888) {
        iris_row_swap_888(out.pixels + 3 * (size_t)x, bgr, n);
    } else {
        memcpy(out.pixels + 3 * (size_t)x, bgr, 3 * (size_t)n);
    }
}

static void unpack_fields(uint8_t *bgr, const iris_bmp_reader *reader, const uint8_t *packed, int32_t n)
{
    for (int32_t i = 0; i < n; i++, bgr += 3) {
        uint32_t pixel = (uint32_t)packed[0] | (uint32_t)packed[1] << 8;
        if (reader->bits == 32) {
            pixel |= (uint32_t)packed[2] << 16 | (uint32_t)packed[3] << 24;
        }
        packed += reader->bits / 8;
        for (int32_t k = 0; k < 3; k++) {
            uint32_t field = (pixel & reader->mask[k]) >> reader->shift[k];
            bgr[2 - k] = (uint8_t)((field * reader->scale_q16[k] + 0x8000u) >> 16);
        }
    }
}

void iris_bmp_unpack(const iris_bmp_reader *reader, iris_bmp_row_out out, int32_t x, const uint8_t *packed,
                     int32_t n)
{
    uint8_t unpacked[IRIS_BMP_PIECE];
    if (!out.pixels || n <= 0) {
        return;
    }
    if (reader->bits <= 8) {
        unpack_indices(unpacked, packed, reader->bits, n);
        put_indices(out, x, reader->palette, unpacked, n);
    } else if (reader->bits == 24) {
        put_bgr(out, x, packed, n);
    } else {
        unpack_fields(unpacked, reader, packed, n);
        put_bgr(out, x, unpacked, n);
    }
}
