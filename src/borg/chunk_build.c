#include "chunk_build.h"

#define CHECK_AT 12

uint32_t borg_chunk_sum(const uint8_t *chunk, size_t bytes)
{
    uint32_t sum = 2166136261u;
    for (size_t i = 0; i < bytes; i++) {
        sum = i >= CHECK_AT && i < BORG_CHUNK_HEADER_BYTES ? sum : (sum ^ chunk[i]) * 16777619u;
    }
    return sum;
}

void borg_build_start(borg_build *b, uint8_t *bytes, size_t capacity)
{
    b->bytes = bytes;
    b->capacity = capacity < BORG_CHUNK_BYTES_MAX ? capacity : BORG_CHUNK_BYTES_MAX;
    b->used = BORG_CHUNK_HEADER_BYTES;
}

static void put(const borg_build *b, size_t at, int32_t value)
{
    if (at < b->capacity) {
        b->bytes[at] = (uint8_t)(value & 255);
    }
}

void borg_build_byte(borg_build *b, int32_t value)
{
    put(b, b->used, value);
    b->used++;
}

void borg_build_two(borg_build *b, int32_t value)
{
    borg_build_byte(b, value);
    borg_build_byte(b, value >> 8);
}

void borg_build_term(borg_build *b, const borg_term *term)
{
    borg_build_byte(b, term->op);
    if (term->op < BORG_SIGNAL_KINDS) {
        borg_build_two(b, term->ref);
        borg_build_byte(b, term->machines);
    }
}

void borg_build_action(borg_build *b, const borg_action *action)
{
    borg_build_byte(b, action->verb);
    borg_build_byte(b, action->unit);
    switch (action->verb) {
    case BORG_LINE_FOLLOW:
    case BORG_AUTO_EXPLORE:
    case BORG_TURN:
        borg_build_two(b, action->a);
        break;
    case BORG_GO:
        borg_build_two(b, action->a);
        borg_build_two(b, action->a >> 16);
        borg_build_two(b, action->b);
        borg_build_two(b, action->b >> 16);
        break;
    case BORG_GO_TARGET:
    case BORG_MULTICAST:
        borg_build_byte(b, action->kind);
        borg_build_two(b, action->ref);
        if (action->verb == BORG_GO_TARGET) {
            borg_build_byte(b, action->which);
        }
        break;
    default:
        break;
    }
}

size_t borg_build_handler(borg_build *b, int repeats, int32_t winners)
{
    const size_t at = b->used;
    borg_build_byte(b, repeats);
    borg_build_byte(b, winners);
    b->used = at + BORG_HANDLER_BYTES;
    return at;
}

void borg_build_body(borg_build *b, size_t at)
{
    const size_t condition = b->used - at - BORG_HANDLER_BYTES;
    if (condition > UINT8_MAX) {
        b->used += BORG_CHUNK_BYTES_MAX; /* such a chunk does not fit */
    }
    put(b, at + 2, (int32_t)(condition & 255));
}

void borg_build_close(borg_build *b, size_t at)
{
    const size_t condition = at + 2 < b->capacity ? b->bytes[at + 2] : 0;
    const size_t body = b->used - at - BORG_HANDLER_BYTES - condition;
    put(b, at + 3, (int32_t)(body & 255));
    put(b, at + 4, (int32_t)(body >> 8 & 255));
}

iris_status borg_build_finish(borg_build *b, size_t *bytes, const borg_build_header *header)
{
    const size_t used = b->used;
    if (used > b->capacity || header->handlers > BORG_HANDLERS_MAX) {
        return IRIS_ERR_RANGE;
    }
    b->used = 0;
    borg_build_byte(b, 'B');
    borg_build_byte(b, 'C');
    borg_build_byte(b, 1);
    borg_build_byte(b, header->units);
    borg_build_two(b, header->ref);
    borg_build_two(b, header->timeout_s);
    borg_build_two(b, (int32_t)used);
    borg_build_byte(b, header->handlers);
    borg_build_byte(b, 0);
    const uint32_t sum = borg_chunk_sum(b->bytes, used);
    borg_build_two(b, (int32_t)(sum & 65535));
    borg_build_two(b, (int32_t)(sum >> 16));
    b->used = used;
    *bytes = used;
    return borg_chunk_check(b->bytes, used) == IRIS_OK ? IRIS_OK : IRIS_ERR_RANGE;
}
