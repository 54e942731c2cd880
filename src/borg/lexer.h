/* Words, numbers, and signs of BorgCode, for scripts and chunks alike. */
#ifndef IRIS_BORG_LEXER_H
#define IRIS_BORG_LEXER_H

#include "iris/borg/problem.h"

/* What a token is: one of these, or the sign itself. */
enum {
    BORG_TOKEN_END = 0,
    BORG_TOKEN_WORD = 'w',
    BORG_TOKEN_NUMBER = 'n',
    BORG_TOKEN_SAME = 'E',
    BORG_TOKEN_BAD = '?'
};

typedef struct {
    const char *at;
    size_t length;
    int32_t value; /* of a number */
    int32_t line, column;
    char kind;
    uint8_t first;    /* of its line */
    uint8_t numbered; /* the line's number stands right before it */
} borg_token;

/* Where the text is read, with the token that comes next. A first problem stays, and ends the text. */
typedef struct {
    const char *at, *end, *line_start;
    int32_t line;
    uint8_t is_first, has_failed;
    uint8_t keeps_comments; /* as tokens '/' */
    uint8_t
        takes_lines; /* numbers at the beginning of lines are theirs: looked at in takes_line and left out */
    int32_t number;  /* of the last line that had one; -1 */
    borg_token token;
    borg_problem problem;
} borg_lexer;

void borg_lexer_start(borg_lexer *l, const char *at, const char *end);
void borg_lexer_next(borg_lexer *l);

/* Keeps the problem of the next token, or of a place, if it is the first one. Returns 0. */
int borg_lexer_fail(borg_lexer *l, const char *expected);

/* Whether the next token is this word, in any case. */
int borg_lexer_is(const borg_lexer *l, const char *word);

/* Each steps over what it names; 0 when something else stands there: without a complaint, or with one. */
int borg_lexer_skip(borg_lexer *l, char kind);
int borg_lexer_skip_word(borg_lexer *l, const char *word);
int borg_lexer_take(borg_lexer *l, char kind, const char *expected);
int borg_lexer_take_word(borg_lexer *l, const char *word, const char *expected);

/* A number within limits; a sign where `least` is below 0. */
int borg_lexer_take_number(int32_t *number, borg_lexer *l, int32_t least, int32_t most, const char *expected);

/* Whether the first `length` letters are this word, in any case. */
int borg_same_word(const char *letters, size_t length, const char *word);

#endif
