#include <string.h>

#include "commands.h"
#include "iris/copy.h"
#include "iris/xt/automaton.h"
#include "iris/xt/blur.h"
#include "iris/xt/canny.h"
#include "iris/xt/edge.h"
#include "operation.h"

static const char help[] =
    "usage: iris edge [--operator NAME] [--sigma S] [--low L] [--high H] [--gain G]\n"
    "                 [--direction] [--generations N] [--border RULE] [--roi x,y,w,h]\n"
    "                 [--json] IN... -o OUT\n\n"
    "Edges. Color counts by its luma.\n\n"
    "  --operator NAME   sobel (the default), prewitt, isotropic, roberts: gray pictures of\n"
    "                    how much the level changes, |dx| + |dy| times the gain\n"
    "                    laplacian, log (Laplacian of Gaussian): masks of zero crossings\n"
    "                    canny: masks of thin lines\n"
    "                    automaton: masks by a cellular automaton, at the least cost\n"
    "  --sigma S         smooths first, by a Gaussian of S pixels, 0.1 to 40; 0 does not.\n"
    "                    Default 1.4 for canny and log, also behind a blur in a pipe, else 0\n"
    "  --low L           0 to 32767. sobel to roberts: a mask of what is above L. laplacian\n"
    "                    and log: the least difference across a crossing, in 32nds of a\n"
    "                    level for log; default 80, 160. canny: of edges that continue\n"
    "                    others; default 40. automaton: levels, up to 255; default 30\n"
    "  --high H          canny: of edges that begin; at least L; default 100, or L if more\n"
    "  --gain G          0 to 15.99, default 0.25. laplacian, log: a gray picture\n"
    "  --direction       sobel to roberts: a gray picture of the direction in which it gets\n"
    "                    brighter, 256 levels to a turn: 0 right, 64 down, 128 left\n"
    "  --generations N   automaton: 0 to 16, default 1\n" OPERATION_BORDER_OPTIONS "\n"
    "Thresholds count |dx| + |dy| of the 3x3 Sobel operator, as OpenCV does.\n\n"
    "example: iris edge --operator canny --sigma 1.4 --low 40 --high 100 room.bmp -o edges.bmp\n";

typedef enum { AS_DERIVATIVE, AS_CANNY, AS_AUTOMATON } method;
typedef enum { TO_GRAY, TO_DIRECTION, TO_MASK } outcome;

static const struct {
    const char *name;
    method as;
    iris_edge_operator op; /* of AS_DERIVATIVE */
    int32_t low;           /* default; -1: gray */
} operators[] = {
    {"sobel", AS_DERIVATIVE, IRIS_EDGE_SOBEL, -1},
    {"prewitt", AS_DERIVATIVE, IRIS_EDGE_PREWITT, -1},
    {"isotropic", AS_DERIVATIVE, IRIS_EDGE_ISOTROPIC, -1},
    {"roberts", AS_DERIVATIVE, IRIS_EDGE_ROBERTS, -1},
    {"laplacian", AS_DERIVATIVE, IRIS_EDGE_LAPLACIAN, 80},
    {"log", AS_DERIVATIVE, IRIS_EDGE_LOG, 160},
    {"canny", AS_CANNY, IRIS_EDGE_SOBEL, 40},
    {"automaton", AS_AUTOMATON, IRIS_EDGE_SOBEL, 30},
};

typedef struct {
    method as;
    outcome to;
    iris_edge_config edge;
    iris_canny_config canny;
    iris_automaton_config automaton;
    iris_q16 sigma_q16; /* of smoothing before; 0: none */
} edging;

static size_t scratch_bytes(const edging *by, iris_size size)
{
    switch (by->as) {
    case AS_CANNY:
        return IRIS_CANNY_SCRATCH_BYTES(size.w, size.h, by->canny.sigma_q16);
    case AS_AUTOMATON:
        return IRIS_AUTOMATON_SCRATCH_BYTES(size.w);
    default:
        return by->edge.op == IRIS_EDGE_LOG ? IRIS_EDGE_LOG_SCRATCH_BYTES(size.w, by->edge.sigma_q16)
                                            : IRIS_EDGE_SCRATCH_BYTES(size.w);
    }
}

/* The input in gray, smoothed: a picture of the stage's own when it may be changed. */
static const iris_image *smooth(operation_stage *stage, const iris_image *input)
{
    const edging *by = stage->settings;
    const iris_image *gray = stage_gray(stage, input);
    if (gray && (by->sigma_q16 > 0 || by->to == TO_GRAY)) {
        gray = stage_copy(stage, gray);
    }
    if (!gray || by->sigma_q16 == 0) {
        return gray;
    }
    iris_scratch *scratch = stage_scratch(stage, IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(gray->w, 1, by->sigma_q16));
    if (!scratch) {
        return NULL;
    }
    iris_status status = iris_blur_gaussian(gray, gray, by->sigma_q16, stage->border, scratch);
    return stage_exit(stage, status) == EXIT_DONE ? gray : NULL;
}

/* Angles as levels: 256 to a turn, the nearest. */
static void show_angles(const iris_image *levels, const iris_image *angles)
{
    for (int32_t y = 0; y < levels->h; y++) {
        uint8_t *to = iris_image_row(levels, y);
        const uint16_t *from = iris_image_row(angles, y);
        for (int32_t x = 0; x < levels->w; x++) {
            to[x] = (uint8_t)((from[x] + 128) >> 8);
        }
    }
}

static int apply_direction(iris_image *result, const iris_image *gray, operation_stage *stage)
{
    const edging *by = stage->settings;
    const iris_size size = {gray->w, gray->h};
    const iris_image *angles = stage_picture(stage, size, IRIS_GRAY_U16);
    const iris_image *levels = angles ? stage_picture(stage, size, IRIS_GRAY8) : NULL;
    iris_scratch *scratch = levels ? stage_scratch(stage, scratch_bytes(by, size)) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    (void)iris_fill(angles, 0);
    iris_status status = iris_edge_direction(angles, gray, &by->edge, stage->border, scratch);
    show_angles(levels, angles);
    *result = *levels;
    return stage_exit(stage, status);
}

static int apply_mask(iris_image *result, const iris_image *gray, operation_stage *stage)
{
    const edging *by = stage->settings;
    const iris_size size = {gray->w, gray->h};
    const iris_image *mask = stage_picture(stage, size, IRIS_MASK1);
    iris_scratch *scratch = mask ? stage_scratch(stage, scratch_bytes(by, size)) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    (void)iris_fill(mask, 0);
    *result = *mask;
    iris_status status = by->as == AS_CANNY ? iris_canny(mask, gray, &by->canny, stage->border, scratch)
                         : by->as == AS_AUTOMATON
                             ? iris_automaton(mask, gray, &by->automaton, stage->border, scratch)
                             : iris_edge_mask(mask, gray, &by->edge, stage->border, scratch);
    return stage_exit(stage, status);
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const edging *by = stage->settings;
    const iris_image *gray = smooth(stage, input);
    if (!gray) {
        return EXIT_BAD_DATA;
    }
    if (by->to != TO_GRAY) {
        return by->to == TO_MASK ? apply_mask(result, gray, stage) : apply_direction(result, gray, stage);
    }
    iris_scratch *scratch = stage_scratch(stage, scratch_bytes(by, (iris_size){gray->w, gray->h}));
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *gray;
    return stage_exit(stage, iris_edge_magnitude(gray, gray, &by->edge, stage->border, scratch));
}

/* The texts of the options; null: not given. */
typedef struct {
    const char *name, *sigma, *low, *high, *gain, *generations;
    int direction;
} texts;

/* A whole number from 0 to most into *number, when given. */
static int read_number(int32_t *number, const char *option, const char *text, int32_t most)
{
    if (text && (!args_numbers(number, 1, ',', text) || *number < 0 || *number > most)) {
        complain(option, "a whole number from 0 to %d, not '%s'", most, text);
        return 0;
    }
    return 1;
}

/* sigma into *sigma_q16, when given. */
static int read_sigma(iris_q16 *sigma_q16, const char *text)
{
    if (text && (!args_q16(sigma_q16, 0, IRIS_BLUR_SIGMA_MAX, text) ||
                 (*sigma_q16 != 0 && *sigma_q16 < IRIS_BLUR_SIGMA_MIN))) {
        complain("--sigma", "0, or 0.1 to 40 pixels, not '%s'", text);
        return 0;
    }
    return 1;
}

static int complain_unless(int fits, const char *option, const char *of)
{
    if (!fits) {
        complain(option, "only with %s", of);
    }
    return fits;
}

/* Do the options belong to the operator, and to each other? */
static int options_fit(const texts *given, method as, int is_second)
{
    static const char first[] =
        "--operator sobel, prewitt, isotropic, or roberts, and without --low and --gain";
    int is_first = as == AS_DERIVATIVE && !is_second;
    return complain_unless(!given->high || as == AS_CANNY, "--high", "--operator canny") &&
           complain_unless(!given->generations || as == AS_AUTOMATON, "--generations",
                           "--operator automaton") &&
           complain_unless(!given->gain || (as == AS_DERIVATIVE && !given->low), "--gain",
                           "--operator sobel to log, and without --low") &&
           complain_unless(!given->direction || (is_first && !given->low && !given->gain), "--direction",
                           first);
}

/* The numbers of the options into the settings of the operator. Returns 0 after complaining. */
static int read_numbers(edging *by, const texts *given, int32_t low)
{
    int32_t high = by->canny.high, sigma = by->sigma_q16;
    int low_most = by->as == AS_AUTOMATON ? 255 : IRIS_EDGE_THRESHOLD_END - 1;
    if (given->gain && !args_q16(&by->edge.gain_q16, 0, IRIS_EDGE_GAIN_END - 1, given->gain)) {
        complain("--gain", "0 up to below 16, not '%s'", given->gain);
        return 0;
    }
    if (!read_number(&low, "--low", given->low, low_most) ||
        !read_number(&high, "--high", given->high, IRIS_CANNY_THRESHOLD_END - 1) ||
        !read_number(&by->automaton.generations, "--generations", given->generations,
                     IRIS_AUTOMATON_GENERATIONS_MAX) ||
        !read_sigma(&sigma, given->sigma)) {
        return 0;
    }
    if (given->high && high < low) {
        complain("--high", "at least --low, which is %d, not '%s'", low, given->high);
        return 0;
    }
    by->edge.threshold = low < 0 ? 0 : low;
    by->canny.low = low;
    by->canny.high = high < low ? low : high;
    by->automaton.threshold = (uint8_t)low;
    by->sigma_q16 = sigma;
    return 1;
}

/* Canny and log smooth by themselves; of log without smoothing there is laplacian. */
static int place_sigma(edging *by, int given)
{
    if (by->as == AS_CANNY) {
        by->canny.sigma_q16 = given ? by->sigma_q16 : by->canny.sigma_q16;
        by->sigma_q16 = 0;
    } else if (by->edge.op == IRIS_EDGE_LOG) {
        by->edge.sigma_q16 = given ? by->sigma_q16 : by->edge.sigma_q16;
        by->sigma_q16 = 0;
        if (by->edge.sigma_q16 == 0) {
            complain("--sigma", "0.1 to 40 pixels with --operator log (0 is --operator laplacian)");
            return 0;
        }
    }
    return 1;
}

static int parse(void *settings, operation_words *words)
{
    edging *by = settings;
    texts given = {.name = "sobel"};
    const args_option options[] = {{"operator", 0, NULL, &given.name},
                                   {"sigma", 0, NULL, &given.sigma},
                                   {"low", 0, NULL, &given.low},
                                   {"high", 0, NULL, &given.high},
                                   {"gain", 0, NULL, &given.gain},
                                   {"generations", 0, NULL, &given.generations},
                                   {"direction", 0, &given.direction, NULL}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    size_t i = 0, count = sizeof operators / sizeof operators[0];
    while (i < count && strcmp(given.name, operators[i].name) != 0) {
        i++;
    }
    if (i == count) {
        complain("--operator",
                 "sobel, prewitt, isotropic, roberts, laplacian, log, canny, or automaton, not '%s'",
                 given.name);
        return 0;
    }
    iris_edge_defaults(&by->edge);
    iris_canny_defaults(&by->canny);
    iris_automaton_defaults(&by->automaton);
    by->as = operators[i].as;
    by->edge.op = operators[i].op;
    int is_second = by->edge.op == IRIS_EDGE_LAPLACIAN || by->edge.op == IRIS_EDGE_LOG;
    if (!options_fit(&given, by->as, is_second)) {
        return 0;
    }
    int is_mask = by->as != AS_DERIVATIVE || given.low || (is_second && !given.gain);
    by->to = is_mask ? TO_MASK : given.direction ? TO_DIRECTION : TO_GRAY;
    return read_numbers(by, &given, operators[i].low) && place_sigma(by, given.sigma != NULL);
}

const operation operation_edge = {.name = "edge",
                                  .summary = "edges, by Sobel to Canny, as gray pictures or masks",
                                  .help = help,
                                  .parse = parse,
                                  .apply = apply};
