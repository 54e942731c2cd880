/* A picture operation: what one command does to a picture, and what one stage of `iris pipe` does. A new one is a file
 * cmd_<name>.c that defines `const operation operation_<name>` and its line in operations.def.
 *
 * Inputs come as IRIS_GRAY8, IRIS_RGB888, or IRIS_MASK1 (1-bit files, and masks made by the stage before), results are
 * one of these. --roi, --border, -o, and --json are read here, and all but --border done.
 */
#ifndef IRIS_TOOL_OPERATION_H
#define IRIS_TOOL_OPERATION_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "args.h"
#include "complain.h"
#include "iris/border.h"
#include "iris/image.h"
#include "iris/scratch.h"
#include "json.h"
#include "picture.h"
#include "raw_picture.h"

/* The end of every help text: the options that all operations share, */
#define OPERATION_SHARED_OPTIONS                                                                             \
    "  --roi x,y,w,h     works on this part alone; the rest of the picture stays as it was\n"                \
    "  --json            one JSON object per picture\n"                                                      \
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n"

/* with --border for operations to which nothing lies beyond the edge, */
#define OPERATION_OPTIONS                                                                                    \
    "  --border RULE     taken by every operation; changes nothing here\n" OPERATION_SHARED_OPTIONS

/* and for those that look at a pixel's surroundings. */
#define OPERATION_BORDER_OPTIONS                                                                             \
    "  --border RULE     beyond the edge: replicate (the default), reflect (mirrored at the\n"               \
    "                    outermost pixel), constant (black; constant:N for level N), or skip\n"              \
    "                    (pixels that would need it stay as they are, in a new mask "                        \
    "black)\n" OPERATION_SHARED_OPTIONS

#define OPERATION_SETTINGS_BYTES 8192
#define STAGE_PICTURES           8

/* What an operation works with. */
typedef struct operation_stage {
    const void *settings; /* what parse has filled in */
    iris_border border;   /* of --border */
    const char *file;     /* the input worked on, for complaints */
    void *finding;        /* what apply leaves for report: stage_room; null for each new input */

    /* Private. */
    const struct operation *operation;
    union {
        uint8_t bytes[OPERATION_SETTINGS_BYTES];
        uint64_t word;
        void *pointer;
    } memory;
    int has_roi;
    iris_rect roi;
    iris_size whole; /* of the input, of which roi is a part */
    picture_buffer pictures[STAGE_PICTURES];
    int pictures_used;
    picture_buffer roi_input, roi_output;
    void *scratch_memory, *room_memory;
    size_t scratch_bytes, room_bytes;
    iris_scratch scratch;
} operation_stage;

/* The words of a call, while they are read. */
typedef struct operation_words {
    int argc;
    char **argv;
    int in_pipe;         /* 1: no operands, no -o, no --json */
    const char *output;  /* -o */
    int json;            /* --json */
    raw_layout raw;      /* what parse has found the inputs to be: see raw_picture.h */
    arguments arguments; /* operands */
    operation_stage *stage;
    int exit_code; /* ARGS_GO, or why it ends here */
} operation_words;

typedef struct operation {
    const char *name;
    const char *summary; /* its line in iris --help */
    const char *help;

    /* Reads the options into settings (zeroed, OPERATION_SETTINGS_BYTES): calls operation_options first. Returns 1, or 0
     * after complaining. Texts of options stay valid as long as the stage. */
    int (*parse)(void *settings, operation_words *words);

    /* Makes *result from *input, which is not to be changed: a view of input or of the stage's pictures. Returns an exit
     * code, after complaining. */
    int (*apply)(iris_image *result, const iris_image *input, operation_stage *stage);

    /* Adds members to the JSON object that has file, output, width, height, and kind; null: none. */
    void (*report)(json_writer *json, const operation_stage *stage);

    /* Writes what people read when neither --json nor -o was given: a line for the picture (stage->file), and more lines.
     * Null: without them the picture goes to standard output. */
    void (*print)(FILE *out, const operation_stage *stage);

    int reshapes;      /* 1: the result may have another size, so that there is no --roi */
    int has_border;    /* 1: takes --border though it reshapes; all that do not take it */
    int reports_alone; /* 1: --json needs no -o: without it no picture is written */
} operation;

/* Reads the words by these options and the shared ones. 1 to go on, 0 when the call ends here. */
int operation_options(operation_words *words, const args_option *options, size_t count);

/* The whole of parse: stage->operation reads the words. ARGS_GO, or the exit code of a call that ends here. */
int operation_parse(operation_words *words);

/* One picture: the operation, or only its part given by --roi. Returns an exit code. */
int stage_apply(iris_image *result, const iris_image *input, operation_stage *stage);

void stage_free(operation_stage *stage);

/* --- for apply --- */

/* The input as IRIS_GRAY8 (color by its luma, masks as 0 and 255), as IRIS_RGB888, as IRIS_MASK1 (gray above 127), or as
 * what it is, but masks as gray: the input itself, or one of the stage's pictures. Null after complaining. */
const iris_image *stage_gray(operation_stage *stage, const iris_image *input);
const iris_image *stage_color(operation_stage *stage, const iris_image *input);
const iris_image *stage_mask(operation_stage *stage, const iris_image *input);
const iris_image *stage_levels(operation_stage *stage, const iris_image *input);

/* A picture of the stage's own, without defined pixels, valid until the next input. At most six for one input, those of
 * the conversions above included. Null after complaining. */
const iris_image *stage_picture(operation_stage *stage, iris_size size, iris_format format);

/* A picture of the stage's own with the pixels of `image`. Null after complaining. */
const iris_image *stage_copy(operation_stage *stage, const iris_image *image);

/* Working memory of `bytes` bytes, all free; one at a time. Null after complaining. */
iris_scratch *stage_scratch(operation_stage *stage, size_t bytes);

/* Zeroed bytes for stage->finding and results of any length; one at a time. Null after complaining. */
void *stage_room(operation_stage *stage, size_t bytes);

/* Where the first pixel of apply's input is in the whole picture: not at 0, 0 with --roi. */
void stage_origin(int32_t *x, int32_t *y, const operation_stage *stage);

/* The size of the whole picture, of which apply's input is a part with --roi. */
iris_size stage_size(const operation_stage *stage);

/* EXIT_DONE for IRIS_OK; else complains about stage->file, and EXIT_BAD_DATA. */
int stage_exit(const operation_stage *stage, iris_status status);

#endif
