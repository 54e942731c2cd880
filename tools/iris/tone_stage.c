#include "tone_stage.h"

int tone_stage_apply(iris_image *result, const iris_image *input, operation_stage *stage,
                     const iris_tone *tone)
{
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *toned =
        levels ? stage_picture(stage, (iris_size){input->w, input->h}, levels->format) : NULL;
    if (!toned) {
        return EXIT_BAD_DATA;
    }
    int exit_code = stage_exit(stage, iris_tone_apply(toned, levels, tone));
    int black = tone->level[0], white = tone->level[255];
    if (input->format == IRIS_MASK1 && black % 255 == 0 && white % 255 == 0) {
        toned = stage_mask(stage, toned);
    }
    if (!toned) {
        return EXIT_BAD_DATA;
    }
    *result = *toned;
    return exit_code;
}
