#include "iris/borg/chunk_text.h"
#include "text_out.h"
#include "words.h"

static void put_line(borg_text_out *out, int32_t line)
{
    borg_put_number(out, line, 3);
}

static void put_indent(borg_text_out *out, int inside)
{
    borg_put_word(out, inside ? "        " : "    ");
}

static void put_signal(borg_text_out *out, const borg_term *term)
{
    borg_put_word(out, "Signal(");
    borg_put_word(out, borg_signal_name(term->op));
    if (term->ref) {
        borg_put_char(out, ',');
        put_line(out, term->ref);
    }
    if (term->machines > 1) {
        borg_put_word(out, term->ref ? "(" : ",000(");
        borg_put_number(out, term->machines, 1);
        borg_put_char(out, ')');
    }
    borg_put_char(out, ')');
}

/* A value of the postfix text: where its terms begin, and how tightly its last word binds: 0 OR, 1 AND, 2 anything
 * else. */
typedef struct {
    uint8_t begin, binding;
} value;

/* What is still to be written: the bytes [begin, end) of the condition, or a word. */
typedef struct {
    uint8_t begin, end;
    char word; /* '(', ')', '&', '|', '!'; 0: the bytes */
} pending;

/* A condition of 255 bytes leaves no more waiting than this: a word of one byte at most one, a signal of four at
 * most three. */
enum { WAITING_MAX = 208 };

typedef struct {
    pending waiting[WAITING_MAX]; /* the last one is next */
    int32_t depth;
} infix;

/* The last word of some bytes, and the one or two values before it. */
static borg_term split(value parts[2], const uint8_t *bytes, const pending *of)
{
    value stack[BORG_STACK_MAX] = {{0, 2}};
    int32_t depth = 0;
    borg_reader r = {bytes + of->begin, bytes + of->end};
    borg_term last = {0, 0, 0};
    for (;;) {
        const uint8_t at = (uint8_t)(r.at - bytes);
        if (!borg_term_next(&last, &r)) {
            return last;
        }
        if (last.op < BORG_SIGNAL_KINDS) {
            stack[depth++] = (value){at, 2};
            continue;
        }
        depth -= last.op != BORG_NOT;
        if (r.at == r.end) {
            parts[0] = stack[depth - 1];
            parts[1] = stack[depth - (last.op == BORG_NOT)];
            return last;
        }
        stack[depth - 1].binding = last.op == BORG_NOT ? 2 : last.op == BORG_AND;
    }
}

static void push(infix *to, pending what)
{
    if (to->depth < WAITING_MAX) {
        to->waiting[to->depth++] = what;
    }
}

static void push_value(infix *to, value part, uint8_t end, int least)
{
    if (part.binding < least) {
        push(to, (pending){0, 0, ')'});
    }
    push(to, (pending){part.begin, end, 0});
    if (part.binding < least) {
        push(to, (pending){0, 0, '('});
    }
}

static void put_sign(borg_text_out *out, char word)
{
    if (word == '(' || word == ')') {
        borg_put_char(out, word);
    } else {
        borg_put_word(out, word == '&' ? " AND " : word == '|' ? " OR " : "NOT ");
    }
}

/* Postfix to infix without recursion: each part waits for its turn. */
static void put_condition(borg_text_out *out, borg_reader condition)
{
    infix to;
    to.depth = 0;
    push(&to, (pending){0, (uint8_t)(condition.end - condition.at), 0});
    while (to.depth > 0) {
        const pending top = to.waiting[--to.depth];
        if (top.word) {
            put_sign(out, top.word);
            continue;
        }
        value parts[2] = {{0, 2}, {0, 2}};
        const borg_term last = split(parts, condition.at, &top);
        const uint8_t end = (uint8_t)(top.end - 1);
        if (last.op < BORG_SIGNAL_KINDS) {
            put_signal(out, &last);
        } else if (last.op == BORG_NOT) {
            push_value(&to, parts[0], end, 2);
            push(&to, (pending){0, 0, '!'});
        } else {
            /* The right one stands in parentheses when it is of the same word, too: read again, it is the same. */
            const int least = last.op == BORG_AND;
            push_value(&to, parts[1], end, least + 1);
            push(&to, (pending){0, 0, least ? '&' : '|'});
            push_value(&to, parts[0], parts[1].begin, least);
        }
    }
}

static void put_action(borg_text_out *out, const borg_action *action)
{
    if (action->unit) {
        borg_put_word(out, "UNITS(");
        borg_put_number(out, action->unit, 1);
        borg_put_word(out, ").");
    }
    borg_put_word(out, borg_verb_name(action->verb));
    const int has_number = action->verb == BORG_TURN || action->verb == BORG_GO || action->a != 0;
    const int has_signal = action->verb == BORG_GO_TARGET || action->verb == BORG_MULTICAST;
    if (has_number || has_signal) {
        borg_put_char(out, '(');
    }
    if (has_signal) {
        borg_put_word(out, borg_signal_name(action->kind));
        borg_put_word(out, action->verb == BORG_GO_TARGET ? ".Target," : ",");
        put_line(out, action->ref);
        if (action->verb == BORG_GO_TARGET) {
            borg_put_char(out, '(');
            borg_put_number(out, action->which, 1);
            borg_put_char(out, ')');
        }
    } else if (has_number) {
        borg_put_number(out, action->a, 1);
        if (action->verb == BORG_GO) {
            borg_put_char(out, ',');
            borg_put_number(out, action->b, 1);
        }
    }
    if (has_number || has_signal) {
        borg_put_char(out, ')');
    }
}

static void put_actions(borg_text_out *out, borg_reader body)
{
    borg_action action;
    const char *between = " ";
    while (borg_action_next(&action, &body)) {
        borg_put_word(out, between);
        put_action(out, &action);
        between = ",";
    }
    borg_put_word(out, ";\n");
}

static void put_head(borg_text_out *out, const borg_handler *h, int inside)
{
    put_indent(out, inside);
    borg_put_word(out, h->repeats ? "WHILE " : "");
    put_condition(out, h->condition);
    borg_put_char(out, ':');
}

static void put_handler(borg_text_out *out, const borg_handler *h)
{
    put_head(out, h, 0);
    if (!h->winners) {
        put_actions(out, h->body);
        return;
    }
    borg_put_word(out, " UNITS=");
    borg_put_number(out, h->winners, 1);
    borg_put_char(out, '\n');
    put_indent(out, 0);
    borg_put_word(out, "[\n");
    borg_reader r = h->body;
    borg_handler inner;
    while (borg_handler_next(&inner, &r)) {
        put_head(out, &inner, 1);
        put_actions(out, inner.body);
    }
    put_indent(out, 0);
    borg_put_word(out, "];\n");
}

iris_status borg_chunk_write_text(char *text, size_t capacity, size_t *length, const uint8_t *chunk,
                                  size_t bytes)
{
    if (!text || !length) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = borg_chunk_check(chunk, bytes);
    if (status != IRIS_OK) {
        return status;
    }
    borg_text_out out;
    out.text = text;
    out.capacity = capacity;
    out.used = 0;
    put_line(&out, borg_chunk_ref(chunk));
    borg_put_word(&out, " UNITS=");
    borg_put_number(&out, borg_chunk_units(chunk), 1);
    if (borg_chunk_timeout_s(chunk) != BORG_TIMEOUT_S) {
        borg_put_word(&out, " TIMEOUT=");
        borg_put_number(&out, borg_chunk_timeout_s(chunk), 1);
    }
    borg_put_word(&out, "\n[\n");
    borg_reader r = borg_chunk_handlers(chunk);
    borg_handler h;
    while (borg_handler_next(&h, &r)) {
        put_handler(&out, &h);
    }
    borg_put_word(&out, "];\n");
    borg_put_char(&out, '\0');
    if (out.used > capacity) {
        return IRIS_ERR_RANGE;
    }
    *length = out.used - 1;
    return IRIS_OK;
}
