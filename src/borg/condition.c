#include "condition.h"

/* Operators that wait for their right side: '(', BORG_AND, BORG_OR, or BORG_NOT. */
enum { WAITING_MAX = 128 };

typedef struct {
    uint8_t waiting[WAITING_MAX];
    int32_t depth, open; /* open: parentheses */
} operators;

int borg_condition_put(borg_condition *c, borg_lexer *lexer, borg_term term)
{
    if (c->count == c->room) {
        return borg_lexer_fail(lexer, "expected fewer conditions: there is no room for more");
    }
    if (c->places) {
        c->places[c->count] = (borg_place){lexer->token.line, lexer->token.column};
    }
    c->terms[c->count++] = term;
    return 1;
}

static int push(operators *o, borg_lexer *lexer, uint8_t what)
{
    if (o->depth == WAITING_MAX) {
        return borg_lexer_fail(lexer, "expected a simpler condition");
    }
    o->waiting[o->depth++] = what;
    return 1;
}

/* Puts all that binds at least as tightly. */
static int put_waiting(borg_condition *c, borg_lexer *lexer, operators *o, uint8_t before)
{
    while (o->depth > 0 && o->waiting[o->depth - 1] != '(' &&
           !(before == BORG_AND && o->waiting[o->depth - 1] == BORG_OR)) {
        if (!borg_condition_put(c, lexer, (borg_term){o->waiting[--o->depth], 0, 0})) {
            return 0;
        }
    }
    return 1;
}

/* NOTs and parentheses, and the signal behind them. */
static int take_value(borg_condition *c, borg_lexer *lexer, operators *o)
{
    for (;;) {
        if (borg_lexer_skip_word(lexer, "NOT")) {
            if (!push(o, lexer, BORG_NOT)) {
                return 0;
            }
        } else if (lexer->token.kind == '(') {
            if (o->open == c->nesting_max) {
                return borg_lexer_fail(lexer, "expected fewer parentheses in parentheses");
            }
            if (!push(o, lexer, '(')) {
                return 0;
            }
            o->open++;
            borg_lexer_next(lexer);
        } else {
            break;
        }
    }
    const borg_place place = {lexer->token.line, lexer->token.column};
    const int32_t at = c->count;
    borg_term term = {0, 1, 0};
    if (lexer->token.kind != BORG_TOKEN_WORD) {
        return borg_lexer_fail(lexer, c->expected);
    }
    const int taken = c->take_signal(&term, lexer);
    if (taken == 0 || !borg_condition_put(c, lexer, term)) {
        return 0;
    }
    if (c->places) {
        c->places[at] = place;
    }
    return taken == 1 || borg_condition_put(c, lexer, (borg_term){BORG_NOT, 0, 0});
}

/* The parentheses that end here, with what stands in them; NOT before them. */
static int take_ends(borg_condition *c, borg_lexer *lexer, operators *o)
{
    while (lexer->token.kind == ')' && o->open > 0) {
        if (!put_waiting(c, lexer, o, BORG_OR)) {
            return 0;
        }
        o->depth--;
        o->open--;
        borg_lexer_next(lexer);
    }
    return 1;
}

int borg_condition_take(borg_condition *c, borg_lexer *lexer)
{
    operators o;
    o.depth = o.open = 0;
    for (;;) {
        if (!take_value(c, lexer, &o) || !take_ends(c, lexer, &o)) {
            return 0;
        }
        const int is_and = borg_lexer_is(lexer, "AND");
        if (!is_and && !borg_lexer_is(lexer, "OR")) {
            break;
        }
        if (!put_waiting(c, lexer, &o, is_and ? BORG_AND : BORG_OR) ||
            !push(&o, lexer, is_and ? BORG_AND : BORG_OR)) {
            return 0;
        }
        borg_lexer_next(lexer);
    }
    if (o.open > 0) {
        return borg_lexer_fail(lexer, "expected AND, OR, or ')'");
    }
    return put_waiting(c, lexer, &o, BORG_OR);
}
