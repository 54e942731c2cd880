/* The floor: a level per block of 8 columns, learned from the rows above.
 *
 * A block without line pixels draws its level towards what it shows, quickly up and slowly down. A block with line
 * pixels cannot see the floor, so it follows the floor to its left and right instead; where there is none (a line
 * across the whole image), it gives in slowly, so that a floor that really is that dark is floor again after a while.
 * The first row has no row above, nor has a row where another floor begins: its valleys are filled between the hills to
 * their left and right.
 *
 * Levels have 8 fraction bits. For bright lines everything is turned upside down: 0 is white. */
#include "follow_parts.h"

/* What a level moves by when it learns, 1 / 2^n of the difference. */
enum { UP = 1, DOWN = 4, BESIDE = 2, GIVE_IN = 5 };

enum { GLARE = 8 * 250 }; /* the sum of a block that is so bright teaches nothing */

/* Bright lines are that much brighter than a dim floor, or that much nearer to white than a light one: the lesser. */
static inline int32_t bright_range(const iris_follow *follow, int32_t floor)
{
    int32_t dim = ((255 * 256 - floor) * (follow->brighter_q10 >> 2)) >> 8;
    return dim < floor ? dim : floor;
}

int32_t iris_follow_range(const iris_follow *follow, int32_t floor)
{
    return follow->config.kind == IRIS_FOLLOW_BRIGHT ? bright_range(follow, floor) : floor;
}

/* Line pixels are below this. The absolute margin keeps noise out of dark scenes. */
static inline int32_t limit_of(const iris_follow *follow, int32_t floor, int bright)
{
    enum { MARGIN = 16 };
    int32_t range = floor;
    if (__builtin_expect(bright, 0)) {
        range = bright_range(follow, floor);
    }
    int32_t depth = (range * follow->contrast_q10) >> 18;
    int32_t limit = (floor >> 8) - (depth > MARGIN ? depth : MARGIN);
    return limit < 0 ? 0 : limit;
}

static int is_bright(const iris_follow *follow)
{
    return follow->config.kind == IRIS_FOLLOW_BRIGHT;
}

/* The last block may be narrower: its sum becomes that of a whole block. */
static void complete_last_block(const iris_follow *follow, iris_block8 *last)
{
    int32_t rest = (follow->size.w & 7);
    if (rest != 0) {
        last->sum = (uint16_t)(last->sum * 8 / rest);
    }
}

/* Turns a row upside down and back: a bright pixel is not below 256 - limit. */
static void turn_limits(const iris_follow *follow, int32_t blocks)
{
    for (int32_t b = 0; b < blocks; b++) {
        int32_t limit = follow->blocks[b].limit;
        follow->blocks[b].limit = (uint8_t)(limit == 0 ? 255 : 256 - limit);
    }
}

static void turn_pixels(const iris_follow *follow, int32_t blocks)
{
    for (int32_t b = 0; b < blocks; b++) {
        follow->blocks[b].below ^= 0xff;
        follow->blocks[b].sum = (uint16_t)(2040 - follow->blocks[b].sum);
    }
    int32_t rest = (follow->size.w & 7);
    if (rest != 0) {
        follow->blocks[blocks - 1].below &= (uint8_t)((1 << rest) - 1);
    }
}

static void scan(const iris_follow *follow, const uint8_t *gray, int32_t blocks)
{
    if (is_bright(follow)) {
        turn_limits(follow, blocks);
    }
    iris_row_scan8_u8(follow->blocks, gray, follow->size.w);
    complete_last_block(follow, &follow->blocks[blocks - 1]);
    if (is_bright(follow)) {
        turn_pixels(follow, blocks);
        turn_limits(follow, blocks);
    }
}

/* The floor of one row alone: every valley is filled up to the lower of the two hills around it. Beyond the image's
 * sides a hill of a third of the highest level is assumed, so that a line that is cut by the side is seen too. */
static void new_floor(const iris_follow *follow, int32_t blocks)
{
    int bright = is_bright(follow);
    int32_t highest = 0, total = follow->blocks[0].sum, count = 1;
    for (; count < blocks; count++) {
        total += follow->blocks[count].sum;
    }
    int32_t most = total / count * 5 >> 2; /* a hill above that is glare */
    for (int32_t b = 0; b < blocks; b++) {
        int32_t sum = follow->blocks[b].sum < most ? follow->blocks[b].sum : most;
        follow->blocks[b].sum = (uint16_t)sum;
        highest = sum > highest ? sum : highest;
    }
    int32_t beyond = highest * 5 >> 4;
    int32_t hill = beyond;
    for (int32_t b = 0; b < blocks; b++) {
        hill = follow->blocks[b].sum > hill ? follow->blocks[b].sum : hill;
        follow->floor[b] = (uint16_t)(hill << 5);
    }
    hill = beyond;
    for (int32_t b = blocks - 1; b >= 0; b--) {
        hill = follow->blocks[b].sum > hill ? follow->blocks[b].sum : hill;
        int32_t level = follow->floor[b] < hill << 5 ? follow->floor[b] : hill << 5;
        follow->floor[b] = (uint16_t)level;
        follow->blocks[b].limit = (uint8_t)limit_of(follow, level, bright);
    }
}

/* Blocks first to last show no floor. At a side of the image, where there is floor on one hand only, they keep what
 * they know: the light may fall off towards the side. */
static void bridge(const iris_follow *follow, int32_t first, int32_t last, int32_t blocks)
{
    int bright = is_bright(follow);
    int at_left = first == 0, at_right = last == blocks - 1;
    if (at_left != at_right) {
        return;
    }
    int32_t beside = 0;
    if (!at_left) {
        int32_t left = follow->floor[first - 1], right = follow->floor[last + 1];
        beside = left < right ? left : right;
    }
    for (int32_t b = first; b <= last; b++) {
        int32_t level = follow->floor[b];
        level += at_left ? ((follow->blocks[b].sum << 5) - level) >> GIVE_IN : (beside - level) >> BESIDE;
        follow->floor[b] = (uint16_t)level;
        follow->blocks[b].limit = (uint8_t)limit_of(follow, level, bright);
    }
}

/* Follows what the blocks without line pixels show, up to the first block with some. Returns that; the one behind the
 * last counts as such. */
static iris_block8 *learn_clear(const iris_follow *follow, iris_block8 *block)
{
    int bright = is_bright(follow);
    uint16_t *floor = &follow->floor[block - follow->blocks];
    for (; block->below == 0; block++, floor++) {
        if (block->sum >= GLARE) {
            continue;
        }
        int32_t level = *floor;
        int32_t difference = (block->sum << 5) - level;
        level += difference > 0 ? difference >> UP : difference >> DOWN;
        *floor = (uint16_t)level;
        block->limit = (uint8_t)limit_of(follow, level, bright);
    }
    return block;
}

void iris_follow_learn(iris_follow *follow)
{
    if (--follow->rows_to_learn > 0) {
        return;
    }
    follow->rows_to_learn = follow->learn_rows;
    int32_t blocks = (int32_t)IRIS_FOLLOW_BLOCKS(follow->size.w);
    int32_t dark_rows = 0;
    iris_block8 *end = &follow->blocks[blocks];
    for (iris_block8 *block = learn_clear(follow, follow->blocks); block < end;
         block = learn_clear(follow, block)) {
        int32_t first = (int32_t)(block - follow->blocks);
        while (block < end && block->below != 0) {
            block++;
        }
        bridge(follow, first, (int32_t)(block - follow->blocks) - 1, blocks);
        if (first == 0 && block == end) {
            dark_rows = follow->dark_rows + follow->learn_rows;
        }
    }
    follow->dark_rows = dark_rows;
}

/* A few blocks speak for the row. */
static int32_t brightness_of(const iris_follow *follow, int32_t blocks)
{
    int32_t total = 0;
    for (int32_t b = 0; b < blocks; b += 4) {
        total += follow->blocks[b].sum;
    }
    return total;
}

/* Is this another floor: the first row, a row that is half as bright again as the one from which the floor was learned,
 * or one behind many that were darker than any line is thick? */
static int is_new_floor(const iris_follow *follow, int32_t brightness)
{
    return follow->y == 0 || brightness * 2 > follow->brightness * 3 + follow->size.w * 2 ||
           follow->dark_rows * 6 > follow->size.h;
}

void iris_follow_mark(iris_follow *follow, const uint8_t *gray)
{
    int32_t blocks = (int32_t)IRIS_FOLLOW_BLOCKS(follow->size.w);
    scan(follow, gray, blocks);
    if (follow->y == 0 || follow->rows_to_learn == 1) {
        int32_t brightness = brightness_of(follow, blocks);
        if (is_new_floor(follow, brightness)) {
            if (follow->dark_rows > 0) {
                iris_follow_take_back(follow);
            }
            new_floor(follow, blocks);
            scan(follow, gray, blocks);
            follow->brightness = brightness;
            follow->dark_rows = 0;
        }
    }
}
