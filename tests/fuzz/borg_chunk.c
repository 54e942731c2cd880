/* Takes any bytes as bytecode: with the header's check made right, so that what stands in it is looked at. Readers
 * stay inside
 * of it; what is accepted has a text that gives it again.
 */
#include <stdlib.h>
#include <string.h>

#include "iris/borg/chunk_text.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static char text[BORG_CHUNK_TEXT_BYTES];

static void read_all(borg_reader r, int depth)
{
    borg_handler h;
    borg_term term;
    borg_action action;
    while (borg_handler_next(&h, &r)) {
        while (borg_term_next(&term, &h.condition)) {
        }
        if (h.winners && depth < 1) {
            read_all(h.body, depth + 1);
        }
        while (borg_action_next(&action, &h.body)) {
        }
    }
}

static void repair(uint8_t *chunk, size_t bytes)
{
    uint32_t sum = 2166136261u;
    memcpy(chunk, "BC\1", 3);
    chunk[8] = (uint8_t)bytes;
    chunk[9] = (uint8_t)(bytes >> 8);
    chunk[11] = 0;
    for (size_t i = 0; i < bytes; i++) {
        sum = i >= 12 && i < 16 ? sum : (sum ^ chunk[i]) * 16777619u;
    }
    for (int i = 0; i < 4; i++) {
        chunk[12 + i] = (uint8_t)(sum >> 8 * i);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    uint8_t again[BORG_CHUNK_BYTES_MAX];
    size_t length = 0, again_length = 0, position = 0;
    borg_problem problem;
    (void)borg_chunk_check(data, bytes);
    const borg_reader any = {data, data + bytes};
    read_all(any, 0);
    if (bytes < BORG_CHUNK_HEADER_BYTES || bytes > BORG_CHUNK_BYTES_MAX) {
        return 0;
    }
    uint8_t *chunk = malloc(bytes);
    memcpy(chunk, data, bytes);
    repair(chunk, bytes);
    if (borg_chunk_check(chunk, bytes) == IRIS_OK) {
        read_all(borg_chunk_handlers(chunk), 0);
        const iris_status status = borg_chunk_write_text(text, sizeof text, &length, chunk, bytes);
        const borg_text of = {text, length};
        if (status != IRIS_OK ||
            borg_chunk_read_text(again, sizeof again, &again_length, &position, &problem, &of) != IRIS_OK ||
            again_length != bytes || memcmp(again, chunk, bytes) != 0) {
            abort();
        }
    }
    free(chunk);
    return 0;
}
