#include "team_script.h"

#include <stdio.h>

#include "complain.h"
#include "floor_file.h"

/* file:line:column: what was expected */
static int complain_at(const char *path, const borg_problem *problem)
{
    char place[1200];
    snprintf(place, sizeof place, "%.1150s:%d:%d", path, (int)problem->line, (int)problem->column);
    complain(place, "%s", problem->expected);
    return 0;
}

int team_script_read(team_script *script, const char *path, int32_t timeout_s)
{
    static char source[BORG_TEXT_BYTES_MAX];
    static borg_script read;
    borg_problem problem;
    borg_text text = {source, 0};
    if (!text_file_read(source, sizeof source, &text.length, path)) {
        return 0;
    }
    if (borg_script_read(&read, &problem, &text) != IRIS_OK) {
        return complain_at(path, &problem);
    }
    read.timeout_s = read.timeout_s ? read.timeout_s : (uint16_t)timeout_s;
    script->number = 0;
    for (script->count = 0; script->count < read.group_count; script->count++) {
        const int32_t i = script->count;
        if (borg_script_decompose(script->chunks[i], BORG_CHUNK_BYTES_MAX, &script->bytes[i], &read, i) !=
            IRIS_OK) {
            complain(path, "a chunk is too long"); /* which was seen before */
            return 0;
        }
        script->number = borg_chunk_number(script->number, script->chunks[i], script->bytes[i]);
    }
    return 1;
}
