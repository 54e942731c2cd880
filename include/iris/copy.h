/* IRIS - copying pixels: whole views, clipped pastes, fills, channels, and other sizes.
 *
 * Every function returns IRIS_ERR_ARG for a null pointer and the errors of iris_image_check for a view that
 * is not valid, besides what its comment says. Only iris_paste clips. Bits of IRIS_MASK1 past w are kept.
 * Report, section 3.2.2 (RGB_BufferManager).
 */
#ifndef IRIS_COPY_H
#define IRIS_COPY_H

#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* dst = src, any format. dst may be src (nothing to do), else they are disjoint.
 * IRIS_ERR_FORMAT, IRIS_ERR_RANGE: formats or sizes differ; IRIS_ERR_ALIAS: partial overlap. O(bytes). */
iris_status iris_copy(const iris_image *dst, const iris_image *src);

/* Puts src into dst so that src's top left pixel lies on (x, y), which may be anywhere in int32_t; what falls
 * outside of dst is left out, and nothing inside is no error. Any format, and IRIS_MASK1 at any x. The part
 * of dst that is written and the part of src that is read are the same pixels or disjoint (masks: compared by
 * 32-bit words).
 * IRIS_ERR_FORMAT: formats differ, or two Bayer patterns that do not meet in step; IRIS_ERR_ALIGN: odd x of a
 * YUV 4:2:2 format; IRIS_ERR_ALIAS: partial overlap. O(bytes written). */
iris_status iris_paste(const iris_image *dst, const iris_image *src, int32_t x, int32_t y);

/* dst = the part of src whose top left pixel is (x, y), both IRIS_MASK1, at any x: the crop that
 * iris_image_crop cannot make. dst and src's part are disjoint (compared by 32-bit words), or the same
 * pixels.
 * IRIS_ERR_FORMAT: not masks; IRIS_ERR_RANGE: the part is not wholly inside src; IRIS_ERR_ALIAS. O(words). */
iris_status iris_mask_copy(const iris_image *dst, const iris_image *src, int32_t x, int32_t y);

/* Every pixel = value. The value of a color has its channels in the order of their letters, the last in the
 * lowest bits, wherever they lie in memory: 0xRRGGBB (IRIS_RGB888 and IRIS_BGR888), 0xRRGGBBAA, 0xHHSSLL,
 * 0xHHHHSSSSLLLL (IRIS_HSL48), 0xYYUUVV (IRIS_YUYV and IRIS_UYVY), 0xUUVV. Both orders of RGB565 take the
 * same 16 bits, IRIS_GRAY_S16 a (uint16_t), IRIS_MASK1 0 or 1.
 * IRIS_ERR_RANGE: value has more bits than a pixel. O(bytes). */
iris_status iris_fill(const iris_image *dst, uint64_t value);

/* One channel of IRIS_RGB888, IRIS_BGR888, IRIS_RGBA8888, or IRIS_HSL24 into IRIS_GRAY8 and back; insert
 * keeps the other channels. channel counts the bytes of a pixel from 0: 0 is R of IRIS_RGB888 and B of
 * IRIS_BGR888.
 * IRIS_ERR_ARG: no such channel; IRIS_ERR_FORMAT: other formats; IRIS_ERR_RANGE: sizes differ;
 * IRIS_ERR_ALIAS: any overlap. O(pixels). */
iris_status iris_channel_extract(const iris_image *dst, const iris_image *src, int32_t channel);
iris_status iris_channel_insert(const iris_image *dst, const iris_image *src, int32_t channel);

/* src in the size of dst; IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888, both the same. The pictures' outer edges
 * coincide, so the center of dst pixel i lies at (i + 0.5) * src_w / dst_w - 0.5, exactly and at every size.
 *   nearest   takes the src pixel whose center is nearest, the right or lower one of two
 *   bilinear  weighs the four around it, repeating the outermost pixels, with positions rounded to 1/2048 pixel: its
 *             value is within 0.625 of the real one (0.5 of which is the rounding, half up)
 *   area      the mean of all of src that dst's pixel covers, parts of pixels by their area, exactly, rounded half up
 * To make a picture smaller take area; the other two average nothing, and below half the size they lose what lies
 * between. To make it larger take bilinear.
 * IRIS_ERR_FORMAT: other or different formats; IRIS_ERR_ALIAS: any overlap. nearest and bilinear: O(dst pixels), no
 * division per pixel; area: O((src_w + dst_w) * (src_h + dst_h)), one 64-bit division per channel of a dst pixel. */
iris_status iris_resize_nearest(const iris_image *dst, const iris_image *src);
iris_status iris_resize_bilinear(const iris_image *dst, const iris_image *src);
iris_status iris_resize_area(const iris_image *dst, const iris_image *src);

#ifdef __cplusplus
}
#endif

#endif
