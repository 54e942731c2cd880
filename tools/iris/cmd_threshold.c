#include "args.h"
#include "commands.h"
#include "complain.h"
#include "iris/xt/threshold.h"
#include "picture_job.h"

static const char help[] =
    "usage: iris threshold (--value N | --otsu | --adaptive R,C) [--invert] [--json] IN... -o OUT\n\n"
    "Gray pictures to masks: white is what is brighter than the threshold. Color counts by its luma.\n\n"
    "  --value N         above N, 0 to 255\n"
    "  --otsu            above the value that separates dark and bright best\n"
    "  --adaptive R,C    above the mean of the (2R+1)x(2R+1) pixels around, less C;\n"
    "                    R 0 to 1023, C -255 to 255\n"
    "  --invert          white is the rest: with C above 0, what is darker than its\n"
    "                    surroundings, such as a line narrower than R\n"
    "  --json            one JSON object per picture: file, output, width, height, kind,\n"
    "                    threshold (the value used; null with --adaptive)\n"
    "  -o OUT            .bmp (1 bit) or .pgm (0 and 255); a folder for several inputs;\n"
    "                    -: standard output (IN - and OUT -: every picture in turn)\n\n"
    "example: iris threshold --adaptive 60,15 --invert floor.bmp -o line.bmp\n";

typedef struct {
    int32_t value;     /* -1: not given */
    int32_t radius, c; /* radius -1: not given */
    iris_select select;
} thresholding;

/* Where the library works: enough for the widest picture and window, and for Otsu's histogram. */
static IRIS_SCRATCH_BUFFER(memory, IRIS_THRESHOLD_SCRATCH_BYTES(IRIS_SIDE_MAX, IRIS_THRESHOLD_RADIUS_MAX));

static int work(iris_image *result, const iris_image *input, picture_job *job)
{
    const thresholding *by = job->options;
    const iris_image *gray = picture_job_gray(job, input);
    iris_scratch scratch;
    uint8_t otsu;
    iris_status status;
    if (!gray || !picture_job_reserve(job, &job->second, (iris_size){input->w, input->h}, IRIS_MASK1)) {
        return EXIT_BAD_DATA;
    }
    *result = job->second.image;
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (by->radius >= 0) {
        status = iris_threshold_adaptive(result, gray, by->radius, by->c, by->select, &scratch);
    } else if (by->value >= 0) {
        job->threshold = (int)by->value;
        status = iris_threshold(result, gray, (uint8_t)by->value, by->select);
    } else {
        status = iris_threshold_otsu(&otsu, result, gray, by->select, &scratch);
        job->threshold = otsu;
    }
    if (status != IRIS_OK) {
        complain(job->file, "%s", iris_status_text(status));
    }
    return status == IRIS_OK ? EXIT_DONE : EXIT_BAD_DATA;
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

int cmd_threshold(int argc, char **argv)
{
    int otsu = 0, invert = 0;
    const char *value = NULL, *adaptive = NULL;
    thresholding by = {-1, -1, 0, IRIS_SELECT_BRIGHT};
    picture_job job = {.command = argv[0], .work = work, .options = &by, .has_threshold = 1};
    const args_option options[] = {{"value", 0, NULL, &value},         {"otsu", 0, &otsu, NULL},
                                   {"adaptive", 0, NULL, &adaptive},   {"invert", 0, &invert, NULL},
                                   {"output", 'o', NULL, &job.output}, {"json", 0, &job.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if ((value != NULL) + otsu + (adaptive != NULL) != 1) {
        complain(NULL, "one of --value, --otsu, and --adaptive (see --help)");
        return EXIT_BAD_CALL;
    }
    if (!read_numbers(&by, value, adaptive)) {
        return EXIT_BAD_CALL;
    }
    by.select = invert ? IRIS_SELECT_DARK : IRIS_SELECT_BRIGHT;
    return picture_job_run(&job, &args);
}
