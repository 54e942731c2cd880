/* Reads any bytes as the text of two cameras. What is accepted is written and read again as it was. */
#include <stdlib.h>
#include <string.h>

#include "iris/3d/pair_text.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    iris_pair pair, again;
    iris_sensor sensors[2];
    int32_t line = 0;
    if (iris_pair_read_text(&pair, &line, (const char *)data, bytes) == IRIS_OK) {
        char text[IRIS_PAIR_TEXT_BYTES];
        size_t length = 0;
        if (iris_pair_write_text(text, sizeof text, &length, &pair) != IRIS_OK ||
            iris_pair_read_text(&again, &line, text, length) != IRIS_OK ||
            memcmp(&again.turn, &pair.turn, sizeof again.turn) != 0 ||
            memcmp(&again.place, &pair.place, sizeof again.place) != 0) {
            abort();
        }
        iris_pair_sensors(sensors, &pair);
    } else if (line < 1 && data) {
        abort();
    }
    return 0;
}
