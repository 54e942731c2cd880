#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "iris/copy.h"
#include "iris/draw.h"
#include "iris/xt/blob.h"
#include "iris/xt/moments.h"
#include "iris/xt/shape.h"
#include "operation.h"

static const char help[] =
    "usage: iris signature [--samples N] [--crossing first|last] [--point x,y] [--json] IN... [-o OUT]\n\n"
    "How far the edge of a silhouette is, all around: a table by angle, the farthest being 1, and with\n"
    "-o a plot of it. The silhouette is the white part that encloses most, holes and all; gray and\n"
    "color pictures count as white above 127.\n\n"
    "  --samples N       rays, 4 to 720 (default 128): one every 360 / N degrees, clockwise from the right\n"
    "  --crossing first  where a ray leaves white first (the default)\n"
    "  --crossing last   where it leaves white for good\n"
    "  --point x,y       rays start here (default: at the center of gravity)\n"
    "  --json            one JSON object per picture\n"
    "  -o OUT            the plot: .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n\n"
    "JSON has x, y (where the rays start), longest (pixels), step_deg, missing (rays that meet nothing),\n"
    "samples (0 to 1, null where a ray meets nothing), cx, cy (the center of gravity), area (white pixels),\n"
    "and hu (Hu's seven moments).\n\n"
    "example: iris signature --samples 72 key.bmp -o key-plot.bmp\n";

typedef struct {
    iris_shape_sampling sampling;
    int32_t x, y; /* of --point */
} settings;

typedef struct {
    iris_shape_rays rays;
    iris_mask_moments sums;
    iris_invariants invariants;
    int32_t samples;
    uint16_t distances[IRIS_SHAPE_SAMPLES_MAX];
} finding;

/* Pixels of the plot. */
enum { LEFT = 62, RIGHT = 28, TOP = 44, BOTTOM = 34, PLOT_W = 720, PLOT_H = 256, TICK = 6, SCALE = 2 };

static const iris_color ink = {40, 40, 40}, pale = {222, 222, 222}, curve = {0, 50, 220};

static int32_t plot_y(uint16_t distance)
{
    return TOP + PLOT_H - distance * PLOT_H / IRIS_SHAPE_ONE;
}

static void put_text(const iris_image *plot, int32_t x, int32_t y, const char *text, int centered)
{
    iris_size size = iris_draw_text_size(text, SCALE);
    iris_draw_text(plot, x - (centered ? size.w / 2 : size.w), y, text, SCALE, ink);
}

static void draw_axes(const iris_image *plot)
{
    static const char *const shares[] = {"0", ".25", ".5", ".75", "1"};
    char text[16];
    for (int i = 0; i <= 4; i++) {
        int32_t y = TOP + PLOT_H - i * PLOT_H / 4;
        iris_draw_line(plot, LEFT - TICK, y, LEFT + PLOT_W, y, pale);
        put_text(plot, LEFT - TICK - 4, y - 7, shares[i], 0);
    }
    for (int degrees = 0; degrees <= 360; degrees += 45) {
        int32_t x = LEFT + degrees * PLOT_W / 360;
        iris_draw_line(plot, x, TOP, x, TOP + PLOT_H + TICK, pale);
        snprintf(text, sizeof text, "%d", degrees);
        put_text(plot, x, TOP + PLOT_H + TICK + 6, text, 1);
    }
    iris_draw_line(plot, LEFT, TOP, LEFT, TOP + PLOT_H, ink);
    iris_draw_line(plot, LEFT, TOP + PLOT_H, LEFT + PLOT_W, TOP + PLOT_H, ink);
}

/* From sample to sample, three pixels strong; the first comes again behind the last. Missing ones leave gaps. */
static void draw_plot(const iris_image *plot, const finding *found)
{
    char text[120];
    iris_fill(plot, 0xFFFFFF);
    draw_axes(plot);
    for (int32_t k = 0; k < found->samples; k++) {
        uint16_t here = found->distances[k], next = found->distances[(k + 1) % found->samples];
        int32_t x0 = LEFT + k * PLOT_W / found->samples, x1 = LEFT + (k + 1) * PLOT_W / found->samples;
        if (here == IRIS_SHAPE_MISSING) {
            continue;
        }
        next = next == IRIS_SHAPE_MISSING ? here : next;
        for (int32_t off = -1; off <= 1; off++) {
            iris_draw_line(plot, x0, plot_y(here) + off, x1, plot_y(next) + off, curve);
            iris_draw_line(plot, x0 + off, plot_y(here), x1 + off, plot_y(next), curve);
        }
    }
    snprintf(text, sizeof text, "from %.1f,%.1f  1 = %.1f pixels  missing %d of %d",
             found->rays.x_q16 / 65536.0, found->rays.y_q16 / 65536.0, found->rays.longest_q16 / 65536.0,
             (int)found->rays.missing, (int)found->samples);
    iris_draw_text(plot, LEFT, 12, text, SCALE, ink);
}

/* The white part that encloses most, alone. Null after complaining. */
static const iris_image *silhouette(const iris_image *mask, operation_stage *stage)
{
    iris_contour outline;
    int32_t count = 0;
    iris_scratch *scratch = stage_scratch(stage, IRIS_CONTOUR_SCRATCH_BYTES(mask->w, mask->h) +
                                                     IRIS_BLOB_MASK_SCRATCH_BYTES(mask->w, mask->h));
    const iris_image *alone =
        scratch ? stage_picture(stage, (iris_size){mask->w, mask->h}, IRIS_MASK1) : NULL;
    if (!alone) {
        return NULL;
    }
    iris_status status = iris_contour_find(&outline, 1, &count, mask, scratch);
    if (status != IRIS_ERR_FULL && stage_exit(stage, status) != EXIT_DONE) {
        return NULL;
    }
    if (count == 0) {
        complain(stage->file, "nothing is white: there is no silhouette");
        return NULL;
    }
    const iris_blob first = {.first_x = outline.x, .box = {.y = outline.y}};
    status = iris_blob_mask(alone, mask, &first, 8, scratch);
    return stage_exit(stage, status) == EXIT_DONE ? alone : NULL;
}

static int measure(finding *found, const iris_image *alone, const operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_shape_sampling sampling = by->sampling;
    sampling.x_q16 = by->x * 65536;
    sampling.y_q16 = by->y * 65536;
    if (sampling.has_point && (by->x >= alone->w || by->y >= alone->h)) {
        complain(stage->file, "--point is outside of the picture of %dx%d pixels", (int)alone->w,
                 (int)alone->h);
        return EXIT_BAD_CALL;
    }
    found->samples = sampling.samples;
    int exit_code = stage_exit(stage, iris_mask_moments_sum(&found->sums, alone));
    if (exit_code == EXIT_DONE) {
        exit_code = stage_exit(stage, iris_moments_invariants(&found->invariants, &found->sums));
    }
    if (exit_code == EXIT_DONE) {
        exit_code = stage_exit(stage, iris_shape_sample(found->distances, &found->rays, alone, &sampling));
    }
    return exit_code;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const iris_size size = {LEFT + PLOT_W + RIGHT, TOP + PLOT_H + BOTTOM};
    const iris_image *mask = stage_mask(stage, input);
    const iris_image *alone = mask ? silhouette(mask, stage) : NULL;
    const iris_image *plot = alone ? stage_picture(stage, size, IRIS_RGB888) : NULL;
    finding *found = plot ? stage_room(stage, sizeof *found) : NULL;
    if (!found) {
        return EXIT_BAD_DATA;
    }
    int exit_code = measure(found, alone, stage);
    if (exit_code == EXIT_DONE) {
        draw_plot(plot, found);
        stage->finding = found;
        *result = *plot;
    }
    return exit_code;
}

static void number(json_writer *json, const char *key, double value, int decimals)
{
    json_key(json, key);
    json_number(json, value, decimals);
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    number(json, "x", found->rays.x_q16 / 65536.0, 3);
    number(json, "y", found->rays.y_q16 / 65536.0, 3);
    number(json, "longest", found->rays.longest_q16 / 65536.0, 3);
    number(json, "step_deg", 360.0 / found->samples, 6);
    number(json, "missing", found->rays.missing, 0);
    json_key(json, "samples");
    json_open(json, '[');
    for (int32_t k = 0; k < found->samples; k++) {
        if (found->distances[k] == IRIS_SHAPE_MISSING) {
            json_null(json);
        } else {
            json_number(json, found->distances[k] / (double)IRIS_SHAPE_ONE, 5);
        }
    }
    json_close(json, ']');
    number(json, "cx", found->invariants.x_q16 / 65536.0, 3);
    number(json, "cy", found->invariants.y_q16 / 65536.0, 3);
    number(json, "area", (double)found->sums.m00, 0);
    json_key(json, "hu");
    json_open(json, '[');
    for (int i = 0; i < 7; i++) {
        json_number(json, found->invariants.hu_q40[i] / 1099511627776.0, 12);
    }
    json_close(json, ']');
}

static void print(FILE *out, const operation_stage *stage)
{
    const finding *found = stage->finding;
    fprintf(out, "%s: from %.1f,%.1f, longest %.1f pixels, %d of %d rays missing, area %ld\n", stage->file,
            found->rays.x_q16 / 65536.0, found->rays.y_q16 / 65536.0, found->rays.longest_q16 / 65536.0,
            (int)found->rays.missing, (int)found->samples, (long)found->sums.m00);
    fprintf(out, "  hu");
    for (int i = 0; i < 7; i++) {
        fprintf(out, " %.4g", found->invariants.hu_q40[i] / 1099511627776.0);
    }
    fprintf(out, "\n  degrees   pixels  of longest\n");
    for (int32_t k = 0; k < found->samples; k++) {
        double share = found->distances[k] / (double)IRIS_SHAPE_ONE;
        if (found->distances[k] == IRIS_SHAPE_MISSING) {
            fprintf(out, "  %7.2f        -           -\n", 360.0 * k / found->samples);
        } else {
            fprintf(out, "  %7.2f %8.2f       %.3f\n", 360.0 * k / found->samples,
                    share * found->rays.longest_q16 / 65536.0, share);
        }
    }
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    const char *samples = NULL, *crossing = "first", *point = NULL;
    int32_t place[2] = {0, 0};
    const args_option options[] = {
        {"samples", 0, NULL, &samples}, {"crossing", 0, NULL, &crossing}, {"point", 0, NULL, &point}};
    iris_shape_sampling_defaults(&by->sampling);
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if (samples && (!args_numbers(&by->sampling.samples, 1, ',', samples) || by->sampling.samples < 4 ||
                    by->sampling.samples > IRIS_SHAPE_SAMPLES_MAX)) {
        complain("--samples", "a number from 4 to %d, not '%s'", IRIS_SHAPE_SAMPLES_MAX, samples);
        return 0;
    }
    if (strcmp(crossing, "first") != 0 && strcmp(crossing, "last") != 0) {
        complain("--crossing", "first or last, not '%s'", crossing);
        return 0;
    }
    if (point && (!args_numbers(place, 2, ',', point) || place[0] < 0 || place[1] < 0 ||
                  place[0] >= IRIS_SIDE_MAX || place[1] >= IRIS_SIDE_MAX)) {
        complain("--point", "x,y in pixels, not '%s'", point);
        return 0;
    }
    by->sampling.crossing = crossing[0] == 'f' ? IRIS_SHAPE_FIRST : IRIS_SHAPE_LAST;
    by->sampling.has_point = point != NULL;
    by->x = place[0];
    by->y = place[1];
    return 1;
}

const operation operation_signature = {.name = "signature",
                                       .summary = "how far the edge of a silhouette is, all around",
                                       .help = help,
                                       .parse = parse,
                                       .apply = apply,
                                       .report = report,
                                       .print = print,
                                       .reshapes = 1,
                                       .reports_alone = 1};
