/* Followers of what has a color signature, in rows of YUYV or UYVY. */
#include "../blob/signature_cells.h"
#include "follow_parts.h"

#define PAIRS (IRIS_SIGNATURE_STEPS * IRIS_SIGNATURE_STEPS)

/* Bit k + 2 of each pair of steps: the cell of level k has a selected signature. Y below and above its range, and so its
 * levels -1 and 9, are as the first and the last level. */
static void select_cells(uint16_t *levels, const iris_signatures *signatures, uint32_t selected)
{
    enum { FIRST = 2, LAST = FIRST + IRIS_SIGNATURE_LEVELS - 1 };
    const uint8_t *cell = signatures->cells;
    for (int32_t pair = 0; pair < PAIRS; pair++) {
        uint32_t bits = 0;
        for (int32_t level = FIRST; level <= LAST; level++) {
            bits |= (uint32_t)((*cell++ & selected) != 0) << level;
        }
        bits |= (bits >> 1 & 1u << (FIRST - 1)) | (bits << 1 & 1u << (LAST + 1));
        levels[pair] = (uint16_t)bits;
    }
}

/* Bits 1, 3, 5, and 7: the first, and the second, pixel of up to four pairs is selected. */
typedef struct {
    uint32_t first, second;
} pair_bits;

/* Puts a pair of pixels before those that are there: a word, Y0 U Y1 V from the lowest byte up. */
static inline void put_pair(pair_bits *to, const uint16_t *levels, uint32_t word)
{
    uint32_t bits = levels[iris_signature_step[word >> 8 & 0xffu] * IRIS_SIGNATURE_STEPS +
                           iris_signature_step[word >> 24]];
    /* 512 times level + 1 of both, where the level is (Y - 16) * 84 / 2048 */
    uint32_t scaled = (word & 0x00ff00ffu) * 21 + 0x00b000b0u;
    to->first = to->first << 2 | (bits >> (scaled >> 9 & 15u) & 2u);
    to->second = to->second << 2 | (bits >> (scaled >> 25) & 2u);
}

static inline uint32_t word_at(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* The bytes of UYVY in the order of YUYV. */
static inline uint32_t in_order(uint32_t word, int is_uyvy)
{
    return is_uyvy ? (word >> 8 & 0x00ff00ffu) | (word & 0x00ff00ffu) << 8 : word;
}

static inline __attribute__((always_inline)) void mark(const iris_follow *follow, const uint8_t *from,
                                                       int is_uyvy)
{
    const uint16_t *levels = follow->levels;
    iris_block8 *block = follow->blocks;
    int32_t left = follow->size.w;
    for (; left >= 8; left -= 8, from += 16) {
        pair_bits bits = {0, 0};
        put_pair(&bits, levels, in_order(word_at(from + 12), is_uyvy));
        put_pair(&bits, levels, in_order(word_at(from + 8), is_uyvy));
        put_pair(&bits, levels, in_order(word_at(from + 4), is_uyvy));
        put_pair(&bits, levels, in_order(word_at(from), is_uyvy));
        (block++)->below = (uint8_t)(bits.first >> 1 | bits.second);
    }
    if (left > 0) {
        pair_bits bits = {0, 0};
        while (left > 0) {
            left -= 2;
            put_pair(&bits, levels, in_order(word_at(from + 2 * left), is_uyvy));
        }
        block->below = (uint8_t)(bits.first >> 1 | bits.second);
    }
}

static const uint8_t *mark_yuyv(iris_follow *follow, const void *pixels)
{
    mark(follow, pixels, 0);
    return NULL;
}

static const uint8_t *mark_uyvy(iris_follow *follow, const void *pixels)
{
    mark(follow, pixels, 1);
    return NULL;
}

iris_status iris_follow_init_signature(iris_follow *follow, iris_size size, const iris_follow_config *config,
                                       const iris_signatures *signatures, uint32_t selected,
                                       iris_scratch *scratch)
{
    if (!follow || !config || !signatures || !scratch || selected < 1 || selected > 255) {
        return IRIS_ERR_ARG;
    }
    if (config->kind != IRIS_FOLLOW_COLOR || (config->format != IRIS_YUYV && config->format != IRIS_UYVY)) {
        return IRIS_ERR_FORMAT;
    }
    if (config->lane == 1) {
        return IRIS_ERR_UNSUPPORTED;
    }
    if (size.w % 2 != 0) {
        return IRIS_ERR_RANGE;
    }
    size_t start = iris_scratch_mark(scratch);
    iris_status status;
    void *memory = iris_follow_memory(&status, size, config, scratch);
    if (!memory) {
        return status;
    }
    uint16_t *levels = iris_scratch_take(scratch, sizeof *levels * PAIRS);
    if (!levels) {
        iris_scratch_release(scratch, start);
        return IRIS_ERR_SCRATCH;
    }
    iris_follow_prepare(follow, size, config, memory);
    follow->mark = config->format == IRIS_UYVY ? mark_uyvy : mark_yuyv;
    follow->levels = levels;
    select_cells(levels, signatures, selected);
    return IRIS_OK;
}
