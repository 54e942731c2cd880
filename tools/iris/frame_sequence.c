#include "frame_sequence.h"

#include <stdio.h>
#include <string.h>

#include "complain.h"
#include "frame_reader.h"

int frame_sequence_run(const frame_sequence *sequence, const char *file)
{
    static frame_reader reader;
    int is_stdin = strcmp(file, "-") == 0, exit_code = EXIT_DONE, code = EXIT_DONE;
    iris_status status = frame_reader_open(&reader, file);
    do {
        status = status == IRIS_OK ? frame_reader_next(&reader, sequence->picture, IRIS_RGB888) : status;
        *sequence->frame += status != IRIS_ERR_END;
        if (status == IRIS_OK) {
            code = sequence->answer(sequence->context, file);
            exit_code = code != EXIT_DONE ? code : exit_code;
        }
    } while (is_stdin && status == IRIS_OK && code == EXIT_DONE && !ferror(stdout));
    frame_reader_close(&reader);
    if (status != IRIS_OK && !(status == IRIS_ERR_END && reader.frames > 0)) {
        complain(file, "%s", frame_reader_problem(&reader));
        exit_code = EXIT_BAD_DATA;
    }
    return exit_code;
}
