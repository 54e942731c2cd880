#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "frame_sequence.h"
#include "hsl_text.h"
#include "inputs.h"
#include "iris/xt/lock.h"
#include "lock_report.h"
#include "overlay_folder.h"
#include "progress.h"
#include "system.h"

static const char help[] =
    "usage: iris lock --teach x,y,w,h [options] FIRST IN...\n"
    "       iris lock --signature hsl:H0-H1,S0-S1,L0-L1 [options] IN...\n\n"
    "Locks on to a colored object and follows it from frame to frame; one line per frame, the first\n"
    "included, at once. IN is a BMP, PGM, or PPM file, a folder of them, or - for standard input, which\n"
    "may hold several one after another. All of them together are one sequence.\n\n"
    "  --teach x,y,w,h  the object is what this rectangle of the first frame shows; its color is\n"
    "                   learned there, and again as the light changes; when the rectangle is full\n"
    "                   of a color that goes on outside, all of that is the object\n"
    "  --signature hsl:H0-H1,S0-S1,L0-L1\n"
    "                   the object is the largest blob of these colors: hue in degrees, saturation\n"
    "                   and lightness in percent; 350-10 goes through red; colons will do, too\n"
    "  --json           one JSON object per frame\n"
    "  -o DIR           a folder: write each frame with what was found and where it came from drawn in, as a "
    "BMP\n\n"
    "x, y, w, h: the box around its pixels; cx, cy: their center; area: how many. id: 1, 2, and so on:\n"
    "what is found again with its color and size keeps its number. age: frames since it was first seen.\n"
    "score: how much it is like what was expected, up to 1. frame: its place among all, from 1.\n"
    "state: found, or lost, also while it is hidden and only predicted; in JSON the positions of a lost\n"
    "object are null, and so is its id while there was none yet.\n\n"
    "example: iris lock --teach 108,123,15,15 --json -o seen ball/*.bmp\n"
    "         camera | iris lock --signature hsl:340-20,40-100,10-70 -\n";

typedef struct {
    int json;
    const char *folder; /* -o */
    int teaches;
    iris_rect rect;
} lock_options;

/* The sequence of frames so far. */
typedef struct {
    const lock_options *options;
    int64_t frame; /* place of the frame among the inputs, 1 first */
    int is_ready;  /* the lock has its size */
    iris_lock lock;
    iris_signatures signatures;
    picture_buffer picture;
    void *memory;
    iris_scratch scratch;
    lock_trail trail;
} sequence;

/* Makes the lock ready for frames of this size. Returns an exit code after complaining. */
static int begin(sequence *s, const char *file, iris_size size)
{
    const size_t bytes = IRIS_LOCK_SCRATCH_BYTES(size.w, size.h);
    s->memory = malloc(bytes);
    if (!s->memory) {
        complain(file, "not enough memory");
        return EXIT_BAD_DATA;
    }
    (void)iris_scratch_init(&s->scratch, s->memory, bytes);
    (void)iris_lock_init(&s->lock, size, &s->signatures, 0, NULL);
    s->is_ready = 1;
    return EXIT_DONE;
}

/* Says so when more was taught than the rectangle. */
static void tell_of_more(const iris_lock_result *seen, const iris_rect *rect)
{
    const iris_rect *box = &seen->box;
    if (seen->state == IRIS_LOCK_FOUND && box->w * INT64_C(2) * box->h > INT64_C(3) * rect->w * rect->h) {
        complain("--teach", "the color goes on outside the rectangle: locked on to %d,%d,%d,%d", (int)box->x,
                 (int)box->y, (int)box->w, (int)box->h);
    }
}

/* Follows the object into the frame in s->picture. Returns an exit code. */
static int look(iris_lock_result *result, sequence *s, const char *file)
{
    const iris_image *frame = &s->picture.image;
    const int is_first = !s->is_ready;
    const int exit_code = is_first ? begin(s, file, (iris_size){frame->w, frame->h}) : EXIT_DONE;
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    const iris_size size = s->lock.size;
    if (frame->w != size.w || frame->h != size.h) {
        complain(file, "%dx%d pixels, but the frames before have %dx%d", (int)frame->w, (int)frame->h,
                 (int)size.w, (int)size.h);
        return EXIT_BAD_DATA;
    }
    iris_status status = is_first && s->options->teaches
                             ? iris_lock_teach(result, &s->lock, frame, s->options->rect, &s->scratch)
                             : iris_lock_frame(result, &s->lock, frame, &s->scratch);
    if (status == IRIS_ERR_RANGE) {
        complain("--teach", "the rectangle is not wholly inside of %s (%dx%d)", file, (int)size.w,
                 (int)size.h);
        return EXIT_BAD_CALL;
    }
    if (status != IRIS_OK) {
        complain(file, "%s", iris_status_text(status));
        return EXIT_BAD_DATA;
    }
    if (is_first && s->options->teaches) {
        tell_of_more(result, &s->options->rect);
    }
    return EXIT_DONE;
}

/* Answers the frame in s->picture. Returns an exit code. */
static int answer_frame(void *context, const char *file)
{
    sequence *s = context;
    iris_lock_result result;
    int exit_code = look(&result, s, file);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    lock_report(&result, &(lock_frame){file, s->frame, &s->picture.image}, s->options->json);
    if (!s->options->folder) {
        return EXIT_DONE;
    }
    return lock_overlay_write(s->options->folder, &(lock_frame){file, s->frame, &s->picture.image}, &result,
                              &s->trail);
}

static int follow_input(sequence *s, const char *file)
{
    return frame_sequence_run(&(frame_sequence){&s->picture, &s->frame, answer_frame, s}, file);
}

/* What is taught is in the first frame: without it there is nothing to follow. */
static int cannot_go_on(const sequence *s, int exit_code)
{
    return exit_code == EXIT_BAD_CALL || ferror(stdout) || (s->options->teaches && !s->is_ready);
}

static int run(const lock_options *options, const iris_hsl_range *range, const input_list *inputs)
{
    static sequence s;
    int exit_code = options->folder ? overlay_folder_begin(options->folder, inputs) : EXIT_DONE;
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    s.options = options;
    if (range) {
        (void)iris_signature_from_range(&s.signatures, 0, range);
    }
    for (int i = 0; i < inputs->count && (i == 0 || !cannot_go_on(&s, exit_code)); i++) {
        if (!system_is_terminal(STDOUT_FILENO)) {
            progress_show("lock", i + 1, inputs->count, inputs->paths[i]);
        }
        int code = follow_input(&s, inputs->paths[i]);
        exit_code = code != EXIT_DONE ? code : exit_code;
    }
    progress_clear();
    lock_overlay_end();
    picture_free(&s.picture);
    free(s.memory);
    return exit_code;
}

static int read_signature(iris_hsl_range *range, const char *text)
{
    if (strncmp(text, "hsl:", 4) != 0) {
        complain("--signature", "hsl:" HSL_TEXT ", not '%s'", text);
        return 0;
    }
    return hsl_text_read(range, "--signature", text + 4);
}

int cmd_lock(int argc, char **argv)
{
    static lock_options options;
    const char *teach = NULL, *signature = NULL;
    const args_option known[] = {{"teach", 0, NULL, &teach},
                                 {"signature", 0, NULL, &signature},
                                 {"json", 0, &options.json, NULL},
                                 {"output", 'o', NULL, &options.folder}};
    arguments args = {help, known, sizeof known / sizeof known[0], NULL, 0};
    iris_hsl_range range;
    input_list inputs;
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (!teach == !signature) {
        complain(NULL, "--teach x,y,w,h or --signature hsl:..., one of them (see --help)");
        return EXIT_BAD_CALL;
    }
    if ((teach && !args_rect(&options.rect, "--teach", teach)) ||
        (signature && !read_signature(&range, signature))) {
        return EXIT_BAD_CALL;
    }
    if (args.operand_count == 0) {
        complain(NULL, "no input (see --help)");
        return EXIT_BAD_CALL;
    }
    options.teaches = teach != NULL;
    exit_code = inputs_expand(&inputs, args.operand_count, args.operands);
    int run_code = inputs.count > 0 ? run(&options, signature ? &range : NULL, &inputs) : exit_code;
    inputs_free(&inputs);
    return run_code != EXIT_DONE ? run_code : exit_code;
}
