#include "iris/runtime/journal.h"

#include "../foundation/text_lines.h"

enum { VERSION = 1 };

static const char hex[] = "0123456789ABCDEF";

static uint32_t check_of(uint32_t check, const char *from, const char *to)
{
    for (; from < to; from++) {
        check = (check ^ (uint8_t)*from) * 16777619u;
    }
    return check;
}

static int is_kind(char c)
{
    return c >= 'A' && c <= 'Z';
}

iris_status iris_journal_record_to(iris_journal *journal,
                                   iris_status (*sink)(void *context, const char *line, size_t bytes),
                                   void *context)
{
    if (!journal || !sink) {
        return IRIS_ERR_ARG;
    }
    *journal = (iris_journal){.sink = sink, .context = context, .check = IRIS_TEXT_CHECK};
    return IRIS_OK;
}

iris_status iris_journal_replay_from(iris_journal *journal, const char *text, size_t bytes)
{
    if (!journal || !text) {
        return IRIS_ERR_ARG;
    }
    *journal = (iris_journal){.text = text, .bytes = bytes, .check = IRIS_TEXT_CHECK};
    return IRIS_OK;
}

static iris_status write_line(iris_journal *journal, char kind, const int32_t *values, int32_t count)
{
    char line[IRIS_JOURNAL_LINE_BYTES];
    char *at = line;
    *at++ = kind;
    for (int32_t i = 0; i < count; i++) {
        at[0] = ' ';
        at = iris_text_put_number(at + 1, values[i], '*') - 1;
    }
    journal->check = check_of(journal->check, line, at);
    *at++ = '*';
    for (int shift = 28; shift >= 0; shift -= 4) {
        *at++ = hex[journal->check >> shift & 15];
    }
    *at++ = '\n';
    journal->status = journal->sink(journal->context, line, (size_t)(at - line));
    journal->line += journal->status == IRIS_OK && journal->line < INT32_MAX;
    return journal->status;
}

/* Takes a number of 32 bits in its one spelling, and steps behind it. */
static int take_number(int32_t *number, const char **at, const char *end)
{
    const char *c = *at;
    const int negative = c < end && *c == '-';
    c += negative;
    if (c >= end || *c < '0' || *c > '9' ||
        (*c == '0' && (negative || (c + 1 < end && c[1] >= '0' && c[1] <= '9')))) {
        return 0;
    }
    const uint32_t most = negative ? 0x80000000u : 0x7FFFFFFFu;
    uint32_t value = 0;
    for (; c < end && *c >= '0' && *c <= '9'; c++) {
        const uint32_t digit = (uint32_t)(*c - '0');
        if (value > (most - digit) / 10) {
            return 0;
        }
        value = value * 10 + digit;
    }
    *number = negative ? (int32_t)(0u - value) : (int32_t)value;
    *at = c;
    return 1;
}

static int is_check(const char *at, uint32_t check)
{
    for (int i = 0; i < 8; i++) {
        if (at[i] != hex[check >> (28 - 4 * i) & 15]) {
            return 0;
        }
    }
    return 1;
}

/* Reads the line from `at` to its line break at `end`. */
static iris_status read_line(iris_journal_record *record, uint32_t *check, const char *at, const char *end)
{
    const char *star = end - 9;
    if (end - at < 10 || *star != '*' || !is_kind(*at)) {
        return IRIS_ERR_DATA;
    }
    *check = check_of(*check, at, star);
    if (!is_check(star + 1, *check)) {
        return IRIS_ERR_DATA;
    }
    record->kind = *at++;
    for (record->count = 0; at < star; record->count++) {
        if (record->count == IRIS_JOURNAL_VALUES || *at++ != ' ' ||
            !take_number(&record->values[record->count], &at, star)) {
            return IRIS_ERR_DATA;
        }
    }
    return IRIS_OK;
}

/* A good line where it may stand. */
static iris_status judge(const iris_journal_record *record, const iris_journal *journal, int is_last)
{
    if (journal->line == 0) {
        const int begins =
            record->kind == IRIS_JOURNAL_BEGIN && record->count > 0 && record->values[0] >= VERSION;
        return !begins ? IRIS_ERR_DATA : record->values[0] > VERSION ? IRIS_ERR_UNSUPPORTED : IRIS_OK;
    }
    if (record->kind == IRIS_JOURNAL_END) {
        return is_last && record->count == 1 && record->values[0] == journal->line ? IRIS_ERR_END
                                                                                   : IRIS_ERR_DATA;
    }
    return record->kind == IRIS_JOURNAL_BEGIN ? IRIS_ERR_DATA : IRIS_OK;
}

/* The next line, and where it ends. */
static iris_status look(iris_journal_record *record, uint32_t *check, size_t *next,
                        const iris_journal *journal)
{
    size_t end = journal->at;
    const size_t most = journal->bytes - journal->at < IRIS_JOURNAL_LINE_BYTES
                            ? journal->bytes
                            : journal->at + IRIS_JOURNAL_LINE_BYTES;
    while (end < most && journal->text[end] != '\n') {
        end++;
    }
    if (end == journal->bytes) {
        return IRIS_ERR_TRUNCATED;
    }
    if (end == most) {
        return IRIS_ERR_DATA;
    }
    *check = journal->check;
    *next = end + 1;
    const iris_status status = read_line(record, check, journal->text + journal->at, journal->text + end);
    return status == IRIS_OK ? judge(record, journal, *next == journal->bytes) : status;
}

iris_status iris_journal_peek(iris_journal_record *record, iris_journal *journal)
{
    if (!record || !journal || journal->sink) {
        return IRIS_ERR_ARG;
    }
    iris_journal_record found;
    uint32_t check = 0;
    size_t next = 0;
    if (journal->status == IRIS_OK) {
        journal->status = look(&found, &check, &next, journal);
    }
    if (journal->status == IRIS_OK) {
        *record = found;
    }
    return journal->status;
}

/* Replaying: the next line, of this kind and count, which is passed either way. */
static iris_status take(iris_journal_record *record, iris_journal *journal, char kind, int32_t count)
{
    uint32_t check = 0;
    size_t next = 0;
    if (journal->status == IRIS_OK) {
        journal->status = look(record, &check, &next, journal);
    }
    if (journal->status != IRIS_OK && journal->status != IRIS_ERR_END) {
        return journal->status;
    }
    const int same = journal->status == IRIS_OK && record->kind == kind && record->count == count;
    if (!same && !journal->differs) {
        journal->differs = journal->line + (journal->line < INT32_MAX);
    }
    if (journal->status == IRIS_OK && same) {
        journal->check = check;
        journal->at = next;
        journal->line += journal->line < INT32_MAX;
    }
    return same ? IRIS_OK : IRIS_ERR_DATA;
}

static iris_status check_call(const iris_journal *journal, char kind, const int32_t *values, int32_t count)
{
    if (!values || !is_kind(kind) || kind == IRIS_JOURNAL_END) {
        return IRIS_ERR_ARG;
    }
    return count < 0 || count > IRIS_JOURNAL_VALUES ? IRIS_ERR_RANGE
           : journal->sink                          ? journal->status
                                                    : IRIS_OK;
}

iris_status iris_journal_input(iris_journal *journal, char kind, int32_t *values, int32_t count)
{
    iris_journal_record record;
    iris_status status = journal ? check_call(journal, kind, values, count) : IRIS_OK;
    if (!journal || status != IRIS_OK) {
        return status;
    }
    if (journal->sink) {
        return write_line(journal, kind, values, count);
    }
    status = take(&record, journal, kind, count);
    for (int32_t i = 0; status == IRIS_OK && i < count; i++) {
        values[i] = record.values[i];
    }
    return status;
}

iris_status iris_journal_output(iris_journal *journal, char kind, const int32_t *values, int32_t count)
{
    iris_journal_record record;
    iris_status status = journal ? check_call(journal, kind, values, count) : IRIS_OK;
    if (!journal || status != IRIS_OK) {
        return status;
    }
    if (journal->sink) {
        return write_line(journal, kind, values, count);
    }
    status = take(&record, journal, kind, count);
    for (int32_t i = 0; status == IRIS_OK && i < count; i++) {
        if (record.values[i] != values[i] && !journal->differs) {
            journal->differs = journal->line;
        }
    }
    return status;
}

iris_status iris_journal_end(iris_journal *journal)
{
    iris_journal_record record;
    if (!journal) {
        return IRIS_OK;
    }
    if (journal->sink) {
        const int32_t lines = journal->line;
        iris_status status =
            journal->status == IRIS_OK ? write_line(journal, IRIS_JOURNAL_END, &lines, 1) : journal->status;
        journal->status = status == IRIS_OK ? IRIS_ERR_END : status;
        return status;
    }
    const iris_status status = iris_journal_peek(&record, journal);
    if (status == IRIS_OK && !journal->differs) {
        journal->differs = journal->line + 1;
    }
    return status == IRIS_ERR_END ? IRIS_OK : status == IRIS_OK ? IRIS_ERR_DATA : status;
}
