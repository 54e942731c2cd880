#include "commands.h"
#include "iris/xt/blur.h"
#include "operation.h"

static const char help[] =
    "usage: iris blur (--sigma S | --box N) [--border RULE] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Each pixel becomes a mean of its surroundings; gray, or each channel of color. A mask turns gray.\n\n"
    "  --sigma S         weighted by a Gaussian of S pixels, 0.1 to 40\n"
    "  --box N           all pixels of NxN alike, 1 to 255; takes the same time for every N. An even\n"
    "                    N reaches one pixel farther to the right and down\n" OPERATION_BORDER_OPTIONS "\n"
    "example: iris blur --sigma 1.4 noisy.pgm -o smooth.pgm\n";

typedef struct {
    iris_q16 sigma; /* 0: box */
    int32_t side;
} blurring;

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const blurring *by = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *blurred = levels ? stage_copy(stage, levels) : NULL;
    size_t channels = levels && levels->format == IRIS_GRAY8 ? 1 : 3;
    size_t bytes = by->sigma ? IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(input->w, channels, by->sigma)
                             : IRIS_BLUR_BOX_SCRATCH_BYTES(input->w, channels, by->side);
    iris_scratch *scratch = blurred ? stage_scratch(stage, bytes) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *blurred;
    return stage_exit(stage, by->sigma
                                 ? iris_blur_gaussian(blurred, blurred, by->sigma, stage->border, scratch)
                                 : iris_blur_box(blurred, blurred, by->side, stage->border, scratch));
}

static int parse(void *settings, operation_words *words)
{
    blurring *by = settings;
    const char *sigma = NULL, *box = NULL;
    const args_option options[] = {{"sigma", 0, NULL, &sigma}, {"box", 0, NULL, &box}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if ((sigma != NULL) + (box != NULL) != 1) {
        complain(NULL, "either --sigma or --box (see --help)");
        return 0;
    }
    if (sigma && !args_q16(&by->sigma, IRIS_BLUR_SIGMA_MIN, IRIS_BLUR_SIGMA_MAX, sigma)) {
        complain("--sigma", "0.1 to 40 pixels, not '%s'", sigma);
        return 0;
    }
    if (box && (!args_numbers(&by->side, 1, ',', box) || by->side < 1 || by->side > IRIS_BLUR_SIDE_MAX)) {
        complain("--box", "1 to %d pixels, not '%s'", IRIS_BLUR_SIDE_MAX, box);
        return 0;
    }
    return 1;
}

const operation operation_blur = {.name = "blur",
                                  .summary = "means of surroundings, Gaussian or of a box",
                                  .help = help,
                                  .parse = parse,
                                  .apply = apply};
