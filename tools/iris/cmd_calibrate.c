#include <stdio.h>
#include <string.h>

#include "calibrate.h"
#include "commands.h"
#include "complain.h"

static const char help[] =
    "usage: iris calibrate scene POINTS3D POINTS2D    (iris calibrate scene --help)\n"
    "       iris calibrate board --board CxR PICTURE...    (iris calibrate board --help)\n"
    "       iris calibrate pair --board CxR --corners-left FILE... --corners-right FILE...\n"
    "                                                     (iris calibrate pair --help)\n"
    "       iris calibrate rotation MATCHES...    (iris calibrate rotation --help)\n"
    "       iris calibrate translation MATCHES...    (iris calibrate translation --help)\n"
    "       iris calibrate motion MOTIONS MATCHES...    (iris calibrate motion --help)\n\n"
    "What a camera is and where it stands, from points that are known: scene, from one picture of six\n"
    "points in space or more; board, from pictures of a flat pattern, with the lens; pair, how two cameras\n"
    "stand to each other, from what both see of a flat pattern. Or from a scene that nobody has\n"
    "measured, by what two pictures show both: rotation, of a camera that only turns; translation, where\n"
    "it moves to; motion, of a camera on a robot whose motions are known.\n\n"
    "example: iris calibrate scene corners3d.txt corners2d.txt\n"
    "         iris calibrate board --board 9x6 --square 25mm left*.pgm\n"
    "         iris calibrate rotation --image-size 640x480 left.txt right.txt\n";

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} kinds[] = {{"scene", calibrate_scene},
             {"board", calibrate_board},
             {"pair", calibrate_pair},
             {"rotation", calibrate_rotation},
             {"translation", calibrate_translation},
             {"motion", calibrate_motion}};

int cmd_calibrate(int argc, char **argv)
{
    const char *kind = argc > 1 ? argv[1] : "";
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (strcmp(kind, kinds[i].name) == 0) {
            return kinds[i].run(argc - 1, argv + 1);
        }
    }
    if (strcmp(kind, "--help") == 0 || strcmp(kind, "-h") == 0) {
        fputs(help, stdout);
        return EXIT_DONE;
    }
    complain(*kind ? kind : NULL, "scene, board, pair, rotation, translation, or motion is to stand behind "
                                  "calibrate (see iris calibrate "
                                  "--help)");
    return EXIT_BAD_CALL;
}
