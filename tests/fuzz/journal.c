/* Replays any bytes as a journal: lines as they are, and with their checks made right, so that what stands in them is looked at.
 */
#include <stdlib.h>
#include <string.h>

#include "iris/runtime/runtime.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static iris_journal journal;

static iris_status sense(void *context, uint32_t now_ms, iris_motion *motion, iris_event *event)
{
    int32_t values[3] = {0, 0, 0};
    (void)context;
    (void)iris_journal_input(&journal, IRIS_JOURNAL_READING, values, 3);
    motion->speed_mms = values[0];
    motion->turn_rate = (int32_t)now_ms;
    motion->done = values[1] & 1;
    event->kind = values[2] & 1 ? IRIS_EVENT_REACHED : IRIS_EVENT_NONE;
    return values[2] & 2 ? IRIS_ERR_IO : IRIS_OK;
}

/* Goes on where something else was made of it, as an investigation would. */
static void replay(const char *text, size_t bytes)
{
    static const int32_t priorities[2] = {1, 2};
    iris_behavior behaviors[IRIS_ORDER_VERBS];
    iris_runtime runtime;
    iris_journal_record record;
    int32_t values[IRIS_JOURNAL_VALUES];
    for (int i = 0; i < IRIS_ORDER_VERBS; i++) {
        behaviors[i] = (iris_behavior){NULL, sense, NULL};
    }
    (void)iris_journal_replay_from(&journal, text, bytes);
    (void)iris_runtime_init(&runtime, behaviors, priorities, 2, &journal, 0);
    for (size_t i = 0; i <= bytes && iris_journal_peek(&record, &journal) == IRIS_OK; i++) {
        const int32_t line = journal.line;
        if (iris_runtime_replay(&runtime, &record) != IRIS_OK || journal.line == line) {
            (void)iris_journal_input(&journal, record.kind, values, record.count);
        }
        if (journal.line == line) {
            break;
        }
        if (journal.line > (int32_t)bytes || runtime.waiting_count > IRIS_RUNTIME_QUEUE) {
            abort();
        }
    }
}

/* The checks of all lines that end with "*" and eight letters. */
static void repair(char *text, size_t bytes)
{
    uint32_t check = 2166136261u;
    for (char *at = text, *end = text + bytes; at < end;) {
        char *next = memchr(at, '\n', (size_t)(end - at));
        if (!next) {
            return;
        }
        if (next - at >= 10 && next[-9] == '*') {
            for (; at < next - 9; at++) {
                check = (check ^ (uint8_t)*at) * 16777619u;
            }
            for (int i = 0; i < 8; i++) {
                next[i - 8] = "0123456789ABCDEF"[check >> (28 - 4 * i) & 15];
            }
        }
        at = next + 1;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    char *text = malloc(bytes + 1);
    memcpy(text, data, bytes);
    replay(text, bytes);
    repair(text, bytes);
    replay(text, bytes);
    free(text);
    return 0;
}
