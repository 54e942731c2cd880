#include "commands.h"
#include "histogram_chart.h"
#include "iris/copy.h"
#include "iris/xt/threshold.h"
#include "operation.h"

static const char help[] =
    "usage: iris histogram [--roi x,y,w,h] --json IN...\n"
    "       iris histogram [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "How many pixels have each level: numbers, a picture of them, or both. One curve for gray, three for\n"
    "color, two levels for a mask.\n\n"
    "  --border RULE     taken by every operation; changes nothing here\n"
    "  --roi x,y,w,h     of this part alone\n"
    "  --json            one JSON object per picture: channels (gray; red, green, blue; or mask), each with\n"
    "                    count, mean, variance, min, max, median, otsu (the threshold between dark and\n"
    "                    bright), percentiles (1, 5, 25, 50, 75, 95, 99), and counts (one per level)\n"
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n\n"
    "example: iris histogram --json photo.bmp -o histogram.bmp\n";

typedef struct {
    int has_roi;
    iris_rect roi;
} part_of;

/* The input, or its part. Null after complaining. */
static const iris_image *take_part(iris_image *part, const iris_image *input, operation_stage *stage)
{
    const part_of *of = stage->settings;
    const iris_image *mask;
    if (!of->has_roi) {
        return input;
    }
    if (of->roi.x > input->w - of->roi.w || of->roi.y > input->h - of->roi.h) {
        complain(stage->file, "--roi is not wholly inside the picture of %dx%d pixels", (int)input->w,
                 (int)input->h);
        return NULL;
    }
    if (input->format != IRIS_MASK1) {
        iris_image_crop(part, input, of->roi);
        return part;
    }
    mask = stage_picture(stage, (iris_size){of->roi.w, of->roi.h}, IRIS_MASK1);
    if (mask) {
        iris_mask_copy(mask, input, of->roi.x, of->roi.y);
    }
    return mask;
}

static void count(chart *counts, const iris_image *part)
{
    static const chart_channel gray = {.name = "gray", .line = {60, 60, 60}},
                               mask = {.name = "mask", .line = {60, 60, 60}};
    static const chart_channel color[3] = {{.name = "red", .line = {200, 0, 0}},
                                           {.name = "green", .line = {0, 130, 0}},
                                           {.name = "blue", .line = {0, 50, 220}}};
    counts->channels = part->format == IRIS_RGB888 ? 3 : 1;
    counts->levels = part->format == IRIS_MASK1 ? 2 : 256;
    for (int c = 0; c < counts->channels; c++) {
        chart_channel *to = &counts->channel[c];
        *to = part->format == IRIS_RGB888 ? color[c] : part->format == IRIS_MASK1 ? mask : gray;
        iris_histogram(to->count, part, c, NULL);
        iris_histogram_measure(&to->is, to->count);
        iris_otsu_value(&to->otsu, to->count);
    }
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    iris_image part;
    const iris_image *of = take_part(&part, input, stage);
    if (!of) {
        return EXIT_BAD_CALL;
    }
    chart *counts = stage_room(stage, sizeof *counts);
    if (!counts) {
        return EXIT_BAD_DATA;
    }
    count(counts, of);
    stage->finding = counts;
    const iris_image *image = stage_picture(stage, chart_size(counts), IRIS_RGB888);
    if (!image) {
        return EXIT_BAD_DATA;
    }
    chart_draw(image, counts);
    *result = *image;
    return EXIT_DONE;
}

static void report_percentiles(json_writer *json, const uint32_t histogram[256])
{
    static const struct {
        const char *name;
        iris_q16 share;
    } percentiles[] = {{"1", 655},    {"5", 3277},   {"25", 16384}, {"50", 32768},
                       {"75", 49152}, {"95", 62259}, {"99", 64881}};
    json_key(json, "percentiles");
    json_open(json, '{');
    for (size_t i = 0; i < sizeof percentiles / sizeof percentiles[0]; i++) {
        uint8_t level = 0;
        iris_histogram_percentile(&level, histogram, percentiles[i].share);
        json_key(json, percentiles[i].name);
        json_integer(json, level);
    }
    json_close(json, '}');
}

static void report_channel(json_writer *json, const chart_channel *channel, int levels)
{
    const struct {
        const char *name;
        int64_t value;
    } numbers[] = {{"min", channel->is.min},
                   {"max", channel->is.max},
                   {"median", channel->is.median},
                   {"otsu", channel->otsu}};
    json_key(json, channel->name);
    json_open(json, '{');
    json_key(json, "count");
    json_integer(json, channel->is.count);
    json_key(json, "mean");
    json_number(json, channel->is.mean_q16 / 65536.0, 4);
    json_key(json, "variance");
    json_number(json, channel->is.variance_q16 / 65536.0, 4);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        json_key(json, numbers[i].name);
        json_integer(json, numbers[i].value);
    }
    report_percentiles(json, channel->count);
    json_key(json, "counts");
    json_open(json, '[');
    for (int p = 0; p < levels; p++) {
        json_integer(json, channel->count[p]);
    }
    json_close(json, ']');
    json_close(json, '}');
}

static void report(json_writer *json, const operation_stage *stage)
{
    const chart *counts = stage->finding;
    json_key(json, "channels");
    json_open(json, '{');
    for (int c = 0; c < counts->channels; c++) {
        report_channel(json, &counts->channel[c], counts->levels);
    }
    json_close(json, '}');
}

static int parse(void *settings, operation_words *words)
{
    part_of *of = settings;
    const char *roi = NULL;
    const args_option options[] = {{"roi", 0, NULL, &roi}};
    if (!operation_options(words, options, 1)) {
        return 0;
    }
    of->has_roi = roi != NULL;
    return !roi || args_rect(&of->roi, "--roi", roi);
}

const operation operation_histogram = {.name = "histogram",
                                       .summary = "how many pixels have each level",
                                       .help = help,
                                       .parse = parse,
                                       .apply = apply,
                                       .report = report,
                                       .reshapes = 1,
                                       .has_border = 1,
                                       .reports_alone = 1};
