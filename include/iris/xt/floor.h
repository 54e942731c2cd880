/* IRIS-XT - the floor: from pixels to millimeters and true angles, and back.
 *
 * A camera that looks at a flat floor sees it by a homography: nine numbers that four marks on the floor determine,
 * with no other knowledge of the camera. Lay marks down, measure where they are, read off where the picture shows them,
 * and iris_floor_fit does the rest. More marks than four even out the errors of reading. A lens that bends
 * straight lines is not corrected.
 *
 * The floor's millimeters: x to the right, y ahead of the robot; where (0, 0) is is the user's choice (for steering,
 * best the middle of the axle). Pixels: (0, 0) is the center of the top left one. Angles are 0 straight ahead (up
 * the picture; along y on the floor) and positive to the right, as in follow.h, but all the way around: directions, not
 * lines.
 *
 *     image * w = m0 x + m1 y + m2,  m3 x + m4 y + m5
 *     w = m6 x + m7 y + m8, above 0 for what is in front of the camera
 *
 * Method: Hartley, "In defense of the eight-point algorithm", 1997 (both sides normalized); a linear least-squares
 * solution by Givens rotations with the ninth number 1 at the middle of the marks - which is safe, because w is linear,
 * so that it is their mean there, and above 0 for every camera that sees all of them - and from there Gauss-Newton
 * steps, which make the sum of squared distances in the picture least.
 */
#ifndef IRIS_XT_FLOOR_H
#define IRIS_XT_FLOOR_H

#include <stddef.h>

#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/status.h"
#include "iris/wide.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_FLOOR_MARKS_MIN 4
#define IRIS_FLOOR_MARKS_MAX 256

/* A place in the picture, pixels, or on the floor, millimeters (32 m at most to each side). */
typedef struct {
    iris_q16 x_q16, y_q16;
} iris_place;

/* A mark: where the picture shows it, and where it is. */
typedef struct {
    iris_place image, floor;
} iris_floor_mark;

typedef enum {
    IRIS_FLOOR_FINE = 0,
    IRIS_FLOOR_TOO_FEW, /* fewer than four marks, or fewer than four different ones */
    IRIS_FLOOR_IN_LINE, /* all but one of the marks are (nearly) on one line, in the picture or on the floor */
    IRIS_FLOOR_HORIZON, /* some marks would be behind the camera: two may be interchanged, or x and y of one */
    IRIS_FLOOR_MIRRORED /* left and right, or near and far, are interchanged */
} iris_floor_flaw;

/* How well the fit meets the marks: distances from each mark to where it should be. With four marks there is nothing to
 * compare, so they are 0. */
typedef struct {
    iris_floor_flaw flaw;
    int32_t worst; /* index of the mark with the largest distance in the picture */
    iris_q16 max_px_q16, rms_px_q16;
    iris_q16 max_mm_q16, rms_mm_q16;
} iris_floor_quality;

/* The fields are private but for size and to_image_q32: nine numbers to keep in a file or in flash. */
typedef struct {
    iris_size size;           /* of the pictures it is for */
    iris_q32 to_image_q32[9]; /* m0 to m8 above, floor to image */
    int64_t to_floor
        [9]; /* image to floor, of no particular scale; the third row is above 0 for what sees floor */
} iris_floor;

/* The floor that fits the marks best. `size` is the size of the pictures they were read off.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: count above IRIS_FLOOR_MARKS_MAX or negative, a side outside
 * 1..IRIS_SIDE_MAX; IRIS_ERR_DATA: the marks do not determine a floor: *quality says which flaw they have, and nothing
 * else is valid. Some 140 000 instructions for each mark on a Cortex-M4, and 1.4 KB of stack. */
iris_status iris_floor_fit(iris_floor *floor, iris_floor_quality *quality, iris_size size,
                           const iris_floor_mark *marks, int32_t count);

/* A floor from nine numbers that were kept.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX, or a number of more than 2^62;
 * IRIS_ERR_DATA: these numbers are no floor seen from above. O(1). */
iris_status iris_floor_init(iris_floor *floor, iris_size size, const iris_q32 to_image_q32[9]);

/* Where on the floor a place of the picture is, inside of it or not.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: it is on or above the horizon, or farther than 32767 mm.
 * O(1): nine 64-bit products and six 64-bit divisions, 1200 instructions on a Cortex-M4. Error below 1/1000 mm within 2
 * m, for the numbers as they are. */
iris_status iris_floor_point(iris_place *mm, const iris_floor *floor, iris_place image);

/* Where the picture shows a place on the floor, inside of the picture or not.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: it is behind the camera, or outside of 32767 pixels. O(1), as above. */
iris_status iris_floor_image(iris_place *image, const iris_floor *floor, iris_place mm);

/* The direction on the floor of what goes into `direction` in the picture, at this place of it: of a line, a branch of
 * a junction, the long axis of a blob. Directions of a line turned by half a turn give angles half a turn apart.
 * Errors as iris_floor_point. O(1). */
iris_status iris_floor_angle(iris_angle *angle, const iris_floor *floor, iris_place image,
                             iris_angle direction);

/* A piece of a line on the floor, from a to b. */
typedef struct {
    iris_place a, b;     /* mm */
    iris_q16 length_q16; /* mm */
    iris_angle angle;    /* of the way from a to b */
} iris_floor_line;

/* The same for a piece of a straight line in the picture: its ends in millimeters, and its true angle and length.
 * Errors as iris_floor_point, for either end; a line of more than 32767 mm is IRIS_ERR_RANGE. O(1). */
iris_status iris_floor_segment(iris_floor_line *line, const iris_floor *floor, iris_place a, iris_place b);

/* Where something stands that the picture shows in `box`: the middle of its lower edge.
 * Errors as iris_floor_point; IRIS_ERR_RANGE: a box outside of 0..IRIS_SIDE_MAX. O(1). */
iris_status iris_floor_foot(iris_place *mm, const iris_floor *floor, iris_rect box);

/* A floor as a text that people can read, to keep in a file or to copy into firmware:
 *
 *     iris floor 1
 *     size 320 240
 *     image_from_floor_q32             m0 to m8, three in a line, times 2^32
 *     3435973836 0 687194767360
 *     0 -12884901 85899345920
 *     0 21474836 4294967296
 *     check 09AF31C7                   over the size and the nine numbers
 *
 * Empty lines, spaces, and what stands behind a # do not count. A text that is written by hand goes without the line of
 * the check: the line before ends with a line break then. */
#define IRIS_FLOOR_TEXT_BYTES 288 /* enough for every floor, with the 0 at the end */

/* *length: without the 0. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: more than `capacity` bytes, or not a floor that
 * iris_floor_init would make. O(1). */
iris_status iris_floor_write_text(char *text, size_t capacity, size_t *length, const iris_floor *floor);

/* Reads `bytes` bytes of any content; a 0 at their end is no part of the text.
 * IRIS_ERR_ARG: null pointer. The others set *line, the line that is wrong, from 1, and nothing else:
 * IRIS_ERR_UNSUPPORTED: a later version; IRIS_ERR_TRUNCATED: the text ends early; IRIS_ERR_DATA: anything else, a
 * wrong check among them. O(bytes). */
iris_status iris_floor_read_text(iris_floor *floor, int32_t *line, const char *text, size_t bytes);

/* The place of a pixel. Wraps outside of -32768..32767. */
static inline iris_place iris_place_of(int32_t x, int32_t y)
{
    iris_place place;
    place.x_q16 = iris_q16_from_int(x);
    place.y_q16 = iris_q16_from_int(y);
    return place;
}

#ifdef __cplusplus
}
#endif

#endif
