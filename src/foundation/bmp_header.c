/* The headers of a BMP: file header, one of the information headers, masks, palette. */
#include "bmp_reader.h"
#include "kernel.h"

#include <string.h>

#define FILE_HEADER_BYTES 14
#define INFO_BYTES_CORE   12 /* OS/2 1.x */
#define INFO_BYTES_MIN    16 /* OS/2 2.x, cut short */
#define INFO_BYTES_V1     40
#define INFO_BYTES_OS2    64
#define INFO_BYTES_MAX    124 /* Windows V5 */

enum { BI_RGB, BI_RLE8, BI_RLE4, BI_BITFIELDS, BI_JPEG, BI_PNG, BI_ALPHABITFIELDS };

typedef struct {
    uint32_t info_bytes;  /* size of the information header */
    uint32_t data_offset; /* declared position of the pixels */
    uint32_t compression;
    uint32_t colors; /* declared entries of the palette */
    uint8_t info[INFO_BYTES_MAX];
} header;

static uint32_t u16(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8;
}

static uint32_t u32(const uint8_t *bytes)
{
    return u16(bytes) | u16(bytes + 2) << 16;
}

/* An end of input where bytes must follow. */
static iris_status expect(iris_stream *stream, uint8_t *buffer, size_t bytes)
{
    iris_status status = iris_stream_read(stream, buffer, bytes);
    return status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
}

/* Reads both headers; what a short information header lacks is zero. */
static iris_status read_headers(iris_bmp_reader *reader, header *head)
{
    uint8_t file[FILE_HEADER_BYTES + 4];
    iris_status status = iris_stream_read(reader->stream, file, 2);
    if (status != IRIS_OK) {
        return status;
    }
    if (file[0] != 'B' || file[1] != 'M') {
        return IRIS_ERR_DATA;
    }
    status = expect(reader->stream, file + 2, sizeof file - 2);
    if (status != IRIS_OK) {
        return status;
    }
    reader->file_bytes = u32(file + 2);
    head->data_offset = u32(file + 10);
    head->info_bytes = u32(file + FILE_HEADER_BYTES);
    if (head->info_bytes != INFO_BYTES_CORE &&
        (head->info_bytes < INFO_BYTES_MIN || head->info_bytes > INFO_BYTES_MAX)) {
        return IRIS_ERR_DATA;
    }
    memset(head->info, 0, sizeof head->info);
    return expect(reader->stream, head->info + 4, head->info_bytes - 4);
}

static iris_status parse_size(iris_bmp_reader *reader, const header *head)
{
    int64_t w, h;
    if (head->info_bytes == INFO_BYTES_CORE) {
        w = u16(head->info + 4);
        h = u16(head->info + 6);
        reader->bits = (int32_t)u16(head->info + 10);
    } else {
        w = (int32_t)u32(head->info + 4);
        h = (int32_t)u32(head->info + 8);
        reader->bits = (int32_t)u16(head->info + 14);
    }
    reader->top_down = h < 0;
    h = h < 0 ? -h : h;
    if (w <= 0 || h == 0) {
        return IRIS_ERR_DATA;
    }
    if (w > IRIS_SIDE_MAX || h > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    reader->w = (int32_t)w;
    reader->h = (int32_t)h;
    return IRIS_OK;
}

/* The kind of an uncompressed picture. */
static iris_status parse_plain(iris_bmp_reader *reader)
{
    switch (reader->bits) {
    case 1:
    case 2:
    case 4:
    case 8:
        reader->kind = IRIS_BMP_PALETTE;
        return IRIS_OK;
    case 16:
    case 32:
        reader->kind = IRIS_BMP_BITFIELDS;
        return IRIS_OK;
    case 24:
        reader->kind = IRIS_BMP_BGR;
        return IRIS_OK;
    case 64:
        return IRIS_ERR_UNSUPPORTED;
    default:
        return IRIS_ERR_DATA;
    }
}

/* Numbers 3 and 4 mean Huffman and RLE24 on OS/2, bit fields and JPEG on Windows. */
static iris_status parse_kind(iris_bmp_reader *reader, const header *head)
{
    int32_t bits = reader->bits;
    switch (head->compression) {
    case BI_RGB:
        return parse_plain(reader);
    case BI_RLE8:
    case BI_RLE4:
        reader->kind = IRIS_BMP_RLE;
        return reader->top_down || bits != (head->compression == BI_RLE8 ? 8 : 4) ? IRIS_ERR_DATA : IRIS_OK;
    case BI_BITFIELDS:
    case BI_ALPHABITFIELDS:
        if (head->info_bytes == INFO_BYTES_OS2 || bits == 1) {
            return IRIS_ERR_UNSUPPORTED;
        }
        reader->kind = IRIS_BMP_BITFIELDS;
        return bits == 16 || bits == 32 ? IRIS_OK : IRIS_ERR_DATA;
    case BI_JPEG:
        if (bits == 24) {
            reader->kind = IRIS_BMP_RLE;
            return reader->top_down ? IRIS_ERR_DATA : IRIS_OK;
        }
        return IRIS_ERR_UNSUPPORTED;
    default:
        return IRIS_ERR_UNSUPPORTED;
    }
}

/* Prepares the conversion of the field under mask i to 0..255. Fields above 8 bits lose their lowest bits. */
static iris_status set_mask(iris_bmp_reader *reader, int32_t i, uint32_t mask)
{
    uint32_t shift = 0;
    reader->mask[i] = mask;
    reader->shift[i] = 0;
    reader->scale_q16[i] = 0;
    if (mask == 0) {
        return IRIS_OK;
    }
    while ((mask >> shift & 1) == 0) {
        shift++;
    }
    uint32_t largest = mask >> shift;
    if ((largest & (largest + 1)) != 0 || (reader->bits == 16 && mask > 0xFFFF)) {
        return IRIS_ERR_DATA;
    }
    while (largest > 255) {
        largest >>= 1;
        shift++;
    }
    reader->shift[i] = (uint8_t)shift;
    reader->scale_q16[i] = (255u << 16) / largest;
    return IRIS_OK;
}

static iris_status parse_masks(iris_bmp_reader *reader, const header *head)
{
    uint8_t bytes[16];
    uint32_t masks[3] = {0xFF0000, 0xFF00, 0xFF};
    if (head->compression == BI_RGB && reader->bits == 16) {
        masks[0] = 0x7C00;
        masks[1] = 0x3E0;
        masks[2] = 0x1F;
    }
    if (head->compression != BI_RGB) {
        if (head->info_bytes <= INFO_BYTES_V1) {
            iris_status status = expect(reader->stream, bytes, head->compression == BI_BITFIELDS ? 12 : 16);
            if (status != IRIS_OK) {
                return status;
            }
        } else {
            memcpy(bytes, head->info + INFO_BYTES_V1, 12);
        }
        for (int32_t i = 0; i < 3; i++) {
            masks[i] = u32(bytes + 4 * i);
        }
        if ((masks[0] | masks[1] | masks[2]) == 0) {
            return IRIS_ERR_DATA;
        }
    }
    iris_status status = IRIS_OK;
    for (int32_t i = 0; i < 3 && status == IRIS_OK; i++) {
        status = set_mask(reader, i, masks[i]);
    }
    return status;
}

/* Reads the entries that both the declared count and the declared start of the pixels leave room for. */
static iris_status read_palette(iris_bmp_reader *reader, const header *head)
{
    size_t entry = head->info_bytes == INFO_BYTES_CORE ? 3 : 4;
    uint32_t count = 1u << reader->bits;
    uint64_t position = iris_bmp_position(reader);
    if (head->colors > 0 && head->colors < count) {
        count = head->colors;
    }
    if (head->data_offset > position && (head->data_offset - position) / entry < count) {
        count = (uint32_t)((head->data_offset - position) / entry);
    }
    reader->is_gray = 1;
    for (uint32_t i = 0; i < count; i++) {
        uint8_t color[4];
        iris_status status = expect(reader->stream, color, entry);
        if (status != IRIS_OK) {
            return status;
        }
        iris_row_swap_888(reader->palette[i], color, 1);
        iris_row_luma_bgr888(&reader->palette[i][3], color, 1);
        reader->is_gray &= color[0] == color[1] && color[1] == color[2];
    }
    return count > 0 ? IRIS_OK : IRIS_ERR_DATA;
}

static iris_status parse(iris_bmp_reader *reader)
{
    header head;
    iris_status status = read_headers(reader, &head);
    if (status != IRIS_OK) {
        return status;
    }
    head.compression = u32(head.info + 16);
    head.colors = u32(head.info + 32);
    reader->pixel_bytes = u32(head.info + 20);
    status = parse_size(reader, &head);
    if (status == IRIS_OK) {
        status = parse_kind(reader, &head);
    }
    if (status == IRIS_OK && reader->kind == IRIS_BMP_BITFIELDS) {
        status = parse_masks(reader, &head);
    }
    if (status == IRIS_OK && reader->bits <= 8) {
        status = read_palette(reader, &head);
    }
    if (status != IRIS_OK) {
        return status;
    }
    uint64_t position = iris_bmp_position(reader);
    if (head.data_offset > position) {
        if (head.data_offset - position > IRIS_BMP_GAP_MAX) {
            return IRIS_ERR_DATA;
        }
        status = iris_stream_skip(reader->stream, head.data_offset - position);
    }
    reader->pixels = iris_bmp_position(reader);
    return status == IRIS_ERR_END ? IRIS_ERR_TRUNCATED : status;
}

iris_status iris_bmp_begin(iris_bmp_reader *reader, iris_stream *stream)
{
    if (!reader || !stream) {
        return IRIS_ERR_ARG;
    }
    memset(reader, 0, sizeof *reader);
    reader->stream = stream;
    reader->start = stream->position;
    reader->status = parse(reader);
    return reader->status;
}
