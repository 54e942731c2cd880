#include "chunk_build.h"
#include "condition.h"
#include "iris/borg/chunk_text.h"
#include "lexer.h"
#include "words.h"

#define TERMS_MAX 128

static int take_signal_name(uint8_t *kind, borg_lexer *l)
{
    const int32_t found =
        l->token.kind == BORG_TOKEN_WORD ? borg_signal_find(l->token.at, l->token.length) : -1;
    if (found < 0) {
        return borg_lexer_fail(l, "expected a signal, such as OBJ_DETECT_TRUE or TIME_OUT");
    }
    *kind = (uint8_t)found;
    borg_lexer_next(l);
    return 1;
}

static int take_ref(uint16_t *ref, borg_lexer *l, int32_t least)
{
    int32_t number = 0;
    const int taken = borg_lexer_take_number(&number, l, least, UINT16_MAX, "expected the line of a group");
    *ref = (uint16_t)number;
    return taken;
}

/* (k) */
static int take_which(uint8_t *which, borg_lexer *l)
{
    int32_t number = 0;
    const int taken = borg_lexer_take(l, '(', "expected '('") &&
                      borg_lexer_take_number(&number, l, 1, BORG_UNITS_MAX, "expected 1 to 255 machines") &&
                      borg_lexer_take(l, ')', "expected ')'");
    *which = (uint8_t)number;
    return taken;
}

static int take_signal(borg_term *term, borg_lexer *l)
{
    if (!borg_lexer_take_word(l, "Signal", "expected Signal(...), NOT, or '('") ||
        !borg_lexer_take(l, '(', "expected '('") || !take_signal_name(&term->op, l)) {
        return 0;
    }
    if (borg_lexer_skip(l, ',')) {
        if (!take_ref(&term->ref, l, 0) || (l->token.kind == '(' && !take_which(&term->machines, l))) {
            return 0;
        }
    }
    return borg_lexer_take(l, ')', "expected ',' or ')'");
}

/* What stands in the parentheses of an action, if anything does. */
static int take_argument(borg_action *action, borg_lexer *l)
{
    const char *const degrees = "expected degrees, -32768 to 32767";
    const char *const mm = "expected millimeters, at most 10000000";
    switch (action->verb) {
    case BORG_LINE_FOLLOW:
    case BORG_AUTO_EXPLORE:
        if (l->token.kind != '(') {
            return 1;
        }
        borg_lexer_next(l);
        return borg_lexer_take_number(&action->a, l, 1, UINT16_MAX, "expected a speed in mm/s, 1 to 65535") &&
               borg_lexer_take(l, ')', "expected ')'");
    case BORG_TURN:
        return borg_lexer_take(l, '(', "expected '(' and degrees") &&
               borg_lexer_take_number(&action->a, l, INT16_MIN, INT16_MAX, degrees) &&
               borg_lexer_take(l, ')', "expected ')'");
    case BORG_MULTICAST:
        return borg_lexer_take(l, '(', "expected '(' and a signal") && take_signal_name(&action->kind, l) &&
               borg_lexer_take(l, ',', "expected ','") && take_ref(&action->ref, l, 1) &&
               borg_lexer_take(l, ')', "expected ')'");
    case BORG_GO:
        if (!borg_lexer_take(l, '(', "expected '(' and where to go")) {
            return 0;
        }
        if (l->token.kind == BORG_TOKEN_WORD) {
            action->verb = BORG_GO_TARGET;
            return take_signal_name(&action->kind, l) && borg_lexer_take(l, '.', "expected .Target") &&
                   borg_lexer_take_word(l, "Target", "expected Target") &&
                   borg_lexer_take(l, ',', "expected ','") && take_ref(&action->ref, l, 1) &&
                   take_which(&action->which, l) && borg_lexer_take(l, ')', "expected ')'");
        }
        return borg_lexer_take_number(&action->a, l, -BORG_PLACE_MAX_MM, BORG_PLACE_MAX_MM, mm) &&
               borg_lexer_take(l, ',', "expected ',' and y") &&
               borg_lexer_take_number(&action->b, l, -BORG_PLACE_MAX_MM, BORG_PLACE_MAX_MM, mm) &&
               borg_lexer_take(l, ')', "expected ')'");
    default:
        return 1;
    }
}

static int take_actions(borg_build *b, borg_lexer *l)
{
    do {
        borg_action action = {0};
        if (borg_lexer_skip_word(l, "UNITS")) {
            if (!take_which(&action.unit, l) || !borg_lexer_take(l, '.', "expected '.'")) {
                return 0;
            }
        }
        const int32_t verb =
            l->token.kind == BORG_TOKEN_WORD ? borg_verb_find(l->token.at, l->token.length) : -1;
        if (verb < 0) {
            return borg_lexer_fail(l, "expected an action, such as LineFollow or Go");
        }
        action.verb = (uint8_t)verb;
        borg_lexer_next(l);
        if (!take_argument(&action, l)) {
            return 0;
        }
        borg_build_action(b, &action);
    } while (borg_lexer_skip(l, ','));
    (void)borg_lexer_skip(l, ';');
    return 1;
}

/* [WHILE] condition ':' */
static int take_head(borg_build *b, size_t *at, borg_lexer *l)
{
    borg_term terms[TERMS_MAX];
    borg_condition condition = {.terms = terms,
                                .room = TERMS_MAX,
                                .nesting_max = TERMS_MAX,
                                .take_signal = take_signal,
                                .expected = "expected Signal(...), NOT, or '('"};
    const int repeats = borg_lexer_skip_word(l, "WHILE");
    if (!borg_condition_take(&condition, l) || !borg_lexer_take(l, ':', "expected AND, OR, or ':'")) {
        return 0;
    }
    *at = borg_build_handler(b, repeats, 0);
    for (int32_t i = 0; i < condition.count; i++) {
        borg_build_term(b, &terms[i]);
    }
    borg_build_body(b, *at);
    return 1;
}

/* = n, within limits. */
static int take_setting(int32_t *number, borg_lexer *l, int32_t most, const char *expected)
{
    return borg_lexer_take(l, '=', "expected '='") && borg_lexer_take_number(number, l, 1, most, expected);
}

/* UNITS=k [ handlers ]: `at` is the handler that it is the body of. */
static int take_election(borg_build *b, size_t at, borg_lexer *l, int32_t *handlers, int32_t units)
{
    int32_t winners = 0;
    if (!take_setting(&winners, l, units,
                      "expected at least 1 winner, and no more than the group has units") ||
        !borg_lexer_take(l, '[', "expected '['")) {
        return 0;
    }
    if (at + 1 < b->capacity) {
        b->bytes[at + 1] = (uint8_t)winners;
    }
    while (!borg_lexer_skip(l, ']')) {
        size_t inner;
        if (!take_head(b, &inner, l) || !take_actions(b, l)) {
            return 0;
        }
        borg_build_close(b, inner);
        ++*handlers;
    }
    (void)borg_lexer_skip(l, ';');
    return 1;
}

/* An election begins like the actions of one machine: UNITS=k, and not UNITS(k). */
static int is_election(const borg_lexer *l)
{
    borg_lexer ahead = *l;
    return borg_lexer_skip_word(&ahead, "UNITS") && ahead.token.kind == '=';
}

static int take_handler(borg_build *b, borg_lexer *l, int32_t *handlers, int32_t units)
{
    size_t at;
    if (!take_head(b, &at, l)) {
        return 0;
    }
    ++*handlers;
    if (is_election(l)) {
        borg_lexer_next(l);
        if (!take_election(b, at, l, handlers, units)) {
            return 0;
        }
    } else if (!take_actions(b, l)) {
        return 0;
    }
    borg_build_close(b, at);
    return 1;
}

static int take_header(borg_build_header *header, borg_lexer *l)
{
    int32_t ignored;
    if (borg_lexer_skip_word(l, "CHUNK") &&
        !borg_lexer_take_number(&ignored, l, 0, UINT16_MAX, "expected the chunk's number")) {
        return 0;
    }
    header->timeout_s = BORG_TIMEOUT_S;
    if (!borg_lexer_take_number(&header->ref, l, 1, UINT16_MAX, "expected the line of a group, 1 to 65535") ||
        !borg_lexer_take_word(l, "UNITS", "expected UNITS=n") ||
        !take_setting(&header->units, l, BORG_UNITS_MAX, "expected 1 to 255 units")) {
        return 0;
    }
    return !borg_lexer_skip_word(l, "TIMEOUT") ||
           take_setting(&header->timeout_s, l, UINT16_MAX, "expected seconds, 1 to 65535");
}

static int take_chunk(borg_build *b, borg_build_header *header, borg_lexer *l)
{
    int32_t all = 0, ref = 0;
    if (!take_header(header, l)) {
        return 0;
    }
    const int brackets = borg_lexer_skip(l, '[');
    while (brackets ? l->token.kind != ']' : !borg_lexer_is(l, "ENDS")) {
        if (all >= BORG_HANDLERS_MAX) {
            return borg_lexer_fail(l, "expected at most 32 handlers");
        }
        if (!take_handler(b, l, &all, header->units)) {
            return 0;
        }
        header->handlers++;
    }
    if (!brackets) {
        borg_lexer_next(l);
        if (l->token.kind == BORG_TOKEN_NUMBER && l->token.value != header->ref) {
            return borg_lexer_fail(l, "expected the line that this chunk began with");
        }
        return borg_lexer_take_number(&ref, l, 1, UINT16_MAX, "expected the line that this chunk began with");
    }
    borg_lexer_next(l);
    (void)borg_lexer_skip(l, ';');
    return all <= BORG_HANDLERS_MAX || borg_lexer_fail(l, "expected at most 32 handlers");
}

iris_status borg_chunk_read_text(uint8_t *chunk, size_t capacity, size_t *bytes, size_t *position,
                                 borg_problem *problem, const borg_text *text)
{
    if (!chunk || !bytes || !position || !problem || !text || (!text->at && text->length > 0) ||
        text->length > BORG_TEXT_BYTES_MAX || *position > text->length) {
        return IRIS_ERR_ARG;
    }
    static const char nothing = '\0';
    const char *const from = text->at ? text->at : &nothing;
    borg_lexer l;
    borg_lexer_start(&l, from, from + text->length);
    for (; l.at < from + *position; l.at++) {
        if (*l.at == '\n') {
            l.line++;
            l.line_start = l.at + 1;
        }
    }
    borg_build b;
    borg_build_header header = {0};
    borg_lexer_next(&l);
    if (l.token.kind == BORG_TOKEN_END && !l.has_failed) {
        return IRIS_ERR_END;
    }
    borg_build_start(&b, chunk, capacity);
    if (!take_chunk(&b, &header, &l)) {
        *problem = l.problem;
        return IRIS_ERR_DATA;
    }
    const borg_lexer end = l;
    if (end.has_failed) { /* behind the chunk: the next one's */
        *position = (size_t)(end.token.at - from);
    } else {
        *position = end.token.kind == BORG_TOKEN_END ? text->length : (size_t)(end.token.at - from);
    }
    return borg_build_finish(&b, bytes, &header);
}
