/* Chunks are made from their beginning to their end. What does not fit is noticed, and said when all is done. */
#ifndef IRIS_BORG_CHUNK_BUILD_H
#define IRIS_BORG_CHUNK_BUILD_H

#include "iris/borg/chunk.h"

#define BORG_HANDLER_BYTES 5 /* before its condition */

typedef struct {
    uint8_t *bytes;
    size_t capacity, used; /* used may pass capacity: then it does not fit */
} borg_build;

/* FNV-1a of all but the place of the check itself. */
uint32_t borg_chunk_sum(const uint8_t *chunk, size_t bytes);

void borg_build_start(borg_build *b, uint8_t *bytes, size_t capacity);
void borg_build_byte(borg_build *b, int32_t value);
void borg_build_two(borg_build *b, int32_t value);
void borg_build_term(borg_build *b, const borg_term *term);
void borg_build_action(borg_build *b, const borg_action *action);

/* Opens a handler, whose condition comes next; *at: where it stands. Then its body; then it is closed. */
size_t borg_build_handler(borg_build *b, int repeats, int32_t winners);
void borg_build_body(borg_build *b, size_t at);
void borg_build_close(borg_build *b, size_t at);

/* The header, and the check of the whole. */
typedef struct {
    int32_t ref, units, timeout_s, handlers;
} borg_build_header;

iris_status borg_build_finish(borg_build *b, size_t *bytes, const borg_build_header *header);

#endif
