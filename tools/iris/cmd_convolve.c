#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "iris/color.h"
#include "iris/copy.h"
#include "iris/xt/convolve.h"
#include "operation.h"

static const char help[] =
    "usage: iris convolve --mask \"R C V...[ / D]\" [--correlate] [--bias N] [--absolute | --signed]\n"
    "                     [--lightness] [--border RULE] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
    "Each pixel becomes the sum of the RxC pixels around it, times the mask's values, divided by D and\n"
    "rounded. Gray, or each channel of color. A mask picture counts as 0 and 255 and turns gray.\n\n"
    "  --mask \"R C V...[ / D]\"   R rows of C whole numbers, each 1 to 31, with blanks between; D is 1\n"
    "                    when not given, else up to 4194304\n"
    "  --correlate       the mask is laid on the picture as it is written. Convolution turns it by 180\n"
    "                    degrees first\n"
    "  --bias N          adds N levels\n"
    "  --absolute        writes the absolute value; without it, what is below 0 becomes 0\n"
    "  --signed          writes 128 + half of it, rounded, so that both signs can be seen\n"
    "  --lightness       of color, its lightness alone\n" OPERATION_BORDER_OPTIONS "\n"
    "The picture's pixel lies under row (R + 1) / 2 and column (C + 1) / 2 of the mask, rounded down.\n\n"
    "example: iris convolve --mask \"3 3 1 2 1 2 4 2 1 2 1 / 16\" noisy.pgm -o smooth.pgm\n";

typedef struct {
    int32_t rows, columns, divisor, bias;
    int correlate, absolute, is_signed, lightness;
    int32_t values[IRIS_KERNEL_SIDE_MAX * IRIS_KERNEL_SIDE_MAX];
} convolving;

static iris_status convolve(const iris_image *dst, const iris_image *src, const convolving *by,
                            operation_stage *stage, iris_scratch *scratch)
{
    iris_kernel kernel = {by->values, by->rows, by->columns, by->divisor, by->bias, by->absolute};
    return (by->correlate ? iris_correlate : iris_convolve)(dst, src, &kernel, stage->border, scratch);
}

/* The part whose pixels are evaluated; 0 when there is none. */
static int evaluated(iris_rect *part, const iris_image *image, const convolving *by, iris_border border)
{
    *part = (iris_rect){0, 0, image->w, image->h};
    if (border.rule == IRIS_BORDER_SKIP) {
        *part = (iris_rect){(by->columns - 1) / 2, (by->rows - 1) / 2, image->w - by->columns + 1,
                            image->h - by->rows + 1};
    }
    return part->w > 0 && part->h > 0;
}

/* One gray picture, in place, as 128 + v / 2. */
static iris_status show_signed(const iris_image *gray, const iris_image *sums, const convolving *by,
                               operation_stage *stage, iris_scratch *scratch)
{
    iris_rect part;
    iris_status status = convolve(sums, gray, by, stage, scratch);
    int some = evaluated(&part, gray, by, stage->border);
    for (int32_t y = part.y; status == IRIS_OK && some && y < part.y + part.h; y++) {
        const int16_t *from = iris_image_row(sums, y);
        uint8_t *to = iris_image_row(gray, y);
        for (int32_t x = part.x; x < part.x + part.w; x++) {
            int32_t shown = 128 + ((from[x] + 1) >> 1);
            to[x] = (uint8_t)(shown < 0 ? 0 : shown > 255 ? 255 : shown);
        }
    }
    return status;
}

static iris_status each_channel_signed(const iris_image *picture, const convolving *by,
                                       operation_stage *stage, iris_scratch *scratch)
{
    iris_size size = {picture->w, picture->h};
    const iris_image *sums = stage_picture(stage, size, IRIS_GRAY_S16);
    if (!sums) {
        return IRIS_ERR_SCRATCH;
    }
    if (picture->format == IRIS_GRAY8) {
        return show_signed(picture, sums, by, stage, scratch);
    }
    const iris_image *channel = stage_picture(stage, size, IRIS_GRAY8);
    iris_status status = channel ? IRIS_OK : IRIS_ERR_SCRATCH;
    for (int32_t c = 0; status == IRIS_OK && c < 3; c++) {
        status = iris_channel_extract(channel, picture, c);
        if (status == IRIS_OK && !(by->lightness && c < 2)) {
            status = show_signed(channel, sums, by, stage, scratch);
        }
        status = status == IRIS_OK ? iris_channel_insert(picture, channel, c) : status;
    }
    return status;
}

/* In place. The pixels that are not evaluated keep their color, which hue and saturation of a byte would change. */
static iris_status lightness(const iris_image *color, const convolving *by, operation_stage *stage,
                             iris_scratch *scratch)
{
    const iris_image *hsl = stage_picture(stage, (iris_size){color->w, color->h}, IRIS_HSL24);
    iris_status status = hsl ? iris_color_convert(hsl, color) : IRIS_ERR_SCRATCH;
    if (status == IRIS_OK) {
        status = by->is_signed ? each_channel_signed(hsl, by, stage, scratch)
                               : convolve(hsl, hsl, by, stage, scratch);
    }
    iris_rect part;
    iris_image to, from;
    if (status != IRIS_OK || !evaluated(&part, color, by, stage->border)) {
        return status;
    }
    status = iris_image_crop(&to, color, part);
    status = status == IRIS_OK ? iris_image_crop(&from, hsl, part) : status;
    return status == IRIS_OK ? iris_color_convert(&to, &from) : status;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const convolving *by = stage->settings;
    const iris_image *levels = stage_levels(stage, input);
    const iris_image *picture = levels ? stage_copy(stage, levels) : NULL;
    int gray = levels && levels->format == IRIS_GRAY8;
    size_t bytes =
        IRIS_CONVOLVE_SCRATCH_BYTES(input->w, gray || by->lightness ? 1u : 3u, by->rows, by->columns);
    iris_scratch *scratch = picture ? stage_scratch(stage, bytes) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *picture;
    return stage_exit(stage, by->lightness && !gray ? lightness(picture, by, stage, scratch)
                             : by->is_signed        ? each_channel_signed(picture, by, stage, scratch)
                                                    : convolve(picture, picture, by, stage, scratch));
}

/* The next whole number of a text; 0 when there is none. */
static int next_number(int32_t *number, const char **text)
{
    char *end;
    const char *start = *text + strspn(*text, " \t\n");
    const char *digits = start + (*start == '-' || *start == '+');
    long long value = strtoll(start, &end, 10);
    if (*digits < '0' || *digits > '9' || value < INT32_MIN || value > INT32_MAX || !strchr(" \t\n/", *end)) {
        return 0;
    }
    *number = (int32_t)value;
    *text = end;
    return 1;
}

/* Returns 0 after complaining. */
static int read_mask(convolving *by, const char *text)
{
    int32_t count = 0, most;
    if (!next_number(&by->rows, &text) || !next_number(&by->columns, &text) || by->rows < 1 ||
        by->columns < 1 || by->rows > IRIS_KERNEL_SIDE_MAX || by->columns > IRIS_KERNEL_SIDE_MAX) {
        complain("--mask", "begins with its rows and columns, each 1 to %d", IRIS_KERNEL_SIDE_MAX);
        return 0;
    }
    most = by->rows * by->columns;
    while (count < most && next_number(&by->values[count], &text)) {
        count++;
    }
    text += strspn(text, " \t\n");
    if (count < most || (*text != '\0' && *text != '/')) {
        complain("--mask", "%d rows of %d are %d whole numbers%s%.20s%s", (int)by->rows, (int)by->columns,
                 (int)most, *text ? ", then '/' and a divisor or nothing, not '" : "; there are fewer", text,
                 *text ? "'" : "");
        return 0;
    }
    by->divisor = 1;
    if (*text == '/') {
        text++;
        if (!next_number(&by->divisor, &text) || text[strspn(text, " \t\n")] != '\0' || by->divisor < 1 ||
            by->divisor > IRIS_KERNEL_DIVISOR_MAX) {
            complain("--mask", "the divisor is one whole number from 1 to %d", IRIS_KERNEL_DIVISOR_MAX);
            return 0;
        }
    }
    return 1;
}

/* Values that could overflow are refused before any picture is read: on a picture of one pixel. */
static int fits(const convolving *by)
{
    static IRIS_SCRATCH_BUFFER(memory,
                               IRIS_CONVOLVE_SCRATCH_BYTES(1, 1, IRIS_KERNEL_SIDE_MAX, IRIS_KERNEL_SIDE_MAX));
    uint8_t pixel = 0;
    iris_scratch scratch;
    iris_image image = {&pixel, 1, 1, 1, IRIS_GRAY8};
    iris_kernel kernel = {by->values, by->rows, by->columns, by->divisor, by->bias, by->absolute};
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    return iris_correlate(&image, &image, &kernel, (iris_border){0}, &scratch) == IRIS_OK;
}

static int parse(void *settings, operation_words *words)
{
    convolving *by = settings;
    const char *mask = NULL, *bias = NULL;
    const args_option options[] = {{"mask", 0, NULL, &mask},
                                   {"correlate", 0, &by->correlate, NULL},
                                   {"bias", 0, NULL, &bias},
                                   {"absolute", 0, &by->absolute, NULL},
                                   {"signed", 0, &by->is_signed, NULL},
                                   {"lightness", 0, &by->lightness, NULL}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    if (!mask) {
        complain(NULL, "no --mask (see --help)");
        return 0;
    }
    if (by->absolute && by->is_signed) {
        complain(NULL, "either --absolute or --signed");
        return 0;
    }
    if (bias && !args_numbers(&by->bias, 1, ',', bias)) {
        complain("--bias", "a whole number, not '%s'", bias);
        return 0;
    }
    if (!read_mask(by, mask)) {
        return 0;
    }
    if (!fits(by)) {
        complain("--mask", "too large: 255 times the sum of the values without their signs, and the divisor "
                           "times half and bias, must be below 2147483648");
        return 0;
    }
    return 1;
}

const operation operation_convolve = {.name = "convolve",
                                      .summary = "weighted sums of surroundings, by a mask of whole numbers",
                                      .help = help,
                                      .parse = parse,
                                      .apply = apply};
