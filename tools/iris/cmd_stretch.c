#include <string.h>

#include "commands.h"
#include "iris/xt/histogram.h"
#include "tone_stage.h"

static const char help[] =
    "usage: iris stretch [--low A] [--high B] [--slopes P,Q,R] [--roi x,y,w,h] [--json] IN... -o OUT\n"
    "       iris stretch --percent P [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Contrast stretch in three straight segments that meet at the levels A and B; or one segment, from\n"
    "the picture's own dark to its own bright level.\n\n"
    "  --low A           85 (a third of 255) when not given\n"
    "  --high B          170; A to 255\n"
    "  --slopes P,Q,R    below A, between, and above B: 0.5,2,0.5 when not given; -32767 to 32767\n"
    "  --percent P       the darkest P percent of the levels become 0, the brightest P percent 255;\n"
    "                    0 to 49.9. Color counts all three channels alike\n" OPERATION_OPTIONS "\n"
    "JSON has the two levels, low and high.\n\n"
    "example: iris stretch --percent 1 pale.bmp -o clear.bmp\n";

typedef struct {
    iris_tone_segments segments;
    iris_q16 share; /* -1: segments */
} stretching;

/* What apply leaves for report. */
typedef struct {
    int32_t low, high;
} finding;

/* Of all channels together. */
static void count(uint32_t histogram[256], const iris_image *levels)
{
    uint32_t one[256];
    memset(histogram, 0, sizeof one);
    for (int32_t channel = 0; channel < (levels->format == IRIS_GRAY8 ? 1 : 3); channel++) {
        iris_histogram(one, levels, channel, NULL);
        for (int p = 0; p < 256; p++) {
            histogram[p] += one[p];
        }
    }
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const stretching *by = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    finding *found = levels ? stage_room(stage, sizeof *found) : NULL;
    uint32_t histogram[256];
    iris_tone tone;
    if (!found) {
        return EXIT_BAD_DATA;
    }
    stage->finding = found;
    *found = (finding){by->segments.a, by->segments.b};
    iris_tone_identity(&tone);
    if (by->share >= 0) {
        uint8_t low = 0, high = 255;
        count(histogram, levels);
        iris_histogram_percentile(&low, histogram, by->share);
        iris_histogram_percentile(&high, histogram, IRIS_Q16_ONE - by->share);
        *found = (finding){low, high};
        iris_tone_levels(&tone, low, high);
    } else {
        iris_tone_stretch(&tone, &by->segments);
    }
    return tone_stage_apply(result, input, stage, &tone);
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    json_key(json, "low");
    json_integer(json, found->low);
    json_key(json, "high");
    json_integer(json, found->high);
}

/* Three decimal numbers with commas between them. */
static int read_slopes(iris_tone_segments *segments, const char *text)
{
    iris_q16 *const slopes[3] = {&segments->below, &segments->between, &segments->above};
    char number[32];
    for (int i = 0; i < 3; i++) {
        size_t length = strcspn(text, ",");
        if (length >= sizeof number || (text[length] == ',') != (i < 2)) {
            return 0;
        }
        memcpy(number, text, length);
        number[length] = '\0';
        if (!args_q16(slopes[i], -32767 * IRIS_Q16_ONE, 32767 * IRIS_Q16_ONE, number)) {
            return 0;
        }
        text += length + (i < 2);
    }
    return 1;
}

/* Reads a level. Complains and returns 0 when it is none. */
static int read_level(int32_t *level, const char *option, const char *text)
{
    if (text && (!args_numbers(level, 1, ',', text) || *level < 0 || *level > 255)) {
        complain(option, "a level from 0 to 255, not '%s'", text);
        return 0;
    }
    return 1;
}

static int parse(void *settings, operation_words *words)
{
    stretching *by = settings;
    const char *low = NULL, *high = NULL, *slopes = NULL, *percent = NULL;
    const args_option options[] = {{"low", 0, NULL, &low},
                                   {"high", 0, NULL, &high},
                                   {"slopes", 0, NULL, &slopes},
                                   {"percent", 0, NULL, &percent}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if (percent && (low || high || slopes)) {
        complain(NULL, "either --percent, or --low, --high, and --slopes (see --help)");
        return 0;
    }
    by->share = -1;
    iris_tone_segments_defaults(&by->segments);
    if (percent) {
        iris_q16 value;
        if (!args_q16(&value, 0, 50 * IRIS_Q16_ONE - IRIS_Q16_ONE / 10, percent)) {
            complain("--percent", "0 to 49.9, not '%s'", percent);
            return 0;
        }
        by->share = (iris_q16)(((int64_t)value + 50) / 100);
    }
    if (!read_level(&by->segments.a, "--low", low) || !read_level(&by->segments.b, "--high", high)) {
        return 0;
    }
    if (by->segments.a > by->segments.b) {
        complain("--low", "at most --high, but they are %d and %d", (int)by->segments.a, (int)by->segments.b);
        return 0;
    }
    if (slopes && !read_slopes(&by->segments, slopes)) {
        complain("--slopes", "three numbers such as 0.5,2,0.5, each -32767 to 32767, not '%s'", slopes);
        return 0;
    }
    return 1;
}

const operation operation_stretch = {.name = "stretch",
                                     .summary = "more contrast between two levels",
                                     .help = help,
                                     .parse = parse,
                                     .apply = apply,
                                     .report = report};
