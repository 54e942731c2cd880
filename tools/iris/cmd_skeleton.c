#include <string.h>

#include "commands.h"
#include "iris/xt/skeleton.h"
#include "operation.h"

static const char help[] =
    "usage: iris skeleton [--method exact|zhang-suen] [--prune N] [--show WHAT] [--roi x,y,w,h]\n"
    "                     [--json] IN... [-o OUT]\n\n"
    "Thins the white shapes of a mask to lines. Gray and color pictures count as white above 127.\n\n"
    "  --method exact       lines one pixel wide, as many parts and holes as the shapes (the default)\n"
    "  --method zhang-suen  as published in 1984: stairs stay two pixels wide, small shapes may vanish\n"
    "  --prune N            takes away branches of fewer than N pixels, from an end to where lines meet\n"
    "  --show WHAT          skeleton (the default), ends, or branches (where three or more lines\n"
    "                       meet), as masks; or overlay: the shapes gray, the skeleton white, ends\n"
    "                       green, branch points red\n" OPERATION_OPTIONS "\n"
    "JSON has pixels, ends, and branches (the counts of each kind of pixel) and passes.\n\n"
    "example: iris skeleton --prune 10 --show overlay horse.bmp -o bones.bmp\n";

typedef enum { SKELETON, ENDS, BRANCHES, OVERLAY } shown;
static const char *const shown_names[] = {"skeleton", "ends", "branches", "overlay"};

typedef struct {
    iris_skeleton_method method;
    int32_t prune; /* 0: not */
    shown show;
} settings;

/* What apply leaves for report. */
typedef struct {
    int64_t pixels, ends, branches;
    int32_t passes;
} finding;

static int selected(const iris_image *mask, int32_t x, int32_t y)
{
    return ((const uint32_t *)iris_image_row(mask, y))[x / 32] >> x % 32 & 1;
}

static int64_t count(const iris_image *mask)
{
    int64_t sum = 0;
    for (int32_t y = 0; y < mask->h; y++) {
        for (int32_t x = 0; x < mask->w; x++) {
            sum += selected(mask, x, y);
        }
    }
    return sum;
}

/* The masks that an input makes. */
typedef struct {
    const iris_image *shape, *skeleton, *ends, *branches;
} masks;

static int thin(const masks *to, finding *found, operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_scratch *scratch = stage_scratch(stage, IRIS_SKELETON_SCRATCH_BYTES(to->shape->w, to->shape->h));
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    iris_status status = iris_skeleton(&found->passes, to->skeleton, to->shape, by->method, scratch);
    if (status == IRIS_OK && by->prune > 0) {
        status = iris_skeleton_prune(to->skeleton, to->skeleton, by->prune, scratch);
    }
    if (status == IRIS_OK) {
        status = iris_skeleton_ends(to->ends, to->skeleton, scratch);
    }
    if (status == IRIS_OK) {
        status = iris_skeleton_branches(to->branches, to->skeleton, scratch);
    }
    return stage_exit(stage, status);
}

static const uint8_t *color_at(const masks *of, int32_t x, int32_t y)
{
    static const uint8_t colors[][3] = {{0, 0, 0}, {96, 96, 96}, {255, 255, 255}, {0, 255, 0}, {255, 0, 0}};
    return colors[selected(of->branches, x, y)   ? 4
                  : selected(of->ends, x, y)     ? 3
                  : selected(of->skeleton, x, y) ? 2
                                                 : selected(of->shape, x, y)];
}

static const iris_image *overlay(const masks *of, operation_stage *stage)
{
    const iris_image *color = stage_picture(stage, (iris_size){of->shape->w, of->shape->h}, IRIS_RGB888);
    for (int32_t y = 0; color && y < color->h; y++) {
        uint8_t *row = iris_image_row(color, y);
        for (int32_t x = 0; x < color->w; x++) {
            memcpy(row + 3 * x, color_at(of, x, y), 3);
        }
    }
    return color;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_size size = {input->w, input->h};
    masks to = {stage_mask(stage, input), NULL, NULL, NULL};
    to.skeleton = to.shape ? stage_picture(stage, size, IRIS_MASK1) : NULL;
    to.ends = to.skeleton ? stage_picture(stage, size, IRIS_MASK1) : NULL;
    to.branches = to.ends ? stage_picture(stage, size, IRIS_MASK1) : NULL;
    finding *found = to.branches ? stage_room(stage, sizeof *found) : NULL;
    int exit_code = found ? thin(&to, found, stage) : EXIT_BAD_DATA;
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    found->pixels = count(to.skeleton);
    found->ends = count(to.ends);
    found->branches = count(to.branches);
    stage->finding = found;
    const iris_image *shows = by->show == SKELETON   ? to.skeleton
                              : by->show == ENDS     ? to.ends
                              : by->show == BRANCHES ? to.branches
                                                     : overlay(&to, stage);
    if (!shows) {
        return EXIT_BAD_DATA;
    }
    *result = *shows;
    return EXIT_DONE;
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    json_key(json, "pixels");
    json_integer(json, found->pixels);
    json_key(json, "ends");
    json_integer(json, found->ends);
    json_key(json, "branches");
    json_integer(json, found->branches);
    json_key(json, "passes");
    json_integer(json, found->passes);
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    const char *method = "exact", *prune = "0", *show = "skeleton";
    const args_option options[] = {
        {"method", 0, NULL, &method}, {"prune", 0, NULL, &prune}, {"show", 0, NULL, &show}};
    if (!operation_options(words, options, 3)) {
        return 0;
    }
    if (strcmp(method, "exact") != 0 && strcmp(method, "zhang-suen") != 0) {
        complain("--method", "exact or zhang-suen, not '%s'", method);
        return 0;
    }
    by->method = strcmp(method, "exact") == 0 ? IRIS_SKELETON_EXACT : IRIS_SKELETON_ZHANG_SUEN;
    if (!args_numbers(&by->prune, 1, ',', prune) || by->prune < 0) {
        complain("--prune", "a number of pixels, not '%s'", prune);
        return 0;
    }
    if (by->prune > 0 && by->method != IRIS_SKELETON_EXACT) {
        complain("--prune", "only with --method exact: branches are lines one pixel wide");
        return 0;
    }
    for (int i = 0; i < 4; i++) {
        if (strcmp(show, shown_names[i]) == 0) {
            by->show = (shown)i;
            return 1;
        }
    }
    complain("--show", "skeleton, ends, branches, or overlay, not '%s'", show);
    return 0;
}

const operation operation_skeleton = {.name = "skeleton",
                                      .summary = "thins the shapes of a mask to lines",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply,
                                      .report = report,
                                      .reports_alone = 1};
