/* From the line bits of a row to its runs, and from the runs of successive rows to chains. */
#include "follow_parts.h"

#define NO_CHAIN 255

/* Keeps the longest runs of the row. Two neighbors with little between them are one, with glare on it. */
static void keep(iris_follow *follow, iris_span *runs, int32_t *count, int32_t left, int32_t right)
{
    iris_span run = {(int16_t)left, (int16_t)right};
    if (right - left + 1 < follow->min_width) {
        return;
    }
    if (*count > 0 && runs[*count - 1].right < left) {
        iris_span *before = &runs[*count - 1];
        int32_t narrower =
            iris_span_width(*before) < iris_span_width(run) ? iris_span_width(*before) : iris_span_width(run);
        if ((left - before->right) * 2 <= narrower) {
            before->right = run.right;
            return;
        }
    }
    if (*count < IRIS_FOLLOW_RUNS) {
        runs[(*count)++] = run;
        return;
    }
    int32_t shortest = 0;
    for (int32_t i = 1; i < IRIS_FOLLOW_RUNS; i++) {
        shortest = iris_span_width(runs[i]) < iris_span_width(runs[shortest]) ? i : shortest;
    }
    if (iris_span_width(run) > iris_span_width(runs[shortest])) {
        runs[shortest] = run;
    }
}

/* The runs of line bits, gaps of up to max_gap columns closed. Returns how many were kept. */
static int32_t find_runs(iris_follow *follow, iris_span *runs)
{
    const iris_block8 *block = follow->blocks, *end = block + IRIS_FOLLOW_BLOCKS(follow->size.w);
    int32_t count = 0, left = -1, right = -1;
    for (;; block++) {
        while (block->below == 0) {
            block++;
        }
        if (block >= end) {
            break;
        }
        int32_t x = (int32_t)(block - follow->blocks) * 8;
        uint32_t bits = block->below;
        if (bits == 0xff && left >= 0 && right == x - 1) {
            right = x + 7;
            continue;
        }
        while (bits != 0) {
            if ((bits & 15u) == 0) {
                bits >>= 4;
                x += 4;
            }
            for (; !(bits & 1u); bits >>= 1) {
                x++;
            }
            if (left >= 0 && x - right - 1 > follow->max_gap) {
                keep(follow, runs, &count, left, right);
                left = -1;
            }
            left = left < 0 ? x : left;
            if ((bits & 15u) == 15) {
                bits >>= 4;
                x += 4;
            }
            for (; bits & 1u; bits >>= 1) {
                x++;
            }
            right = x - 1;
        }
    }
    if (left >= 0) {
        keep(follow, runs, &count, left, right);
    }
    return count;
}

/* Columns that a run shares with the end of a chain; touching diagonally counts. */
static int32_t overlap(iris_span a, iris_span b)
{
    int32_t left = a.left > b.left ? a.left : b.left;
    int32_t right = a.right < b.right ? a.right : b.right;
    return right - left + 3;
}

/* Did the chain end so little above this row, or in it, that a run may continue it? */
static int is_open(const iris_follow *follow, const iris_follow_chain *chain)
{
    return chain->bottom_y >= follow->y - 1 - follow->max_gap;
}

/* The chain to write a new one over: a free one, else the smallest that has ended, if it is small. */
static int32_t free_chain(iris_follow *follow)
{
    if (follow->chain_count < IRIS_FOLLOW_CHAINS) {
        return follow->chain_count++;
    }
    int32_t smallest = -1;
    for (int32_t c = 0; c < IRIS_FOLLOW_CHAINS; c++) {
        const iris_follow_chain *chain = &follow->chains[c];
        if (!is_open(follow, chain) && (smallest < 0 || chain->area < follow->chains[smallest].area)) {
            smallest = c;
        }
    }
    return smallest;
}

/* A pixel's level, upside down for bright lines, as the floor is. */
static int32_t level_at(const iris_follow *follow, const uint8_t *gray, int32_t x)
{
    return follow->config.kind == IRIS_FOLLOW_BRIGHT ? 255 - gray[x] : gray[x];
}

/* One sample of how the run stands out: its middle pixel against the floor there. */
static void sample_contrast(const iris_follow *follow, iris_follow_chain *chain, iris_span run,
                            const uint8_t *gray)
{
    if (!gray) {
        chain->contrast_sum += 1;
        chain->range_sum += 1;
        return;
    }
    int32_t x = (run.left + run.right) >> 1;
    int32_t floor = follow->floor[x >> 3];
    chain->contrast_sum += (floor >> 8) - level_at(follow, gray, x);
    chain->range_sum += iris_follow_range(follow, floor) >> 8;
}

/* Is the pixel below the floor, if only by a third of the contrast asked for? */
static int is_weak(const iris_follow *follow, const uint8_t *gray, int32_t x)
{
    int32_t floor = follow->floor[x >> 3] >> 8;
    return (floor - level_at(follow, gray, x)) * 3 > floor - follow->blocks[x >> 3].limit;
}

/* Where glare weakens the line, its run grows over weak pixels up to where it was in the row above. */
static void grow(const iris_follow *follow, iris_span *run, iris_span above, const uint8_t *gray)
{
    while (run->left > above.left && is_weak(follow, gray, run->left - 1)) {
        run->left--;
    }
    while (run->right < above.right && is_weak(follow, gray, run->right + 1)) {
        run->right++;
    }
    for (int32_t b = run->left >> 3; b <= run->right >> 3; b++) {
        follow->blocks[b].below |= 1; /* the floor does not learn from glare on the line */
    }
}

static void append(const iris_follow *follow, iris_follow_chain *chain, iris_span run, const uint8_t *gray)
{
    chain->bottom = run;
    chain->bottom_y = (uint16_t)follow->y;
    chain->rows++;
    chain->area += iris_span_width(run);
    if (iris_span_width(run) > chain->widest) {
        chain->widest = (uint16_t)iris_span_width(run);
    }
    sample_contrast(follow, chain, run, gray);
}

/* Returns the new chain's number, or -1 when there is no room. */
static int32_t start_chain(iris_follow *follow, iris_span run)
{
    int32_t number = free_chain(follow);
    if (number >= 0) {
        follow->chains[number] = (iris_follow_chain){.top = run, .top_y = (uint16_t)follow->y, .next = -1};
    }
    return number;
}

/* Shortens the chain by its last rows as long as they span nearly the whole image. */
static void shorten(iris_follow *follow, iris_follow_chain *chain, uint8_t number)
{
    for (int32_t y = chain->bottom_y; y >= chain->top_y; y--) {
        for (int32_t i = y * IRIS_FOLLOW_RUNS; i < (y + 1) * IRIS_FOLLOW_RUNS; i++) {
            if (follow->owner[i] != number) {
                continue;
            }
            chain->bottom = follow->runs[i];
            chain->bottom_y = (uint16_t)y;
            if (iris_span_width(chain->bottom) * 8 < follow->size.w * 7) {
                return;
            }
            follow->owner[i] = NO_CHAIN;
            chain->rows--;
            chain->area -= iris_span_width(chain->bottom);
        }
    }
    chain->used = 1; /* nothing is left */
}

void iris_follow_take_back(iris_follow *follow)
{
    for (int32_t c = 0; c < follow->chain_count; c++) {
        if (is_open(follow, &follow->chains[c])) {
            shorten(follow, &follow->chains[c], (uint8_t)c);
        }
    }
}

/* What is done next: among the runs without a chain and the chains that ended above and not in this row, the pair that
 * share most, so that a fork continues on its thicker side; else the first such run alone. */
typedef struct {
    int32_t run, chain; /* -1: none */
} iris_follow_pair;

static iris_follow_pair best_pair(const iris_follow *follow, const iris_span *runs, const uint8_t *owner,
                                  int32_t count)
{
    iris_follow_pair best = {-1, -1};
    int32_t most = 0;
    for (int32_t i = 0; i < count; i++) {
        if (owner[i] != NO_CHAIN) {
            continue;
        }
        best.run = best.run < 0 ? i : best.run;
        for (int32_t c = 0; c < follow->chain_count; c++) {
            const iris_follow_chain *chain = &follow->chains[c];
            int32_t shared = overlap(chain->bottom, runs[i]);
            if (shared > most && chain->bottom_y < follow->y && is_open(follow, chain)) {
                best = (iris_follow_pair){i, c};
                most = shared;
            }
        }
    }
    return best;
}

void iris_follow_collect(iris_follow *follow, const uint8_t *gray)
{
    iris_span *runs = &follow->runs[follow->y * IRIS_FOLLOW_RUNS];
    uint8_t *owner = &follow->owner[follow->y * IRIS_FOLLOW_RUNS];
    int32_t count = find_runs(follow, runs);
    for (int32_t i = 0; i < IRIS_FOLLOW_RUNS; i++) {
        owner[i] = NO_CHAIN;
    }
    for (int32_t left = count; left > 0; left--) {
        iris_follow_pair next = best_pair(follow, runs, owner, count);
        if (next.chain < 0) {
            next.chain = start_chain(follow, runs[next.run]);
        } else if (gray && follow->chains[next.chain].bottom_y == follow->y - 1) {
            grow(follow, &runs[next.run], follow->chains[next.chain].bottom, gray);
        }
        if (next.chain < 0) {
            return;
        }
        append(follow, &follow->chains[next.chain], runs[next.run], gray);
        owner[next.run] = (uint8_t)next.chain;
    }
}
