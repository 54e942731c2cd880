#include <stdio.h>
#include <string.h>

#include "calibrate.h"
#include "commands.h"
#include "complain.h"

static const char help[] =
    "usage: iris calibrate scene POINTS3D POINTS2D    (iris calibrate scene --help)\n\n"
    "What a camera is and where it stands, from points that are known: scene, from six points in space\n"
    "or more.\n\n"
    "example: iris calibrate scene corners3d.txt corners2d.txt\n";

int cmd_calibrate(int argc, char **argv)
{
    const char *kind = argc > 1 ? argv[1] : "";
    if (strcmp(kind, "scene") == 0) {
        return calibrate_scene(argc - 1, argv + 1);
    }
    if (strcmp(kind, "--help") == 0 || strcmp(kind, "-h") == 0) {
        fputs(help, stdout);
        return EXIT_DONE;
    }
    complain(*kind ? kind : NULL, "scene is to stand behind calibrate (see iris calibrate --help)");
    return EXIT_BAD_CALL;
}
