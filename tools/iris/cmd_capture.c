#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "args.h"
#include "camera.h"
#include "capture_output.h"
#include "commands.h"
#include "complain.h"
#include "overlay_folder.h"
#include "progress.h"
#include "stop_signal.h"
#include "system.h"

static const char help[] =
    "usage: iris capture --device D [options] -o DIR\n\n"
    "Writes a camera's frames into a folder as frame_000001.bmp and so on, by their numbers, so that gaps "
    "are\n"
    "seen, until Ctrl-C. What the camera gives is what comes nearest to what is wanted.\n\n"
    "  --device D    " CAMERA_DEVICE_HELP "  --size WxH    pixels; default: as the camera is set\n"
    "  --format F    gray, rgb, bgr, rgba, rgb565, rgb565-be, yuyv, uyvy, nv12, bayer-rggb, bayer-grbg,\n"
    "                bayer-gbrg, or bayer-bggr; default: any\n"
    "  --rate N      frames per second, such as 30 or 7.5\n"
    "  --frames N    end after so many\n"
    "  --latest      the newest frame each time; default: every frame\n"
    "  --timeout MS  end when no frame comes for so long, 1 to 3600000, default 5000\n"
    "  --raw         the camera's own bytes, rows without padding, as frame_000001.raw, which\n"
    "                iris convert --raw reads\n"
    "  --json        one JSON object per frame, and a last one with what was granted and the counters\n"
    "  -o DIR        the folder, made if it is missing; - for standard output, PGM and PPM one after "
    "another\n\n"
    "example: iris capture --device /dev/video0 --size 640x480 --rate 30 --frames 300 -o frames\n"
    "         iris capture --device /dev/video0 -o - | iris follow -\n";

#define STEP_MS 100

typedef struct {
    const char *device;
    iris_capture_config wanted;
    capture_output output;
    int32_t frames; /* 0: no limit */
    int32_t timeout_ms;
} capture_options;

static void show_progress(const capture_options *options)
{
    const uint64_t frames = camera_capture()->frames;
    progress_show("capture", (int)(frames < INT32_MAX ? frames : INT32_MAX),
                  options->frames > 0 ? options->frames : 0, options->device);
}

/* Writes frame after frame. Complains; returns an exit code. */
static int capture_frames(const capture_options *options)
{
    const iris_capture *capture = camera_capture();
    int64_t seen_ms = system_clock_ms();
    int exit_code = EXIT_DONE, lost = 0;
    while (exit_code == EXIT_DONE && !stop_signal_came() && !ferror(stdout) &&
           (options->frames == 0 || capture->frames < (uint64_t)options->frames)) {
        iris_frame frame;
        iris_status status =
            camera_next(&frame, options->timeout_ms < STEP_MS ? options->timeout_ms : STEP_MS);
        if (status == IRIS_OK) {
            exit_code = capture_output_write(&options->output, &frame);
            camera_give(&frame);
            show_progress(options);
            seen_ms = system_clock_ms();
            lost = 0;
        } else if (status == IRIS_ERR_END) {
            break;
        } else if (status != IRIS_ERR_TIMEOUT && status != IRIS_ERR_IO) {
            complain(options->device, "%s", camera_problem());
            exit_code = EXIT_BAD_DATA;
        } else if (system_clock_ms() - seen_ms >= options->timeout_ms) {
            complain(options->device, "no frame for %d ms", (int)options->timeout_ms);
            exit_code = EXIT_BAD_DATA;
        } else if (status == IRIS_ERR_IO && !lost) {
            complain(options->device, "%s; waiting for it", camera_problem());
            lost = 1;
        }
    }
    progress_clear();
    return exit_code;
}

static int run(const capture_options *options)
{
    const input_list none = {NULL, 0, 0};
    int to_stdout = strcmp(options->output.folder, "-") == 0;
    stop_signal_catch();
    int exit_code = camera_open(options->device, &options->wanted); /* first: no folder without a camera */
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    exit_code = to_stdout ? EXIT_DONE : overlay_folder_begin(options->output.folder, &none);
    if (exit_code == EXIT_DONE) {
        exit_code = capture_frames(options);
        if (!to_stdout) {
            capture_output_end(&options->output, options->device, camera_capture());
        }
    }
    if (exit_code == EXIT_DONE && camera_recording_is_damaged()) {
        complain(options->device, "%llu frames damaged; %s", (unsigned long long)camera_capture()->damaged,
                 camera_problem());
        exit_code = EXIT_BAD_DATA;
    }
    camera_close();
    capture_output_free();
    return exit_code;
}

/* Returns 0 after complaining. */
static int fits_together(const capture_options *options, int operand_count)
{
    const capture_output *output = &options->output;
    if (operand_count > 0 || !options->device || !output->folder) {
        complain(NULL, operand_count > 0  ? "the camera is given by --device"
                       : !options->device ? "no --device (see iris cameras)"
                                          : "no output (-o DIR, or -o -)");
        return 0;
    }
    if (strcmp(output->folder, "-") != 0) {
        return 1;
    }
    if (output->json) {
        complain("--json", "not together with -o -: both would go to standard output");
        return 0;
    }
    if (system_is_terminal(STDOUT_FILENO)) {
        complain("-o", "- would write pictures to the terminal");
        return 0;
    }
    return 1;
}

int cmd_capture(int argc, char **argv)
{
    static capture_options options = {.timeout_ms = 5000};
    camera_texts texts = {0};
    const char *frames = NULL, *timeout = NULL;
    int latest = 0;
    const args_option known[] = {{"device", 0, NULL, &options.device},
                                 {"size", 0, NULL, &texts.size},
                                 {"format", 0, NULL, &texts.format},
                                 {"rate", 0, NULL, &texts.rate},
                                 {"frames", 0, NULL, &frames},
                                 {"latest", 0, &latest, NULL},
                                 {"timeout", 0, NULL, &timeout},
                                 {"raw", 0, &options.output.raw, NULL},
                                 {"json", 0, &options.output.json, NULL},
                                 {"output", 'o', NULL, &options.output.folder}};
    arguments args = {help, known, sizeof known / sizeof known[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    const args_whole numbers[] = {{"--frames", frames, &options.frames, 1, INT32_MAX},
                                  {"--timeout", timeout, &options.timeout_ms, 1, 3600000}};
    if (!fits_together(&options, args.operand_count) || !camera_options_read(&options.wanted, &texts) ||
        !args_wholes(numbers, 2)) {
        return EXIT_BAD_CALL;
    }
    options.wanted.policy = latest ? IRIS_CAPTURE_LATEST : IRIS_CAPTURE_EVERY;
    return run(&options);
}
