/* IRIS-XT - blobs: the connected parts of a mask, and what each of them looks like.
 *
 * Selected pixels that touch belong to one blob: by a side or a corner (8-connectivity), or by a side alone (4). Blobs
 * are measured while they are found, by runs of pixels, in one pass over the mask: no label picture, no second look.
 * Rows may come from a sensor, one at a time; only the runs of two rows and the blobs that are still growing are in
 * working memory. What is finished goes to the caller's table, which keeps the largest. Report, sections 2.3 and
 * 3.3.3; A. Rosenfeld and J. L. Pfaltz, "Sequential operations in digital picture processing", 1966.
 *
 *     static IRIS_SCRATCH_BUFFER(memory, IRIS_BLOB_SCRATCH_BYTES(160, 16));
 *     iris_blob found[16];
 *     iris_blob_table table = {found, 16, 0};
 *     iris_blobs(&table, &mask, NULL, NULL, &scratch);
 */
#ifndef IRIS_XT_BLOB_H
#define IRIS_XT_BLOB_H

#include "iris/color.h"
#include "iris/fixed.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "iris/status.h"
#include "iris/xt/regress.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A blob. Its first pixel is the leftmost one of its top row: (first_x, box.y).
 * edges are the sides that its pixels share with pixels that are not selected, or with the picture's edge, around
 * holes too: the length of the outline as a saw sees it. corners counts the quarter turns of that outline: 4 of a
 * rectangle. holes are the parts of the rest that it encloses; such a part hangs together by sides, with
 * 4-connectivity by corners, too. */
typedef struct {
    iris_rect box;   /* the smallest around it */
    int32_t first_x; /* of its first pixel */
    int32_t area;    /* pixels */
    iris_q16 x_q16,
        y_q16; /* center of gravity, pixels, rounded half up; a single pixel's is the pixel itself */
    int32_t edges;
    int32_t corners;
    int32_t holes;
    iris_color mean; /* of its pixels in the picture, rounded half up; gray: r = g = b; 0 without a picture */
    iris_moments moments; /* sums over its pixels: n, x, y, xx, xy, yy; iris_regress_moments takes them */
} iris_blob;

/* Which blobs count. All bounds are inclusive; a blob has to meet them all. */
typedef struct {
    int32_t min_area, max_area;                      /* pixels; default 0 and INT32_MAX */
    int32_t min_w, max_w, min_h, max_h;              /* of the box, pixels; default 0 and INT32_MAX */
    int32_t min_fill_permil, max_fill_permil;        /* area in permil of the box; default 0 and 1000 */
    iris_q16 min_elongation_q16, max_elongation_q16; /* as iris_blob_shape has it; default 0 and INT32_MAX */
    int32_t min_holes, max_holes;                    /* default 0 and INT32_MAX */
    int32_t inside;      /* 1: only those that do not touch the picture's edge; default 0 */
    iris_rect center_in; /* where the center is, rounded to pixels; default 0, 0, 32767, 32767: anywhere */
} iris_blob_filter;

typedef struct {
    int32_t connectivity;    /* 8 or 4; default 8 */
    iris_blob_filter filter; /* default: every blob counts */
} iris_blob_config;

/* The results. Before the call: blobs and capacity. */
typedef struct {
    iris_blob *blobs; /* the caller's; may be null when capacity is 0 */
    int32_t capacity; /* how many there is room for */
    int32_t count;    /* of all blobs that count */
} iris_blob_table;

/* Working memory for masks of width w and a table of that capacity; and so much more for mean colors. 160 pixels and
 * 16 blobs: 6.9 KB, and 2 KB. */
#define IRIS_BLOB_RUNS(w) (((size_t)(w) + 1u) / 2u) /* the most runs of a row */
#define IRIS_BLOB_OPEN(w) ((size_t)(w) / 2u + 1u)   /* the most blobs that grow at a time */
#define IRIS_BLOB_SCRATCH_BYTES(w, capacity)                                                                 \
    (IRIS_SCRATCH_ROUND(IRIS_BLOB_OPEN(w) * 72u) + 2u * IRIS_SCRATCH_ROUND((IRIS_BLOB_RUNS(w) + 1u) * 6u) +  \
     IRIS_SCRATCH_ROUND((size_t)(capacity)*4u))
#define IRIS_BLOB_COLOR_SCRATCH_BYTES(w) IRIS_SCRATCH_ROUND(IRIS_BLOB_OPEN(w) * 24u)

/* A search on its way. The fields are its own. */
typedef struct {
    iris_blob_config config;
    iris_blob_table *table;
    iris_size size;
    int32_t channels;  /* of the picture */
    int32_t y;         /* rows fed */
    int32_t kept;      /* blobs in the table */
    int32_t found;     /* blobs that count */
    int32_t free_open; /* the first unused one */
    /* in the caller's working memory: */
    struct iris_open_blob *open;
    uint64_t (*colors)[3]; /* sums of each; null without a picture */
    struct iris_blob_run *runs, *new_runs;
    int32_t *order; /* of the table */
} iris_blob_scan;

/* Sensible values, as given above. Null is ignored. */
void iris_blob_filter_defaults(iris_blob_filter *filter);
void iris_blob_defaults(iris_blob_config *config);

/* The blobs of a mask, IRIS_MASK1, the largest first; of equal ones that with the earlier first pixel (row by row,
 * from the left). picture: IRIS_GRAY8 or IRIS_RGB888 of the mask's size for the mean colors, or null. config may be
 * null for the defaults.
 *
 * Working memory: IRIS_BLOB_SCRATCH_BYTES(w, capacity), and IRIS_BLOB_COLOR_SCRATCH_BYTES(w) more with a picture;
 * given back afterwards.
 * IRIS_ERR_FULL: more blobs than capacity; the table has the largest of all, and count is that of all.
 * IRIS_ERR_ARG: null pointer, a negative capacity, or a config value out of range (connectivity, inside; a lower bound
 * above its upper one is none: no blob counts then); the errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE:
 * sizes differ; IRIS_ERR_SCRATCH. O(words + runs + blobs * log(capacity)), and the selected pixels once with a
 * picture; never more than twice the runs are looked at, whatever their shapes. */
iris_status iris_blobs(iris_blob_table *table, const iris_image *mask, const iris_image *picture,
                       const iris_blob_config *config, iris_scratch *scratch);

/* The same in pieces, for rows as they arrive: begin, then h times row (top row first), then end. channels: of the
 * picture's rows, 1 for IRIS_GRAY8, 3 for IRIS_RGB888, 0 for none. table and its blobs are written until end; the
 * working memory stays taken (iris_scratch_release gives it back). config is copied.
 * IRIS_ERR_ARG: as above, or channels not 0, 1, or 3; IRIS_ERR_RANGE: a side outside 1..IRIS_SIDE_MAX, or a capacity
 * that no memory has; IRIS_ERR_SCRATCH. O(w). */
iris_status iris_blob_begin(iris_blob_scan *scan, iris_blob_table *table, iris_size size, int32_t channels,
                            const iris_blob_config *config, iris_scratch *scratch);

/* mask_row: w bits, as in IRIS_MASK1; picture_row: w pixels, ignored without channels. Neither is kept.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: more than h rows. O(w / 32 + runs). */
iris_status iris_blob_row(iris_blob_scan *scan, const uint32_t *mask_row, const uint8_t *picture_row);

/* Finishes what still grows, sorts the table, and sets its count. Rows that have not come are empty. The scan is ready
 * for the first row of another picture, whose blobs replace these.
 * IRIS_ERR_FULL: as above; IRIS_ERR_ARG: null pointer. O(w + kept * log(kept)). */
iris_status iris_blob_end(iris_blob_scan *scan);

/* The rest of a blob's description, worked out when it is asked for. length and breadth are the sides of the rectangle
 * that has the blob's second moments, each pixel taken as a square: exact for upright rectangles.
 * perimeter is the length of the outline, 0.948 edges - 0.278 corners: slanting lines are as long as they look,
 * within 5 % in every direction, and right on average over all. D. Proffitt and D. Rosen, "Metrication errors and
 * coding efficiency of chain-encoding schemes", 1979. */
typedef struct {
    iris_angle angle;     /* of its long axis: 0 straight up, positive when it leans right, -90 up to below 90
                         degrees; 0 when it has none */
    iris_q16 length_q16;  /* pixels; saturates at 32767 */
    iris_q16 breadth_q16; /* pixels */
    iris_q16 elongation_q16; /* length / breadth, 1 or more; saturates at 32767 */
    iris_q16 perimeter_q16;  /* pixels; saturates at 32767 */
} iris_blob_shape;

/* IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: sums that a blob cannot have (as iris_regress_moments). The width of
 * lines longer than 4000 pixels that are not upright or level gets uncertain. O(1): some 4500 instructions on a
 * Cortex-M4. */
iris_status iris_blob_shape_of(iris_blob_shape *shape, const iris_blob *blob);

/* 1 when a blob of a picture of this size meets all bounds, 0 when it does not, or for null. O(1). */
int iris_blob_passes(const iris_blob *blob, const iris_blob_filter *filter, iris_size size);

/* The mask of one blob: dst, IRIS_MASK1, is 1 where src, IRIS_MASK1 of the same size, hangs together with the blob's
 * first pixel (first_x, box.y; the rest of blob is not looked at), and all 0 when src does not select that one.
 * connectivity: 8 or 4. dst and src are disjoint; bits past w are kept.
 * IRIS_ERR_ARG: null pointer, or another connectivity; errors of iris_image_check; IRIS_ERR_FORMAT; IRIS_ERR_RANGE:
 * sizes differ, or the pixel is outside; IRIS_ERR_ALIAS; IRIS_ERR_SCRATCH. O(words + words of the blob's runs): a
 * run is reached once, and then the words above and below it are looked at again, whatever maze they are in. */
#define IRIS_BLOB_MASK_SCRATCH_BYTES(w, h) IRIS_SCRATCH_ROUND(((size_t)(w) + 1023u) / 1024u * (size_t)(h)*4u)
iris_status iris_blob_mask(const iris_image *dst, const iris_image *src, const iris_blob *blob,
                           int32_t connectivity, iris_scratch *scratch);

#ifdef __cplusplus
}
#endif

#endif
