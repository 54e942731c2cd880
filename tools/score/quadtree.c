/* Quadtrees of real pictures: do the block means reproduce them, and are their regions those that people see? */
#include <stdlib.h>
#include <string.h>

#include "iris/xt/region.h"
#include "picture.h"
#include "score.h"

#define LABELS 256

static const struct {
    const char *name, *file,
        *people; /* people: what one of them saw, as region numbers; null: nobody was asked */
    iris_format format;
} pictures[] = {
    {"3063", "edges/bsds/3063.bmp", "edges/bsds/3063_seg4.pgm", IRIS_RGB888},
    {"196027", "edges/bsds/196027.bmp", "edges/bsds/196027_seg4.pgm", IRIS_RGB888},
    {"69007", "edges/bsds/69007.pgm", "edges/bsds/69007_seg6.pgm", IRIS_GRAY8},
    {"camera", "edges/classic/camera_256.pgm", NULL, IRIS_GRAY8},
    {"moon", "edges/classic/moon_256.pgm", NULL, IRIS_GRAY8},
    {"baboon", "colour/baboon_256.bmp", NULL, IRIS_RGB888},
    {"fruits", "colour/fruits_256.bmp", NULL, IRIS_RGB888},
};
enum { PICTURES = sizeof pictures / sizeof pictures[0] };

/* The tree of a picture, with room for it; null leaves without memory. */
static iris_quadtree tree_of(const iris_image *image, const iris_quadtree_config *config)
{
    size_t area = (size_t)image->w * (size_t)image->h;
    iris_quadtree tree = {.leaves = malloc(area * sizeof *tree.leaves), .capacity = (int32_t)area};
    if (iris_quadtree_segment(&tree, image, config) != IRIS_OK) {
        free(tree.leaves);
        tree.leaves = NULL;
    }
    return tree;
}

/* Is every channel of every pixel within the tolerance of its leaf's mean? */
static int means_reproduce(const iris_image *image, int32_t tolerance)
{
    iris_quadtree tree = tree_of(image, &(iris_quadtree_config){tolerance, 1});
    iris_image means = picture_make(image->w, image->h, image->format);
    int within = tree.leaves && means.data && iris_quadtree_means(&means, &tree) == IRIS_OK;
    size_t bytes = iris_format_row_bytes(image->format, image->w);
    for (int32_t y = 0; y < image->h && within; y++) {
        const uint8_t *is = iris_image_row(image, y), *mean = iris_image_row(&means, y);
        for (size_t i = 0; i < bytes; i++) {
            within &= abs(is[i] - mean[i]) <= tolerance;
        }
    }
    free(tree.leaves);
    free(means.data);
    return within;
}

/* What share of the picture is covered, when every region that a person saw counts by its best intersection over union with
 * one of ours. labels, of `count` kinds, has one for each pixel. */
static double covering(const iris_image *people, const int32_t *labels, int32_t count)
{
    size_t area = (size_t)people->w * (size_t)people->h, kinds = (size_t)count;
    const uint8_t *seen = people->data;
    int32_t *shared = calloc(LABELS * kinds, sizeof *shared), *ours = calloc(kinds, sizeof *ours);
    int32_t theirs[LABELS] = {0};
    double covered = 0;
    for (size_t i = 0; i < area && shared && ours; i++) {
        shared[seen[i] * kinds + (size_t)labels[i]]++;
        ours[labels[i]]++;
        theirs[seen[i]]++;
    }
    for (int t = 0; t < LABELS && shared && ours; t++) {
        double best = 0;
        for (size_t k = 0; k < kinds; k++) {
            int32_t both = shared[(size_t)t * kinds + k];
            double ratio = both > 0 ? both / (double)(ours[k] + theirs[t] - both) : 0;
            best = ratio > best ? ratio : best;
        }
        covered += best * theirs[t];
    }
    free(shared);
    free(ours);
    return covered / (double)area;
}

typedef struct {
    double covering;
    int32_t regions;
} regions_score;

/* config null: each leaf for itself. */
static regions_score score_regions(const iris_image *image, const iris_image *people,
                                   const iris_quadtree_config *by, const iris_region_config *merge_by)
{
    regions_score result = {0, 0};
    iris_quadtree tree = tree_of(image, by);
    size_t bytes = IRIS_REGION_SCRATCH_BYTES(image->w, image->h, tree.count);
    int32_t *of_leaf = malloc(sizeof *of_leaf * (size_t)tree.count);
    int32_t *of_pixel = calloc((size_t)image->w * (size_t)image->h, sizeof *of_pixel);
    void *memory = malloc(bytes);
    iris_scratch scratch;
    iris_region_table table = {.labels = of_leaf};
    if (tree.leaves && of_leaf && of_pixel && iris_scratch_init(&scratch, memory, bytes) == IRIS_OK) {
        iris_region_merge(&table, &tree, merge_by, &scratch);
        for (int32_t i = 0; i < tree.count; i++) {
            const iris_quadtree_leaf *leaf = &tree.leaves[i];
            for (int32_t k = 0; k < leaf->w * leaf->h; k++) {
                of_pixel[(leaf->y + k / leaf->w) * image->w + leaf->x + k % leaf->w] = of_leaf[i];
            }
        }
        result = (regions_score){covering(people, of_pixel, table.count), table.count};
    }
    free(tree.leaves);
    free(of_leaf);
    free(of_pixel);
    free(memory);
    return result;
}

static const int32_t TREE_TOLERANCES[] = {20, 30, 40, 51, 70}, TOLERANCES[] = {15, 20, 25, 30, 40};

/* By one setting for all pictures, the best of those above; and by the defaults. */
static void score_covering(score *s, const iris_image *images, const iris_image *people)
{
    regions_score best[3] = {{0, 0}}, by_default[3], whole[3];
    double best_sum = 0;
    int32_t best_tree = 0, best_merge = 0;
    for (int i = 0; i < 25; i++) {
        iris_quadtree_config by = {TREE_TOLERANCES[i / 5], 1};
        iris_region_config merge_by = {TOLERANCES[i % 5], 64};
        regions_score here[3];
        double sum = 0;
        for (int k = 0; k < 3; k++) {
            here[k] = score_regions(&images[k], &people[k], &by, &merge_by);
            sum += here[k].covering;
        }
        if (sum > best_sum) {
            best_sum = sum;
            best_tree = by.tolerance;
            best_merge = merge_by.tolerance;
            memcpy(best, here, sizeof best);
        }
    }
    for (int k = 0; k < 3; k++) {
        by_default[k] = score_regions(&images[k], &people[k], NULL, NULL);
        whole[k] = score_regions(&images[k], &people[k], &(iris_quadtree_config){255, 1}, NULL);
    }
    const struct {
        const char *how;
        const regions_score *found;
    } rows[] = {{"defaults", by_default}, {"best of 25 settings", best}, {"all of it one region", whole}};
    for (int i = 0; i < 3; i++) {
        char what[96], setting[48] = "";
        const regions_score *r = rows[i].found;
        snprintf(what, sizeof what, "regions of 3063, 196027, 69007, %s: covering", rows[i].how);
        if (i == 1) {
            snprintf(setting, sizeof setting, ", tolerances %d and %d", (int)best_tree, (int)best_merge);
        }
        score_row(s, what, NULL, SCORE_INFORMATION, "%.2f (%.2f %.2f %.2f; %d %d %d regions%s)",
                  (r[0].covering + r[1].covering + r[2].covering) / 3, r[0].covering, r[1].covering,
                  r[2].covering, (int)r[0].regions, (int)r[1].regions, (int)r[2].regions, setting);
    }
}

void score_quadtree(score *s)
{
    static const int32_t tolerances[] = {0, 5, 20, 51, 100, 254};
    iris_image images[PICTURES], people[PICTURES] = {{0}};
    int loaded = 0, within = 0, tried = 0;
    for (int i = 0; i < PICTURES; i++) {
        loaded += picture_load(&images[i], pictures[i].file, pictures[i].format) == IRIS_OK;
        if (pictures[i].people) {
            loaded += picture_load(&people[i], pictures[i].people, IRIS_GRAY8) == IRIS_OK;
        }
    }
    if (loaded < PICTURES + 3) {
        score_row(s, "block means within the tolerance", "always", SCORE_SKIPPED, "no shared data");
    } else {
        for (int i = 0; i < PICTURES; i++) {
            for (size_t k = 0; k < sizeof tolerances / sizeof tolerances[0]; k++, tried++) {
                within += means_reproduce(&images[i], tolerances[k]);
            }
        }
        score_row(s, "block means within the tolerance: pictures times tolerances", "always",
                  score_if(within == tried), "%d of %d", within, tried);
        score_covering(s, images, people);
    }
    for (int i = 0; i < PICTURES; i++) {
        free(images[i].data);
        free(people[i].data);
    }
}
