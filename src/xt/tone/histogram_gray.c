#include "histogram_gray.h"

#include <string.h>

/* Gray levels are counted in two tables in turn: neighbors are alike, and an increment that waits for the one before takes
 * several times as long. The second table has room for so many pixels. */
#define SECOND_MAX 65535

typedef struct {
    uint16_t count[256];
    int32_t used; /* at most this in one of them */
} second_table;

static void add_second(uint32_t histogram[256], second_table *second)
{
    for (int32_t p = 0; p < 256; p++) {
        histogram[p] += second->count[p];
    }
    memset(second, 0, sizeof *second);
}

/* n is at most IRIS_SIDE_MAX. */
static void count_bytes(uint32_t histogram[256], second_table *second, const uint8_t *row, int32_t n)
{
    int32_t x = 0;
    if (second->used > SECOND_MAX - n) {
        add_second(histogram, second);
    }
    second->used += n;
    for (; x + 2 <= n; x += 2) {
        uint32_t first = row[x], next = row[x + 1];
        histogram[first]++;
        second->count[next]++;
    }
    if (x < n) {
        histogram[row[x]]++;
    }
}

void iris_histogram_count_gray(uint32_t histogram[256], const iris_image *src)
{
    second_table second;
    memset(&second, 0, sizeof second);
    for (int32_t y = 0; y < src->h; y++) {
        count_bytes(histogram, &second, (const uint8_t *)iris_image_row(src, y), src->w);
    }
    add_second(histogram, &second);
}
