#include "chunk_walk.h"

void borg_walk_start(borg_walk *w, const uint8_t *chunk)
{
    w->top = borg_chunk_handlers(chunk);
    w->inner = (borg_reader){w->top.end, w->top.end};
    w->index = w->parent = w->election = -1;
}

int borg_walk_next(borg_walk *w)
{
    w->index++;
    if (borg_handler_next(&w->handler, &w->inner)) {
        w->parent = w->election;
        return 1;
    }
    w->parent = -1;
    if (!borg_handler_next(&w->handler, &w->top)) {
        return 0;
    }
    if (w->handler.winners) {
        w->inner = w->handler.body;
        w->election = w->index;
    }
    return 1;
}

int borg_walk_to(borg_walk *w, const uint8_t *chunk, int32_t index)
{
    borg_walk_start(w, chunk);
    while (w->index < index) {
        if (!borg_walk_next(w)) {
            return 0;
        }
    }
    return 1;
}

int32_t borg_chunk_elections(const uint8_t *chunk)
{
    int32_t count = 0;
    borg_walk w;
    borg_walk_start(&w, chunk);
    while (borg_walk_next(&w)) {
        count += w.handler.winners != 0;
    }
    return count;
}

void borg_uses_start(borg_uses *u, const uint8_t *chunk)
{
    borg_walk_start(&u->walk, chunk);
    u->condition = u->body = u->walk.inner;
}

int borg_uses_next(borg_uses *u)
{
    borg_term term;
    borg_action action;
    for (;;) {
        while (borg_term_next(&term, &u->condition)) {
            if (term.op < BORG_SIGNAL_KINDS) {
                u->kind = term.op;
                u->ref = term.ref;
                u->machines = term.machines;
                return 1;
            }
        }
        while (borg_action_next(&action, &u->body)) {
            if (action.verb == BORG_GO_TARGET) {
                u->kind = action.kind;
                u->ref = action.ref;
                u->machines = action.which;
                return 1;
            }
        }
        if (!borg_walk_next(&u->walk)) {
            return 0;
        }
        u->condition = u->walk.handler.condition;
        u->body = u->walk.handler.winners ? u->walk.inner : u->walk.handler.body;
        if (u->walk.handler.winners) {
            u->body.at = u->body.end;
        }
    }
}
