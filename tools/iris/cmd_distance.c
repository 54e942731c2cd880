#include <string.h>

#include "commands.h"
#include "iris/xt/distance.h"
#include "operation.h"

static const char help[] =
    "usage: iris distance [--metric l1|chamfer] [--roi x,y,w,h] [--json] IN... [-o OUT]\n\n"
    "How far from the nearest black pixel each white pixel of a mask is. The farthest becomes\n"
    "white, and half as far half as bright. Gray and color pictures count as white above 127.\n\n"
    "  --metric l1       steps to the side and up and down (the default)\n"
    "  --metric chamfer  diagonal steps, too: within 6 % of the true distance\n" OPERATION_OPTIONS "\n"
    "JSON has maximum, the greatest distance, in pixels (null when the mask is all white: all is white "
    "then).\n\n"
    "example: iris distance --metric chamfer floor.bmp -o room.bmp\n";

/* What apply leaves for report. */
typedef struct {
    int32_t greatest, unit; /* so many units are a pixel */
} finding;

static int32_t greatest_of(const iris_image *distance)
{
    int32_t greatest = 0;
    for (int32_t y = 0; y < distance->h; y++) {
        const uint16_t *row = iris_image_row(distance, y);
        for (int32_t x = 0; x < distance->w; x++) {
            greatest = row[x] > greatest ? row[x] : greatest;
        }
    }
    return greatest;
}

/* 0 to `greatest` becomes 0 to 255, rounded. */
static void show(const iris_image *gray, const iris_image *distance, int32_t greatest)
{
    int32_t scale = greatest > 0 ? greatest : 1;
    for (int32_t y = 0; y < gray->h; y++) {
        const uint16_t *from = iris_image_row(distance, y);
        uint8_t *to = iris_image_row(gray, y);
        for (int32_t x = 0; x < gray->w; x++) {
            to[x] = (uint8_t)((from[x] * 255 + scale / 2) / scale);
        }
    }
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const iris_distance_metric *metric = stage->settings;
    iris_size size = {input->w, input->h};
    const iris_image *mask = stage_mask(stage, input);
    const iris_image *distance = mask ? stage_picture(stage, size, IRIS_GRAY_U16) : NULL;
    const iris_image *gray = distance ? stage_picture(stage, size, IRIS_GRAY8) : NULL;
    finding *found = gray ? stage_room(stage, sizeof *found) : NULL;
    if (!found) {
        return EXIT_BAD_DATA;
    }
    int exit_code = stage_exit(stage, iris_distance_transform(distance, mask, *metric));
    if (exit_code == EXIT_DONE) {
        *found = (finding){greatest_of(distance), *metric == IRIS_DISTANCE_CHAMFER ? 3 : 1};
        show(gray, distance, found->greatest);
        stage->finding = found;
        *result = *gray;
    }
    return exit_code;
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    json_key(json, "maximum");
    if (found->greatest == IRIS_DISTANCE_MAX) {
        json_null(json);
    } else {
        json_number(json, (double)found->greatest / found->unit, 2);
    }
}

static int parse(void *settings, operation_words *words)
{
    iris_distance_metric *metric = settings;
    const char *name = "l1";
    const args_option options[] = {{"metric", 0, NULL, &name}};
    if (!operation_options(words, options, 1)) {
        return 0;
    }
    if (strcmp(name, "l1") != 0 && strcmp(name, "chamfer") != 0) {
        complain("--metric", "l1 or chamfer, not '%s'", name);
        return 0;
    }
    *metric = strcmp(name, "l1") == 0 ? IRIS_DISTANCE_L1 : IRIS_DISTANCE_CHAMFER;
    return 1;
}

const operation operation_distance = {.name = "distance",
                                      .summary = "how far from the nearest black pixel each white one is",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply,
                                      .report = report,
                                      .reports_alone = 1};
