#include "floor_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "complain.h"

int text_file_read(char *text, size_t room, size_t *length, const char *path)
{
    int is_stdin = strcmp(path, "-") == 0;
    FILE *file = is_stdin ? stdin : fopen(path, "rb");
    if (!file) {
        complain(path, "%s", strerror(errno));
        return 0;
    }
    errno = 0;
    *length = fread(text, 1, room, file);
    int failed = ferror(file), problem = errno;
    if (!is_stdin) {
        fclose(file);
    }
    if (failed) {
        complain(path, "%s", problem ? strerror(problem) : "cannot be read");
    } else if (*length >= room) {
        complain(path, "longer than %d bytes: this is another kind of file", (int)room - 1);
    }
    return !failed && *length < room;
}

int floor_file_read(iris_floor *floor, const char *path)
{
    static char text[TEXT_FILE_BYTES];
    size_t length = 0;
    int32_t line = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    iris_status status = iris_floor_read_text(floor, &line, text, length);
    if (status != IRIS_OK) {
        complain(path, "line %d: %s", (int)line,
                 status == IRIS_ERR_TRUNCATED ? "ends early"
                 : status == IRIS_ERR_UNSUPPORTED
                     ? "a later version of floor file than this iris knows"
                     : "not a floor file, or damaged: make it again by iris floor");
    }
    return status == IRIS_OK;
}

int floor_fits(const iris_floor *floor, const char *file, iris_size size)
{
    if (size.w == floor->size.w && size.h == floor->size.h) {
        return 1;
    }
    complain(file, "%dx%d pixels, but the floor file was made for pictures of %dx%d", (int)size.w,
             (int)size.h, (int)floor->size.w, (int)floor->size.h);
    return 0;
}
