#include "iris/xt/shape.h"
#include "shape_heights.h"

void iris_shape_matching_defaults(iris_shape_matching *config, iris_shape_method method)
{
    if (config) {
        *config = (iris_shape_matching){method, 1, IRIS_SHAPE_LEAST(method), -1, {0, 0, 0, 0}};
        iris_shape_tolerance_defaults(&config->tolerance);
    }
}

static int is_share(iris_q16 value)
{
    return value >= 0 && value <= IRIS_Q16_ONE;
}

static int config_is_bad(const iris_shape_matching *c)
{
    return (unsigned)c->method > IRIS_SHAPE_MOMENTS || (c->mirrored != 0 && c->mirrored != 1) ||
           !is_share(c->least_q16) || c->except < -1 || c->tolerance.tolerance < 0 ||
           c->tolerance.tolerance > IRIS_SHAPE_ONE || !is_share(c->tolerance.cumulative_q16) ||
           !is_share(c->tolerance.missing_q16);
}

/* Can a description be this? Then nothing that follows overflows. */
static int is_plausible(const iris_shape *s)
{
    int good = s->class_index >= 0;
    for (int i = 0; i < IRIS_SHAPE_POINTS; i++) {
        good &= s->x[i] >= -IRIS_SHAPE_DIAMETER && s->x[i] <= IRIS_SHAPE_DIAMETER;
        good &= s->y[i] >= -IRIS_SHAPE_DIAMETER && s->y[i] <= IRIS_SHAPE_DIAMETER;
    }
    for (int i = 0; i < IRIS_SHAPE_RAYS; i++) {
        good &= s->rays[i] <= IRIS_SHAPE_ONE || s->rays[i] == IRIS_SHAPE_MISSING;
    }
    for (int i = 0; i < 4; i++) {
        good &= s->moments_q20[i] >= 0 && s->moments_q20[i] <= 1 << 30;
    }
    return good;
}

static iris_shape_likeness compare_rays(const iris_shape *shape, const iris_shape *model,
                                        const iris_shape_matching *config)
{
    iris_shape_correlation best = {0, 0, 0, 0, 0}, plain = {0, 0, 0, 0, 0};
    iris_shape_tolerance tolerance = config->tolerance;
    tolerance.mirrored = config->mirrored;
    (void)iris_shape_correlate(&best, shape->rays, model->rays, IRIS_SHAPE_RAYS, &tolerance);
    if (best.mirrored) {
        tolerance.mirrored = 0;
        (void)iris_shape_correlate(&plain, shape->rays, model->rays, IRIS_SHAPE_RAYS, &tolerance);
        best = best.degree_q16 > plain.degree_q16 + IRIS_SHAPE_MIRROR_LEAD_Q16 ? best : plain;
    }
    return (iris_shape_likeness){best.degree_q16, best.angle, best.mirrored};
}

/* What the numbers differ by, as a share of the larger ones. */
static iris_shape_likeness compare_moments(const iris_shape *shape, const iris_shape *model)
{
    int64_t differ = 0, larger = 0;
    for (int i = 0; i < 4; i++) {
        int64_t a = shape->moments_q20[i], b = model->moments_q20[i];
        differ += a > b ? a - b : b - a;
        larger += a > b ? a : b;
    }
    return (iris_shape_likeness){
        larger == 0 ? IRIS_Q16_ONE : (iris_q16)((larger - differ) * IRIS_Q16_ONE / larger), 0, 0};
}

static iris_status take_memory(iris_shape_memory *memory, iris_scratch *scratch)
{
    const size_t heights = IRIS_SHAPE_POINTS * sizeof(iris_shape_heights);
    memory->shape = (iris_shape_heights *)iris_scratch_take(scratch, heights);
    memory->model = (iris_shape_heights *)iris_scratch_take(scratch, heights);
    memory->mirrored = (iris_shape_heights *)iris_scratch_take(scratch, heights);
    memory->ways = (uint8_t *)iris_scratch_take(scratch, IRIS_SHAPE_POINTS * (2u * IRIS_SHAPE_GIVE + 1u));
    return memory->shape && memory->model && memory->mirrored && memory->ways ? IRIS_OK : IRIS_ERR_SCRATCH;
}

static iris_status check(const iris_shape *shape, const iris_shape_library *library)
{
    if (!shape || !library || library->count < 0 || (!library->models && library->count > 0)) {
        return IRIS_ERR_ARG;
    }
    int good = is_plausible(shape);
    for (int32_t i = 0; i < library->count; i++) {
        good &= is_plausible(&library->models[i]);
    }
    return good ? IRIS_OK : IRIS_ERR_RANGE;
}

static iris_shape_found find(const iris_shape *shape, const iris_shape_library *library,
                             const iris_shape_matching *c, const iris_shape_memory *memory)
{
    iris_shape_found best = {IRIS_SHAPE_UNKNOWN, -1, 0, 0, 0};
    if (c->method == IRIS_SHAPE_HEIGHTS) {
        iris_shape_heights_of(memory->shape, shape);
    }
    for (int32_t i = 0; i < library->count; i++) {
        const iris_shape *model = &library->models[i];
        if (i == c->except) {
            continue;
        }
        iris_shape_likeness like = c->method == IRIS_SHAPE_HEIGHTS
                                       ? iris_shape_heights_compare(memory, shape, model, c->mirrored)
                                   : c->method == IRIS_SHAPE_RADIAL ? compare_rays(shape, model, c)
                                                                    : compare_moments(shape, model);
        if (best.index < 0 || like.score_q16 > best.score_q16) {
            best = (iris_shape_found){model->class_index, i, like.score_q16, like.angle, like.mirrored};
        }
    }
    if (best.score_q16 < c->least_q16) {
        best.class_index = IRIS_SHAPE_UNKNOWN;
    }
    return best;
}

iris_status iris_shape_match(iris_shape_found *found, const iris_shape *shape,
                             const iris_shape_library *library, const iris_shape_matching *config,
                             iris_scratch *scratch)
{
    iris_shape_matching c;
    iris_shape_matching_defaults(&c, IRIS_SHAPE_HEIGHTS);
    if (config) {
        c = *config;
    }
    if (!found || !scratch || config_is_bad(&c)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = check(shape, library);
    if (status != IRIS_OK) {
        return status;
    }
    size_t mark = iris_scratch_mark(scratch);
    iris_shape_memory memory;
    status = take_memory(&memory, scratch);
    if (status == IRIS_OK) {
        *found = find(shape, library, &c, &memory);
    }
    iris_scratch_release(scratch, mark);
    return status;
}
