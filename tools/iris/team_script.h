/* A script of BorgCode from a file, taken apart into a chunk for each group of robots.
 */
#ifndef IRIS_TOOL_TEAM_SCRIPT_H
#define IRIS_TOOL_TEAM_SCRIPT_H

#include "iris/borg/script.h"

typedef struct {
    uint8_t chunks[BORG_GROUPS_MAX][BORG_CHUNK_BYTES_MAX];
    size_t bytes[BORG_GROUPS_MAX];
    int32_t count;
    uint32_t number; /* of the script: borg_chunk_number */
} team_script;

/* timeout_s: where the script itself names none. Complains, with the place in the script; returns 1, or 0. */
int team_script_read(team_script *script, const char *path, int32_t timeout_s);

#endif
