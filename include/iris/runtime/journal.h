/* IRIS - the journal of a session: all that came in, and what was made of it, as lines of checked text.
 *
 *     J 1 0 2 100 10*8D2F1A07      version, time, sources and their priorities: a runtime begins
 *     O 40 0 2 500 0 0*...         order: time, source, verb, a, b, lease in ms
 *     L 60 1*...                   lease renewed: time, source
 *     T 5 120 80*...               event that the caller told: kind, x, y
 *     R 3 812 790 0*...            reading: whatever the caller or a behavior took from outside
 *     S 60*...                     step: time
 *     M 200 -4096*...              motion from here on: mm/s, angle units a second
 *     E 3 500 0*...                event: kind, x, y
 *     Z 8*...                      the end, behind so many lines
 *
 * Behind the * is the FNV-1a check (32 bits) of all the journal's bytes up to there but for checks and line breaks, in
 * hexadecimal: a line that is damaged, missing, or at another place is found by its number. Without its end a journal is
 * truncated, and good up to there: what a robot wrote until its battery was pulled out is a journal, too.
 *
 * The same journal replayed takes what comes in from the text, and compares what is made of it, bit for bit: runtime and behaviors
 * call the same functions either way, and need not know. What a behavior takes from outside goes through iris_journal_input.
 */
#ifndef IRIS_RUNTIME_JOURNAL_H
#define IRIS_RUNTIME_JOURNAL_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define IRIS_JOURNAL_VALUES     12
#define IRIS_JOURNAL_LINE_BYTES 160 /* the longest line, with its line break */

/* What a line begins with. */
#define IRIS_JOURNAL_BEGIN   'J'
#define IRIS_JOURNAL_ORDER   'O'
#define IRIS_JOURNAL_LEASE   'L'
#define IRIS_JOURNAL_TOLD    'T'
#define IRIS_JOURNAL_READING 'R'
#define IRIS_JOURNAL_STEP    'S'
#define IRIS_JOURNAL_MOTION  'M'
#define IRIS_JOURNAL_EVENT   'E'
#define IRIS_JOURNAL_END     'Z'

typedef struct {
    char kind;
    int32_t count; /* of values, 0..IRIS_JOURNAL_VALUES */
    int32_t values[IRIS_JOURNAL_VALUES];
} iris_journal_record;

/* Read line, status, and differs; the rest belongs to the functions. */
typedef struct {
    int32_t line;    /* lines written, or taken; a wrong one is the next; stays at 2^31 - 1 */
    int32_t differs; /* replaying: line with which something else was made of it than recorded; 0: none */
    iris_status
        status; /* why nothing more is recorded or replayed; IRIS_OK: it goes on; IRIS_ERR_END: a whole replay */
    iris_status (*sink)(void *context, const char *line, size_t bytes); /* recording; null: replaying */
    void *context;
    const char *text;
    size_t bytes, at; /* of the text; where the next line begins */
    uint32_t check;
} iris_journal;

/* Records. The sink gets each line when it is made, `bytes` of it with the line break, and returns IRIS_OK, or else what
 * is kept in journal->status, and then gets nothing more: a robot goes on without its journal. IRIS_ERR_ARG: null pointer. O(1). */
iris_status iris_journal_record_to(iris_journal *journal,
                                   iris_status (*sink)(void *context, const char *line, size_t bytes),
                                   void *context);

/* Replays a text of `bytes` bytes, which must outlive *journal. IRIS_ERR_ARG: null pointer. O(1). */
iris_status iris_journal_replay_from(iris_journal *journal, const char *text, size_t bytes);

/* What comes in from outside: recorded as it is; or when replaying, `count` values from the journal take its place. What is
 * recorded next must be of this kind and count: if not, journal->differs is that line, and the values stay as they are.
 * kind: an upper-case letter, READING unless there is a reason. A null journal does nothing.
 * IRIS_ERR_ARG: null values, or kind; IRIS_ERR_RANGE: count; others: journal->status as it is then. O(count). */
iris_status iris_journal_input(iris_journal *journal, char kind, int32_t *values, int32_t count);

/* What was made of it: recorded; or when replaying, compared with what is recorded next, journal->differs being the
 * line when it is not the same. Others as iris_journal_input. O(count). */
iris_status iris_journal_output(iris_journal *journal, char kind, const int32_t *values, int32_t count);

/* Nothing more comes: recorded; or when replaying, that nothing more is there is compared. Null does nothing. O(1). */
iris_status iris_journal_end(iris_journal *journal);

/* Replaying: what comes next, which stays there. It says with which call the session went on.
 * IRIS_ERR_END: the end, as recorded; IRIS_ERR_TRUNCATED: the journal stops within or behind line journal->line;
 * IRIS_ERR_DATA: the line behind journal->line is damaged, is not the one that was there, or stands behind the end; IRIS_ERR_UNSUPPORTED: of a
 * later version; IRIS_ERR_ARG: null pointer, or it records; others: journal->status. O(line). */
iris_status iris_journal_peek(iris_journal_record *record, iris_journal *journal);

#ifdef __cplusplus
}
#endif

#endif
