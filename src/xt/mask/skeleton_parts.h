/* What thinning, pruning, and the search for points share: masks as rows of 64-bit words, bit i of word i / 64 pixel i,
 * between zeros. A row has at least one bit to spare, so that what is to the left of a row is the zero that ends
 * the row before. */
#ifndef IRIS_XT_SKELETON_PARTS_H
#define IRIS_XT_SKELETON_PARTS_H

#include "iris/xt/skeleton.h"

/* Words from one row of w pixels to the next. */
static inline int32_t iris_skeleton_stride(int32_t w)
{
    return w / 64 + 1;
}

/* Fills the `stride` words of a row from row y of a mask; what is past w is 0. */
void iris_skeleton_load(uint64_t *row, const iris_image *mask, int32_t y);

/* Writes word i of a row to row y of a mask and keeps what is past w. */
void iris_skeleton_put(const iris_image *mask, int32_t y, int32_t i, uint64_t bits);

/* The pixels to the left, and to the right, of those of a word. */
static inline uint64_t iris_skeleton_west(const uint64_t *word)
{
    return word[0] << 1 | word[-1] >> 63;
}

static inline uint64_t iris_skeleton_east(const uint64_t *word)
{
    return word[0] >> 1 | word[1] << 63;
}

/* The neighbors of the 64 pixels of a word: clockwise from the one above. */
typedef struct {
    uint64_t n, ne, e, se, s, sw, w, nw;
} iris_around;

static inline iris_around iris_around_word(const uint64_t *above, const uint64_t *word, const uint64_t *below)
{
    return (iris_around){
        above[0], iris_skeleton_east(above), iris_skeleton_east(word), iris_skeleton_east(below),
        below[0], iris_skeleton_west(below), iris_skeleton_west(word), iris_skeleton_west(above)};
}

/* How many groups of selected pixels are around a pixel, counted where one begins, once around. Two that follow each
 * other cannot both begin a group, so that a quarter holds at most one. */
typedef struct {
    uint64_t q0, q1, q2, q3;
} iris_groups;

static inline iris_groups iris_groups_around(const iris_around *a)
{
    return (iris_groups){(~a->n & a->ne) | (~a->ne & a->e), (~a->e & a->se) | (~a->se & a->s),
                         (~a->s & a->sw) | (~a->sw & a->w), (~a->w & a->nw) | (~a->nw & a->n)};
}

static inline uint64_t iris_groups_one(const iris_groups *g)
{
    return ((g->q0 ^ g->q1) & ~(g->q2 | g->q3)) | ((g->q2 ^ g->q3) & ~(g->q0 | g->q1));
}

/* A mask between zeros, while it is thinned. */
typedef struct {
    int32_t h, stride;
    uint64_t *words;    /* pixel 0 of row 0; a row of zeros above and below, a zero before and behind */
    uint64_t *snapshot; /* the same when the pass began */
    uint64_t *removed;  /* what is to be removed: a ring */
    uint32_t *at;       /* from which word; as long */
    uint8_t *lives;     /* of each word: the sub-passes that are to look at it */
} iris_thinning;

/* Takes IRIS_SKELETON_SCRATCH_BYTES. All is zero. IRIS_ERR_SCRATCH. */
iris_status iris_thinning_begin(iris_thinning *thinning, iris_size size, iris_scratch *scratch);

/* What is new in the mask will be looked at. */
void iris_thinning_load(iris_thinning *thinning, const iris_image *mask);
void iris_thinning_store(const iris_image *mask, const iris_thinning *thinning);

/* Thins until nothing changes. Returns the passes. */
int32_t iris_thinning_run(iris_thinning *thinning, iris_skeleton_method method);

/* The ends of lines among the pixels of a word. */
uint64_t iris_ends_of_word(const uint64_t *above, const uint64_t *word, const uint64_t *below);

/* Branch points among them. */
uint64_t iris_branches_of_word(const uint64_t *above, const uint64_t *word, const uint64_t *below);

/* The neighbors of pixel (x, y) as bits, clockwise from the one above, where they are, and whether the pixel between
 * them is a branch point as iris_skeleton_branches says. */
extern const int8_t iris_step_x[8], iris_step_y[8];
unsigned iris_skeleton_neighbors(const iris_thinning *skeleton, int32_t x, int32_t y);
int iris_skeleton_is_branch(unsigned around);

/* Takes pixel (x, y) away; the next iris_thinning_run looks at what is around it. */
void iris_thinning_clear(const iris_thinning *thinning, int32_t x, int32_t y);

/* Takes the short branches of a skeleton away, which dst holds too. */
void iris_skeleton_prune_branches(const iris_image *dst, iris_thinning *skeleton, int32_t length);

#endif
