#include "chunk_build.h"
#include "iris/borg/member.h"
#include "script_parts.h"
#include "seen.h"

/* One chunk in the making. */
typedef struct {
    borg_build build;
    const borg_script *script;
    const borg_group *group;
    int32_t handlers, all; /* at the top, and with those of elections */
    borg_place place;      /* where it is too much */
    const char *expected;  /* null: it is not */
} making;

static size_t open_handler(making *c, int repeats, int32_t winners, borg_term signal)
{
    const size_t at = borg_build_handler(&c->build, repeats, winners);
    borg_build_term(&c->build, &signal);
    borg_build_body(&c->build, at);
    c->all++;
    return at;
}

static void put_verb(making *c, uint8_t verb, uint8_t unit)
{
    const borg_action action = {.verb = verb, .unit = unit};
    borg_build_action(&c->build, &action);
}

static void put_start(making *c)
{
    const size_t at = open_handler(c, 0, 0, (borg_term){BORG_START, 1, 0});
    put_verb(c, BORG_RESET_TIME, 0);
    for (int32_t i = 0; i < c->group->count; i++) {
        borg_build_action(&c->build, &c->script->actions[c->group->first + i]);
    }
    borg_build_close(&c->build, at);
    c->handlers++;
}

static int branch_repeats(const borg_script *s, int32_t branch)
{
    int repeats = 0;
    for (; branch >= 0; branch = s->guards[branch / 2].around) {
        repeats |= s->guards[branch / 2].repeats;
    }
    return repeats;
}

/* Whether others hear of a signal: 0 no, 1 once, 2 each time, and when it stops. */
static int told(const making *c, uint8_t kind)
{
    borg_term terms[BORG_CHAIN_MAX];
    int most = 0;
    for (int32_t i = 0; i < c->script->effect_count; i++) {
        const borg_effect *e = &c->script->effects[i];
        const borg_action *a = &c->script->actions[e->action];
        if (e->ref == c->group->line && c->group->units == 1) {
            continue;
        }
        const int32_t count = borg_branch_terms(terms, c->script, e->branch);
        int uses = a->verb == BORG_GO_TARGET && a->ref == c->group->line && kind == BORG_OBJ_DETECT_TRUE;
        int often = branch_repeats(c->script, e->branch);
        for (int32_t j = 0; j < count; j++) {
            uses |= terms[j].op == kind && terms[j].ref == c->group->line;
            often |= terms[j].op == BORG_NOT;
        }
        const int now = uses ? 1 + often : 0;
        most = now > most ? now : most;
    }
    return most;
}

static void put_multicast(making *c, uint8_t kind, int repeats)
{
    const borg_action action = {.verb = BORG_MULTICAST, .kind = kind, .ref = c->group->line};
    const size_t at = open_handler(c, repeats, 0, (borg_term){kind, 1, c->group->line});
    if (kind != BORG_OBJ_DETECT_FALSE) {
        put_verb(c, BORG_RESET_TIME, 0);
    }
    borg_build_action(&c->build, &action);
    borg_build_close(&c->build, at);
    c->handlers++;
}

static void put_multicasts(making *c)
{
    static const uint8_t kinds[] = {BORG_OBJ_DETECT_TRUE, BORG_REACHED, BORG_LINE_END, BORG_BUMPED,
                                    BORG_BATTERY_LOW};
    for (size_t i = 0; i < sizeof kinds; i++) {
        const int how = told(c, kinds[i]);
        if (how > 0) {
            put_multicast(c, kinds[i], how == 2);
        }
        if (how == 2 && kinds[i] == BORG_OBJ_DETECT_TRUE) {
            put_multicast(c, BORG_OBJ_DETECT_FALSE, 1);
        }
    }
}

/* The machine that an effect is for; 0: all, or those chosen. */
static uint8_t unit_of(const making *c, const borg_effect *e)
{
    return e->of == 0 && c->group->units > 1 ? e->k : 0;
}

static int32_t winners_of(const borg_effect *e)
{
    return e->of != 0 && e->k < e->of ? e->k : 0;
}

/* The next effect on this group, from i. */
static int32_t next_effect(const making *c, int32_t i)
{
    while (i < c->script->effect_count && c->script->effects[i].ref != c->group->line) {
        i++;
    }
    return i;
}

/* Effects i and those behind it that belong to the same handler. Returns where they end. */
static int32_t put_run(making *c, int32_t i)
{
    const borg_effect *const effects = c->script->effects, *const e = &effects[i];
    const borg_action *const actions = c->script->actions;
    int32_t end = i, only_stops = 1, goes = 0;
    while (end < c->script->effect_count && effects[end].branch == e->branch &&
           unit_of(c, &effects[end]) == unit_of(c, e) && winners_of(&effects[end]) == winners_of(e)) {
        const uint8_t verb = actions[effects[end].action].verb;
        only_stops &= verb == BORG_STOP;
        goes |= verb == BORG_GO || verb == BORG_GO_TARGET;
        end = next_effect(c, end + 1);
    }
    borg_term terms[BORG_CHAIN_MAX];
    const int32_t count = borg_branch_terms(terms, c->script, e->branch), winners = winners_of(e);
    const size_t at = borg_build_handler(&c->build, branch_repeats(c->script, e->branch), winners);
    for (int32_t j = 0; j < count; j++) {
        borg_build_term(&c->build, &terms[j]);
    }
    borg_build_body(&c->build, at);
    const size_t inner = winners ? open_handler(c, 0, 0, (borg_term){BORG_VOTE_WIN, 1, 0}) : 0;
    if (!only_stops && actions[e->action].verb != BORG_RESET_TIME) {
        put_verb(c, BORG_RESET_TIME, unit_of(c, e));
    }
    for (int32_t j = i; j < end; j = next_effect(c, j + 1)) {
        borg_action action = actions[effects[j].action];
        action.unit = unit_of(c, e);
        borg_build_action(&c->build, &action);
    }
    if (winners) {
        borg_build_close(&c->build, inner);
    }
    if (winners && goes) {
        const size_t reached = open_handler(c, 0, 0, (borg_term){BORG_REACHED, 1, 0});
        put_verb(c, BORG_STOP, 0);
        borg_build_close(&c->build, reached);
    }
    borg_build_close(&c->build, at);
    c->handlers++;
    c->all++;
    return end;
}

/* With what is at this place, a chunk has no room any more. */
static void look_at_size(making *c, borg_place place)
{
    if (c->expected) {
        return;
    }
    c->place = place;
    if (c->all > BORG_HANDLERS_MAX) {
        c->expected = "expected less for this group: from here on its chunk would have more than 32 handlers";
    } else if (c->build.used > BORG_CHUNK_BYTES_MAX) {
        c->expected = "expected less for this group: from here on its chunk would have more than 512 bytes";
    }
}

/* All but the header. */
static void put_all(making *c)
{
    put_start(c);
    put_multicasts(c);
    look_at_size(c, c->group->place);
    for (int32_t i = next_effect(c, 0); i < c->script->effect_count;) {
        const borg_place place = c->script->effects[i].place;
        i = put_run(c, i);
        look_at_size(c, place);
    }
}

iris_status borg_script_decompose(uint8_t *chunk, size_t capacity, size_t *bytes, const borg_script *script,
                                  int32_t group)
{
    if (!chunk || !bytes || !script || group < 0 || group >= script->group_count) {
        return IRIS_ERR_ARG;
    }
    making c = {.script = script, .group = &script->groups[group]};
    borg_build_start(&c.build, chunk, capacity);
    put_all(&c);
    if (c.expected) {
        return IRIS_ERR_RANGE;
    }
    const uint16_t timeout_s = c.group->timeout_s ? c.group->timeout_s : script->timeout_s;
    const borg_build_header header = {c.group->line, c.group->units, timeout_s ? timeout_s : BORG_TIMEOUT_S,
                                      c.handlers};
    return borg_build_finish(&c.build, bytes, &header);
}

/* What no machine can run of a chunk that fits; null: nothing. */
static const char *beyond_a_machine(const borg_script *script, int32_t group)
{
    uint8_t chunk[BORG_CHUNK_BYTES_MAX];
    size_t bytes;
    if (borg_script_decompose(chunk, sizeof chunk, &bytes, script, group) != IRIS_OK) {
        return "expected simpler conditions: this group's chunk has one of more than 255 bytes";
    }
    const int32_t elections = borg_chunk_elections(chunk);
    if (elections > BORG_MEMBER_ELECTIONS_MAX) {
        return "expected at most 4 choices of some units of a group, as UNITS(1 OF 2)";
    }
    if (elections > 0 && script->groups[group].units > BORG_ELECTION_UNITS_MAX) {
        return "expected at most 16 units in a group of which some are chosen";
    }
    if (borg_seen_missing(chunk, NULL) > BORG_SEEN_MAX) {
        return "expected less to react to: a machine remembers 24 different signals at once";
    }
    return NULL;
}

int borg_script_fits(const borg_script *script, borg_problem *problem)
{
    for (int32_t i = 0; i < script->group_count; i++) {
        making c = {.script = script, .group = &script->groups[i]};
        borg_build_start(&c.build, NULL, 0);
        put_all(&c);
        if (!c.expected) {
            c.place = c.group->place;
            c.expected = beyond_a_machine(script, i);
        }
        if (c.expected) {
            *problem = (borg_problem){c.place.line, c.place.column, c.expected};
            return 0;
        }
    }
    return 1;
}
