#include "iris/xt/line_mask.h"

#include <string.h>

#include "../../foundation/views.h"

enum {
    REACH = 3,                      /* blocks to each side that the closing looks at */
    BEYOND = IRIS_LINE_MASK_BEYOND, /* blocks beyond the picture from which it looks into it */
    MARGIN = 16,                    /* gray levels */
    ONE = 1024                      /* contrast 1 */
};

/* What the rows are compared with. Levels of the floor have 4 fraction bits. */
typedef struct {
    const iris_image *gray;
    int32_t bright, least_q10;   /* of contrast */
    int32_t margin_q4;           /* gray levels that a line differs by at least */
    int32_t block, across, down; /* side of a block, and blocks */
    uint16_t *floor, *other,
        *row;       /* of the blocks, another plane of them, and the floor between two rows of them */
    uint16_t *sums; /* of three pixels of a column; the first and the last column twice */
} plan;

void iris_line_mask_defaults(iris_line_mask_config *config)
{
    if (config) {
        *config = (iris_line_mask_config){.contrast_permil = 300};
    }
}

static int32_t block_mean_q4(const plan *p, int32_t column, int32_t row)
{
    int32_t x0 = column * p->block, x1 = x0 + p->block < p->gray->w ? x0 + p->block : p->gray->w;
    int32_t y0 = row * p->block, y1 = y0 + p->block < p->gray->h ? y0 + p->block : p->gray->h;
    uint32_t sum = 0, count = (uint32_t)(x1 - x0) * (uint32_t)(y1 - y0);
    for (int32_t y = y0; y < y1; y++) {
        const uint8_t *pixels = iris_image_row(p->gray, y);
        for (int32_t x = x0; x < x1; x++) {
            sum += pixels[x];
        }
    }
    return (int32_t)((sum / count) * 16 + (sum % count) * 16 / count);
}

/* A row or a column of blocks. */
typedef struct {
    uint16_t *at;
    int32_t step, count;
} line_of_blocks;

/* The largest, or the smallest, of those within reach. `shift`: number in `from` of the place of the first in `to`. */
static void spread(line_of_blocks to, line_of_blocks from, int32_t shift, int largest)
{
    for (int32_t i = 0; i < to.count; i++) {
        int32_t low = i + shift - REACH, high = i + shift + REACH;
        low = low < 0 ? 0 : low;
        high = high < from.count ? high : from.count - 1;
        uint16_t best = from.at[low * from.step];
        for (int32_t k = low + 1; k <= high; k++) {
            uint16_t level = from.at[k * from.step];
            best = (level > best) == largest ? level : best;
        }
        to.at[i * to.step] = best;
    }
}

/* Dilation: it may lie partly outside, so that towards the sides the light may go on falling off. */
static void grow(const plan *p, int largest)
{
    int32_t wide = p->across + 2 * BEYOND;
    for (int32_t y = 0; y < p->down; y++) {
        spread((line_of_blocks){p->other + y * wide, 1, wide},
               (line_of_blocks){p->floor + y * p->across, 1, p->across}, -BEYOND, largest);
    }
    for (int32_t x = 0; x < wide; x++) {
        spread((line_of_blocks){p->floor + x, wide, p->down + 2 * BEYOND},
               (line_of_blocks){p->other + x, wide, p->down}, -BEYOND, largest);
    }
}

static void shrink(const plan *p, int largest)
{
    int32_t wide = p->across + 2 * BEYOND, high = p->down + 2 * BEYOND;
    for (int32_t y = 0; y < high; y++) {
        spread((line_of_blocks){p->other + y * p->across, 1, p->across},
               (line_of_blocks){p->floor + y * wide, 1, wide}, BEYOND, largest);
    }
    for (int32_t x = 0; x < p->across; x++) {
        spread((line_of_blocks){p->floor + x, p->across, p->down},
               (line_of_blocks){p->other + x, p->across, high}, BEYOND, largest);
    }
}

/* The floor of each block: dark lines closed, or bright ones opened. */
static void find_floor(const plan *p)
{
    for (int32_t row = 0; row < p->down; row++) {
        for (int32_t column = 0; column < p->across; column++) {
            p->floor[row * p->across + column] = (uint16_t)block_mean_q4(p, column, row);
        }
    }
    grow(p, !p->bright);
    shrink(p, p->bright);
}

/* The floor along row y, at the middle of each column of blocks. */
static void floor_of_row(const plan *p, int32_t y)
{
    int32_t at = 2 * y + 1 - p->block, whole = 2 * p->block;
    int32_t row = at < 0 ? 0 : at / whole, share = at < 0 ? 0 : at % whole;
    const uint16_t *upper = p->floor + row * p->across;
    const uint16_t *lower = row + 1 < p->down ? upper + p->across : upper;
    for (int32_t i = 0; i < p->across; i++) {
        p->row[i] = (uint16_t)(upper[i] + ((int32_t)lower[i] - upper[i]) * share / whole);
    }
}

/* Columns from the middle of one block to that of the next, over which the floor is drawn straight. */
typedef struct {
    int32_t first, end;  /* columns */
    int32_t level, step; /* of the floor at the first column, and from one to the next; 16 fraction bits */
} stretch;

static stretch stretch_of(const plan *p, int32_t i)
{
    int32_t half = p->block / 2, w = p->gray->w;
    int32_t left = p->row[i > 0 ? i - 1 : 0], right = p->row[i < p->across ? i : p->across - 1];
    stretch s = {i == 0 ? 0 : (i - 1) * p->block + half, i * p->block + half, left * 4096,
                 (right - left) * 4096 / p->block};
    s.first = s.first < w ? s.first : w;
    s.end = s.end < w ? s.end : w;
    return s;
}

/* How far from a floor of this level (4 fraction bits) pixels of a contrast are, at least the margin; 4 fraction bits.
 * */
static int32_t depth_q4(const plan *p, int32_t floor_q4, int32_t contrast_q10)
{
    int32_t depth = floor_q4 * contrast_q10 / ONE;
    if (p->bright) {
        int32_t up = floor_q4 * contrast_q10 / (ONE - contrast_q10);
        int32_t left = (255 * 16 - floor_q4) * contrast_q10 / ONE;
        depth = up < left ? up : left;
    }
    return depth > p->margin_q4 ? depth : p->margin_q4;
}

static int32_t contrast_q10(const plan *p, int32_t floor_q4, int32_t level_q4)
{
    if (!p->bright) {
        return floor_q4 > 0 ? (floor_q4 - level_q4) * ONE / floor_q4 : 0;
    }
    int32_t above = level_q4 - floor_q4, left = 255 * 16 - floor_q4;
    int32_t whole = level_q4 < left ? level_q4 : left;
    return whole > 0 ? above * ONE / whole : 0;
}

/* Sums of the three pixels around (x, y) of each column, then of three columns: nine times the smoothed pixel. */
static void sum_columns(const plan *p, int32_t y)
{
    int32_t w = p->gray->w;
    const uint8_t *at = iris_image_row(p->gray, y);
    const uint8_t *above = y > 0 ? iris_image_row(p->gray, y - 1) : at;
    const uint8_t *below = y + 1 < p->gray->h ? iris_image_row(p->gray, y + 1) : at;
    for (int32_t x = 0; x < w; x++) {
        p->sums[x + 1] = (uint16_t)(above[x] + at[x] + below[x]);
    }
    p->sums[0] = p->sums[1];
    p->sums[w + 1] = p->sums[w];
}

static inline int32_t nine(const plan *p, int32_t x)
{
    return p->sums[x] + p->sums[x + 1] + p->sums[x + 2];
}

/* Four times the noise of smoothed pixels, as neighbors tell it: they differ by 9 / 8 of its deviation in the mean, and
 * smoothing leaves a third. */
static int32_t noise_margin_q4(const iris_image *gray)
{
    uint32_t sum = 0, count = 0;
    for (int32_t y = 0; y < gray->h; y += 4) {
        const uint8_t *row = iris_image_row(gray, y);
        for (int32_t x = 1; x < gray->w; x += 4, count++) {
            sum += (uint32_t)(row[x] > row[x - 1] ? row[x] - row[x - 1] : row[x - 1] - row[x]);
        }
    }
    int32_t margin_q4 = count > 0 ? (int32_t)(sum / count * 19 + sum % count * 19 / count) : 0;
    return margin_q4 > MARGIN * 16 ? margin_q4 : MARGIN * 16;
}

/* The mean contrast of the pixels that have the least contrast, of every eighth pixel; 0 when they are too few. */
static int32_t line_contrast(const plan *p)
{
    int64_t sum = 0;
    int32_t count = 0, samples = 0;
    for (int32_t y = 1; y < p->gray->h || y == 1; y += 2) {
        int32_t row = y < p->gray->h ? y : 0;
        sum_columns(p, row);
        floor_of_row(p, row);
        for (int32_t i = 0; i <= p->across; i++) {
            stretch s = stretch_of(p, i);
            for (int32_t x = s.first; x < s.end; x += 4) {
                int32_t floor_q4 = (s.level + (x - s.first) * s.step) >> 12;
                int32_t level_q4 = nine(p, x) * 16 / 9;
                int32_t away = p->bright ? level_q4 - floor_q4 : floor_q4 - level_q4;
                samples++;
                if (away >= depth_q4(p, floor_q4, p->least_q10)) {
                    sum += contrast_q10(p, floor_q4, level_q4);
                    count++;
                }
            }
        }
    }
    return count > 0 && count * 500 >= samples ? (int32_t)(sum / count) : 0;
}

static void mark_stretch(const plan *p, uint32_t *row, const stretch *s, int32_t half_q10)
{
    int32_t depth0 = depth_q4(p, s->level >> 12, half_q10);
    int32_t depth1 = depth_q4(p, (s->level + s->step * p->block) >> 12, half_q10);
    int32_t sign = p->bright ? 1 : -1;
    int32_t limit = s->level + sign * depth0 * 4096;
    int32_t step = s->step + sign * (depth1 - depth0) * 4096 / p->block;
    for (int32_t x = s->first; x < s->end; x++, limit += step) {
        int32_t nine_q12 = nine(p, x) * 4096, bound = (limit >> 4) * 9;
        int on = p->bright ? nine_q12 * 1 > bound : nine_q12 < bound;
        row[x / 32] |= (uint32_t)on << x % 32;
    }
}

static void mark(const plan *p, const iris_image *mask, int32_t half_q10)
{
    int32_t last = (mask->w - 1) / 32, rest = mask->w - 32 * last;
    for (int32_t y = 0; y < mask->h; y++) {
        uint32_t *row = iris_image_row(mask, y);
        memset(row, 0, (size_t)last * sizeof *row);
        row[last] &= rest < 32 ? ~(uint32_t)0 << rest : 0;
        if (half_q10 == 0) {
            continue;
        }
        sum_columns(p, y);
        floor_of_row(p, y);
        for (int32_t i = 0; i <= p->across; i++) {
            stretch s = stretch_of(p, i);
            mark_stretch(p, row, &s, half_q10);
        }
    }
}

iris_status iris_line_mask(int32_t *found, const iris_image *mask, const iris_image *gray,
                           const iris_line_mask_config *config, iris_scratch *scratch)
{
    iris_line_mask_config used;
    iris_line_mask_defaults(&used);
    used = config ? *config : used;
    if (!scratch || used.bright < 0 || used.bright > 1 || used.contrast_permil < 100 ||
        used.contrast_permil > 900) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_views_check_formats(mask, IRIS_MASK1, gray, IRIS_GRAY8);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark_at = iris_scratch_mark(scratch), block = IRIS_LINE_MASK_BLOCK(gray->w, gray->h);
    uint16_t *memory = iris_scratch_take(scratch, IRIS_LINE_MASK_SCRATCH_BYTES(gray->w, gray->h));
    if (!memory) {
        return IRIS_ERR_SCRATCH;
    }
    plan p = {.gray = gray, .bright = used.bright, .least_q10 = used.contrast_permil * ONE / 1000};
    p.block = (int32_t)block;
    p.across = (int32_t)IRIS_LINE_MASK_BLOCKS(gray->w, block);
    p.down = (int32_t)IRIS_LINE_MASK_BLOCKS(gray->h, block);
    p.floor = memory;
    p.other = p.floor + (p.across + 2 * BEYOND) * (p.down + 2 * BEYOND);
    p.row = p.other + (p.across + 2 * BEYOND) * (p.down + 2 * BEYOND);
    p.sums = p.row + p.across;
    p.margin_q4 = noise_margin_q4(gray);
    find_floor(&p);
    int32_t contrast = line_contrast(&p);
    mark(&p, mask, contrast / 2);
    iris_scratch_release(scratch, mark_at);
    if (found) {
        *found = contrast > 0;
    }
    return IRIS_OK;
}
