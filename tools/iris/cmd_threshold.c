#include "commands.h"
#include "iris/xt/threshold.h"
#include "operation.h"

static const char help[] =
    "usage: iris threshold (--value N | --otsu | --adaptive R,C) [--invert]\n"
    "                      [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Gray pictures to masks: white is what is brighter than the threshold. Color counts by its luma.\n\n"
    "  --value N         above N, 0 to 255\n"
    "  --otsu            above the value that separates dark and bright best\n"
    "  --adaptive R,C    above the mean of the (2R+1)x(2R+1) pixels around, less C;\n"
    "                    R 0 to 1023, C -255 to 255\n"
    "  --invert          white is the rest: with C above 0, what is darker than its\n"
    "                    surroundings, such as a line narrower than R\n" OPERATION_OPTIONS "\n"
    "A mask is a BMP of 1 bit, or a PGM of 0 and 255. JSON has the threshold used too\n"
    "(null with --adaptive).\n\n"
    "example: iris threshold --adaptive 60,15 --invert floor.bmp -o line.bmp\n";

typedef struct {
    int32_t value;     /* -1: not given */
    int32_t radius, c; /* radius -1: not given */
    iris_select select;
} thresholding;

/* What apply leaves for report. */
typedef struct {
    int has_value;
    uint8_t value;
} finding;

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const thresholding *by = stage->settings;
    const iris_image *gray = stage_gray(stage, input);
    const iris_image *mask = gray ? stage_picture(stage, (iris_size){input->w, input->h}, IRIS_MASK1) : NULL;
    finding *found = mask ? stage_room(stage, sizeof *found) : NULL;
    size_t bytes = by->radius >= 0 ? IRIS_THRESHOLD_SCRATCH_BYTES(input->w, by->radius)
                                   : IRIS_THRESHOLD_OTSU_SCRATCH_BYTES;
    iris_scratch *scratch = found ? stage_scratch(stage, bytes) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *mask;
    stage->finding = found;
    if (by->radius >= 0) {
        return stage_exit(stage, iris_threshold_adaptive(mask, gray, by->radius, by->c, by->select, scratch));
    }
    found->has_value = 1;
    if (by->value >= 0) {
        found->value = (uint8_t)by->value;
        return stage_exit(stage, iris_threshold(mask, gray, found->value, by->select));
    }
    return stage_exit(stage, iris_threshold_otsu(&found->value, mask, gray, by->select, scratch));
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    json_key(json, "threshold");
    found->has_value ? json_integer(json, found->value) : json_null(json);
}

/* Reads --value and --adaptive. Returns 0 after complaining. */
static int read_numbers(thresholding *by, const char *value, const char *adaptive)
{
    int32_t n[2];
    if (value && (!args_numbers(&by->value, 1, ',', value) || by->value < 0 || by->value > 255)) {
        complain("--value", "0 to 255, not '%s'", value);
        return 0;
    }
    if (!adaptive) {
        return 1;
    }
    if (!args_numbers(n, 2, ',', adaptive) || n[0] < 0 || n[0] > IRIS_THRESHOLD_RADIUS_MAX || n[1] < -255 ||
        n[1] > 255) {
        complain("--adaptive", "R,C with R 0 to %d and C -255 to 255, not '%s'", IRIS_THRESHOLD_RADIUS_MAX,
                 adaptive);
        return 0;
    }
    by->radius = n[0];
    by->c = n[1];
    return 1;
}

static int parse(void *settings, operation_words *words)
{
    thresholding *by = settings;
    int otsu = 0, invert = 0;
    const char *value = NULL, *adaptive = NULL;
    const args_option options[] = {{"value", 0, NULL, &value},
                                   {"otsu", 0, &otsu, NULL},
                                   {"adaptive", 0, NULL, &adaptive},
                                   {"invert", 0, &invert, NULL}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if ((value != NULL) + otsu + (adaptive != NULL) != 1) {
        complain(NULL, "one of --value, --otsu, and --adaptive (see --help)");
        return 0;
    }
    *by = (thresholding){-1, -1, 0, invert ? IRIS_SELECT_DARK : IRIS_SELECT_BRIGHT};
    return read_numbers(by, value, adaptive);
}

const operation operation_threshold = {.name = "threshold",
                                       .summary = "gray pictures to masks",
                                       .help = help,
                                       .parse = parse,
                                       .apply = apply,
                                       .report = report};
