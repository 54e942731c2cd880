/* The part of iris borg that runs a team; argv[0] is "run". */
#ifndef IRIS_TOOL_CMD_BORG_RUN_H
#define IRIS_TOOL_CMD_BORG_RUN_H

/* Returns an exit code. */
int cmd_borg_run(int argc, char **argv);

#endif
