#include "file_name.h"

#include "system.h"

const char *file_name(const char *path)
{
    const char *name = path;
    for (const char *at = path; *at != '\0'; at++) {
        if (system_is_separator(*at)) {
            name = at + 1;
        }
    }
    return name;
}
