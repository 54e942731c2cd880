/* What tests of cameras count before and after: open files, and pieces of devices' memory. */
#ifndef VIDEO_CAMERA_H
#define VIDEO_CAMERA_H

#include <dirent.h>
#include <stdio.h>
#include <time.h>

#include "test.h"

static inline int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static inline int open_files(void)
{
    int count = 0;
    DIR *folder = opendir("/proc/self/fd");
    assert_non_null(folder);
    while (readdir(folder)) {
        count++;
    }
    closedir(folder);
    return count;
}

/* Mappings of files whose name has that in it. */
static inline int mappings(const char *part)
{
    char line[512];
    int count = 0;
    FILE *file = fopen("/proc/self/maps", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        count += strstr(line, part) != NULL;
    }
    (void)fclose(file);
    return count;
}

#endif
