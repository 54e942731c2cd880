/* What the robot's sensor sees in the tests: a floor in uneven light, noise, and a dark line. And the other hooks of
 * examples/firmware_follow.c. */
#ifndef IRIS_TEST_COURSE_H
#define IRIS_TEST_COURSE_H

#include <stddef.h>
#include <stdint.h>

/* The line's left edge in the bottom row, and how many pixels it moves to the right over the whole height, going up.
 * A line outside the picture is no line. */
void course_set(int32_t left, int32_t lean);

/* Row y of 160 pixels, 0 at the top of 120. */
void sensor_row(uint8_t *row, int32_t y);

int sensor_frame(void);
uint32_t board_milliseconds(void);
void uart_send(const char *bytes, size_t count);

#endif
