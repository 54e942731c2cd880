/* What an operation works with: pictures, working memory, and the part of the picture that it is asked for. */
#include <stdlib.h>
#include <string.h>

#include "iris/color.h"
#include "iris/copy.h"
#include "iris/xt/threshold.h"
#include "operation.h"
#include "system.h"

/* picture_reserve that complains. */
static int reserve(const operation_stage *stage, picture_buffer *picture, iris_size size, iris_format format)
{
    iris_status status = picture_reserve(picture, size, format);
    if (status != IRIS_OK) {
        complain(stage->file, "%s", picture_problem(status, size));
    }
    return status == IRIS_OK;
}

const iris_image *stage_picture(operation_stage *stage, iris_size size, iris_format format)
{
    if (stage->pictures_used == STAGE_PICTURES) {
        complain(stage->file, "more than %d pictures at a time", STAGE_PICTURES);
        return NULL;
    }
    picture_buffer *picture = &stage->pictures[stage->pictures_used++];
    return reserve(stage, picture, size, format) ? &picture->image : NULL;
}

const iris_image *stage_copy(operation_stage *stage, const iris_image *image)
{
    const iris_image *copy = stage_picture(stage, (iris_size){image->w, image->h}, image->format);
    if (copy) {
        iris_copy(copy, image);
    }
    return copy;
}

/* A mask is made of gray, and color of a mask through gray. */
static const iris_image *converted(operation_stage *stage, const iris_image *image, iris_format format)
{
    if (image->format == format) {
        return image;
    }
    int through_gray = (image->format == IRIS_MASK1 || format == IRIS_MASK1) && format != IRIS_GRAY8;
    const iris_image *from = through_gray ? converted(stage, image, IRIS_GRAY8) : image;
    const iris_image *to = from ? stage_picture(stage, (iris_size){image->w, image->h}, format) : NULL;
    if (to && format == IRIS_MASK1) {
        iris_threshold(to, from, 127, IRIS_SELECT_BRIGHT);
    } else if (to) {
        iris_color_convert(to, from);
    }
    return to;
}

const iris_image *stage_gray(operation_stage *stage, const iris_image *input)
{
    return converted(stage, input, IRIS_GRAY8);
}

const iris_image *stage_color(operation_stage *stage, const iris_image *input)
{
    return converted(stage, input, IRIS_RGB888);
}

const iris_image *stage_mask(operation_stage *stage, const iris_image *input)
{
    return converted(stage, input, IRIS_MASK1);
}

const iris_image *stage_levels(operation_stage *stage, const iris_image *input)
{
    return input->format == IRIS_MASK1 ? stage_gray(stage, input) : input;
}

/* Memory of at least `bytes` bytes at *memory, kept from one picture to the next. */
static int grow(const operation_stage *stage, void **memory, size_t *have, size_t bytes)
{
    if (*memory && *have >= bytes) {
        return 1;
    }
    free(*memory);
    *have = 0;
    *memory = NULL;
    if (bytes < PICTURE_MEMORY_MAX) {
        *memory = system_scratch(bytes + 1);
    }
    if (!*memory) {
        complain(stage->file, "not enough working memory: %lu bytes", (unsigned long)bytes);
        return 0;
    }
    *have = bytes;
    return 1;
}

iris_scratch *stage_scratch(operation_stage *stage, size_t bytes)
{
    if (!grow(stage, &stage->scratch_memory, &stage->scratch_bytes, bytes)) {
        return NULL;
    }
    iris_scratch_init(&stage->scratch, stage->scratch_memory, stage->scratch_bytes);
    return &stage->scratch;
}

void *stage_room(operation_stage *stage, size_t bytes)
{
    if (!grow(stage, &stage->room_memory, &stage->room_bytes, bytes)) {
        return NULL;
    }
    return memset(stage->room_memory, 0, bytes);
}

void stage_origin(int32_t *x, int32_t *y, const operation_stage *stage)
{
    *x = stage->has_roi ? stage->roi.x : 0;
    *y = stage->has_roi ? stage->roi.y : 0;
}

iris_size stage_size(const operation_stage *stage)
{
    return stage->whole;
}

int stage_exit(const operation_stage *stage, iris_status status)
{
    if (status != IRIS_OK) {
        complain(stage->file, "%s", iris_status_text(status));
    }
    return status == IRIS_OK ? EXIT_DONE : EXIT_BAD_DATA;
}

/* The part of the input that the operation gets: a view, or of a mask a copy, whose words begin where the part does. */
static int take_part(iris_image *part, const iris_image *input, operation_stage *stage)
{
    iris_rect roi = stage->roi;
    if (roi.x > input->w - roi.w || roi.y > input->h - roi.h) {
        complain(stage->file, "--roi is not wholly inside the picture of %dx%d pixels", (int)input->w,
                 (int)input->h);
        return EXIT_BAD_CALL;
    }
    if (input->format != IRIS_MASK1) {
        iris_image_crop(part, input, roi);
        return EXIT_DONE;
    }
    if (!reserve(stage, &stage->roi_input, (iris_size){roi.w, roi.h}, IRIS_MASK1)) {
        return EXIT_BAD_DATA;
    }
    *part = stage->roi_input.image;
    iris_mask_copy(part, input, roi.x, roi.y);
    return EXIT_DONE;
}

int stage_apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    iris_image part, made;
    stage->pictures_used = 0;
    stage->finding = NULL;
    stage->whole = (iris_size){input->w, input->h};
    if (!stage->has_roi) {
        return stage->operation->apply(result, input, stage);
    }
    int exit_code = take_part(&part, input, stage);
    if (exit_code == EXIT_DONE) {
        exit_code = stage->operation->apply(&made, &part, stage);
    }
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    const iris_image *fitting = converted(stage, &made, input->format);
    if (!fitting || !reserve(stage, &stage->roi_output, (iris_size){input->w, input->h}, input->format)) {
        return EXIT_BAD_DATA;
    }
    *result = stage->roi_output.image;
    iris_copy(result, input);
    return stage_exit(stage, iris_paste(result, fitting, stage->roi.x, stage->roi.y));
}

void stage_free(operation_stage *stage)
{
    for (int i = 0; i < STAGE_PICTURES; i++) {
        picture_free(&stage->pictures[i]);
    }
    picture_free(&stage->roi_input);
    picture_free(&stage->roi_output);
    free(stage->scratch_memory);
    free(stage->room_memory);
}
