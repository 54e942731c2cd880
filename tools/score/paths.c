/* Lines told apart: how many there are in painted crossings, by skeletons and by blocks. */
#include <stdlib.h>

#include "crossing.h"
#include "iris/xt/line_mask.h"
#include "iris/xt/paths.h"
#include "nothing.h"
#include "picture.h"
#include "score.h"

enum { PER_KIND = 40, W = 320, H = 240, PATHS = 8, LEAVES = 20000, REGIONS = 2000 };

static int32_t by_skeleton(const iris_image *gray)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_PATHS_SCRATCH_BYTES(W, H));
    static uint32_t words[W / 32 * H];
    iris_image mask;
    iris_path found[PATHS];
    int32_t count = -1;
    iris_scratch scratch;
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (iris_image_wrap(&mask, words, sizeof words, (iris_size){W, H}, 0, IRIS_MASK1) == IRIS_OK &&
        iris_line_mask(NULL, &mask, gray, NULL, &scratch) == IRIS_OK) {
        (void)iris_paths_find(found, PATHS, &count, &mask, NULL, &scratch);
    }
    return count;
}

static int32_t by_blocks(const iris_image *gray)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_REGION_SCRATCH_BYTES(W, H, LEAVES));
    static iris_quadtree_leaf leaves[LEAVES];
    static iris_region regions[REGIONS];
    static int32_t labels[LEAVES];
    iris_quadtree tree = {.leaves = leaves, .capacity = LEAVES};
    iris_region_table table = {regions, REGIONS, labels, 0};
    iris_path found[PATHS];
    int32_t count = -1;
    iris_scratch scratch;
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    iris_status status = iris_quadtree_segment(&tree, gray, NULL);
    if ((status == IRIS_OK || status == IRIS_ERR_FULL) &&
        iris_region_merge(&table, &tree, NULL, &scratch) == IRIS_OK) {
        (void)iris_paths_of_regions(found, PATHS, &count, &tree, &table, NULL);
    }
    return count;
}

static void score_kind(score *s, const char *what, crossing_kind kind, int32_t lines)
{
    int right[2] = {0, 0};
    iris_image gray = picture_make(W, H, IRIS_GRAY8);
    for (int i = 0; gray.data && i < PER_KIND; i++) {
        crossing_truth truth;
        crossing_paint(&truth, &gray, kind, 0, (uint32_t)i + 3000);
        right[0] += by_skeleton(&gray) == lines;
        right[1] += by_blocks(&gray) == lines;
    }
    free(gray.data);
    score_row(s, what, NULL, SCORE_INFORMATION, "by skeletons %d of %d, by blocks %d", right[0], PER_KIND,
              right[1]);
}

void score_paths(score *s)
{
    int wrong[2] = {0, 0};
    score_kind(s, "lines told apart: one line is one", CROSSING_STRAIGHT, 1);
    score_kind(s, "lines told apart: a crossing is two", CROSSING_PLUS, 2);
    score_kind(s, "lines told apart: a T is two", CROSSING_T, 2);
    score_kind(s, "lines told apart: an empty floor is none", CROSSING_EMPTY, 0);
    for (int i = 0; i < NOTHING_PICTURES; i++) {
        iris_image gray = nothing_picture(i);
        wrong[0] += gray.data && by_skeleton(&gray) != 0;
        wrong[1] += gray.data && by_blocks(&gray) > 0;
        free(gray.data);
    }
    score_row(s, "lines told apart where nothing is", NULL, SCORE_INFORMATION,
              "on %d by skeletons, %d by blocks, of %d pictures", wrong[0], wrong[1], NOTHING_PICTURES);
    score_cost_row(s, "lines told apart", "paths of a crossing", IRIS_PATHS_SCRATCH_BYTES(160, 120));
}
