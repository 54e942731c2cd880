/* IRIS - frames from cameras and recordings, one after another, through one interface.
 *
 * Open a source with what is wanted, read what was granted, then borrow a frame and give it back, again and again. A frame
 * is a view of the source's own memory: no pixel is copied. Every wait has an end.
 *
 *     static iris_v4l2 device;
 *     iris_capture camera;
 *     iris_frame frame;
 *     if (iris_capture_open(&camera, iris_v4l2_source(&device), "/dev/video0", NULL) == IRIS_OK) {
 *         while (iris_capture_next(&frame, &camera, 100) == IRIS_OK) {
 *             look(&frame.image);
 *             iris_capture_give(&camera, &frame);
 *         }
 *         iris_capture_close(&camera);
 *     }
 *
 * Sources are in headers of their own: v4l2.h (cameras of the Linux kernel), libcamera.h, and recording.h (files, a folder,
 * standard input). A source of your own is a driver of seven functions, at the end of this header.
 *
 * A camera that is unplugged is an error that the loop survives: iris_capture_next says IRIS_ERR_IO, and goes on trying to
 * open the path again. Meanwhile the robot has to stand still.
 */
#ifndef IRIS_CAPTURE_H
#define IRIS_CAPTURE_H

#include <stddef.h>
#include <stdint.h>

#include "iris/image.h"
#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most buffers that a source may have. */
#define IRIS_CAPTURE_BUFFERS_MAX 8

/* Room for why something failed, with a terminating 0. */
#define IRIS_CAPTURE_PROBLEM_BYTES 256

/* The format of a frame: an iris_format for pixels in one plane, or this: frame.image is the luma (IRIS_GRAY8), and
 * frame.chroma the colors (IRIS_UV88); see nv12.h. */
#define IRIS_CAPTURE_NV12 100

typedef enum {
    IRIS_CAPTURE_EVERY = 0, /* each frame in turn: for recording */
    IRIS_CAPTURE_LATEST /* the newest; older ones that wait go back unseen and are counted: for steering */
} iris_capture_policy;

/* What is wanted. A source gives what comes nearest. A null config and zeros mean what is said here. */
typedef struct {
    iris_size size; /* pixels, each side up to IRIS_SIDE_MAX; 0x0: as the source is set */
    int32_t format; /* an iris_format or IRIS_CAPTURE_NV12, and no other is taken; 0: any that IRIS reads */
    int32_t rate_millihz; /* frames in 1000 seconds, up to 1000000; 0: as the source is set */
    int32_t stride;       /* bytes from row to row, for drivers that can pad; 0: the source's own */
    int32_t buffers;      /* 2 to IRIS_CAPTURE_BUFFERS_MAX; 0: 4. All but one may be borrowed at a time */
    int32_t reconnect_ms; /* the least time between two attempts to open a lost source, 1 to 60000; 0: 250 */
    iris_capture_policy policy;
} iris_capture_config;

typedef enum {
    IRIS_MATRIX_UNKNOWN = 0,
    IRIS_MATRIX_BT601, /* what color.h computes with */
    IRIS_MATRIX_BT709,
    IRIS_MATRIX_BT2020
} iris_color_matrix;

typedef enum {
    IRIS_RANGE_UNKNOWN = 0,
    IRIS_RANGE_LIMITED, /* luma from 16 to 235 */
    IRIS_RANGE_FULL
} iris_color_range;

/* What was granted. */
typedef struct {
    iris_size size;
    int32_t format;       /* an iris_format or IRIS_CAPTURE_NV12 */
    int32_t stride;       /* bytes from row to row */
    int32_t rate_millihz; /* 0: the source does not say */
    int32_t buffers;      /* that may be borrowed at a time, plus one */
    iris_color_matrix matrix;
    iris_color_range range;
} iris_capture_grant;

/* A borrowed frame. The views are valid until it is given back. Do not write to it: some sources' memory cannot be. */
typedef struct {
    iris_image image;  /* NV12: the luma */
    iris_image chroma; /* NV12 only; otherwise its data is null */
    uint64_t sequence; /* of the frame, from 0; a gap is what the source lost */
    int64_t
        time_us; /* of the frame by the source's clock, usually CLOCK_MONOTONIC; not to be trusted with more than
                          a log: drivers have been seen to jump */
    int32_t buffer; /* which of the source's buffers it is */
} iris_frame;

typedef struct iris_capture_driver iris_capture_driver;

/* A driver and the device that it works on, made by a function such as iris_v4l2_source. */
typedef struct {
    const iris_capture_driver *driver;
    void *device; /* handed to the driver's functions; must outlive the capture */
} iris_capture_source;

/* Read the grant and the counters; the rest belongs to the functions. Not to be used from two threads at a time. */
typedef struct {
    iris_capture_grant granted;
    uint64_t frames;   /* borrowed so far */
    uint64_t dropped;  /* lost by the source: gaps in its sequence */
    uint64_t skipped;  /* overtaken by newer ones: IRIS_CAPTURE_LATEST */
    uint64_t damaged;  /* that the source itself called bad, and that were not delivered */
    uint32_t restarts; /* times that the stream broke and was started again */
    uint32_t returns;  /* times that the source was lost and opened again */

    iris_capture_source source;
    const char *path;
    iris_capture_config config;
    int32_t state;
    int32_t restarted;      /* no frame has come since */
    int32_t changed;        /* what returned was something else */
    uint32_t borrowed;      /* a bit for each buffer */
    int32_t counting;       /* 0: the next frame's sequence follows on nothing */
    uint32_t last_sequence; /* by the source's count */
    uint64_t sequence;      /* of the next frame, if nothing is lost */
    int64_t tried_ms;       /* when the source was lost, or last tried */
} iris_capture;

/* Opens the source and starts its stream.
 *   path    what the source's header says (kept, not copied: it must outlive *capture)
 *   config  null: the defaults
 * IRIS_ERR_ARG: null pointer or a config value outside its range; IRIS_ERR_FORMAT: the source offers no format that is
 * wanted and that IRIS reads; IRIS_ERR_RANGE: another thing that it cannot do; IRIS_ERR_IO: not there, busy, or broken;
 * IRIS_ERR_UNSUPPORTED: a kind of device or file that this is no source for. iris_capture_problem says more. After an
 * error nothing is open. Takes what the driver takes, some 100 ms for a camera. */
iris_status iris_capture_open(iris_capture *capture, iris_capture_source source, const char *path,
                              const iris_capture_config *config);

/* Borrows the next frame, and waits for it at most timeout_ms (0 or more) and what one attempt to open takes.
 * IRIS_ERR_TIMEOUT: none came; IRIS_ERR_IO: the source is away, or came back as something else than was granted; the
 * next calls go on trying; IRIS_ERR_END: a recording is over, IRIS_ERR_TRUNCATED: broken, and over; IRIS_ERR_FULL: all
 * frames but one are borrowed; IRIS_ERR_ARG: null pointer, negative time, or not open. *frame is written with IRIS_OK
 * only. O(1) without the wait. */
iris_status iris_capture_next(iris_frame *frame, iris_capture *capture, int32_t timeout_ms);

/* Gives a frame back; its views are gone then. In any order.
 * IRIS_ERR_ARG: null pointer, or not a frame that is borrowed. IRIS_ERR_IO: the source broke, as the next
 * iris_capture_next will say; the frame is given back all the same. O(1). */
iris_status iris_capture_give(iris_capture *capture, const iris_frame *frame);

/* Ends the stream and closes the source; frames still borrowed are gone. Grant and counters stay. Null and a second call
 * do nothing. */
void iris_capture_close(iris_capture *capture);

/* Is there a stream now? 0 while the source is away. O(1). */
int iris_capture_is_running(const iris_capture *capture);

/* Why the source failed last, in words that say what to do. Never null; belongs to the source. */
const char *iris_capture_problem(const iris_capture *capture);

/* What a source consists of: called in this order only, open (start (take give)* stop)* close. Statuses are those above;
 * every function but close may fail, and none may block for long but take. */
struct iris_capture_driver {
    /* Makes the device ready, fills the grant, with 2 buffers or more. After a failure nothing is open. */
    iris_status (*open)(void *device, iris_capture_grant *grant, const char *path,
                        const iris_capture_config *wanted);
    iris_status (*start)(void *device);
    /* The next frame that waits, in order, its sequence by the source's own count of 32 bits. IRIS_ERR_DATA: it is damaged,
     * frame->sequence is set, and it is not borrowed. IRIS_ERR_IO: the stream broke. IRIS_ERR_END, IRIS_ERR_TRUNCATED:
     * there is nothing more, now and later. */
    iris_status (*take)(void *device, iris_frame *frame, int32_t timeout_ms);
    iris_status (*give)(void *device, int32_t buffer);
    /* Frames may still be borrowed: their memory stays, and they are given back later. */
    void (*stop)(void *device);
    void (*close)(void *device);
    const char *(*problem)(const void *device); /* never null */
};

#ifdef __cplusplus
}
#endif

#endif
