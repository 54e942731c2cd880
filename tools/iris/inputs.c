#include "inputs.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "complain.h"
#include "system.h"

/* Takes over `path`; 0 when there is no memory. */
static int append(input_list *inputs, char *path)
{
    char **grown = path ? realloc(inputs->paths, ((size_t)inputs->count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(path);
        return 0;
    }
    inputs->paths = grown;
    inputs->paths[inputs->count++] = path;
    return 1;
}

static char *joined(const char *folder, const char *name)
{
    size_t bytes = strlen(folder) + strlen(name) + 2;
    char *path = malloc(bytes);
    if (path) {
        snprintf(path, bytes, "%s%s%s", folder, system_is_separator(folder[strlen(folder) - 1]) ? "" : "/",
                 name);
    }
    return path;
}

static int is_picture(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot && dot != name &&
           (strcasecmp(dot, ".bmp") == 0 || strcasecmp(dot, ".pgm") == 0 || strcasecmp(dot, ".ppm") == 0 ||
            strcasecmp(dot, ".pnm") == 0);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Returns 0 after complaining. */
static int append_folder(input_list *inputs, const char *folder)
{
    DIR *directory = opendir(folder);
    int before = inputs->count;
    int has_memory = 1;
    if (!directory) {
        complain(folder, "%s", strerror(errno));
        return 0;
    }
    for (struct dirent *entry = readdir(directory); entry && has_memory; entry = readdir(directory)) {
        if (is_picture(entry->d_name)) {
            has_memory = append(inputs, joined(folder, entry->d_name));
        }
    }
    closedir(directory);
    if (inputs->count == before) {
        complain(folder,
                 has_memory ? "no .bmp, .pgm, .ppm, or .pnm file in this folder" : "not enough memory");
        return 0;
    }
    qsort(inputs->paths + before, (size_t)(inputs->count - before), sizeof *inputs->paths, by_name);
    return 1;
}

int inputs_expand(input_list *inputs, int count, char **operands)
{
    int exit_code = EXIT_DONE;
    *inputs = (input_list){NULL, 0, 0};
    for (int i = 0; i < count; i++) {
        struct stat status;
        int done;
        if (strcmp(operands[i], "-") != 0 && stat(operands[i], &status) == 0 && S_ISDIR(status.st_mode)) {
            inputs->has_folder = 1;
            done = append_folder(inputs, operands[i]);
        } else {
            done = append(inputs, strdup(operands[i]));
        }
        exit_code = done ? exit_code : EXIT_BAD_DATA;
    }
    return exit_code;
}

void inputs_free(input_list *inputs)
{
    for (int i = 0; i < inputs->count; i++) {
        free(inputs->paths[i]);
    }
    free(inputs->paths);
    inputs->paths = NULL;
    inputs->count = 0;
}
