/* IRIS - a steering command as plain data, and its sentence on the wire.
 *
 * The sentence follows NMEA 0183's framing, so that any serial terminal can show it:
 *
 *     $PIRIS,<seq>,<state>,<steer>,<speed>,<angle>,<offset>,<confidence>*hh\r\n
 *     $PIRIS,42,F,-180,750,-1250,-93,880*27
 *
 * seq 0-9999; state F found, S stale, L lost; steer, speed, offset, and confidence in permil; angle in
 * hundredths of a degree; decimals with a minus when negative, without plus or leading zeros; hh the XOR of
 * all bytes between $ and *, in upper-case hexadecimal. At most 82 bytes with \r\n, as NMEA has it (with
 * today's fields at most 46). Every command has exactly one spelling.
 *
 * The robot stops by itself when no sentence has come for some frames (examples/robot_side.c): the sender may be gone.
 */
#ifndef IRIS_COMMAND_H
#define IRIS_COMMAND_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Room for the longest sentence with \r\n and a terminating 0. */
#define IRIS_COMMAND_SENTENCE_BYTES 83

typedef enum {
    IRIS_LINE_LOST = 0, /* no line for longer than the hold time, or never one */
    IRIS_LINE_STALE,    /* no line in this frame: the last result is repeated */
    IRIS_LINE_FOUND     /* the line is in this frame */
} iris_line_state;

typedef struct {
    int32_t seq; /* 0..9999, counts sentences, wraps */
    iris_line_state state;
    int32_t steer_permil;      /* -1000 full left .. 1000 full right */
    int32_t speed_permil;      /* 0 stop .. 1000 full speed */
    int32_t angle_centideg;    /* -9000..9000, the line at the robot; 0 when lost */
    int32_t offset_permil;     /* -9999..9999, at the bottom row, 1000 = half the image width; 0 when lost */
    int32_t confidence_permil; /* 0..1000 */
} iris_command;

/* Writes the sentence, \r\n and a terminating 0 to `sentence` (capacity bytes, IRIS_COMMAND_SENTENCE_BYTES
 * are always enough) and its length without the 0 to *length.
 * IRIS_ERR_ARG: null pointer, or a field outside its range; IRIS_ERR_RANGE: capacity too small. O(length). */
iris_status iris_command_format(char *sentence, size_t capacity, size_t *length, const iris_command *command);

/* The robot's side: takes bytes in any chunks. A zeroed parser is ready. */
typedef struct {
    char text[IRIS_COMMAND_SENTENCE_BYTES - 1]; /* the sentence so far, from its '$' */
    uint8_t length;                             /* bytes in text; 0 outside a sentence */
} iris_command_parser;

/* Makes *parser ready; forgets a sentence that has begun. Null is allowed and does nothing. O(1). */
void iris_command_parser_init(iris_command_parser *parser);

/* Takes one byte.
 * IRIS_OK: *command is a whole good sentence that ended with this byte; written in this case only.
 * IRIS_ERR_TRUNCATED: nothing yet (the usual answer), or a byte outside any sentence.
 * IRIS_ERR_DATA: a sentence has ended that is broken, too long, or another talker's; it is dropped. A '$' in
 * the middle of a sentence answers this too, and starts the next, so a good sentence behind garbage is never
 * lost.
 * IRIS_ERR_ARG: null pointer.
 * A sentence is good when it is, byte for byte, what iris_command_format writes for the command in it; it
 * ends with \r\n, and a bare \n is refused. O(1); O(82) for the byte that ends a sentence. */
iris_status iris_command_parse(iris_command *command, iris_command_parser *parser, char byte);

#ifdef __cplusplus
}
#endif

#endif
