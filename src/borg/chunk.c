#include "iris/borg/chunk.h"

#include "chunk_build.h"

static int has(const borg_reader *r, size_t bytes)
{
    return (size_t)(r->end - r->at) >= bytes;
}

static int32_t four(const uint8_t *at)
{
    const uint32_t bits = borg_chunk_two(at) | (uint32_t)borg_chunk_two(at + 2) << 16;
    return bits <= INT32_MAX ? (int32_t)bits : (int32_t)(bits - INT32_MAX - 1) + INT32_MIN;
}

int borg_handler_next(borg_handler *handler, borg_reader *r)
{
    if (!has(r, BORG_HANDLER_BYTES)) {
        return 0;
    }
    const uint8_t *at = r->at;
    const size_t condition = at[2], body = borg_chunk_two(at + 3);
    if (!has(r, BORG_HANDLER_BYTES + condition + body)) {
        return 0;
    }
    handler->repeats = at[0] & 1;
    handler->winners = at[1];
    at += BORG_HANDLER_BYTES;
    handler->condition = (borg_reader){at, at + condition};
    handler->body = (borg_reader){at + condition, at + condition + body};
    r->at = at + condition + body;
    return 1;
}

int borg_term_next(borg_term *term, borg_reader *r)
{
    if (!has(r, 1)) {
        return 0;
    }
    *term = (borg_term){r->at[0], 0, 0};
    if (term->op >= BORG_AND) {
        r->at++;
        return 1;
    }
    if (!has(r, 4)) {
        return 0;
    }
    term->ref = borg_chunk_two(r->at + 1);
    term->machines = r->at[3];
    r->at += 4;
    return 1;
}

int borg_action_next(borg_action *action, borg_reader *r)
{
    static const uint8_t lengths[BORG_VERBS] = {2, 0, 2, 0, 8, 4, 2, 0, 0, 3};
    if (!has(r, 2) || r->at[0] >= BORG_VERBS || !has(r, 2u + lengths[r->at[0]])) {
        return 0;
    }
    const uint8_t *at = r->at + 2;
    *action = (borg_action){.verb = r->at[0], .unit = r->at[1]};
    switch (action->verb) {
    case BORG_LINE_FOLLOW:
    case BORG_AUTO_EXPLORE:
        action->a = borg_chunk_two(at);
        break;
    case BORG_TURN:
        action->a = (borg_chunk_two(at) ^ 0x8000) - 0x8000;
        break;
    case BORG_GO:
        action->a = four(at);
        action->b = four(at + 4);
        break;
    case BORG_GO_TARGET:
    case BORG_MULTICAST:
        action->kind = at[0];
        action->ref = borg_chunk_two(at + 1);
        action->which = action->verb == BORG_GO_TARGET ? at[3] : 0;
        break;
    default:
        break;
    }
    r->at = at + lengths[action->verb];
    return 1;
}

static int condition_is_good(borg_reader r)
{
    borg_term term;
    int32_t depth = 0;
    while (borg_term_next(&term, &r)) {
        if (term.op < BORG_SIGNAL_KINDS) {
            depth++;
            if (term.machines == 0 || depth > BORG_STACK_MAX) {
                return 0;
            }
        } else if (term.op == BORG_AND || term.op == BORG_OR) {
            if (--depth < 1) {
                return 0;
            }
        } else if (term.op != BORG_NOT || depth < 1) {
            return 0;
        }
    }
    return r.at == r.end && depth == 1;
}

static int actions_are_good(borg_reader r)
{
    borg_action action;
    const int any = r.at < r.end;
    while (borg_action_next(&action, &r)) {
        const int tells = action.verb == BORG_GO_TARGET || action.verb == BORG_MULTICAST;
        const int far =
            action.verb == BORG_GO && (action.a > BORG_PLACE_MAX_MM || action.a < -BORG_PLACE_MAX_MM ||
                                       action.b > BORG_PLACE_MAX_MM || action.b < -BORG_PLACE_MAX_MM);
        if (far || action.kind >= BORG_SIGNAL_KINDS || (tells && action.ref == 0) ||
            (action.verb == BORG_GO_TARGET && action.which == 0)) {
            return 0;
        }
    }
    return any && r.at == r.end;
}

/* Those of an election. How many there are; -1: something is wrong. */
static int32_t inner_handlers(borg_reader r)
{
    borg_handler h;
    int32_t count = 0;
    for (; r.at < r.end; count++) {
        const uint8_t flags = r.at[0];
        if (!borg_handler_next(&h, &r) || flags > 1 || h.winners != 0 || !condition_is_good(h.condition) ||
            !actions_are_good(h.body)) {
            return -1;
        }
    }
    return r.at == r.end ? count : -1;
}

iris_status borg_chunk_check(const uint8_t *chunk, size_t bytes)
{
    if (!chunk) {
        return IRIS_ERR_ARG;
    }
    if (bytes < BORG_CHUNK_HEADER_BYTES) {
        return IRIS_ERR_TRUNCATED;
    }
    if (chunk[0] != 'B' || chunk[1] != 'C' || chunk[2] == 0) {
        return IRIS_ERR_DATA;
    }
    if (chunk[2] != 1) {
        return IRIS_ERR_UNSUPPORTED;
    }
    const size_t length = borg_chunk_length(chunk);
    if (length > BORG_CHUNK_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    if (length > bytes) {
        return IRIS_ERR_TRUNCATED;
    }
    if (length != bytes || borg_chunk_units(chunk) == 0 || borg_chunk_ref(chunk) == 0 || chunk[11] != 0 ||
        borg_chunk_timeout_s(chunk) == 0 || (uint32_t)four(chunk + 12) != borg_chunk_sum(chunk, bytes)) {
        return IRIS_ERR_DATA;
    }
    borg_reader r = borg_chunk_handlers(chunk);
    borg_handler h;
    int32_t top = 0, all = 0;
    while (r.at < r.end) {
        const uint8_t flags = r.at[0];
        if (!borg_handler_next(&h, &r) || flags > 1 || !condition_is_good(h.condition) ||
            h.winners > borg_chunk_units(chunk)) {
            return IRIS_ERR_DATA;
        }
        const int32_t inside = h.winners ? inner_handlers(h.body) : actions_are_good(h.body) ? 0 : -1;
        if (inside < 0) {
            return IRIS_ERR_DATA;
        }
        top++;
        all += 1 + inside;
    }
    return top == chunk[10] && all <= BORG_HANDLERS_MAX ? IRIS_OK : IRIS_ERR_DATA;
}

uint32_t borg_chunk_number(uint32_t before, const uint8_t *chunk, size_t bytes)
{
    uint32_t sum = before ? before : 2166136261u;
    for (size_t i = 0; chunk && i < bytes; i++) {
        sum = (sum ^ chunk[i]) * 16777619u;
    }
    return sum;
}
