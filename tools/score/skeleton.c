/* Skeletons of the shapes: one pixel wide, and connected as the shape. Everything is counted by flooding, here. */
#include <stdlib.h>
#include <string.h>

#include "iris/xt/skeleton.h"
#include "iris/xt/threshold.h"
#include "picture.h"
#include "score.h"

/* A mask as one byte per pixel, with a margin of one pixel that is not selected. */
typedef struct {
    int32_t w, h; /* with the margin */
    uint8_t *at;  /* null: no memory */
} plane;

static plane plane_of(const iris_image *mask)
{
    plane p = {mask->w + 2, mask->h + 2, calloc((size_t)(mask->w + 2) * (size_t)(mask->h + 2), 1)};
    for (int32_t i = 0; p.at && i < mask->w * mask->h; i++) {
        int32_t x = i % mask->w, y = i / mask->w;
        const uint32_t *row = iris_image_row(mask, y);
        p.at[(y + 1) * p.w + x + 1] = row[x / 32] >> x % 32 & 1;
    }
    return p;
}

typedef struct {
    int parts, holes;
} topology;

/* What touches `start` and is alike gets the value 2: by a side or a corner when it is selected, else by a side. */
static void flood(const plane *p, int32_t *stack, int32_t start)
{
    const int32_t step[8] = {-1, 1, -p->w, p->w, -p->w - 1, -p->w + 1, p->w - 1, p->w + 1};
    uint8_t of = p->at[start];
    int32_t used = 0;
    stack[used++] = start;
    p->at[start] = 2;
    while (used > 0) {
        int32_t from = stack[--used];
        for (int i = 0; i < (of ? 8 : 4); i++) {
            int32_t to = from + step[i];
            if (to >= 0 && to < p->w * p->h && p->at[to] == of) {
                p->at[to] = 2;
                stack[used++] = to;
            }
        }
    }
}

/* Uses the plane up. */
static topology count(const plane *p, int32_t *stack)
{
    topology result = {0, -1}; /* the outside is no hole */
    for (int32_t i = 0; i < p->w * p->h; i++) {
        if (p->at[i] != 2) {
            result.parts += p->at[i] == 1;
            result.holes += p->at[i] == 0;
            flood(p, stack, i);
        }
    }
    return result;
}

/* {0, 0} without memory. */
static topology topology_of(const iris_image *mask)
{
    plane p = plane_of(mask);
    int32_t *stack = malloc((size_t)p.w * (size_t)p.h * sizeof *stack);
    topology result = {0, 0};
    if (p.at && stack) {
        result = count(&p, stack);
    }
    free(p.at);
    free(stack);
    return result;
}

/* Parts and holes of the 3x3 pixels around `at`, with or without the middle. */
static topology around(int *selected, const plane *p, int32_t at, int with)
{
    int32_t stack[25];
    uint8_t nine[25] = {0};
    plane small = {5, 5, nine};
    *selected = 0;
    for (int i = 0; i < 9; i++) {
        uint8_t value = i == 4 ? (uint8_t)with : p->at[at + (i / 3 - 1) * p->w + i % 3 - 1];
        nine[(i / 3 + 1) * 5 + i % 3 + 1] = value;
        *selected += value;
    }
    return count(&small, stack);
}

/* Is every pixel needed, or an end (one neighbor), or alone? 0 without memory. */
static int is_one_wide(const iris_image *skeleton)
{
    plane p = plane_of(skeleton);
    int one_wide = p.at != NULL;
    for (int32_t i = p.w; one_wide && i < p.w * (p.h - 1); i++) {
        if (p.at[i]) {
            int neighbors, selected;
            topology without = around(&neighbors, &p, i, 0), with = around(&selected, &p, i, 1);
            one_wide = neighbors < 2 || without.parts != with.parts || without.holes != with.holes;
        }
    }
    free(p.at);
    return one_wide;
}

/* The shape's skeleton; data is null when there is none. *mask: the shape. */
static iris_image skeleton_of(iris_image *mask, const iris_image *gray)
{
    iris_scratch scratch;
    static IRIS_SCRATCH_BUFFER(working, IRIS_SKELETON_SCRATCH_BYTES(512, 512));
    iris_image skeleton = picture_make(gray->w, gray->h, IRIS_MASK1);
    *mask = picture_make(gray->w, gray->h, IRIS_MASK1);
    iris_scratch_init(&scratch, working.memory, sizeof working.memory);
    if (iris_threshold(mask, gray, 127, IRIS_SELECT_BRIGHT) != IRIS_OK ||
        iris_skeleton(NULL, &skeleton, mask, IRIS_SKELETON_EXACT, &scratch) != IRIS_OK) {
        free(skeleton.data);
        skeleton.data = NULL;
    }
    return skeleton;
}

/* Squared distance of the pixel at x, y (of a plane with a margin) from the nearest that is not selected. The margin ends
 * every search. */
static int32_t radius2(const plane *p, int32_t x, int32_t y)
{
    int32_t least = INT32_MAX;
    for (int32_t dy = 0; dy * dy < least; dy++) {
        for (int32_t dx = 0; dx * dx + dy * dy < least; dx++) {
            int32_t left = x - dx, right = x + dx, up = y - dy, down = y + dy;
            if (!p->at[up * p->w + left] || !p->at[up * p->w + right] || !p->at[down * p->w + left] ||
                !p->at[down * p->w + right]) {
                least = dx * dx + dy * dy;
            }
        }
    }
    return least;
}

/* The share of a shape that the greatest discs inside it around the skeleton's pixels cover: all, if they were its exact
 * middle line. */
static double covered(const iris_image *mask, const iris_image *skeleton)
{
    plane shape = plane_of(mask), line = plane_of(skeleton), discs = plane_of(mask);
    int32_t area = 0, inside = 0, size = shape.w * shape.h;
    for (int32_t i = 0; shape.at && line.at && discs.at && i < size; i++) {
        area += shape.at[i];
        int32_t x = i % shape.w, y = i / shape.w, r2 = line.at[i] ? radius2(&shape, x, y) : 0;
        for (int32_t dy = -y; dy < shape.h - y; dy++) {
            for (int32_t dx = -x; r2 > dy * dy && dx < shape.w - x; dx++) {
                if (dx * dx + dy * dy < r2) {
                    discs.at[i + dy * shape.w + dx] = 2;
                }
            }
        }
    }
    for (int32_t i = 0; discs.at && i < size; i++) {
        inside += discs.at[i] == 2;
    }
    free(shape.at);
    free(line.at);
    free(discs.at);
    return area ? (double)inside / area : 0;
}

/* 1: right, 0: wrong, -1: there is no such shape. *cover: the share that its discs cover. */
static int try_shape(double *cover, const char *name, const score *s)
{
    iris_image gray, mask = {0}, skeleton = {0};
    int right = -1;
    *cover = 0;
    if (picture_load(&gray, name, IRIS_GRAY8) == IRIS_OK) {
        skeleton = skeleton_of(&mask, &gray);
        right = skeleton.data && is_one_wide(&skeleton);
    }
    if (right == 1) {
        topology before = topology_of(&mask), after = topology_of(&skeleton);
        right = before.parts > 0 && before.parts == after.parts && before.holes == after.holes;
        *cover = covered(&mask, &skeleton);
    }
    if (skeleton.data && s->pictures) {
        char file[64];
        snprintf(file, sizeof file, "skeleton-%s", strrchr(name, '/') + 1);
        picture_save(&skeleton, s->pictures, file);
    }
    free(gray.data);
    free(mask.data);
    free(skeleton.data);
    return right;
}

void score_skeleton(score *s)
{
    static const char *const classes[] = {"apple", "bell",   "bone",   "bottle", "camel",
                                          "fork",  "guitar", "hammer", "heart",  "key"};
    const char *what = "skeletons one pixel wide, parts and holes of the shape";
    int right = 0, there = 0;
    double cover, sum = 0;
    for (int i = 0; i <= 30; i++) {
        char name[64] = "shapes/horse.bmp";
        if (i < 30) {
            snprintf(name, sizeof name, "shapes/mpeg7/%s-0%d.bmp", classes[i / 3], 1 + i % 3 * 4);
        }
        int result = try_shape(&cover, name, s);
        there += result >= 0;
        right += result > 0;
        sum += cover;
    }
    if (there == 0) {
        score_row(s, what, "all", SCORE_SKIPPED, "no shared data");
    } else {
        score_row(s, what, "all", score_if(right == 31), "%d of 31", right);
        score_row(s, "shape that the discs around its skeleton cover, mean", NULL, SCORE_INFORMATION,
                  "%.1f %%", 100 * sum / there);
    }
}
