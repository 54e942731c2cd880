/* Any bytes: the parser never reads outside its memory, and what it accepts is spelled as the formatter
 * spells it. */
#include <stdlib.h>
#include <string.h>

#include "iris/command.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    iris_command_parser parser;
    iris_command_parser_init(&parser);
    for (size_t i = 0; i < size; i++) {
        iris_command command;
        if (iris_command_parse(&command, &parser, (char)data[i]) != IRIS_OK) {
            continue;
        }
        char sentence[IRIS_COMMAND_SENTENCE_BYTES];
        size_t length = 0;
        if (iris_command_format(sentence, sizeof sentence, &length, &command) != IRIS_OK || length > i + 1 ||
            memcmp(sentence, data + i + 1 - length, length) != 0) {
            abort();
        }
    }
    return 0;
}
