/* The commands. argv[0] is the command's name; each returns an exit code and has complained unless it is EXIT_DONE. */
#ifndef IRIS_TOOL_COMMANDS_H
#define IRIS_TOOL_COMMANDS_H

int cmd_info(int argc, char **argv);
int cmd_convert(int argc, char **argv);
int cmd_gray(int argc, char **argv);
int cmd_threshold(int argc, char **argv);
int cmd_follow(int argc, char **argv);

#endif
