/* Reads any bytes as a map's text. What is accepted is written and read again as it was. */
#include "iris/3d/map_text.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    iris_map_text map, again;
    int32_t line = 0;
    if (iris_map_read_text(&map, &line, (const char *)data, bytes) == IRIS_OK) {
        char text[IRIS_MAP_TEXT_BYTES];
        size_t length = 0;
        if (iris_map_write_text(text, sizeof text, &length, &map) != IRIS_OK ||
            iris_map_read_text(&again, &line, text, length) != IRIS_OK || again.cell_mm != map.cell_mm ||
            again.left_mm != map.left_mm || again.bottom_mm != map.bottom_mm ||
            strcmp(again.image, map.image) != 0) {
            abort();
        }
    } else if (line < 1 && data) {
        abort();
    }
    return 0;
}
