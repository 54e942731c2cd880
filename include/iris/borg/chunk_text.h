/* IRIS - chunks of BorgCode as people read and change them:
 *
 *     chunk     = [CHUNK number] line UNITS=n [TIMEOUT=s] ( "[" {handler} "]" [;] | {handler} ENDS line )
 *     handler   = [WHILE] condition : ( actions [;] | UNITS=k "[" {handler} "]" [;] )
 *     condition = {AND and OR, AND first} of [NOT] ( "(" condition ")" | Signal(name) | Signal(name, line) |
 *                 Signal(name, line(k)) )
 *     actions   = [UNITS(k).]action {, ...}
 *     action    = LineFollow | LineFollow(mm/s) | ObjDetect | AutoExplore | AutoExplore(mm/s) | MapBuild | Go(x, y) |
 *                 Go(name.Target, line(k)) | Turn(degrees) | Stop | ResetTime | Multicast(name, line)
 *
 * Words in any case, // comments, line breaks anywhere between words. The first form with brackets is written. Without
 * a TIMEOUT it is BORG_TIMEOUT_S.
 */
#ifndef IRIS_BORG_CHUNK_TEXT_H
#define IRIS_BORG_CHUNK_TEXT_H

#include "iris/borg/chunk.h"
#include "iris/borg/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_CHUNK_TEXT_BYTES 16384 /* of any chunk, with its 0 */

/* Writes a chunk and a 0; *length without the 0. IRIS_ERR_ARG: a null pointer; IRIS_ERR_RANGE: it does not fit, text
 * and
 * length are untouched where `capacity` is below 1 (else text is undefined); others as borg_chunk_check. O(length). */
iris_status borg_chunk_write_text(char *text, size_t capacity, size_t *length, const uint8_t *chunk,
                                  size_t bytes);

/* Reads the chunk that begins at text[*position] and moves *position behind it. *bytes: of the chunk, which is checked.
 * IRIS_ERR_END: nothing but comments was left. IRIS_ERR_ARG: a null pointer, a position behind the end, more than
 * BORG_TEXT_BYTES_MAX bytes; IRIS_ERR_DATA: *problem says where and what; IRIS_ERR_RANGE: more than `capacity` or
 * BORG_CHUNK_BYTES_MAX bytes of bytecode. chunk is undefined then. O(length). */
iris_status borg_chunk_read_text(uint8_t *chunk, size_t capacity, size_t *bytes, size_t *position,
                                 borg_problem *problem, const borg_text *text);

#ifdef __cplusplus
}
#endif

#endif
