#include <string.h>

#include "commands.h"
#include "iris/xt/morph.h"
#include "operation.h"

#define ELEMENT_USAGE                                                                                        \
    " [--size N] [--shape square|cross] [--exclude-center]\n"                                                \
    "            [--border RULE] [--roi x,y,w,h] [--json] IN... -o OUT\n\n"
#define ELEMENT_OPTIONS                                                                                      \
    "Gray pictures, each channel of color, and masks.\n\n"                                                   \
    "  --size N          NxN pixels (3), or WxH, up to 1023; of an even size the anchor is\n"                \
    "                    the upper left one of the four in the middle\n"                                     \
    "  --shape square    all of them (the default)\n"                                                        \
    "  --shape cross     the anchor's row and column\n"                                                      \
    "  --exclude-center  all but the pixel itself\n" OPERATION_BORDER_OPTIONS "\n"

typedef iris_status (*morph_call)(const iris_image *, const iris_image *, const iris_morph_element *,
                                  iris_border, iris_scratch *);

static int apply_call(iris_image *result, const iris_image *input, operation_stage *stage, morph_call call,
                      int steps)
{
    const iris_morph_element *element = stage->settings;
    const iris_image *copy = stage_copy(stage, input);
    size_t bytes = IRIS_MORPH_SCRATCH_BYTES(input->format, input->w, element->w, element->h);
    iris_scratch *scratch = copy ? stage_scratch(stage, (size_t)steps * bytes) : NULL;
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    *result = *copy;
    return stage_exit(stage, call(copy, copy, element, stage->border, scratch));
}

static int read_size(iris_morph_element *element, const char *text)
{
    int32_t n[2];
    if (args_numbers(n, 1, 'x', text)) {
        n[1] = n[0];
    } else if (!args_numbers(n, 2, 'x', text)) {
        n[0] = 0;
    }
    if (n[0] < 1 || n[0] > IRIS_MORPH_SIDE_MAX || n[1] < 1 || n[1] > IRIS_MORPH_SIDE_MAX) {
        complain("--size", "N or WxH, 1 to %d, not '%s'", IRIS_MORPH_SIDE_MAX, text);
        return 0;
    }
    element->w = n[0];
    element->h = n[1];
    return 1;
}

static int parse(void *settings, operation_words *words)
{
    iris_morph_element *element = settings;
    const char *size = "3", *shape = "square";
    iris_morph_element_defaults(element);
    const args_option options[] = {{"size", 0, NULL, &size},
                                   {"shape", 0, NULL, &shape},
                                   {"exclude-center", 0, &element->exclude_center, NULL}};
    if (!operation_options(words, options, sizeof options / sizeof options[0]) || !read_size(element, size)) {
        return 0;
    }
    if (strcmp(shape, "square") != 0 && strcmp(shape, "cross") != 0) {
        complain("--shape", "square or cross, not '%s'", shape);
        return 0;
    }
    element->shape = strcmp(shape, "cross") == 0 ? IRIS_MORPH_CROSS : IRIS_MORPH_SQUARE;
    if (element->exclude_center && element->w * element->h == 1) {
        complain("--exclude-center", "leaves nothing of a --size of 1");
        return 0;
    }
    return 1;
}

/* One command: its function of the library and how many steps that has, what it says in iris --help, and how it is
 * explained. */
#define MORPH_OPERATION(word, call, steps, line, text, example)                                              \
    static int apply_##word(iris_image *result, const iris_image *input, operation_stage *stage)             \
    {                                                                                                        \
        return apply_call(result, input, stage, call, steps);                                                \
    }                                                                                                        \
    const operation operation_##word = {.name = #word,                                                       \
                                        .summary = line,                                                     \
                                        .help = "usage: iris " #word ELEMENT_USAGE text ELEMENT_OPTIONS      \
                                                "example: iris " #word " " example,                          \
                                        .parse = parse,                                                      \
                                        .apply = apply_##word};

MORPH_OPERATION(dilate, iris_morph_dilate, 1, "the brightest of each pixel's neighbors",
                "Each pixel becomes the brightest of its neighbors: what is bright (white) grows.\n",
                "--size 5 line.bmp -o thick.bmp\n")
MORPH_OPERATION(erode, iris_morph_erode, 1, "the darkest of each pixel's neighbors",
                "Each pixel becomes the darkest of its neighbors: what is bright (white) shrinks.\n",
                "--shape cross line.bmp -o thin.bmp\n")
MORPH_OPERATION(open, iris_morph_open, 2, "removes what is bright and small",
                "Removes what is bright (white) and smaller than the size: erosion, then dilation.\n",
                "--size 3 line.bmp -o clean.bmp\n")
MORPH_OPERATION(close, iris_morph_close, 2, "fills what is dark and small",
                "Fills what is dark (black) and smaller than the size: dilation, then erosion.\n",
                "--size 7x3 line.bmp -o whole.bmp\n")
MORPH_OPERATION(gradient, iris_morph_gradient, 2, "how much each pixel's neighbors differ",
                "The brightest of each pixel's neighbors less the darkest: outlines.\n",
                "floor.bmp -o outlines.bmp\n")
MORPH_OPERATION(tophat, iris_morph_tophat, 2, "what is bright and small",
                "What open removes: bright things smaller than the size, under uneven light.\n",
                "--size 25 floor.bmp -o marks.bmp\n")
MORPH_OPERATION(blackhat, iris_morph_blackhat, 2, "what is dark and small",
                "What close fills: dark things smaller than the size, under uneven light.\n",
                "--size 25 floor.bmp -o line.bmp\n")
