/* What the tool asks of the operating system: once in posix/, once in windows/. */
#ifndef IRIS_TOOL_SYSTEM_H
#define IRIS_TOOL_SYSTEM_H

#include <stddef.h>
#include <stdint.h>

#include "file_write.h"

/* Before anything else: makes the three standard streams carry bytes as they are, and makes errors of writing errors
 * that a call returns. Returns 0 when the streams cannot be used. */
int system_begin(void);

/* fd: STDOUT_FILENO or STDERR_FILENO. */
int system_is_terminal(int fd);

/* Milliseconds and microseconds from any start; never backwards. */
int64_t system_clock_ms(void);
int64_t system_clock_us(void);

/* Less when a signal comes. */
void system_sleep_ms(int32_t ms);

/* Memory aligned to IRIS_SCRATCH_ALIGN, for free(); null when there is none. */
void *system_scratch(size_t bytes);

/* Does `c` stand between folder and file in a path? */
int system_is_separator(char c);

/* A descriptor to read bytes from, or -1 with errno set. */
int system_open(const char *path);

/* Are both there, and the same file? */
int system_is_same_file(const char *a, const char *b);

/* Returns 0, or -1 with errno set. */
int system_make_folder(const char *path);

/* Is `path` there, and no regular file: a device, a pipe, a folder? */
int system_is_special(const char *path);

/* Writes a new file beside `path`, which then takes its place. Complains; returns 1 when done, 0 when not. */
int system_replace(const char *path, file_writer write, const void *user);

#endif
