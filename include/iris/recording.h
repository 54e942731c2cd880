/* IRIS - recordings that play as a camera: pictures from a file, a folder, or standard input, through capture.h.
 *
 *     static uint8_t memory[IRIS_RECORDING_BYTES(320, 240, 3)];
 *     static iris_recording device = {memory, sizeof memory};
 *     iris_capture_config wanted = {.rate_millihz = 30000, .policy = IRIS_CAPTURE_LATEST};
 *     iris_capture_open(&camera, iris_recording_source(&device), "frames", &wanted);
 *
 * The path is a BMP, PGM, or PPM file; a folder of them, which play in the order of their names (frame10 before frame2:
 * number with leading zeros); or "-", standard input. A file and standard input hold one picture or several, one after
 * another; of a file in a folder the first counts.
 *
 * All frames have the size of the first good picture, and one format: what is wanted, IRIS_GRAY8, IRIS_RGB888, or
 * IRIS_BGR888, or else IRIS_GRAY8 or IRIS_RGB888, whichever the first good picture holds. A wanted size or stride changes
 * nothing. One frame may be borrowed at a time.
 *
 * With a rate, frame n is due n frame times after the start, and comes no sooner. IRIS_CAPTURE_EVERY delivers what is
 * overdue at once, one after the other, and loses none. IRIS_CAPTURE_LATEST leaves out what a later frame that is due,
 * too, has overtaken; such frames are counted as dropped, as those of a camera whose buffers were full. The last frame
 * always comes. A sender on standard input that is late shifts the times of all that follows. Without a rate every
 * frame comes as soon as it is asked for, with either policy.
 *
 * A picture of a folder that cannot be read, or has another size, is damaged: it is counted, and the others go on.
 * Another size is no more than that in a file or on standard input either; but what is broken there has no end that could
 * be found, so that the recording ends with IRIS_ERR_TRUNCATED. Recordings that are over stay so.
 */
#ifndef IRIS_RECORDING_H
#define IRIS_RECORDING_H

#include <stddef.h>
#include <stdint.h>

#include "iris/bmp.h"
#include "iris/capture.h"
#include "iris/pnm.h"
#include "iris/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Memory for frames of w x h pixels; bytes_per_pixel is 1 for IRIS_GRAY8 and 3 for the others. */
#define IRIS_RECORDING_BYTES(w, h, bytes_per_pixel) ((size_t)(w) * (size_t)(h) * (size_t)(bytes_per_pixel))

/* How long standard input may take: until its first picture begins, when it is opened; for the header of a picture; and
 * for its pixels. Between two pictures it may be silent for as long as it likes. */
#define IRIS_RECORDING_FIRST_MS   10000
#define IRIS_RECORDING_PICTURE_MS 2000

/* Names of a folder that are read at a time. Each costs 256 bytes here, and all files of the folder are looked at once
 * for every so many pictures. */
#define IRIS_RECORDING_NAMES      16
#define IRIS_RECORDING_NAME_BYTES 256

/* Set memory and bytes; the rest belongs to the functions. Do not copy it while it is open. */
typedef struct {
    void *memory; /* for one frame: IRIS_RECORDING_BYTES */
    size_t bytes;

    /* Private. Where pictures come from: */
    int folder;          /* descriptor; -1: not a folder */
    int handle;          /* descriptor of the file that is open; -1: none */
    int64_t until_ms;    /* bytes that have not come by then do not come */
    int stalled;         /* that has happened */
    size_t first, count; /* bytes waiting in `buffer` */
    uint8_t buffer[16384];
    char names[IRIS_RECORDING_NAMES][IRIS_RECORDING_NAME_BYTES]; /* that follow, in order */
    char last[IRIS_RECORDING_NAME_BYTES];                        /* the name that was taken last */
    int32_t name_count, next_name;
    /* The picture that has begun: */
    int begun;
    iris_stream stream;
    iris_picture_kind kind;
    iris_bmp_reader bmp;
    iris_pnm_reader pnm;
    /* Frames: */
    iris_size size;
    iris_format format;
    int32_t rate_millihz;
    iris_capture_policy policy;
    int64_t start_us; /* when frame 0 was due */
    int64_t index;    /* of the frame that comes next */
    int held;         /* it is in memory */
    int borrowed;
    iris_status over; /* IRIS_OK until there is nothing more */
    char problem[IRIS_CAPTURE_PROBLEM_BYTES];
} iris_recording;

/* A source that plays what iris_capture_open is given as the path. device, with its memory, must outlive the capture.
 * Opening fails with the errors of iris_capture_open, IRIS_ERR_IO also when there is no picture in the folder or none
 * comes, and with IRIS_ERR_SCRATCH: the memory is too small for a frame, and the problem says how much it takes.
 * A frame costs the reading of its picture; while one is coming in on standard input, iris_capture_next may take twice
 * IRIS_RECORDING_PICTURE_MS longer than its timeout. */
iris_capture_source iris_recording_source(iris_recording *device);

#ifdef __cplusplus
}
#endif

#endif
