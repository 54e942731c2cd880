/* The kinds of iris calibrate: argv[0] is the kind; each returns an exit code. */
#ifndef IRIS_TOOL_CALIBRATE_H
#define IRIS_TOOL_CALIBRATE_H

int calibrate_board(int argc, char **argv);
int calibrate_motion(int argc, char **argv);
int calibrate_rotation(int argc, char **argv);
int calibrate_pair(int argc, char **argv);
int calibrate_scene(int argc, char **argv);
int calibrate_translation(int argc, char **argv);

#endif
