/* IRIS-XT - tone: what becomes of each gray level, and the adjustment of color channels.
 *
 * A tone is a curve of 256 levels in the caller's memory. It begins as the identity; every iris_tone_<step> then adds a step
 * behind those that are there already. However many steps it has, applying it is one look-up per pixel, and gives
 * exactly the pixels that the steps would give one after the other:
 *
 *     iris_tone tone;
 *     iris_tone_identity(&tone);
 *     iris_tone_levels(&tone, 30, 200);            30 becomes black, 200 white,
 *     iris_tone_gamma(&tone, IRIS_Q16_ONE / 2);    and what is between gets brighter
 *     iris_tone_apply(&picture, &picture, &tone);
 *
 * Each entry of a step is the exact value rounded half up and limited to 0..255. Every function returns IRIS_ERR_ARG for a
 * null pointer, besides what its comment says; an error leaves the tone as it was. Report, sections 2.2 and 3.3.3
 * (AlgorithmManager).
 */
#ifndef IRIS_XT_TONE_H
#define IRIS_XT_TONE_H

#include "iris/fixed.h"
#include "iris/image.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint8_t level[256]; /* level[p] is what p becomes */
} iris_tone;

/* ---- Curves. Each O(256); compression and gamma take some hundred additions and shifts per entry. ---- */

/* Every level stays as it is. */
iris_status iris_tone_identity(iris_tone *tone);

/* 255 - p. */
iris_status iris_tone_negate(iris_tone *tone);

/* p + amount; any amount. */
iris_status iris_tone_add(iris_tone *tone, int32_t amount);

/* The constant that keeps 255 at 255: 255 / ln 256 = 45.986, rounded up. */
#define IRIS_TONE_COMPRESS_C ((iris_q16)3013733)

/* Range compression: c ln(1 + p). Opens up the dark levels, as the eye does. c_q16 is at least 0.
 * IRIS_ERR_RANGE: c_q16 is negative. */
iris_status iris_tone_compress(iris_tone *tone, iris_q16 c_q16);

/* 255 (p / 255)^gamma: below 1 brightens, above 1 darkens; 0 and 255 stay.
 * IRIS_ERR_RANGE: gamma_q16 is not above 0. */
iris_status iris_tone_gamma(iris_tone *tone, iris_q16 gamma_q16);

/* Three straight lines that meet at a and b, the first from (0, 0). */
typedef struct {
    int32_t a, b;                   /* levels, 0 <= a <= b <= 255 */
    iris_q16 below, between, above; /* slopes: of p <= a, a <= p <= b, and b <= p; any, also negative */
} iris_tone_segments;

/* a = 85 and b = 170 (a third and two thirds), slopes 1/2, 2, and 1/2: 0 and 255 stay. */
void iris_tone_segments_defaults(iris_tone_segments *segments);

/* Contrast stretch in three segments; null: the defaults.
 * IRIS_ERR_ARG: a or b outside. */
iris_status iris_tone_stretch(iris_tone *tone, const iris_tone_segments *segments);

/* Linear stretch between two levels: low and what is below becomes 0, high and what is above 255. Between equal levels there
 * is nothing to stretch, and nothing changes.
 * IRIS_ERR_RANGE: not 0 <= low <= high <= 255. */
iris_status iris_tone_levels(iris_tone *tone, int32_t low, int32_t high);

/* Linear stretch between percentiles: of the pixels in histogram at most this share is darker than the level that becomes 0,
 * and at most this share brighter than the one that becomes 255. 0 stretches from the darkest to the brightest pixel, 655
 * leaves out one percent at either end. histogram is that of the picture as this step finds it.
 * IRIS_ERR_RANGE: share_q16 outside 0..32767, or no counts. */
iris_status iris_tone_stretch_share(iris_tone *tone, const uint32_t histogram[256], iris_q16 share_q16);

/* Equalization: round((cdf(p) - cdf_min) 255 / (n - cdf_min)), where cdf(p) counts the pixels that are not brighter than p, n
 * all of them, and cdf_min those of the darkest level there is, which becomes 0. A histogram of one level changes
 * nothing. histogram is that of the picture as this step finds it.
 * IRIS_ERR_RANGE: no counts. */
iris_status iris_tone_equalize(iris_tone *tone, const uint32_t histogram[256]);

/* Adds all steps of another tone. next may be tone. */
iris_status iris_tone_then(iris_tone *tone, const iris_tone *next);

/* ---- Pictures ----
 *
 * dst and src have the same size and format: IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888. dst may be src (the same data and
 * stride), else they are disjoint. All return the errors of iris_image_check for a view that is not valid,
 * IRIS_ERR_FORMAT for other or different formats, IRIS_ERR_RANGE when the sizes differ, and IRIS_ERR_ALIAS. O(pixels). */

/* One tone for all channels. */
iris_status iris_tone_apply(const iris_image *dst, const iris_image *src, const iris_tone *tone);

/* One for each of red, green, and blue, wherever they lie in memory.
 * IRIS_ERR_FORMAT: IRIS_GRAY8 too. */
iris_status iris_tone_apply_rgb(const iris_image *dst, const iris_image *src, const iris_tone *red,
                                const iris_tone *green, const iris_tone *blue);

/* On the lightness alone: of HSL as color.h defines it, hue and saturation are kept. Lightness has 511 steps there; half way
 * between two entries of the tone it takes their mean. Identity for the identity. Of IRIS_GRAY8 the same as
 * iris_tone_apply. One division per pixel of color. */
iris_status iris_tone_apply_lightness(const iris_image *dst, const iris_image *src, const iris_tone *tone);

/* n bytes of a row, as they arrive. dst may be src, else they are disjoint.
 * IRIS_ERR_RANGE: n is negative; IRIS_ERR_ALIAS. O(n). */
iris_status iris_tone_row(uint8_t *dst, const uint8_t *src, int32_t n, const iris_tone *tone);

/* What iris_adjust adds to the channels of a color. All zeros changes nothing. */
typedef struct {
    int32_t red, green, blue; /* levels, -255 to 255 */
    int32_t hue;              /* degrees, any number of turns */
    int32_t saturation;       /* percent points, -100 to 100 */
    int32_t lightness;        /* percent points, -100 to 100 */
} iris_adjustment;

/* Independent adjustment of the channels of IRIS_RGB888 or IRIS_BGR888: first of red, green, and blue, limited to 0..255, then
 * of hue, which wraps around, and saturation and lightness, limited to 0..100 percent, as color.h defines them: 120
 * degrees of hue turn red into green, 100 points of lightness turn every color into white. A gray has no hue: it stays
 * gray at any saturation. Each channel is within 0.51 of the exact value.
 * IRIS_ERR_ARG: a number outside. Two divisions for every pixel that is not gray, when one of hue, saturation, and
 * lightness is not 0. */
iris_status iris_adjust(const iris_image *dst, const iris_image *src, const iris_adjustment *by);

#ifdef __cplusplus
}
#endif

#endif
