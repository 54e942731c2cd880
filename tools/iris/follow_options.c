#include "follow_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "complain.h"
#include "hsl_text.h"

static int read_line(iris_follow_config *config, const char *text)
{
    if (strncmp(text, "hsl:", 4) == 0) {
        config->kind = IRIS_FOLLOW_COLOR;
        return hsl_text_read(&config->color, "--line", text + 4);
    }
    if (strcmp(text, "dark") != 0 && strcmp(text, "bright") != 0) {
        complain("--line", "dark, bright, or hsl:" HSL_TEXT ", not '%s'", text);
        return 0;
    }
    config->kind = *text == 'd' ? IRIS_FOLLOW_DARK : IRIS_FOLLOW_BRIGHT;
    return 1;
}

static int read_estimator(int *hough, const char *text)
{
    *hough = strcmp(text, "hough") == 0;
    if (!*hough && strcmp(text, "regression") != 0) {
        complain("--estimator", "regression or hough, not '%s'", text);
        return 0;
    }
    return 1;
}

static int read_rows(follow_options *options, const char *text)
{
    int count = 1;
    for (const char *at = text; *at != '\0'; at++) {
        count += *at == ',';
    }
    if (count > FOLLOW_ROWS_MAX) {
        complain("--rows", "at most %d rows, not %d", FOLLOW_ROWS_MAX, count);
        return 0;
    }
    int good = args_numbers(options->rows, count, ',', text);
    for (int i = 0; i < count && good; i++) {
        good = options->rows[i] >= 0 && options->rows[i] < IRIS_FOLLOW_SIDE_MAX;
    }
    if (!good) {
        complain("--rows", "rows from 0 to %d with commas between them, not '%s'", IRIS_FOLLOW_SIDE_MAX - 1,
                 text);
        return 0;
    }
    options->row_count = count;
    return 1;
}

static int read_number(int32_t *number, const char *option, const char *text, int32_t low, int32_t high)
{
    if (!args_numbers(number, 1, ',', text) || *number < low || *number > high) {
        complain(option, "%d to %d, not '%s'", (int)low, (int)high, text);
        return 0;
    }
    return 1;
}

/* Percent to permil. */
static int read_contrast(iris_follow_config *config, const char *text)
{
    int32_t percent;
    if (config->kind == IRIS_FOLLOW_COLOR) {
        complain("--contrast", "only for dark and bright lines");
        return 0;
    }
    if (!read_number(&percent, "--contrast", text, 10, 90)) {
        return 0;
    }
    config->contrast_permil = percent * 10;
    return 1;
}

static int read_camera(follow_options *options, const follow_texts *texts)
{
    if (!camera_options_read(&options->capture, &texts->camera)) {
        return 0;
    }
    options->capture.policy = IRIS_CAPTURE_LATEST;
    options->capture.rate_millihz = texts->rate ? options->rate * 1000 : 0;
    return 1;
}

int follow_options_read(follow_options *options, const follow_texts *texts)
{
    iris_follow_defaults(&options->line);
    options->line.format = IRIS_RGB888;
    options->hough = 0;
    options->row_count = 0;
    options->rate = 30;
    return (!texts->line || read_line(&options->line, texts->line)) &&
           (!texts->contrast || read_contrast(&options->line, texts->contrast)) &&
           (!texts->estimator || read_estimator(&options->hough, texts->estimator)) &&
           (!texts->rows || read_rows(options, texts->rows)) &&
           (!texts->rate || read_number(&options->rate, "--rate", texts->rate, 1, 1000)) &&
           (!texts->frames || read_number(&options->frames, "--frames", texts->frames, 1, INT32_MAX)) &&
           read_camera(options, texts) &&
           (!texts->take || follow_junctions_take(&options->junctions, texts->take)) &&
           steering_options_read(&options->steering, &texts->steering, options->rate);
}
