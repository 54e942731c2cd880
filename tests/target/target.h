/* What a program without an operating system has: a way to speak, and its stack. */
#ifndef IRIS_TEST_TARGET_H
#define IRIS_TEST_TARGET_H

#include <stdint.h>

void target_print(const char *text);
void target_putc(int c);

/* The deepest that the stack has been since reset, in bytes. */
uint32_t target_stack_used(void);

#endif
