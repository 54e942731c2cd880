/* The command line tool: finds the command and runs it. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "complain.h"
#include "iris/version.h"

typedef struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *summary;
} command;

static const command commands[] = {
    {"info", cmd_info, "format, size, bits, and kind of pictures"},
    {"convert", cmd_convert, "another format, size, or part of pictures"},
    {"gray", cmd_gray, "color pictures to gray"},
    {"threshold", cmd_threshold, "gray pictures to masks"},
    {"follow", cmd_follow, "the line on the floor, and how to steer"},
};

#define COMMAND_COUNT (sizeof commands / sizeof commands[0])

static const command *find(const char *name)
{
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i].name, name) == 0) {
            return &commands[i];
        }
    }
    return NULL;
}

static void print_help(FILE *out)
{
    fputs("usage: iris <command> [options] IN... [-o OUT]\n"
          "       iris <command> --help\n"
          "       iris --version\n\n"
          "Machine vision for small robots. Reads BMP and PGM/PPM; writes the format of OUT's extension.\n"
          "IN and OUT: a file, a folder, or - for standard input or output.\n\n",
          out);
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        fprintf(out, "  %-12s%s\n", commands[i].name, commands[i].summary);
    }
    fputs("\nexample: iris threshold --otsu floor.bmp -o mask.bmp\n"
          "Exit code: 0 done, 1 the data or a device is bad, 2 the call is wrong.\n",
          out);
}

/* iris help [command] */
static int help(const char *name)
{
    char option[] = "--help";
    const char *topic = name;
    if (!topic) {
        print_help(stdout);
        return EXIT_DONE;
    }
    const command *about = find(topic);
    if (!about) {
        complain(topic, "no such command (see iris --help)");
        return EXIT_BAD_CALL;
    }
    char *words[] = {option, option, NULL};
    return about->run(2, words);
}

static int run(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : NULL;
    if (!name) {
        print_help(stderr);
        return EXIT_BAD_CALL;
    }
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        return help(argc > 2 ? argv[2] : NULL);
    }
    if (strcmp(name, "--version") == 0) {
        puts("iris " IRIS_VERSION_TEXT);
        return EXIT_DONE;
    }
    const command *found = find(name);
    if (!found) {
        complain(name, "no such command (see iris --help)");
        return EXIT_BAD_CALL;
    }
    complain_as(name);
    return found->run(argc - 1, argv + 1);
}

/* A stream that the caller closed is held by something that fails: else the next file opened would get its number, and
 * the robot's port our answers. Returns 0 when that is impossible. */
static int hold_closed_streams(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++) {
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) != fd) {
            return 0;
        }
    }
    return 1;
}

int main(int argc, char **argv)
{
    if (!hold_closed_streams()) {
        return EXIT_BAD_DATA;
    }
    (void)signal(SIGXFSZ, SIG_IGN); /* a file that may not grow is an error of writing */
    int exit_code = run(argc, argv);
    errno = 0;
    if (exit_code != EXIT_BAD_CALL && (fflush(stdout) != 0 || ferror(stdout))) {
        if (exit_code == EXIT_DONE) {
            complain("standard output", "%s", errno ? strerror(errno) : "cannot be written");
        }
        exit_code = EXIT_BAD_DATA;
    }
    return exit_code;
}
