/* IRIS-XT - line following: where is the line, and where does it go?
 *
 * Finds a dark, bright, or colored line on the floor, in whole images or in rows as they arrive from the
 * sensor, with a few rows of working memory and no frame buffer. Rows come top first, which is far first for
 * a forward-looking camera. Three calls drive a robot (examples/follow.c): iris_follow_init,
 * iris_follow_frame, iris_steer_update.
 *
 * How: every row is compared with the floor as it was seen in the rows above (a level per 8 columns that
 * follows light and shade, but not the line); the longest runs of line pixels are kept and joined, row by
 * row, into chains; at the end the chains that continue each other are put together, the best is the line,
 * and straight segments are fitted to it by trimmed orthogonal regression or found by a Hough transform.
 * Report, sections 2.3 and 2.4.
 *
 * Directions: an angle is 0 when the line runs straight ahead (up the image) and positive when it leans
 * right, -90 to 90 degrees. Offsets are (center - (w - 1) / 2) / (w / 2): 0 in the middle, -1 and 1 at the
 * sides, positive right.
 */
#ifndef IRIS_XT_FOLLOW_H
#define IRIS_XT_FOLLOW_H

#include "iris/color.h"
#include "iris/command.h"
#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"
#include "iris/xt/hough.h"
#include "iris/xt/regress.h"
#include "iris/xt/signature.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_FOLLOW_SIDE_MAX     8191 /* longest side of a frame */
#define IRIS_FOLLOW_SEGMENTS_MAX 8
#define IRIS_FOLLOW_RUNS         4  /* runs kept per row, the longest */
#define IRIS_FOLLOW_CHAINS       16 /* chains kept per frame, the longest */

typedef enum {
    IRIS_FOLLOW_DARK = 0, /* darker than the floor around it */
    IRIS_FOLLOW_BRIGHT,   /* brighter than the floor around it */
    IRIS_FOLLOW_COLOR     /* within a range of hue, saturation, and lightness */
} iris_follow_kind;

/* contrast_permil is how much darker than the floor a line pixel is at least, relative to the floor (bright lines:
 * brighter, relative to the line, or to what is left up to white, whichever is less). The line as a whole stands out by
 * a fifth of the rest more: 480 at the default. */
typedef struct {
    iris_follow_kind kind;    /* default IRIS_FOLLOW_DARK */
    iris_format format;       /* of the rows; any that color.h converts to IRIS_GRAY8 (IRIS_FOLLOW_COLOR: to
                                 IRIS_RGB888); default IRIS_GRAY8 */
    iris_hsl_range color;     /* for IRIS_FOLLOW_COLOR only */
    int32_t lane;             /* 1: follow the middle between two lines; default 0 */
    int32_t contrast_permil;  /* 100..900; default 350 */
    int32_t min_width_permil; /* 1..500: narrower runs are not the line, in permil of the image width;
                                 default 12 */
    int32_t lookahead_permil; /* 0..1000: the look-ahead row, counted from the top, in permil of the height;
                                 default 333 */
    int32_t hold_ms;          /* 0..60000: how long a lost line's last result is repeated; default 200 */
} iris_follow_config;

/* A straight piece of the line, in pixels; (x0, y0) is the end nearer to the robot. A fitted line's ends may lie beyond
 * the sides of the image. */
typedef struct {
    int32_t x0, y0, x1, y1;
} iris_segment;

/* First and last column of the line in a row, inclusive; left > right when the row has none. With `lane`: the
 * columns between the two lines. */
typedef struct {
    int16_t left, right;
} iris_span;

typedef struct {
    iris_line_state state; /* everything below is zero when IRIS_LINE_LOST */
    int32_t has_next;      /* 1: the line bends sharply, next_angle is the direction behind the bend */
    iris_angle angle;      /* of the line at the robot */
    iris_angle next_angle; /* of the next straight part */
    iris_q16 offset_q16;   /* at the bottom row */
    iris_q16 lookahead_offset_q16; /* at the look-ahead row */
    int32_t width_px;              /* of the line (or of the lane), mean over its rows */
    int32_t confidence_permil;     /* 0..1000 */
    int32_t segment_count;
    iris_segment segments[IRIS_FOLLOW_SEGMENTS_MAX]; /* near to far */
    const iris_span *rows; /* one per image row, in the follower's memory until the next frame begins;
                              null when stale or lost */
} iris_follow_result;

/* Working memory for frames of w x h pixels, kept by the follower for its whole life: 3.1 KB for 160x120. The second
 * size is for iris_follow_init_full: 3.6 KB; the third for iris_follow_init_signature: 4.0 KB. */
#define IRIS_FOLLOW_BLOCKS(w) (((size_t)(w) + 7) / 8)
#define IRIS_FOLLOW_SCRATCH_BYTES(w, h)                                                                      \
    IRIS_SCRATCH_ROUND(IRIS_FOLLOW_CHAINS * 36 + (size_t)(h)*IRIS_FOLLOW_RUNS * (sizeof(iris_span) + 1) +    \
                       IRIS_FOLLOW_BLOCKS(w) * 6 + 4)
#define IRIS_FOLLOW_FULL_SCRATCH_BYTES(w, h)                                                                 \
    (IRIS_FOLLOW_SCRATCH_BYTES(w, h) + IRIS_SCRATCH_ROUND(((size_t)(w) + 31) / 32 * 4) +                     \
     IRIS_SCRATCH_ROUND((size_t)(w)*3))
#define IRIS_FOLLOW_SIGNATURE_SCRATCH_BYTES(w, h)                                                            \
    (IRIS_FOLLOW_SCRATCH_BYTES(w, h) + IRIS_SCRATCH_ROUND(IRIS_SIGNATURE_CELLS / 9 * 2))

/* A follower. The fields are its own; keep it anywhere, but do not copy it while a frame is being fed. */
typedef struct iris_follow iris_follow;
struct iris_follow {
    iris_follow_config config;
    iris_size size;
    int32_t y;            /* rows fed in this frame; -1 between frames */
    int32_t min_width;    /* pixels */
    int32_t max_gap;      /* columns that do not interrupt a run, rows that do not interrupt a chain */
    int32_t contrast_q10; /* contrast_permil with 10 fraction bits */
    int32_t brighter_q10; /* how much brighter than the floor bright lines are at least: 1 / (1 - contrast) */
    int32_t brightness;   /* of the row from which the whole floor was learned */
    int32_t learn_rows;   /* the floor learns every so many rows */
    int32_t rows_to_learn; /* until it does again */
    int32_t dark_rows;     /* in a row without any floor */
    int32_t chain_count;   /* in this frame */
    int32_t seen;          /* 1 while a found line may be repeated */
    uint32_t seen_ms;      /* when */
    /* in the caller's working memory: */
    uint16_t *floor;                  /* level of the floor per block of 8 columns, 8 fraction bits */
    struct iris_block8 *blocks;       /* this row, 8 columns each, and one more that is never clear */
    iris_span *runs;                  /* IRIS_FOLLOW_RUNS per row; after the frame: one span per row */
    uint8_t *owner;                   /* chain of each run */
    struct iris_follow_chain *chains; /* pieces of line, or of anything else that looks like it */
    /* Finds a row's line pixels; returns the row as gray, or null when lines are told by color. */
    const uint8_t *(*mark)(iris_follow *follow, const void *pixels);
    /* Fits a line to the centers of the rows y0 to y1 (twice_x as for iris_regress_rows). */
    iris_status (*fit)(iris_line *line, const iris_follow *follow, const int16_t *twice_x, int32_t y0,
                       int32_t y1);
    /* From the chosen chains, the farthest first, to the result; returns 0 when there is none. */
    int (*describe)(iris_follow_result *result, iris_follow *follow, int32_t line);
    /* in the caller's working memory: */
    uint32_t *mask;            /* this row by color, one bit per column */
    uint8_t *row;              /* this row as GRAY8 or RGB888 */
    uint8_t *votes;            /* of the Hough transform */
    uint16_t *levels;          /* of Y that are selected, a bit each, per step of U and V */
    iris_hsl_range_test color; /* the range, made ready */
    iris_follow_result last;   /* what a stale frame repeats */
};

/* Sensible values, as given above. Null is ignored. */
void iris_follow_defaults(iris_follow_config *config);

/* Prepares a follower of dark or bright lines for frames of IRIS_GRAY8 of the given size. config may be null for the
 * defaults; it is copied. The working memory (IRIS_FOLLOW_SCRATCH_BYTES) stays taken.
 * IRIS_ERR_ARG: null pointer, or a config value out of range; IRIS_ERR_RANGE: a side outside 8..IRIS_FOLLOW_SIDE_MAX;
 * IRIS_ERR_FORMAT: the config asks for another format or for a color, IRIS_ERR_UNSUPPORTED: for a lane, see below;
 * IRIS_ERR_SCRATCH. O(w). */
iris_status iris_follow_init(iris_follow *follow, iris_size size, const iris_follow_config *config,
                             iris_scratch *scratch);

/* The same for every kind of line, lanes, and every format of rows (IRIS_FOLLOW_FULL_SCRATCH_BYTES). It is apart so
 * that firmware that follows one line with a gray sensor carries neither color conversion nor lanes.
 * The same errors, but IRIS_ERR_FORMAT: rows of a format that iris_color_takes does not know. */
iris_status iris_follow_init_full(iris_follow *follow, iris_size size, const iris_follow_config *config,
                                  iris_scratch *scratch);

/* The same for lines that have a color signature, in rows of IRIS_YUYV or IRIS_UYVY, which are looked up as they are
 * (IRIS_FOLLOW_SIGNATURE_SCRATCH_BYTES; about 14 instructions per pixel on a Cortex-M4, all in all). config says
 * IRIS_FOLLOW_COLOR and the format, and its range of colors is not asked. selected: bit k selects signature k; the
 * signatures are taken as they are now, and the table is not kept.
 * The same errors as iris_follow_init, and IRIS_ERR_ARG: config is null, or selected outside 1..255; IRIS_ERR_RANGE:
 * the width is odd. O(w + cells). */
iris_status iris_follow_init_signature(iris_follow *follow, iris_size size, const iris_follow_config *config,
                                       const iris_signatures *signatures, uint32_t selected,
                                       iris_scratch *scratch);

/* From now on straight pieces are fitted by a Hough transform (hough.h) instead of the trimmed regression: of the row
 * centers, within 22 degrees and 16 steps of rho around the untrimmed regression line. It stands more strangers among
 * the rows and costs more; angles come in steps of a fraction of a degree. Takes IRIS_FOLLOW_HOUGH_BYTES of working
 * memory. It is apart so that firmware without it does not carry it.
 * IRIS_ERR_ARG: null pointer, or a follower without init; IRIS_ERR_SCRATCH. O(1); each frame O(32 h) more. */
#define IRIS_FOLLOW_HOUGH_BINS  32
#define IRIS_FOLLOW_HOUGH_BYTES IRIS_HOUGH_BINS_SCRATCH_BYTES(IRIS_FOLLOW_HOUGH_BINS, IRIS_FOLLOW_HOUGH_BINS)
iris_status iris_follow_use_hough(iris_follow *follow, iris_scratch *scratch);

/* A whole frame: begin, every row, end. frame must have the size and format given at init.
 * IRIS_ERR_ARG: null pointer or invalid image; IRIS_ERR_RANGE: another size; IRIS_ERR_FORMAT: another format.
 * O(w h) plus O(h) per segment; about 8 instructions per pixel on a Cortex-M4. */
iris_status iris_follow_frame(iris_follow_result *result, iris_follow *follow, const iris_image *frame,
                              uint32_t now_ms);

/* The same in pieces, for rows as they arrive: begin, then h times row (top row first), then end. now_ms is
 * any millisecond clock; it may wrap. A frame that is begun again, or ended early, is a frame whose missing
 * rows hold no line. row: `pixels` has w pixels of the configured format and is not kept. IRIS_ERR_ARG: null
 * pointer; IRIS_ERR_RANGE: no frame begun, or more than h rows. */
iris_status iris_follow_begin(iris_follow *follow);
iris_status iris_follow_row(iris_follow *follow, const void *pixels);
iris_status iris_follow_end(iris_follow_result *result, iris_follow *follow, uint32_t now_ms);

/* Forgets earlier frames: the next one without a line is lost, not stale. Null is ignored. O(1). */
void iris_follow_forget(iris_follow *follow);

#ifdef __cplusplus
}
#endif

#endif
