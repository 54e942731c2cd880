/* Where the library has no cameras. */
#include "../camera_tables.h"

#include <stddef.h>

#include "../complain.h"

static int refuse(const char *device)
{
    complain(device, "this build of iris has no cameras");
    return EXIT_BAD_DATA;
}

int camera_tables_cameras(int json)
{
    (void)json;
    return refuse(NULL);
}

int camera_tables_controls(const char *device, int json)
{
    (void)json;
    return refuse(device);
}

int camera_tables_set(const char *device, int count, char **words, int json)
{
    (void)count;
    (void)words;
    (void)json;
    return refuse(device);
}
