/* Any bytes from a robot's line. What is accepted is spelled as it would be written. */
#include "iris/osiris/telemetry.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    osiris_telemetry_parser parser;
    osiris_telemetry t;
    memset(&parser, 0, sizeof parser);
    for (size_t i = 0; i < bytes; i++) {
        char again[OSIRIS_TELEMETRY_BYTES];
        size_t length = 0;
        if (osiris_telemetry_parse(&t, &parser, (char)data[i]) == IRIS_OK &&
            (osiris_telemetry_format(again, sizeof again, &length, &t) != IRIS_OK || length > i + 1 ||
             memcmp(again, data + i + 1 - length, length) != 0)) {
            abort();
        }
    }
    return 0;
}
