/* The floor: a level per block of 8 columns, learned from the rows above.
 *
 * A block without line pixels draws its level towards what it shows. A block with line pixels cannot see the
 * floor, so it follows the floor to its left and right instead; where there is none either (a line across the
 * whole image), it gives in slowly, so that a floor that really is that dark is floor again after a while.
 * The first row has no row above: its valleys are filled between the hills to their left and right. */
#include "../foundation/kernel.h"
#include "follow_parts.h"

#define LEVEL(value) ((int32_t)((value) << 8)) /* 8 fraction bits */

enum { UP = 2, DOWN = 5, BESIDE = 3, GIVE_IN = 6 }; /* each row, 1 / 2^n of the difference */

static int32_t block_level(const iris_follow *follow, int32_t block, int32_t blocks)
{
    int32_t rest = follow->size.w % 8;
    if (block == blocks - 1 && rest != 0) {
        return LEVEL((int32_t)follow->sum[block]) / rest;
    }
    return (int32_t)follow->sum[block] << 5;
}

/* Line pixels are below (dark) or above (bright) this. The absolute margin keeps noise out of dark scenes. */
static void set_limit(iris_follow *follow, int32_t block)
{
    enum { MARGIN = 16 };
    int32_t floor = follow->floor[block] >> 8;
    int32_t contrast = follow->config.contrast_permil;
    if (follow->config.kind == IRIS_FOLLOW_BRIGHT) {
        int32_t above = floor + (255 - floor) * contrast / 1000;
        above = above < floor + MARGIN ? floor + MARGIN : above;
        follow->limit[block] = (uint8_t)(above > 255 ? 255 : above);
    } else {
        int32_t below = floor - floor * contrast / 1000;
        below = below > floor - MARGIN ? floor - MARGIN : below;
        follow->limit[block] = (uint8_t)(below < 0 ? 0 : below);
    }
}

/* The floor of the first row: every valley is filled up to the lower of the two hills around it. (Bright
 * lines are the same upside down.) Beyond the image's sides a hill of a third of the highest level is
 * assumed, so that a line that is cut by the side is seen too. */
static void first_floor(iris_follow *follow, int32_t blocks)
{
    int32_t flip = follow->config.kind == IRIS_FOLLOW_BRIGHT ? LEVEL(255) : 0;
    int32_t highest = 0;
    for (int32_t b = 0; b < blocks; b++) {
        int32_t level = block_level(follow, b, blocks);
        level = flip ? flip - level : level;
        highest = level > highest ? level : highest;
    }
    int32_t hill = highest * 5 / 16;
    for (int32_t b = 0; b < blocks; b++) {
        int32_t level = block_level(follow, b, blocks);
        level = flip ? flip - level : level;
        hill = level > hill ? level : hill;
        follow->floor[b] = (uint16_t)hill;
    }
    hill = highest * 5 / 16;
    for (int32_t b = blocks - 1; b >= 0; b--) {
        int32_t level = block_level(follow, b, blocks);
        level = flip ? flip - level : level;
        hill = level > hill ? level : hill;
        int32_t filled = hill < follow->floor[b] ? hill : follow->floor[b];
        follow->floor[b] = (uint16_t)(flip ? flip - filled : filled);
        set_limit(follow, b);
    }
}

static void approach(uint16_t *floor, int32_t level, int32_t shift)
{
    *floor = (uint16_t)(*floor + ((level - *floor) >> shift));
}

/* Blocks first to last show no floor. At a side of the image, where there is floor on one hand only, they keep what they
 * know: the light may fall off towards the side. */
static void bridge(iris_follow *follow, int32_t first, int32_t last, int32_t blocks)
{
    int at_left = first == 0, at_right = last == blocks - 1;
    for (int32_t b = first; b <= last; b++) {
        if (at_left && at_right) {
            approach(&follow->floor[b], block_level(follow, b, blocks), GIVE_IN);
        } else if (!at_left && !at_right) {
            int32_t left = follow->floor[first - 1], right = follow->floor[last + 1];
            approach(&follow->floor[b], left < right ? left : right, BESIDE);
        }
        set_limit(follow, b);
    }
}

static void learn(iris_follow *follow, int32_t blocks)
{
    int bright = follow->config.kind == IRIS_FOLLOW_BRIGHT;
    for (int32_t b = 0; b < blocks; b++) {
        if (follow->line[b] == 0) {
            int32_t level = block_level(follow, b, blocks);
            approach(&follow->floor[b], level, (level > follow->floor[b]) == bright ? DOWN : UP);
            set_limit(follow, b);
        } else {
            int32_t last = b;
            while (last + 1 < blocks && follow->line[last + 1] != 0) {
                last++;
            }
            bridge(follow, b, last, blocks);
            b = last;
        }
    }
}

/* Bright lines: the bits of pixels that are not below the limit. */
static void complement(iris_follow *follow, int32_t blocks)
{
    for (int32_t b = 0; b < blocks; b++) {
        follow->line[b] ^= 0xff;
    }
    int32_t rest = follow->size.w % 8;
    if (rest != 0) {
        follow->line[blocks - 1] &= (uint8_t)((1 << rest) - 1);
    }
}

static void scan(iris_follow *follow, const uint8_t *gray, int32_t blocks)
{
    iris_row_scan8_u8(follow->line, follow->sum, gray, follow->limit, follow->size.w);
    if (follow->config.kind == IRIS_FOLLOW_BRIGHT) {
        complement(follow, blocks);
    }
}

void iris_follow_mark_floor(iris_follow *follow, const uint8_t *gray)
{
    int32_t blocks = (int32_t)IRIS_FOLLOW_BLOCKS(follow->size.w);
    scan(follow, gray, blocks);
    if (follow->y == 0) {
        first_floor(follow, blocks);
        scan(follow, gray, blocks);
    }
    learn(follow, blocks);
}
