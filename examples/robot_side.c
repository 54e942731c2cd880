/* The robot's side of the wire: bytes in any chunks, noise in between, commands out. */
#include <stdio.h>

#include "iris/command.h"

int main(void)
{
    static const char wire[] =
        "boot 0.1 $PIRIS,41,F,-1$PIRIS,42,F,-180,750,-1250,-93,880*27\r\nnoise $PIRIS,43*00\r\n"
        "$PIRIS,42,F,-180,750,-1250,-93,880*27\r\n";
    iris_command_parser parser;
    iris_command command;
    int commands = 0;
    iris_command_parser_init(&parser);
    for (size_t i = 0; i + 1 < sizeof wire; i++) {
        if (iris_command_parse(&command, &parser, wire[i]) == IRIS_OK) {
            int left = command.speed_permil + command.speed_permil * command.steer_permil / 1000;
            int right = command.speed_permil - command.speed_permil * command.steer_permil / 1000;
            printf("command %d: wheels %d and %d permil\n", (int)command.seq, left, right);
            commands++;
        }
    }
    return commands == 2 ? 0 : 1;
}
