#include <stdio.h>
#include <string.h>

#include "calibrate.h"
#include "commands.h"
#include "complain.h"

static const char help[] =
    "usage: iris calibrate scene POINTS3D POINTS2D    (iris calibrate scene --help)\n"
    "       iris calibrate board --board CxR PICTURE...    (iris calibrate board --help)\n\n"
    "What a camera is and where it stands, from points that are known: scene, from one picture of six\n"
    "points in space or more; board, from pictures of a flat pattern, with the lens.\n\n"
    "example: iris calibrate scene corners3d.txt corners2d.txt\n"
    "         iris calibrate board --board 9x6 --square 25mm left*.pgm\n";

int cmd_calibrate(int argc, char **argv)
{
    const char *kind = argc > 1 ? argv[1] : "";
    if (strcmp(kind, "scene") == 0) {
        return calibrate_scene(argc - 1, argv + 1);
    }
    if (strcmp(kind, "board") == 0) {
        return calibrate_board(argc - 1, argv + 1);
    }
    if (strcmp(kind, "--help") == 0 || strcmp(kind, "-h") == 0) {
        fputs(help, stdout);
        return EXIT_DONE;
    }
    complain(*kind ? kind : NULL, "scene or board is to stand behind calibrate (see iris calibrate --help)");
    return EXIT_BAD_CALL;
}
