#include "digest.h"

#include "iris/command.h"

static iris_command any_command(void)
{
    iris_command command;
    command.seq = digest_between(0, 9999);
    command.state = (iris_line_state)digest_between(0, 2);
    command.steer_permil = digest_between(-1000, 1000);
    command.speed_permil = digest_between(0, 1000);
    command.angle_centideg = digest_between(-9000, 9000);
    command.offset_permil = digest_between(-9999, 9999);
    command.confidence_permil = digest_between(0, 1000);
    return command;
}

static void there_and_back(void)
{
    iris_command_parser parser;
    iris_command_parser_init(&parser);
    for (int i = 0; i < 200; i++) {
        iris_command command = any_command(), received = {0};
        char sentence[IRIS_COMMAND_SENTENCE_BYTES];
        size_t length = 0;
        digest_number(iris_command_format(sentence, sizeof sentence, &length, &command));
        digest_bytes(sentence, length);
        for (size_t j = 0; j < length; j++) {
            char byte = digest_random() % 100 == 0 ? '#' : sentence[j];
            digest_number(iris_command_parse(&received, &parser, byte));
        }
        digest_number(received.seq);
        digest_number(received.angle_centideg);
    }
}

const digest_operation digest_command[] = {
    {"command.there_and_back", there_and_back},
    {NULL, NULL},
};
