#include "overlay_folder.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "complain.h"
#include "file_name.h"
#include "picture_write.h"
#include "system.h"

/* Returns 0 when the path would be too long. */
static int path_of(char path[PATH_MAX], const char *folder, const char *file, int64_t frame)
{
    const char *name = file_name(file);
    const char *dot = strrchr(name, '.');
    int length = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
    int written = strcmp(file, "-") == 0
                      ? snprintf(path, PATH_MAX, "%s/frame_%05lld.bmp", folder, (long long)frame)
                      : snprintf(path, PATH_MAX, "%s/%.*s.bmp", folder, length, name);
    return written < PATH_MAX;
}

/* Makes the folder and the folders that lead to it. Returns 0 with errno set. */
static int make_folder(const char *folder)
{
    char path[PATH_MAX];
    struct stat status;
    if (snprintf(path, sizeof path, "%s", folder) >= (int)sizeof path) {
        errno = ENAMETOOLONG;
        return 0;
    }
    for (char *at = path + 1; *folder != '\0' && *at != '\0'; at++) {
        if (system_is_separator(*at)) {
            char separator = *at;
            *at = '\0';
            (void)system_make_folder(path); /* what went wrong shows at the end */
            *at = separator;
        }
    }
    if (system_make_folder(path) != 0 && errno != EEXIST) {
        return 0;
    }
    errno = ENOTDIR;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static int by_text(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Is `path` there, and the same file as `input`? */
static int is_input(const char *path, const char *input)
{
    return strcmp(input, "-") != 0 && system_is_same_file(path, input);
}

/* Fills paths with where each input's picture goes. Returns an exit code after complaining. */
static int collect_paths(char **paths, const char *folder, const input_list *inputs)
{
    for (int i = 0; i < inputs->count; i++) {
        char path[PATH_MAX];
        if (!path_of(path, folder, inputs->paths[i], 1)) {
            complain(inputs->paths[i], "%s", strerror(ENAMETOOLONG));
            return EXIT_BAD_DATA;
        }
        if (is_input(path, inputs->paths[i])) {
            complain(path, "the overlay would replace the input");
            return EXIT_BAD_CALL;
        }
        paths[i] = strdup(path);
        if (!paths[i]) {
            complain(NULL, "not enough memory");
            return EXIT_BAD_DATA;
        }
    }
    return EXIT_DONE;
}

/* Was one picture meant? */
static int has_picture_name(const char *folder)
{
    static const char *const extensions[] = {".bmp", ".pgm", ".ppm", ".pnm"};
    const size_t length = strlen(folder);
    for (size_t i = 0; i < sizeof extensions / sizeof extensions[0]; i++) {
        if (length > 4 && strcasecmp(folder + length - 4, extensions[i]) == 0) {
            return 1;
        }
    }
    return 0;
}

int overlay_folder_begin(const char *folder, const input_list *inputs)
{
    if (has_picture_name(folder)) {
        complain("-o", "a folder for the pictures of all frames, not '%s'", folder);
        return EXIT_BAD_CALL;
    }
    if (!make_folder(folder)) {
        complain(folder, "%s", strerror(errno));
        return EXIT_BAD_DATA;
    }
    char **paths = calloc((size_t)inputs->count + 1, sizeof *paths);
    if (!paths) {
        complain(NULL, "not enough memory");
        return EXIT_BAD_DATA;
    }
    int exit_code = collect_paths(paths, folder, inputs);
    if (exit_code == EXIT_DONE) {
        qsort(paths, (size_t)inputs->count, sizeof *paths, by_text);
    }
    for (int i = 1; i < inputs->count && exit_code == EXIT_DONE; i++) {
        if (strcmp(paths[i - 1], paths[i]) == 0) {
            complain(paths[i], "more than one overlay would be written there");
            exit_code = EXIT_BAD_CALL;
        }
    }
    for (int i = 0; i < inputs->count; i++) {
        free(paths[i]);
    }
    free(paths);
    return exit_code;
}

int overlay_folder_write(const char *folder, const char *file, int64_t frame, const iris_image *picture)
{
    char path[PATH_MAX];
    if (!path_of(path, folder, file, frame)) {
        complain(file, "%s", strerror(ENAMETOOLONG));
        return EXIT_BAD_DATA;
    }
    return picture_write(path, picture) ? EXIT_DONE : EXIT_BAD_DATA;
}
