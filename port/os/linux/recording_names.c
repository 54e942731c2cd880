/* The pictures of a folder in the order of their names, without a list of all of them. */
#include "recording_parts.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static int is_picture(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot && dot != name &&
           (strcasecmp(dot, ".bmp") == 0 || strcasecmp(dot, ".pgm") == 0 || strcasecmp(dot, ".ppm") == 0 ||
            strcasecmp(dot, ".pnm") == 0);
}

/* Puts the name among those that follow device->last, of which the first IRIS_RECORDING_NAMES are kept. */
static void insert(iris_recording *device, const char *name)
{
    int32_t count = device->name_count, at = count;
    size_t bytes = strlen(name) + 1;
    if (bytes > IRIS_RECORDING_NAME_BYTES || strcmp(name, device->last) <= 0) {
        return;
    }
    while (at > 0 && strcmp(name, device->names[at - 1]) < 0) {
        at--;
    }
    if (at == IRIS_RECORDING_NAMES) {
        return;
    }
    int32_t behind = (count < IRIS_RECORDING_NAMES ? count : IRIS_RECORDING_NAMES - 1) - at;
    memmove(device->names[at + 1], device->names[at], (size_t)behind * IRIS_RECORDING_NAME_BYTES);
    memcpy(device->names[at], name, bytes);
    device->name_count = at + behind + 1;
}

static int list_names(iris_recording *device)
{
    int copy = openat(device->folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *directory = copy >= 0 ? fdopendir(copy) : NULL;
    if (!directory) {
        iris_recording_say(device, NULL, iris_recording_reason(errno));
        if (copy >= 0) {
            (void)close(copy);
        }
        return 0;
    }
    device->name_count = device->next_name = 0;
    for (struct dirent *entry = readdir(directory); entry; entry = readdir(directory)) {
        if (is_picture(entry->d_name)) {
            insert(device, entry->d_name);
        }
    }
    (void)closedir(directory);
    return 1;
}

int32_t iris_recording_names_left(iris_recording *device, int32_t wanted)
{
    /* a list that was not full has the last name in it */
    if (device->name_count - device->next_name < wanted && device->name_count == IRIS_RECORDING_NAMES &&
        !list_names(device)) {
        return -1;
    }
    int32_t left = device->name_count - device->next_name;
    return left < wanted ? left : wanted;
}

void iris_recording_next_name(iris_recording *device)
{
    memcpy(device->last, device->names[device->next_name++], IRIS_RECORDING_NAME_BYTES);
}

void iris_recording_first_name(iris_recording *device)
{
    device->last[0] = '\0';
    device->name_count = device->next_name = IRIS_RECORDING_NAMES;
}
