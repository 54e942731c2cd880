#include "course.h"

static struct {
    int32_t left, lean;
    uint32_t random;
} course;

void course_set(int32_t left, int32_t lean)
{
    course.left = left;
    course.lean = lean;
}

void sensor_row(uint8_t *row, int32_t y)
{
    int32_t left = course.left + course.lean * (119 - y) / 120;
    for (int32_t x = 0; x < 160; x++) {
        course.random = course.random * 1664525u + 1013904223u;
        int32_t level = 200 - x / 2 + (int32_t)(course.random >> 28) - 8;
        row[x] = (uint8_t)(x >= left && x < left + 14 ? level / 4 : level);
    }
}
