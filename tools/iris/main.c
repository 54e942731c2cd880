/* The command line tool: finds the command and runs it. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "chain.h"
#include "commands.h"
#include "iris/version.h"
#include "system.h"

/* What is not an operation on pictures. */
typedef struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *summary;
} command;

static const command commands[] = {
    {"info", cmd_info, "format, size, bits, and kind of pictures"},
    {"pipe", cmd_pipe, "several operations, one after the other"},
    {"follow", cmd_follow, "the line on the floor, and how to steer"},
    {"floor", cmd_floor, "from marks on the floor to millimeters"},
    {"shape", cmd_shape, "a taught shape, found moved, turned, scaled, and partly hidden"},
    {"lock", cmd_lock, "a colored object, from frame to frame"},
    {"calibrate", cmd_calibrate, "a camera from points that are known"},
    {"rectify", cmd_rectify, "pictures of two cameras, turned so that rows correspond"},
    {"stereo", cmd_stereo, "how far things are, from two cameras side by side"},
    {"carve", cmd_carve, "the shape of a thing from its silhouettes"},
    {"map", cmd_map, "a map of the floor from depths, and where the robot is in it"},
    {"robot", cmd_robot, "a robot file: checked, and shown with what its devices see"},
    {"run", cmd_run, "a robot that does what it is ordered, with a journal that replays"},
    {"borg", cmd_borg, "one script for a team of robots: checked, and a chunk for each group"},
    {"swarm", cmd_swarm, "a whole team of robots in a simulated world: paths, signals, and how it ends"},
    {"cameras", cmd_cameras, "which cameras there are, with formats, sizes, and rates"},
    {"controls", cmd_controls, "a camera's exposure, gain, and what else it lets be set"},
    {"capture", cmd_capture, "a camera's frames into files"},
};

#define COMMAND_COUNT (sizeof commands / sizeof commands[0])

/* Runs the command argv[0]. 0 when there is none of that name. */
static int run_named(int *exit_code, int argc, char **argv)
{
    const operation *found = operation_find(argv[0]);
    if (found) {
        *exit_code = chain_command(found, argc, argv);
        return 1;
    }
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i].name, argv[0]) == 0) {
            *exit_code = commands[i].run(argc, argv);
            return 1;
        }
    }
    return 0;
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
    fputs("\nOperations, each a command, and a stage of iris pipe:\n\n", out);
    for (size_t i = 0; operations[i]; i++) {
        fprintf(out, "  %-12s%s\n", operations[i]->name, operations[i]->summary);
    }
    fputs("\nexample: iris threshold --otsu floor.bmp -o mask.bmp\n"
          "Exit code: 0 done, 1 the data or a device is bad, 2 the call is wrong.\n",
          out);
}

/* iris help [command] */
static int help(char *topic)
{
    char option[] = "--help";
    int exit_code = EXIT_DONE;
    if (!topic) {
        print_help(stdout);
        return EXIT_DONE;
    }
    char *words[] = {topic, option, NULL};
    if (!run_named(&exit_code, 2, words)) {
        complain(topic, "no such command (see iris --help)");
        return EXIT_BAD_CALL;
    }
    return exit_code;
}

static int run(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : NULL;
    int exit_code = EXIT_BAD_CALL;
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
    complain_as(name);
    if (!run_named(&exit_code, argc - 1, argv + 1)) {
        complain_as(NULL);
        complain(name, "no such command (see iris --help)");
    }
    return exit_code;
}

int main(int argc, char **argv)
{
    if (!system_begin()) {
        return EXIT_BAD_DATA;
    }
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
