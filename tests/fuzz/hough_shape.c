/* A table of a shape from anywhere: the first bytes say how to search, then comes the table, with its sum made right for
 * every other input, so that what lies behind the sum is reached, too. */
#include <stdlib.h>
#include <string.h>

#include "iris/xt/hough_shape.h"

#define POINTS 40

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static uint32_t crc(const uint8_t *table, size_t bytes)
{
    uint32_t sum = 0xFFFFFFFFu;
    for (size_t i = 0; i < bytes; i++) {
        if (i >= 16 && i < 20) {
            continue;
        }
        sum ^= table[i];
        for (int bit = 0; bit < 8; bit++) {
            sum = sum >> 1 ^ (0xEDB88320u & (0u - (sum & 1)));
        }
    }
    return ~sum;
}

/* The head of a table with the number of entries that the bytes have room for. */
static void mend(uint8_t *table, size_t bytes)
{
    size_t entries = (bytes - 150) / 6;
    entries = entries > IRIS_HOUGH_SHAPE_ENTRIES_MAX ? IRIS_HOUGH_SHAPE_ENTRIES_MAX : entries;
    memcpy(table, "IRSH\1", 6);
    table[6] = (uint8_t)entries;
    table[7] = (uint8_t)(entries >> 8);
    size_t entry = 0;
    for (unsigned bin = 0; bin <= 64; bin++) { /* directions that grow */
        while (entry < entries && table[150 + 6 * entry + 5] >> 2 < (int)bin) {
            entry++;
        }
        table[20 + 2 * bin] = (uint8_t)entry;
        table[21 + 2 * bin] = (uint8_t)(entry >> 8);
    }
    uint32_t sum = crc(table, 150 + 6 * entries);
    for (int i = 0; i < 4; i++) {
        table[16 + i] = (uint8_t)(sum >> 8 * i);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    iris_edge_point points[POINTS];
    iris_hough_shape shape;
    iris_hough_shape_config config;
    iris_hough_shape_found found[3];
    int32_t count;
    if (bytes < 8 + 156) {
        return 0;
    }
    uint8_t *table = malloc(bytes - 8);
    memcpy(table, data + 8, bytes - 8);
    if (data[0] & 1) {
        mend(table, bytes - 8);
    }
    iris_hough_shape_defaults(&config);
    config.angle_step = 32768;
    config.polarity = (iris_hough_shape_polarity)(data[0] >> 1 & 1);
    config.scale_min_q16 = 6554 + data[1] * 1024;
    config.scale_max_q16 = config.scale_min_q16 + data[2] * 512;
    config.scale_step_q16 = 100000;
    config.cell = 1 << data[3] % 6;
    config.min_score = 1 + data[4];
    iris_size size = {1 + data[5], 1 + data[6]};
    for (int i = 0; i < POINTS; i++) {
        points[i] = (iris_edge_point){(int16_t)(i * 37 % size.w), (int16_t)(i * data[7] % size.h),
                                      (iris_angle)(i * 1999)};
    }
    config.points = POINTS;
    static IRIS_SCRATCH_BUFFER(
        working, IRIS_HOUGH_SHAPE_SCRATCH_BYTES(256, 256, 1, IRIS_HOUGH_SHAPE_ENTRIES_MAX, POINTS));
    iris_scratch scratch;
    iris_scratch_init(&scratch, working.memory, sizeof working.memory);
    if (iris_hough_shape_begin(&shape, table, bytes - 8, size, &config, &scratch) == IRIS_OK) {
        iris_hough_shape_find(found, 3, &count, &shape, points, POINTS);
    }
    free(table);
    return 0;
}
