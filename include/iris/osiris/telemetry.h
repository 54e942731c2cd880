/* Osiris - telemetry: one raw value of one device on the wire, in either direction; and a robot at the other end of it.
 *
 *     $PIRIV,<seq>,<kind>,<channel>,<validity>,<value>{,<value>}*hh\r\n
 *     $PIRIV,42,range,0,V,1234*2F
 *
 * From the robot: what a sensor measured. To it: what an actuator is to do; "drive" as in device.h, so that a robot needs to know
 * no other sentence. Framing is that of command.h: seq 0-9999; kind as in a robot file; channel 0-255; V valid, or N nothing within
 * reach; one to four values of 32 bits, decimals with a minus when negative and without plus or leading zeros, zeros behind the
 * last other value left out (the first stays); hh the XOR of all bytes between $ and *, in upper-case hexadecimal. At most 82
 * bytes with \r\n. Every telemetry has exactly one spelling.
 *
 * A robot that hears neither a drive nor a command for half a second stands still.
 */
#ifndef IRIS_OSIRIS_TELEMETRY_H
#define IRIS_OSIRIS_TELEMETRY_H

#include <stddef.h>

#include "iris/osiris/plan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Room for the longest sentence with \r\n and a terminating 0. */
#define OSIRIS_TELEMETRY_BYTES 83

typedef struct {
    int32_t seq;     /* 0..9999, counts sentences, wraps */
    int32_t channel; /* 0..255 */
    osiris_raw raw;  /* time_ms is not on the wire */
} osiris_telemetry;

/* Writes the sentence, \r\n and a terminating 0 to `sentence` (capacity bytes, OSIRIS_TELEMETRY_BYTES are always enough) and its
 * length without the 0 to *length.
 * IRIS_ERR_ARG: null pointer, or a field outside its range; IRIS_ERR_RANGE: capacity too small. O(length). */
iris_status osiris_telemetry_format(char *sentence, size_t capacity, size_t *length,
                                    const osiris_telemetry *telemetry);

/* Takes bytes in any chunks. A zeroed parser is ready. */
typedef struct {
    char text[OSIRIS_TELEMETRY_BYTES - 1]; /* the sentence so far, from its '$' */
    uint8_t length;                        /* bytes in text; 0 outside a sentence */
} osiris_telemetry_parser;

/* Takes one byte, as iris_command_parse does.
 * IRIS_OK: *telemetry is a whole good sentence that ended with this byte (raw.time_ms is 0); written in this case only.
 * IRIS_ERR_TRUNCATED: nothing yet; IRIS_ERR_DATA: a sentence has ended that is broken, too long, or another's; a '$' in the
 * middle of one answers this, too, and starts the next. IRIS_ERR_ARG: null pointer.
 * A sentence is good when it is what osiris_telemetry_format writes, byte for byte. O(1); O(82) at an end. */
iris_status osiris_telemetry_parse(osiris_telemetry *telemetry, osiris_telemetry_parser *parser, char byte);

/* --- a robot at the other end --- */

/* What one of its devices said last. */
typedef struct {
    osiris_raw raw;
    int32_t is_new;
} osiris_remote_device;

/* Read taken and refused; the rest belongs to the functions. */
typedef struct {
    uint32_t taken;   /* good sentences of devices of the plan */
    uint32_t refused; /* sentences that were broken, or of others */
    const osiris_plan *plan;
    int32_t driver;
    osiris_remote_device *devices;
    osiris_telemetry_parser parser;
    int32_t seq, command_seq;
} osiris_remote;

/* A remote that has said nothing. The plan and devices (plan->device_count of them) must outlive it.
 *   driver  which of the plan's drivers this is
 * IRIS_ERR_ARG: null pointer, a bad plan, or no such driver; nothing is touched. O(devices^2). */
iris_status osiris_remote_init(osiris_remote *remote, osiris_remote_device *devices, const osiris_plan *plan,
                               int32_t driver);

/* Takes what has come, whatever it is. IRIS_ERR_ARG: null pointer. O(count devices / 20). */
iris_status osiris_remote_take(osiris_remote *remote, const void *bytes, size_t count, uint32_t now_ms);

/* As a driver's read: the newest of a device; IRIS_ERR_TIMEOUT: nothing new; IRIS_ERR_UNSUPPORTED: not one of this driver's. */
iris_status osiris_remote_read(osiris_remote *remote, osiris_raw *raw, const osiris_device *device);

/* Room for what osiris_remote_tell writes, with a terminating 0. */
#define OSIRIS_REMOTE_BYTES 128

/* What is to be sent so that an actuator does this: its telemetry. For a drive, the command sentence that robots of command.h
 * know stands before it, with the same speed and steering in permil: one that knows both takes the second.
 *   sentences  OSIRIS_REMOTE_BYTES of them; *length without the 0
 * IRIS_ERR_ARG: null pointer; IRIS_ERR_UNSUPPORTED: not an actuator of this driver's. O(length). */
iris_status osiris_remote_tell(char *sentences, size_t *length, osiris_remote *remote,
                               const osiris_device *device, const osiris_raw *raw);

#ifdef __cplusplus
}
#endif

#endif
