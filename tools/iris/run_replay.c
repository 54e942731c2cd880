/* A journal replayed: what came in comes in again, and what is made of it is compared. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "run_session_parts.h"

#define JOURNAL_BYTES_MAX ((size_t)1 << 30)

/* For free(). Null when it complained. */
static char *read_journal(size_t *bytes, const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    size_t room = 0, count = 0;
    if (!file) {
        complain(path, "%s", strerror(errno));
        return NULL;
    }
    for (size_t got = 1; got > 0; count += got) {
        if (room - count < 65536) {
            char *more = room < JOURNAL_BYTES_MAX ? realloc(text, room = 2 * room + 65536) : NULL;
            if (!more) {
                complain(path, "not enough memory");
                free(text);
                (void)fclose(file);
                return NULL;
            }
            text = more;
        }
        got = fread(text + count, 1, room - count, file);
    }
    if (ferror(file)) {
        complain(path, "%s", strerror(errno));
        free(text);
        text = NULL;
    }
    (void)fclose(file);
    *bytes = count;
    return text;
}

static void note(run_session *s)
{
    if (run_session_note_command(s) && !s->is_quiet) {
        printf("%.3f %d %d\n", s->now_ms / 1000.0, (int)s->command.speed_mms, (int)s->command.turn_rate);
    }
}

static void replay_step(run_session *s, const iris_journal_record *record)
{
    const int quiet = s->is_quiet;
    robot_behaviors_sense(&s->behaviors);
    (void)iris_runtime_replay(&s->runtime, record);
    note(s);
    s->is_quiet = 1; /* commands alone are printed */
    (void)run_session_take_events(s, s->now_ms);
    s->is_quiet = quiet;
    run_session_walk(s, s->senses.pose);
}

static iris_status replay_all(run_session *s)
{
    iris_journal_record record;
    iris_status status = IRIS_OK;
    while (!s->journal.differs && (status = iris_journal_peek(&record, &s->journal)) == IRIS_OK) {
        const int has_time =
            record.count > 0 && (record.kind == IRIS_JOURNAL_STEP || record.kind == IRIS_JOURNAL_ORDER);
        s->now_ms = has_time ? (uint32_t)record.values[0] : s->now_ms;
        if (record.kind == IRIS_JOURNAL_READING) {
            const osiris_raw nothing = {OSIRIS_NOTHING, OSIRIS_NEVER, 0, {0, 0, 0, 0}};
            run_session_sense(s, 0, &nothing);
        } else if (record.kind == IRIS_JOURNAL_STEP && record.count == 1) {
            replay_step(s, &record);
        } else if (iris_runtime_replay(&s->runtime, &record) == IRIS_OK) {
            s->orders += record.kind == IRIS_JOURNAL_ORDER;
            note(s);
        } else {
            s->journal.differs = s->journal.line + 1;
        }
    }
    return status;
}

static int verdict(run_session *s, iris_status status, const char *path)
{
    const int line = (int)s->journal.line + 1;
    if (s->journal.differs) {
        complain(path, "line %d: what is done now is not what was recorded", (int)s->journal.differs);
        return EXIT_BAD_DATA;
    }
    if (status == IRIS_ERR_TRUNCATED) {
        complain(path, "line %d: the journal ends early; up to there all is the same", line);
        return EXIT_BAD_DATA;
    }
    if (status != IRIS_ERR_END) {
        complain(path, "line %d: %s", line,
                 status == IRIS_ERR_UNSUPPORTED ? "a journal of a later version"
                                                : "damaged, or not the line that was there");
        return EXIT_BAD_DATA;
    }
    if (!s->is_quiet) {
        printf("replayed: the same %d commands, bit for bit\n", (int)s->commands);
    }
    return EXIT_DONE;
}

int run_session_replay(run_session *s, const char *path)
{
    size_t bytes = 0;
    iris_journal_record record;
    const osiris_pose middle = {0, 0, 0};
    char *text = read_journal(&bytes, path);
    if (!text) {
        return EXIT_BAD_DATA;
    }
    (void)iris_journal_replay_from(&s->journal, text, bytes);
    iris_status status = iris_journal_peek(&record, &s->journal);
    if (status == IRIS_OK) {
        run_session_begin(s, middle);
        if (s->journal.differs == 2) {
            complain(path, "line 2: recorded with another robot file");
            free(text);
            return EXIT_BAD_DATA;
        }
        status = replay_all(s);
    }
    const int code = verdict(s, status, path);
    free(text);
    return s->has_failed ? EXIT_BAD_DATA : code;
}
