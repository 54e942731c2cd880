#include "lexer.h"
#include "script_parts.h"
#include "text_out.h"
#include "words.h"

typedef struct {
    borg_text_out out;
    borg_lexer lexer;
    borg_token before;   /* kind BORG_TOKEN_END: none on this line of the output */
    int32_t number;      /* to be written where the next line begins; -1 */
    int32_t depth, open; /* blocks, parentheses */
    uint8_t after_colon_of_ref, in_statement;
} formatting;

static void break_line(formatting *f)
{
    if (f->before.kind != BORG_TOKEN_END) {
        borg_put_char(&f->out, '\n');
        f->before.kind = BORG_TOKEN_END;
    }
}

static void begin_line(formatting *f)
{
    if (f->number >= 0) {
        borg_put_number(&f->out, f->number, 3);
    } else if (f->lexer.token.kind == '/' && f->depth == 0) {
        return;
    } else {
        borg_put_word(&f->out, "   ");
    }
    f->number = -1;
    for (int32_t i = 0; i < 1 + 4 * f->depth; i++) {
        borg_put_char(&f->out, ' ');
    }
}

/* Whether a word or sign begins a line of the output. */
static int begins_statement(const formatting *f)
{
    const borg_token *t = &f->lexer.token;
    if (t->kind == '[' || t->kind == ']') {
        return 1;
    }
    if (f->open > 0 || t->kind != BORG_TOKEN_WORD) {
        return 0;
    }
    const borg_lexer *l = &f->lexer;
    return borg_lexer_is(l, "START") || borg_lexer_is(l, "END") || borg_lexer_is(l, "IF") ||
           borg_lexer_is(l, "WHILE") || borg_lexer_is(l, "ELSE") || borg_lexer_is(l, "REF") ||
           (borg_lexer_is(l, "UNITS") && !f->after_colon_of_ref);
}

static int is_word(const borg_token *t, const char *word)
{
    return t->kind == BORG_TOKEN_WORD && borg_same_word(t->at, t->length, word);
}

static int takes_space(const formatting *f)
{
    const borg_token *a = &f->before, *b = &f->lexer.token;
    const int a_is_word = a->kind == BORG_TOKEN_WORD || a->kind == BORG_TOKEN_NUMBER;
    const int b_is_word = b->kind == BORG_TOKEN_WORD || b->kind == BORG_TOKEN_NUMBER;
    if (a->kind == ',' || (a->kind == ':' && !f->after_colon_of_ref)) {
        return 1;
    }
    if (b->kind == '(') {
        return is_word(a, "IF") || is_word(a, "WHILE") || is_word(a, "AND") || is_word(a, "OR") ||
               is_word(a, "NOT");
    }
    return (a_is_word || a->kind == ')') && b_is_word;
}

static void put_letters(borg_text_out *out, const char *at, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        borg_put_char(out, at[i]);
    }
}

static void put_token(formatting *f)
{
    const borg_token *t = &f->lexer.token;
    const char *word = t->kind == BORG_TOKEN_WORD ? borg_word_written(t->at, t->length) : NULL;
    if (f->before.kind == '.' && is_word(t, "TimeOut")) {
        borg_put_word(&f->out, "TimeOut"); /* and not a group's TIMEOUT */
    } else if (word) {
        borg_put_word(&f->out, word);
    } else if (t->kind == BORG_TOKEN_NUMBER) {
        borg_put_number(&f->out, t->value, 1);
    } else {
        put_letters(&f->out, t->at, t->length);
    }
}

static void put_comment(formatting *f)
{
    const borg_token *t = &f->lexer.token;
    size_t length = t->length;
    while (length > 0 &&
           (t->at[length - 1] == ' ' || t->at[length - 1] == '\t' || t->at[length - 1] == '\r')) {
        length--;
    }
    if (t->first || f->number >= 0) {
        break_line(f);
        begin_line(f);
    } else if (f->before.kind == BORG_TOKEN_END) {
        begin_line(f);
    } else {
        borg_put_word(&f->out, "  ");
    }
    put_letters(&f->out, t->at, length);
    f->before = *t;
    break_line(f);
}

static void put_next(formatting *f)
{
    const borg_token *t = &f->lexer.token;
    if (t->kind == '/') {
        put_comment(f);
        return;
    }
    if (begins_statement(f)) {
        break_line(f);
        f->in_statement = 0;
    }
    f->depth -= t->kind == ']' && f->depth > 0;
    if (f->before.kind == BORG_TOKEN_END) {
        begin_line(f);
        if (f->in_statement) {
            borg_put_word(&f->out, "    "); /* what a comment has broken */
        }
    } else if (takes_space(f)) {
        borg_put_char(&f->out, ' ');
    }
    put_token(f);
    f->in_statement = 1;
    f->depth += t->kind == '[';
    f->open += t->kind == '(' ? 1 : t->kind == ')' ? -1 : 0;
    f->after_colon_of_ref = t->kind == ':' && f->before.kind == ')';
    f->before = *t;
    f->number = -1; /* of a line in the middle of a statement */
    if (t->kind == '[') {
        f->in_statement = 0;
    }
}

iris_status borg_script_format(char *out, size_t capacity, size_t *length, borg_script *script,
                               borg_problem *problem, const borg_text *text)
{
    if (!out || !length) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = borg_script_read(script, problem, text);
    if (status != IRIS_OK) {
        return status;
    }
    formatting f = {.number = -1};
    f.out.text = out;
    f.out.capacity = capacity;
    borg_lexer_start(&f.lexer, text->at, text->at + text->length);
    f.lexer.keeps_comments = 1;
    for (borg_lexer_next(&f.lexer); f.lexer.token.kind != BORG_TOKEN_END; borg_lexer_next(&f.lexer)) {
        const borg_token *t = &f.lexer.token;
        if (t->kind == BORG_TOKEN_NUMBER && t->first) {
            f.number = t->value;
        } else {
            put_next(&f);
        }
    }
    break_line(&f);
    borg_put_char(&f.out, '\0');
    if (f.out.used > capacity) {
        return IRIS_ERR_RANGE;
    }
    *length = f.out.used - 1;
    return IRIS_OK;
}
