#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "args.h"
#include "camera.h"
#include "commands.h"
#include "complain.h"
#include "follow_camera.h"
#include "follow_options.h"
#include "follow_session.h"
#include "frame_sequence.h"
#include "inputs.h"
#include "overlay_folder.h"
#include "progress.h"
#include "steering.h"
#include "stop_signal.h"
#include "system.h"

static const char help[] =
    "usage: iris follow [options] IN...\n"
    "       iris follow --camera D [options]\n\n"
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
    "  --rate N       frames per second, 1 to 1000, default 30; a camera: as it is set\n"
    "  --overlay DIR  write each frame with what was found drawn in, as a BMP\n" FOLLOW_FLOOR_HELP
    "  --camera D     frames as they come: from a device such as /dev/video0, from libcamera:ID, or from a\n"
    "                 recording that plays at --rate: a file, a folder, - for standard input\n"
    "  --size WxH     the camera's size in pixels, or the nearest it has; default: as it is set\n"
    "  --format F     its format: yuyv, nv12, rgb, gray, ... (iris capture --help); default: any\n"
    "  --frames N     end after so many frames\n"
    "  --timing       at the end: how long frames took from when they were there until their command\n"
    "                 was sent, by percentiles, on standard error; with --json as a last "
    "object\n" STEERING_HELP "\n"
    "angle: degrees, 0 straight ahead, right positive; next: behind a sharp bend. offset, ahead: of the\n"
    "line from the middle at the bottom row and the look-ahead row, 1 is half the width. A line lost for\n"
    "up to 200 ms is stale: its last result is repeated, without rows. After that it is lost.\n"
    "steer: -1 full left to 1 full right, and as wheel angle; speed: 0 to 1. Both are there for lost\n"
    "frames too: the search for the line, then the stop. In JSON, what does not exist is null.\n"
    "When no frame comes for a while the robot is told to stop.\n\n"
    "example: iris follow --rows 40,120,200 --overlay seen frames/\n"
    "         iris follow --junctions --take left,straight frames/\n"
    "         iris follow --camera /dev/video0 --gpio gpiochip0:left=17,right=18,stop=27\n"
    "         camera | iris follow --json -\n"
    "         iris follow --line hsl:50-90:20-100:20-70 yellow/*.bmp\n";

/* The sequence of frames from files. */
typedef struct {
    follow_session session;
    int64_t frame; /* place of the frame among the inputs, 1 first */
    picture_buffer picture;
} sequence;

/* Answers the frame in s->picture. Returns an exit code. */
static int answer_frame(void *context, const char *file)
{
    sequence *s = context;
    const follow_frame frame = {.file = file,
                                .number = s->frame,
                                .time_ms = (s->frame - 1) * 1000 / s->session.options->rate,
                                .image = s->picture.image,
                                .overlay = file};
    return follow_session_answer(&s->session, &frame);
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

/* Follows through a camera, or through files. Returns an exit code. */
static int follow(const follow_options *options, const input_list *inputs)
{
    static sequence s;
    int exit_code;
    follow_session_begin(&s.session, options);
    if (options->camera) {
        exit_code = follow_camera_run(&s.session);
        exit_code = exit_code == EXIT_DONE && camera_recording_is_damaged() ? EXIT_BAD_DATA : exit_code;
    } else {
        for (int i = 0; i < inputs->count; i++) {
            int length = (int)strlen(inputs->paths[i]);
            s.session.name_width =
                length > s.session.name_width && length <= 60 ? length : s.session.name_width;
        }
        exit_code = follow_all(&s, inputs);
    }
    follow_session_end(&s.session);
    picture_free(&s.picture);
    return exit_code;
}

/* Opens what frames come from and the answers go to, and follows. Returns an exit code. */
static int run(const follow_options *options, const input_list *inputs)
{
    int exit_code = options->overlay ? overlay_folder_begin(options->overlay, inputs) : EXIT_DONE;
    if (options->camera) {
        stop_signal_catch();
    }
    if (exit_code == EXIT_DONE &&
        options->steering.used) { /* before the camera, which its process shall not have */
        exit_code = steering_open(&options->steering);
    }
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    if (options->camera) {
        exit_code = follow_camera_begin(options);
    }
    if (exit_code == EXIT_DONE) {
        exit_code = follow(options, inputs);
    }
    if (options->steering.used && steering_stop() != EXIT_DONE && exit_code == EXIT_DONE) {
        exit_code = EXIT_BAD_DATA;
    }
    if (options->camera) {
        follow_camera_end();
    }
    return exit_code;
}

/* Follows what the words name. Returns an exit code. */
static int run_inputs(const follow_options *options, int count, char **words)
{
    input_list inputs;
    int exit_code = inputs_expand(&inputs, count, words);
    int run_code = inputs.count > 0 || options->camera ? run(options, &inputs) : exit_code;
    inputs_free(&inputs);
    return run_code != EXIT_DONE ? run_code : exit_code;
}

/* What belongs together. Returns 0 after complaining. */
static int fits_together(const follow_options *options, const follow_texts *texts, int operand_count)
{
    if (!options->camera && operand_count == 0) {
        complain(NULL, "no input (see --help)");
        return 0;
    }
    if (options->camera && operand_count > 0) {
        complain("--camera", "either a camera or files");
        return 0;
    }
    const char *alone = texts->camera.size     ? "--size"
                        : texts->camera.format ? "--format"
                        : texts->frames        ? "--frames"
                        : options->timing      ? "--timing"
                                               : NULL;
    if (!options->camera && alone) {
        complain(alone, "only together with --camera");
        return 0;
    }
    if (texts->take && !options->junctions.used) {
        complain("--take", "only together with --junctions");
        return 0;
    }
    return 1;
}

int cmd_follow(int argc, char **argv)
{
    static follow_options options;
    follow_texts texts = {0};
    follow_floor_texts floor = {0};
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
                                 {"camera", 0, NULL, &options.camera},
                                 {"size", 0, NULL, &texts.camera.size},
                                 {"format", 0, NULL, &texts.camera.format},
                                 {"frames", 0, NULL, &texts.frames},
                                 {"timing", 0, &options.timing, NULL},
                                 {"serial", 0, NULL, &texts.steering.serial},
                                 {"baud", 0, NULL, &texts.steering.baud},
                                 {"gpio", 0, NULL, &texts.steering.gpio},
                                 {"pwm", 0, NULL, &texts.steering.pwm},
                                 {"watchdog", 0, NULL, &texts.steering.watchdog}};
    arguments args = {help, known, sizeof known / sizeof known[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (!fits_together(&options, &texts, args.operand_count) || !follow_options_read(&options, &texts)) {
        return EXIT_BAD_CALL;
    }
    exit_code = follow_floor_read(&options.floor, &floor);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    options.line.lane = lane;
    return run_inputs(&options, args.operand_count, args.operands);
}
