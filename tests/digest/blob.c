#include "digest.h"

#include "iris/xt/blob.h"
#include "iris/xt/threshold.h"

#define W    64
#define H    40
#define ROOM 10

static void digest_one(const iris_blob *b)
{
    const iris_moments *m = &b->moments;
    const int64_t numbers[] = {m->n,     m->x,       m->y,     m->xx,     m->xy,      m->yy,    b->box.x,
                               b->box.y, b->box.w,   b->box.h, b->area,   b->first_x, b->x_q16, b->y_q16,
                               b->edges, b->corners, b->holes, b->mean.r, b->mean.g,  b->mean.b};
    iris_blob_shape shape = {0, 0, 0, 0, 0};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        digest_number(numbers[i]);
    }
    digest_number(iris_blob_shape_of(&shape, b));
    digest_number(shape.angle);
    digest_number(shape.length_q16);
    digest_number(shape.breadth_q16);
    digest_number(shape.elongation_q16);
    digest_number(shape.perimeter_q16);
}

/* The blobs of a picture above several levels: its noise, its spots, and most of it. */
static void found(int32_t connectivity, iris_format format)
{
    iris_image gray = digest_picture(IRIS_GRAY8, W, H), mask = digest_canvas(IRIS_MASK1, W, H);
    iris_image picture = digest_picture(format, format == IRIS_RGB888 ? 20 : W, H / 2), part;
    iris_image_crop(&part, &mask, (iris_rect){0, 0, picture.w, picture.h});
    iris_blob_table table = {digest_take(ROOM * sizeof(iris_blob)), ROOM, 0};
    iris_scratch scratch =
        digest_scratch(IRIS_BLOB_SCRATCH_BYTES(W, ROOM) + IRIS_BLOB_COLOR_SCRATCH_BYTES(W));
    iris_blob_config config;
    iris_blob_defaults(&config);
    config.connectivity = connectivity;
    for (int32_t level = 60; level < 200; level += 20) {
        (void)iris_threshold(&mask, &gray, (uint8_t)level, IRIS_SELECT_BRIGHT);
        for (int colored = 0; colored < 2; colored++) {
            digest_number(
                iris_blobs(&table, colored ? &part : &mask, colored ? &picture : NULL, &config, &scratch));
            digest_number(table.count);
            for (int32_t i = 0; i < table.count && i < ROOM; i++) {
                digest_one(&table.blobs[i]);
            }
        }
    }
}

static void touching_by_corners(void)
{
    found(8, IRIS_RGB888);
}

static void touching_by_sides(void)
{
    found(4, IRIS_GRAY8);
}

static void filtered(void)
{
    iris_image mask = digest_canvas(IRIS_MASK1, W, H), one = digest_canvas(IRIS_MASK1, W, H);
    iris_blob_table table = {digest_take(ROOM * sizeof(iris_blob)), ROOM, 0};
    iris_scratch scratch = digest_scratch(IRIS_BLOB_SCRATCH_BYTES(W, ROOM));
    iris_blob_config config;
    iris_blob_defaults(&config);
    config.filter.min_area = 3;
    config.filter.min_elongation_q16 = 100000;
    for (int i = 0; i < 4; i++) {
        for (int32_t k = 0; k < W * H / 32; k++) {
            uint32_t high = digest_random(), low = digest_random();
            ((uint32_t *)mask.data)[k] = (high << 12 ^ low) & (i % 2 ? ~0u : high << 7 ^ low << 4);
        }
        digest_number(iris_blobs(&table, &mask, NULL, &config, &scratch));
        for (int32_t k = 0; k < table.count && k < ROOM; k++) {
            digest_one(&table.blobs[k]);
            if (k < 3) {
                digest_number(iris_blob_mask(&one, &mask, &table.blobs[k], 8, &scratch));
                digest_view(&one);
            }
        }
    }
}

const digest_operation digest_blob[] = {{"blob.corners", touching_by_corners},
                                        {"blob.sides", touching_by_sides},
                                        {"blob.filtered", filtered},
                                        {NULL, NULL}};
