/* Reads any bytes as a world file. What is accepted is a world, whatever is looked for in it. */
#include "iris/osiris/world_text.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    static osiris_world_memory memory;
    osiris_world world;
    osiris_problem problem = {0, NULL};
    if (osiris_world_read_text(&world, &memory, &problem, (const char *)data, bytes) == IRIS_OK) {
        if (osiris_world_check(&world) != IRIS_OK) {
            abort();
        }
        for (int i = 0; i < 8; i++) {
            const osiris_pose at = {i * 1000 - 4000, i << 17, (iris_angle)(i * 9000)},
                              there = {1 << 20, 0, 0};
            iris_angle angle = 0;
            int32_t offset = 0;
            const int32_t range = osiris_world_range(&world, at, 1 << (i + 12));
            if (range < -1 || range > 1 << (i + 12)) {
                abort();
            }
            (void)osiris_world_is_hidden(&world, at, there);
            (void)osiris_world_touches(&world, &angle, at, 200 << i);
            (void)osiris_world_line(&world, &offset, &angle, at, 32 << i);
        }
    } else if (data && (problem.line < 1 || !problem.expected)) {
        abort();
    }
    return 0;
}
