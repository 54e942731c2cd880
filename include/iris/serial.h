/* IRIS - a serial port for command sentences: the newest command wins, and the control loop never waits.
 *
 * Raw 8N1, no flow control. A send never blocks. A sentence that the port takes only in part is finished by
 * the next calls; while one is unfinished, or still leaving the operating system's queue, newer sentences
 * replace each other and only the newest waits. So the robot reads whole sentences only, and none that was
 * overtaken by more than the one on the wire, however slow the line.
 *
 * A port that disappears is an error that the loop survives: what waited is dropped (a late command is worse
 * than none), and later calls open the path again. The operating system's part is in port/os.
 */
#ifndef IRIS_SERIAL_H
#define IRIS_SERIAL_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The longest sentence, in bytes. */
#define IRIS_SERIAL_SENTENCE_MAX 128

/* Read the counters and `error`; the rest belongs to the functions. */
typedef struct {
    uint32_t sent;       /* sentences that the system took whole; the last may die with the port */
    uint32_t dropped;    /* sentences replaced by a newer one, or lost with the port */
    uint32_t reconnects; /* times that the port was opened again */
    int error;           /* errno of the last failure; 0 before the first */

    const char *path; /* null when closed */
    int32_t baud;
    int32_t reconnect_ms;
    int handle;        /* file descriptor, -1 while the port is away */
    uint32_t tried_ms; /* when the port was lost, or last tried */
    size_t length;     /* of the sentence that is being written; 0 when none */
    size_t written;    /* bytes of it that the operating system took */
    size_t waiting;    /* length of the sentence behind it; 0 when none */
    char sentence[IRIS_SERIAL_SENTENCE_MAX];
    char next[IRIS_SERIAL_SENTENCE_MAX];
} iris_serial;

/* Opens the port at `path` (kept, not copied: it must outlive *serial) and claims it for this program: no
 * other that opens it so gets it, root's neither.
 *   baud          1200, 1800, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 500000, 576000, 921600,
 *                 1000000, 1152000, 1500000, 2000000, 2500000, 3000000, 3500000, or 4000000
 *   reconnect_ms  the least time between two attempts to open a lost port, 0..60000
 *   now_ms        any clock of the caller's that counts milliseconds, here and below; may wrap
 * IRIS_ERR_ARG: null pointer, or a value outside these lists; IRIS_ERR_IO: not opened, and iris_serial_error
 * says why; *serial is ready, and the calls below go on trying: a program may start before its port is there.
 * O(1). */
iris_status iris_serial_open(iris_serial *serial, const char *path, int32_t baud, int32_t reconnect_ms,
                             uint32_t now_ms);

/* Sends a sentence of `length` bytes, 1..IRIS_SERIAL_SENTENCE_MAX, after continuing with what is unfinished.
 * IRIS_OK: the operating system has it whole. IRIS_ERR_FULL: the port is busy; the sentence waits for the
 * next call, and the one that waited before is dropped. IRIS_ERR_IO: the port is away; the sentence is
 * dropped. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: length. O(length), never blocks. */
iris_status iris_serial_send(iris_serial *serial, const char *sentence, size_t length, uint32_t now_ms);

/* Continues with what is unfinished or away, without a new sentence: for the last command before a program
 * ends. IRIS_OK: nothing waits; otherwise like iris_serial_send. */
iris_status iris_serial_continue(iris_serial *serial, uint32_t now_ms);

/* The robot's side: takes what has arrived, up to `capacity` bytes, without waiting; *count may be 0.
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_IO: the port is away, *count is 0. O(capacity). */
iris_status iris_serial_receive(void *bytes, size_t *count, iris_serial *serial, size_t capacity,
                                uint32_t now_ms);

/* Closes the port and gives its claim back; its settings stay as they are, and what waits is dropped. A
 * sentence that the operating system has whole still leaves: closing takes at most its time on the line.
 * Every later call but iris_serial_open returns IRIS_ERR_IO. Null and a second call do nothing. */
void iris_serial_close(iris_serial *serial);

/* Why the port failed last, such as "no such device". Never null; static storage. */
const char *iris_serial_error(const iris_serial *serial);

#ifdef __cplusplus
}
#endif

#endif
