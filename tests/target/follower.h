/* A line-following robot's whole vision: rows of 160 gray pixels in, a sentence per frame out, no frame buffer. */
#ifndef IRIS_TEST_FOLLOWER_H
#define IRIS_TEST_FOLLOWER_H

#include <stdint.h>

#define FOLLOWER_W 160
#define FOLLOWER_H 120

/* Bytes that all of this needs, besides the stack and the sensor's row. */
uint32_t follower_memory(void);

/* 0 when ready. */
int follower_start(void);

/* One frame: asks the sensor for each row, top first. The sentence, or null on an error. */
const char *follower_frame(void (*sensor)(uint8_t *row, int32_t y), uint32_t now_ms);

#endif
