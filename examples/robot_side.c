/* The robot's side of the wire: bytes in any chunks, noise in between, wheel speeds out. The wheels stop when no
 * command has come for a while: a cable that is torn off must not leave the robot driving. */
#include <stdio.h>

#include "iris/command.h"

enum { WATCHDOG_MS = 250, STEP_MS = 10 };

/* What the port gives in one step of the motor loop, 10 ms. Silent after the second sentence. */
static const char *receive(int step)
{
    static const char *const chunks[] = {"boot 0.1 $PIRIS,41,F,-1$PIRIS,42,F,-180,7",
                                         "50,-1250,-93,880*27\r\nnoise", "", "$PIRIS,43*00\r\n",
                                         "$PIRIS,42,F,-180,750,-1250,-93,880*27\r\n"};
    return step < (int)(sizeof chunks / sizeof chunks[0]) ? chunks[step] : "";
}

static int within_full_speed(int permil)
{
    return permil > 1000 ? 1000 : permil;
}

int main(void)
{
    iris_command_parser parser;
    iris_command command = {0};
    int silent_ms = 0, commands = 0, stopped = 0;
    iris_command_parser_init(&parser);
    for (int step = 0; step < 40; step++, silent_ms += STEP_MS) {
        iris_command arrived;
        for (const char *byte = receive(step); *byte; byte++) {
            if (iris_command_parse(&arrived, &parser, *byte) == IRIS_OK) {
                command = arrived;
                silent_ms = 0;
                commands++;
            }
        }
        if (silent_ms > WATCHDOG_MS) {
            command.speed_permil = 0;
            stopped = 1;
        }
        int turn = command.speed_permil * command.steer_permil / 1000;
        printf("%3d ms: wheels %4d %4d permil\n", step * STEP_MS,
               within_full_speed(command.speed_permil + turn),
               within_full_speed(command.speed_permil - turn));
    }
    return commands == 2 && stopped ? 0 : 1;
}
