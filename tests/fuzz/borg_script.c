/* Reads any bytes as a script. What is accepted is formatted to what stays as it is, and its chunks are chunks that
 * their
 * texts give again.
 */
#include <stdlib.h>
#include <string.h>

#include "iris/borg/chunk_text.h"
#include "iris/borg/script.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static borg_script script;
static char once[1 << 20], twice[1 << 20], chunk_text[BORG_CHUNK_TEXT_BYTES];

static void expect(int good)
{
    if (!good) {
        abort();
    }
}

static void same_again(const uint8_t *chunk, size_t length)
{
    uint8_t again[BORG_CHUNK_BYTES_MAX];
    size_t text_length = 0, again_length = 0, position = 0;
    borg_problem problem;
    expect(borg_chunk_check(chunk, length) == IRIS_OK);
    expect(borg_chunk_write_text(chunk_text, sizeof chunk_text, &text_length, chunk, length) == IRIS_OK);
    const borg_text text = {chunk_text, text_length};
    expect(borg_chunk_read_text(again, sizeof again, &again_length, &position, &problem, &text) == IRIS_OK);
    expect(again_length == length && memcmp(again, chunk, length) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    const borg_text text = {(const char *)data, bytes};
    borg_problem problem = {0, 0, NULL};
    uint8_t chunk[BORG_CHUNK_BYTES_MAX];
    size_t length = 0, again = 0;
    if (borg_script_read(&script, &problem, &text) != IRIS_OK) {
        expect(bytes > BORG_TEXT_BYTES_MAX || (problem.line > 0 && problem.column > 0 && problem.expected));
        return 0;
    }
    for (int32_t i = 0; i < script.group_count; i++) {
        if (borg_script_decompose(chunk, sizeof chunk, &length, &script, i) == IRIS_OK) {
            same_again(chunk, length);
        }
    }
    expect(borg_script_format(once, sizeof once, &length, &script, &problem, &text) == IRIS_OK);
    const borg_text formatted = {once, length};
    if (length <= BORG_TEXT_BYTES_MAX) {
        expect(borg_script_format(twice, sizeof twice, &again, &script, &problem, &formatted) == IRIS_OK);
        expect(again == length && memcmp(once, twice, length) == 0);
    }
    return 0;
}
