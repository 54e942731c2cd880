#include "lexer.h"

#define NUMBER_MAX 99999999

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static int is_letter(char c)
{
    return (lower(c) >= 'a' && lower(c) <= 'z') || c == '_';
}

int borg_same_word(const char *letters, size_t length, const char *word)
{
    size_t i = 0;
    while (i < length && word[i] != '\0' && lower(letters[i]) == lower(word[i])) {
        i++;
    }
    return i == length && word[i] == '\0';
}

void borg_lexer_start(borg_lexer *l, const char *at, const char *end)
{
    *l = (borg_lexer){.at = at, .end = end, .line_start = at, .line = 1, .is_first = 1, .number = -1};
}

int borg_lexer_fail(borg_lexer *l, const char *expected)
{
    if (!l->has_failed) {
        l->problem = (borg_problem){l->token.line, l->token.column, expected};
        l->has_failed = 1;
    }
    l->at = l->end;
    l->token.kind = BORG_TOKEN_END;
    return 0;
}

/* Stands before a token, a comment that is kept, or the end. */
static void skip_blank(borg_lexer *l)
{
    while (l->at < l->end) {
        const char c = *l->at;
        if (c == '\n') {
            l->line++;
            l->line_start = l->at + 1;
            l->is_first = 1;
        } else if (c == '/' && l->end - l->at > 1 && l->at[1] == '/' && !l->keeps_comments) {
            while (l->end - l->at > 1 && l->at[1] != '\n') {
                l->at++;
            }
        } else if (c != ' ' && c != '\t' && c != '\r') {
            return;
        }
        l->at++;
    }
}

static void read_number(borg_lexer *l, borg_token *t)
{
    t->kind = BORG_TOKEN_NUMBER;
    for (; l->at < l->end && is_digit(*l->at); l->at++) {
        t->value = t->value <= NUMBER_MAX ? 10 * t->value + (*l->at - '0') : t->value;
    }
    if (t->value > NUMBER_MAX || (l->at < l->end && is_letter(*l->at))) {
        borg_lexer_fail(l,
                        t->value > NUMBER_MAX ? "expected a number of at most 8 digits" : "expected a space");
    }
}

static void read_token(borg_lexer *l)
{
    borg_token *t = &l->token;
    *t = (borg_token){.at = l->at, .line = l->line, .first = l->is_first};
    t->column = (int32_t)(l->at - l->line_start) + 1;
    l->is_first = 0;
    if (l->at == l->end) {
        return;
    }
    if (is_letter(*l->at)) {
        t->kind = BORG_TOKEN_WORD;
        while (l->at < l->end && (is_letter(*l->at) || is_digit(*l->at))) {
            l->at++;
        }
    } else if (is_digit(*l->at)) {
        read_number(l, t);
    } else if (*l->at == '/' && l->end - l->at > 1 && l->at[1] == '/') {
        t->kind = '/';
        while (l->at < l->end && *l->at != '\n') {
            l->at++;
        }
    } else {
        const char c = *l->at++;
        const int known = c == '(' || c == ')' || c == '[' || c == ']' || c == ':' || c == ';' || c == ',' ||
                          c == '.' || c == '=' || c == '-';
        t->kind = c;
        if (c == '=' && l->at < l->end && *l->at == '=') {
            t->kind = BORG_TOKEN_SAME;
            l->at++;
        }
        if (!known) {
            borg_lexer_fail(l, "expected a word, a number, or one of ( ) [ ] : ; , . = == //");
        }
    }
    t->length = (size_t)(l->at - t->at);
}

/* A line's own number. */
static void take_line(borg_lexer *l)
{
    const int32_t value = l->token.value;
    if (value > UINT16_MAX) {
        borg_lexer_fail(l, "expected a line number of at most 65535");
    } else if (value <= l->number) {
        borg_lexer_fail(l, value == l->number
                               ? "expected a line number that is not taken: a line, or group, is named once"
                               : "expected a line number above the one before");
    }
    l->number = value;
}

void borg_lexer_next(borg_lexer *l)
{
    if (l->has_failed) {
        return;
    }
    skip_blank(l);
    read_token(l);
    while (l->takes_lines && !l->has_failed && l->token.kind == BORG_TOKEN_NUMBER && l->token.first) {
        take_line(l);
        if (!l->has_failed) {
            skip_blank(l);
            read_token(l);
            l->token.numbered = 1;
        }
    }
}

int borg_lexer_is(const borg_lexer *l, const char *word)
{
    return l->token.kind == BORG_TOKEN_WORD && borg_same_word(l->token.at, l->token.length, word);
}

int borg_lexer_skip(borg_lexer *l, char kind)
{
    const int is = l->token.kind == kind;
    if (is) {
        borg_lexer_next(l);
    }
    return is;
}

int borg_lexer_skip_word(borg_lexer *l, const char *word)
{
    const int is = borg_lexer_is(l, word);
    if (is) {
        borg_lexer_next(l);
    }
    return is;
}

int borg_lexer_take(borg_lexer *l, char kind, const char *expected)
{
    return borg_lexer_skip(l, kind) || borg_lexer_fail(l, expected);
}

int borg_lexer_take_word(borg_lexer *l, const char *word, const char *expected)
{
    return borg_lexer_skip_word(l, word) || borg_lexer_fail(l, expected);
}

int borg_lexer_take_number(int32_t *number, borg_lexer *l, int32_t least, int32_t most, const char *expected)
{
    const int negative = least < 0 && borg_lexer_skip(l, '-');
    const int32_t value = negative ? -l->token.value : l->token.value;
    if (l->token.kind != BORG_TOKEN_NUMBER || value < least || value > most) {
        return borg_lexer_fail(l, expected);
    }
    *number = value;
    borg_lexer_next(l);
    return 1;
}
