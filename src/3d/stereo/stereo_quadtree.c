#include "stereo_hidden.h"
#include "stereo_planes.h"

/* The pictures at all resolutions; left: that which is divided. */
typedef struct {
    iris_image left[IRIS_STEREO_LEVELS_MAX], right[IRIS_STEREO_LEVELS_MAX];
} pyramids;

/* What a level is worked on with. */
typedef struct {
    iris_stereo_claims claims;
    iris_quadtree_leaf *leaves;
    iris_stereo_window *window;
    uint16_t *sums;
} tools;

void iris_stereo_quadtree_defaults(iris_stereo_quadtree_config *config)
{
    if (config) {
        *config = (iris_stereo_quadtree_config){63, IRIS_STEREO_CENSUS, 20, IRIS_STEREO_LEFT, 0, 3};
    }
}

/* --- pictures --- */

static int32_t side_of(int32_t n, int32_t level)
{
    return (int32_t)IRIS_PYRAMID_SIDE(n, level);
}

static iris_status make_view(iris_image *view, int32_t w, int32_t h, iris_scratch *scratch)
{
    uint8_t *pixels = iris_scratch_take(scratch, (size_t)w * (size_t)h);
    *view = (iris_image){pixels, w, w, h, IRIS_GRAY8};
    return pixels ? IRIS_OK : IRIS_ERR_SCRATCH;
}

/* A copy from right to left, in the scratch. */
static iris_status mirror(iris_image *to, const iris_image *from, iris_scratch *scratch)
{
    iris_status status = make_view(to, from->w, from->h, scratch);
    for (int32_t y = 0; y < from->h && status == IRIS_OK; y++) {
        const uint8_t *row = iris_image_row(from, y);
        uint8_t *reversed = iris_image_row(to, y);
        for (int32_t x = 0; x < from->w; x++) {
            reversed[from->w - 1 - x] = row[x];
        }
    }
    return status;
}

static void reverse_rows(const iris_image *map)
{
    for (int32_t y = 0; y < map->h; y++) {
        uint16_t *row = iris_image_row(map, y);
        for (int32_t x = 0; x < map->w - 1 - x; x++) {
            uint16_t other = row[map->w - 1 - x];
            row[map->w - 1 - x] = row[x];
            row[x] = other;
        }
    }
}

/* Views [1] to [levels - 1]. */
static iris_status make_smaller(iris_image *views, int32_t levels, iris_scratch *scratch)
{
    iris_status status = IRIS_OK;
    for (int32_t k = 1; k < levels && status == IRIS_OK; k++) {
        status = make_view(&views[k], (views[k - 1].w + 1) / 2, (views[k - 1].h + 1) / 2, scratch);
        if (status == IRIS_OK) {
            status =
                iris_pyramid_down(&views[k], &views[k - 1], (iris_border){IRIS_BORDER_REPLICATE, 0}, scratch);
        }
    }
    return status;
}

/* --- a level --- */

static iris_status take_blocks(iris_stereo_level *l, const pyramids *p, int32_t k, iris_scratch *scratch)
{
    const iris_image *left = &p->left[k];
    size_t tiles = IRIS_STEREO_TILES(left->w, left->h);
    *l = (iris_stereo_level){.left = left,
                             .right = &p->right[k],
                             .columns = (left->w + IRIS_STEREO_TILE - 1) / IRIS_STEREO_TILE,
                             .rows = (left->h + IRIS_STEREO_TILE - 1) / IRIS_STEREO_TILE};
    l->patches = iris_scratch_take(scratch, tiles * sizeof *l->patches);
    l->owner = iris_scratch_take(scratch, tiles * sizeof *l->owner);
    return l->patches && l->owner ? IRIS_OK : IRIS_ERR_SCRATCH;
}

static iris_status take_tools(tools *t, iris_stereo_level *l, iris_scratch *scratch)
{
    size_t tiles = (size_t)l->columns * (size_t)l->rows, steps = (size_t)l->steps;
    l->costs = iris_scratch_take(scratch, 2 * tiles * steps);
    l->means = iris_scratch_take(scratch, tiles);
    t->window = iris_scratch_take(scratch, sizeof *t->window);
    t->sums = iris_scratch_take(scratch, 2 * steps);
    iris_status status = iris_stereo_claims_begin(&t->claims, l, scratch);
    t->leaves = iris_scratch_take(scratch, tiles * sizeof *t->leaves);
    return l->costs && l->means && t->window && t->sums && t->leaves ? status : IRIS_ERR_SCRATCH;
}

static iris_status match_level(iris_stereo_level *l, const iris_stereo_level *coarser, tools *t,
                               const iris_stereo_quadtree_config *config, iris_scratch *scratch)
{
    iris_status status = iris_stereo_level_divide(l, t->leaves, config->tolerance);
    if (status == IRIS_OK) {
        status = iris_stereo_level_fill(l, coarser, config->cost, scratch);
    }
    if (status == IRIS_OK) {
        iris_stereo_match_flat(l, t->window, t->sums);
        if (config->planes) {
            iris_stereo_match_planes(l, t->window);
        }
    }
    return status;
}

static void draw(const iris_image *map, const iris_stereo_level *l, const tools *t, int32_t shift,
                 const iris_stereo_quadtree_config *config)
{
    for (int32_t i = 0; i < l->count; i++) {
        const iris_stereo_patch *p = &l->patches[i];
        iris_stereo_patch_draw(map, p, &(iris_rect){p->x, p->y, p->w, p->h}, shift, config->max_disparity);
    }
    iris_stereo_fill_hidden(map, l, &t->claims, shift, config->max_disparity);
    if (config->divided == IRIS_STEREO_RIGHT) {
        reverse_rows(map);
    }
}

/* --- from coarse to fine --- */

/* The finest map that is wanted; count: none. */
static int32_t finest_of(const iris_image *maps, int32_t count)
{
    int32_t finest = 0;
    while (finest < count && !maps[finest].data) {
        finest++;
    }
    return finest;
}

static iris_status match(const iris_image *maps, int32_t count, const pyramids *p,
                         const iris_stereo_quadtree_config *config, iris_scratch *scratch)
{
    iris_stereo_level level[2];
    int32_t finest = finest_of(maps, count);
    iris_status status = IRIS_OK;
    for (int32_t k = config->levels - 1; k >= finest && status == IRIS_OK; k--) {
        iris_stereo_level *own = &level[k % 2], *coarser = k < config->levels - 1 ? &level[1 - k % 2] : NULL;
        tools t;
        status = take_blocks(own, p, k, scratch);
        own->most = side_of(config->max_disparity, k);
        own->steps = own->most / 16 * 16 + 16;
        size_t mark = iris_scratch_mark(scratch);
        if (status == IRIS_OK) {
            status = take_tools(&t, own, scratch);
        }
        if (status == IRIS_OK) {
            status = match_level(own, coarser, &t, config, scratch);
        }
        if (status == IRIS_OK && k < count && maps[k].data) {
            draw(&maps[k], own, &t, k, config);
        }
        iris_scratch_release(scratch, mark);
    }
    return status;
}

static size_t bytes_of(const iris_image *left, const iris_stereo_quadtree_config *c)
{
    return IRIS_STEREO_QUADTREE_SCRATCH_BYTES(left->w, left->h, c->max_disparity, c->levels) +
           (c->divided == IRIS_STEREO_RIGHT ? IRIS_STEREO_MIRROR_BYTES(left->w, left->h) : 0);
}

static iris_status match_pictures(const iris_image *maps, int32_t count, pyramids *p,
                                  const iris_stereo_quadtree_config *config, iris_scratch *scratch)
{
    size_t mark = iris_scratch_mark(scratch);
    iris_status status =
        iris_scratch_take(scratch, bytes_of(&p->left[0], config)) ? IRIS_OK : IRIS_ERR_SCRATCH;
    iris_scratch_release(scratch, mark);
    if (status == IRIS_OK && config->divided == IRIS_STEREO_RIGHT) {
        const iris_image left = p->left[0];
        status = mirror(&p->left[0], &p->right[0], scratch);
        status = status == IRIS_OK ? mirror(&p->right[0], &left, scratch) : status;
    }
    status = status == IRIS_OK ? make_smaller(p->left, config->levels, scratch) : status;
    status = status == IRIS_OK ? make_smaller(p->right, config->levels, scratch) : status;
    return status == IRIS_OK ? match(maps, count, p, config, scratch) : status;
}

/* --- calls --- */

static iris_status check_map(const iris_image *maps, int32_t k, const iris_image *left,
                             const iris_image *right)
{
    const iris_image *map = &maps[k];
    iris_status status = iris_image_check(map);
    if (status != IRIS_OK) {
        return status;
    }
    if (map->format != IRIS_GRAY_U16) {
        return IRIS_ERR_FORMAT;
    }
    if (map->w != side_of(left->w, k) || map->h != side_of(left->h, k)) {
        return IRIS_ERR_RANGE;
    }
    int meet = iris_image_overlaps(map, left) || iris_image_overlaps(map, right);
    for (int32_t i = 0; i < k; i++) {
        meet = meet || (maps[i].data && iris_image_overlaps(map, &maps[i]));
    }
    return meet ? IRIS_ERR_ALIAS : IRIS_OK;
}

static iris_status check(const iris_image *maps, int32_t count, const iris_image *left,
                         const iris_image *right, const iris_stereo_quadtree_config *c)
{
    if (c->max_disparity < 1 || c->max_disparity > IRIS_STEREO_DISPARITY_MAX ||
        (unsigned)c->cost > IRIS_STEREO_BOTH || c->tolerance < 0 || c->tolerance > 255 ||
        (unsigned)c->divided > IRIS_STEREO_RIGHT || c->levels < 1 || c->levels > IRIS_STEREO_LEVELS_MAX ||
        count < 1 || count > c->levels) {
        return IRIS_ERR_ARG;
    }
    const iris_image *views[] = {left, right};
    for (int i = 0; i < 2; i++) {
        iris_status status = iris_image_check(views[i]);
        if (status != IRIS_OK || views[i]->format != IRIS_GRAY8) {
            return status != IRIS_OK ? status : IRIS_ERR_FORMAT;
        }
    }
    if (left->w != right->w || left->h != right->h) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = IRIS_OK;
    for (int32_t k = 0; k < count && status == IRIS_OK; k++) {
        status = maps[k].data ? check_map(maps, k, left, right) : IRIS_OK;
    }
    size_t tiles = IRIS_STEREO_TILES(left->w, left->h);
    return status == IRIS_OK && tiles > SIZE_MAX / 8 / (size_t)(c->max_disparity + 1) ? IRIS_ERR_RANGE
                                                                                      : status;
}

iris_status iris_stereo_quadtree_maps(const iris_image *maps, int32_t count, const iris_image *left,
                                      const iris_image *right, const iris_stereo_quadtree_config *config,
                                      iris_scratch *scratch)
{
    iris_stereo_quadtree_config defaults;
    iris_stereo_quadtree_defaults(&defaults);
    config = config ? config : &defaults;
    iris_status status =
        maps && left && right && scratch ? check(maps, count, left, right, config) : IRIS_ERR_ARG;
    if (status == IRIS_OK) {
        pyramids p = {{*left}, {*right}};
        size_t mark = iris_scratch_mark(scratch);
        status = match_pictures(maps, count, &p, config, scratch);
        iris_scratch_release(scratch, mark);
    }
    return status;
}

iris_status iris_stereo_quadtree(const iris_image *disparity, const iris_image *left, const iris_image *right,
                                 const iris_stereo_quadtree_config *config, iris_scratch *scratch)
{
    iris_status status = disparity ? iris_image_check(disparity) : IRIS_ERR_ARG;
    return status == IRIS_OK ? iris_stereo_quadtree_maps(disparity, 1, left, right, config, scratch) : status;
}
