#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "args.h"
#include "commands.h"
#include "complain.h"
#include "floor_file.h"
#include "follow_options.h"
#include "follow_overlay.h"
#include "follow_port.h"
#include "follow_report.h"
#include "frame_sequence.h"
#include "inputs.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"
#include "overlay_folder.h"
#include "progress.h"
#include "system.h"

static const char help[] =
    "usage: iris follow [options] IN...\n\n"
    "Finds the line on the floor in each frame and says how to steer, in one line per frame, at once.\n"
    "IN is a BMP, PGM, or PPM file, a folder of them, or - for standard input, which may hold\n"
    "several one after another. All of them together are one sequence.\n\n"
    "  --line KIND    dark (default), bright, or hsl:H0-H1,S0-S1,L0-L1 (colons will do, too):\n"
    "                 hue in degrees, saturation and lightness in percent; 350-10 goes through red\n"
    "  --contrast N   percent, 10 to 90, default 35, by which a pixel of the line is darker than the\n"
    "                 floor at least (bright lines: the floor than the line). The line as a whole\n"
    "                 has a fifth of the rest more, 48: lower it for faint lines\n"
    "  --lane         follow the middle between two lines\n"
    "  --estimator E  straight parts by regression (default) or hough\n"
    "  --rows Y,...   the rows to report; default: the look-ahead row (a third from the top),\n"
    "                 the middle, and the bottom in JSON, none in the text\n"
    "  --junctions    tell T, Y, crossings, corners, and ends, and where their branches lead\n"
    "  --take T,...   left, right, or straight: at the next junctions that offer it, one each,\n"
    "                 until that branch is straight ahead; goes with --junctions\n"
    "  --json         one JSON object per frame\n"
    "  --stills       frames have nothing to do with each other: forget between them\n"
    "  --rate N       frames per second, 1 to 1000, default 30\n"
    "  --overlay DIR  write each frame with what was found drawn in, as a BMP\n" FOLLOW_FLOOR_HELP
    "  --serial DEV   send each command to a serial port; files are then paced at --rate\n"
    "  --baud N       its speed, default 115200\n\n"
    "angle: degrees, 0 straight ahead, right positive; next: behind a sharp bend. offset, ahead: of the\n"
    "line from the middle at the bottom row and the look-ahead row, 1 is half the width. A line lost for\n"
    "up to 200 ms is stale: its last result is repeated, without rows. After that it is lost.\n"
    "steer: -1 full left to 1 full right, and as wheel angle; speed: 0 to 1. Both are there for lost\n"
    "frames too: the search for the line, then the stop. In JSON, what does not exist is null.\n\n"
    "example: iris follow --rows 40,120,200 --overlay seen frames/\n"
    "         iris follow --junctions --take left,straight frames/\n"
    "         camera | iris follow --json --serial /dev/ttyUSB0 -\n"
    "         iris follow --line hsl:50-90:20-100:20-70 yellow/*.bmp\n";

/* Where the library works: enough for the largest frame. */
static IRIS_SCRATCH_BUFFER(memory,
                           IRIS_FOLLOW_FULL_SCRATCH_BYTES(IRIS_FOLLOW_SIDE_MAX, IRIS_FOLLOW_SIDE_MAX) +
                               IRIS_FOLLOW_HOUGH_BYTES);

/* The sequence of frames so far. */
typedef struct {
    const follow_options *options;
    int name_width;
    int64_t frame;    /* place of the frame among the inputs, 1 first */
    int64_t answered; /* frames with an answer */
    uint32_t last_ms; /* time of the last of them */
    iris_size size;   /* that the follower is made for; 0x0: none yet */
    iris_follow follow;
    iris_steer steer;
    picture_buffer picture;
} sequence;

/* Makes the follower ready for frames of another size. Returns an exit code after complaining. */
static int change_size(sequence *s, const char *file, iris_size size)
{
    iris_scratch scratch;
    const follow_options *options = s->options;
    if (options->floor.used && !floor_fits(&options->floor.floor, file, size)) {
        return EXIT_BAD_DATA;
    }
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (iris_follow_init_full(&s->follow, size, &options->line, &scratch) != IRIS_OK) {
        complain(file, "%dx%d pixels: sides of 8 to %d can be followed", (int)size.w, (int)size.h,
                 IRIS_FOLLOW_SIDE_MAX);
        return EXIT_BAD_DATA;
    }
    if (options->hough) {
        iris_follow_use_hough(&s->follow, &scratch);
    }
    for (int i = 0; i < options->row_count && s->answered == 0; i++) {
        if (options->rows[i] >= size.h) {
            complain("--rows", "row %d is outside of %s (%dx%d)", (int)options->rows[i], file, (int)size.w,
                     (int)size.h);
            return EXIT_BAD_CALL;
        }
    }
    s->size = size;
    return EXIT_DONE;
}

/* Follows the line into this frame and steers. Returns an exit code after complaining. */
static int look(follow_answer *answer, sequence *s, uint32_t now_ms)
{
    int32_t elapsed_ms = s->answered > 0 ? (int32_t)(now_ms - s->last_ms) : 0;
    if (s->options->stills) {
        iris_follow_forget(&s->follow);
        iris_steer_init(&s->steer, NULL);
        elapsed_ms = 0;
    }
    iris_follow_frame(&answer->line, &s->follow, &s->picture.image, now_ms);
    answer->junctions.count = -1;
    if (s->options->junctions.used) {
        int afresh = s->answered == 0 || s->options->stills;
        int exit_code =
            follow_junctions_look(&answer->junctions, &answer->line, &s->picture.image, &s->options->line,
                                  &s->options->junctions, afresh ? -1 : elapsed_ms);
        if (exit_code != EXIT_DONE) {
            return exit_code;
        }
    }
    follow_floor_steer(&answer->command, &answer->goal, &s->steer, &answer->line, &s->options->floor,
                       elapsed_ms);
    answer->command.seq = (int32_t)(s->answered % 10000); /* --stills too counts sentences */
    answer->wheel_centideg = iris_steer_wheel_centideg(&s->steer, &answer->command);
    s->answered++;
    s->last_ms = now_ms;
    return EXIT_DONE;
}

/* Answers the frame in s->picture. Returns an exit code. */
static int answer_frame(void *context, const char *file)
{
    sequence *s = context;
    const follow_options *options = s->options;
    follow_answer answer = {
        .file = file, .frame = s->frame, .size = {s->picture.image.w, s->picture.image.h}};
    int64_t now_ms = (s->frame - 1) * 1000 / options->rate;
    if (answer.size.w != s->size.w || answer.size.h != s->size.h) {
        int exit_code = change_size(s, file, answer.size);
        if (exit_code != EXIT_DONE) {
            return exit_code;
        }
    }
    int looked = look(&answer, s, (uint32_t)now_ms);
    if (looked != EXIT_DONE) {
        return looked;
    }
    if (options->serial) {
        if (strcmp(file, "-") != 0) {
            follow_port_wait(now_ms);
        }
        follow_port_send(&answer.command);
    }
    follow_report(&answer, options, s->name_width);
    return options->overlay ? follow_overlay_write(options->overlay, &s->picture.image, &answer) : EXIT_DONE;
}

static int follow_input(sequence *s, const char *file)
{
    return frame_sequence_run(&(frame_sequence){&s->picture, &s->frame, answer_frame, s}, file);
}

static int follow_all(sequence *s, const input_list *inputs)
{
    int exit_code = EXIT_DONE;
    for (int i = 0; i < inputs->count && exit_code != EXIT_BAD_CALL && !ferror(stdout); i++) {
        if (!system_is_terminal(STDOUT_FILENO)) {
            progress_show("follow", i + 1, inputs->count, inputs->paths[i]);
        }
        int code = follow_input(s, inputs->paths[i]);
        exit_code = code != EXIT_DONE ? code : exit_code;
    }
    progress_clear();
    return exit_code;
}

/* Opens what the answers go to, and follows. Returns an exit code. */
static int run(const follow_options *options, const input_list *inputs)
{
    static sequence s;
    s.options = options;
    iris_steer_init(&s.steer, NULL);
    for (int i = 0; i < inputs->count; i++) {
        int length = (int)strlen(inputs->paths[i]);
        s.name_width = length > s.name_width && length <= 60 ? length : s.name_width;
    }
    int exit_code = options->overlay ? overlay_folder_begin(options->overlay, inputs) : EXIT_DONE;
    if (exit_code == EXIT_DONE && options->serial) {
        exit_code = follow_port_open(options->serial, options->baud);
    }
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    exit_code = follow_all(&s, inputs);
    if (options->serial && follow_port_stop() != EXIT_DONE && exit_code == EXIT_DONE) {
        exit_code = EXIT_BAD_DATA;
    }
    follow_overlay_end();
    follow_junctions_end();
    picture_free(&s.picture);
    return exit_code;
}

int cmd_follow(int argc, char **argv)
{
    static follow_options options;
    follow_texts texts = {NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    follow_floor_texts floor = {NULL, NULL, NULL, NULL};
    int lane = 0;
    const args_option known[] = {{"floor", 0, NULL, &floor.floor},
                                 {"lookahead", 0, NULL, &floor.lookahead},
                                 {"radius", 0, NULL, &floor.radius},
                                 {"axle", 0, NULL, &floor.axle},
                                 {"line", 0, NULL, &texts.line},
                                 {"contrast", 0, NULL, &texts.contrast},
                                 {"lane", 0, &lane, NULL},
                                 {"estimator", 0, NULL, &texts.estimator},
                                 {"rows", 0, NULL, &texts.rows},
                                 {"junctions", 0, &options.junctions.used, NULL},
                                 {"take", 0, NULL, &texts.take},
                                 {"json", 0, &options.json, NULL},
                                 {"stills", 0, &options.stills, NULL},
                                 {"rate", 0, NULL, &texts.rate},
                                 {"overlay", 0, NULL, &options.overlay},
                                 {"serial", 0, NULL, &options.serial},
                                 {"baud", 0, NULL, &texts.baud}};
    arguments args = {help, known, sizeof known / sizeof known[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (args.operand_count == 0) {
        complain(NULL, "no input (see --help)");
        return EXIT_BAD_CALL;
    }
    if (texts.take && !options.junctions.used) {
        complain("--take", "only together with --junctions");
        return EXIT_BAD_CALL;
    }
    if (texts.baud && !options.serial) {
        complain("--baud", "only together with --serial");
        return EXIT_BAD_CALL;
    }
    if (!follow_options_read(&options, &texts)) {
        return EXIT_BAD_CALL;
    }
    exit_code = follow_floor_read(&options.floor, &floor);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    options.line.lane = lane;
    input_list inputs;
    exit_code = inputs_expand(&inputs, args.operand_count, args.operands);
    int run_code = inputs.count > 0 ? run(&options, &inputs) : exit_code;
    inputs_free(&inputs);
    return run_code != EXIT_DONE ? run_code : exit_code;
}
