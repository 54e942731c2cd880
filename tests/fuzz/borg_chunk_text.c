/* Reads any bytes as texts of chunks. What is accepted is written, and read again as it was. */
#include <stdlib.h>
#include <string.h>

#include "iris/borg/chunk_text.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static char written[BORG_CHUNK_TEXT_BYTES];

static void expect(int good)
{
    if (!good) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    const borg_text text = {(const char *)data, bytes};
    borg_problem problem = {0, 0, NULL};
    size_t position = 0, before = 0;
    for (;;) {
        uint8_t chunk[BORG_CHUNK_BYTES_MAX], again[BORG_CHUNK_BYTES_MAX];
        size_t length = 0, again_length = 0, written_length = 0, again_position = 0;
        const iris_status status =
            borg_chunk_read_text(chunk, sizeof chunk, &length, &position, &problem, &text);
        if (status != IRIS_OK) {
            expect(status != IRIS_ERR_DATA || (problem.line > 0 && problem.column > 0 && problem.expected));
            return 0;
        }
        expect(position > before && position <= bytes);
        before = position;
        expect(borg_chunk_write_text(written, sizeof written, &written_length, chunk, length) == IRIS_OK);
        const borg_text out = {written, written_length};
        expect(borg_chunk_read_text(again, sizeof again, &again_length, &again_position, &problem, &out) ==
               IRIS_OK);
        expect(length == again_length && memcmp(chunk, again, length) == 0);
    }
}
