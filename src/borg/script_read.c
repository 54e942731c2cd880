#include "condition.h"
#include "lexer.h"
#include "script_parts.h"
#include "words.h"

typedef struct {
    borg_script *script;
    borg_lexer lexer;
    int16_t branches[BORG_NESTING_MAX]; /* that are open */
    int32_t depth;
} reading;

static borg_place place_of(const borg_lexer *l)
{
    return (borg_place){l->token.line, l->token.column};
}

typedef struct {
    uint16_t ref;
    uint8_t k, of; /* of: 0 where none is written */
} units_ref;

/* REF(line):UNITS(k [OF n]). */
static int take_ref(units_ref *to, borg_lexer *l, int takes_of)
{
    int32_t line = 0, k = 0, of = 0;
    if (!borg_lexer_take_word(l, "REF", "expected REF(line)") || !borg_lexer_take(l, '(', "expected '('") ||
        !borg_lexer_take_number(&line, l, 0, UINT16_MAX, "expected the line of a group") ||
        !borg_lexer_take(l, ')', "expected ')'") || !borg_lexer_take(l, ':', "expected ':'") ||
        !borg_lexer_take_word(l, "UNITS", "expected UNITS(k)") || !borg_lexer_take(l, '(', "expected '('") ||
        !borg_lexer_take_number(&k, l, 1, BORG_UNITS_MAX, "expected 1 to 255 units")) {
        return 0;
    }
    if (takes_of && borg_lexer_skip_word(l, "OF") &&
        !borg_lexer_take_number(&of, l, 1, BORG_UNITS_MAX, "expected 1 to 255 units")) {
        return 0;
    }
    *to = (units_ref){(uint16_t)line, (uint8_t)k, (uint8_t)of};
    return borg_lexer_take(l, ')', takes_of ? "expected OF or ')'" : "expected ')'") &&
           borg_lexer_take(l, '.', "expected '.'");
}

/* A predicate; 2: the opposite of the signal is meant. */
static int take_predicate(borg_term *term, borg_lexer *l)
{
    units_ref ref;
    if (!take_ref(&ref, l, 0)) {
        return 0;
    }
    const int32_t kind =
        l->token.kind == BORG_TOKEN_WORD ? borg_predicate_find(l->token.at, l->token.length) : -1;
    if (kind < 0) {
        return borg_lexer_fail(l, "expected ObjDetect, TimeOut, Reached, LineEnd, Bumped, or BatteryLow");
    }
    *term = (borg_term){(uint8_t)kind, ref.k, ref.ref};
    borg_lexer_next(l);
    if (!borg_lexer_skip(l, BORG_TOKEN_SAME)) {
        return l->token.kind == '=' ? borg_lexer_fail(l, "expected ==") : 1;
    }
    return borg_lexer_skip_word(l, "TRUE")    ? 1
           : borg_lexer_skip_word(l, "FALSE") ? 2
                                              : borg_lexer_fail(l, "expected TRUE or FALSE");
}

/* Where to go: a target, or x and y. */
static int take_way(borg_action *action, borg_lexer *l)
{
    const char *const mm = "expected REF(line):UNITS(k).Target, or millimeters of at most 10000000";
    if (borg_lexer_is(l, "REF")) {
        units_ref ref;
        if (!take_ref(&ref, l, 0)) {
            return 0;
        }
        *action = (borg_action){
            .verb = BORG_GO_TARGET, .kind = BORG_OBJ_DETECT_TRUE, .which = ref.k, .ref = ref.ref};
        return borg_lexer_take_word(l, "Target", "expected Target");
    }
    return borg_lexer_take_number(&action->a, l, -BORG_PLACE_MAX_MM, BORG_PLACE_MAX_MM, mm) &&
           borg_lexer_take(l, ',', "expected ',' and y") &&
           borg_lexer_take_number(&action->b, l, -BORG_PLACE_MAX_MM, BORG_PLACE_MAX_MM, mm);
}

static int take_argument(borg_action *action, borg_lexer *l)
{
    const int may = action->verb == BORG_LINE_FOLLOW || action->verb == BORG_AUTO_EXPLORE;
    const int must = action->verb == BORG_TURN || action->verb == BORG_GO;
    if (!must && !(may && l->token.kind == '(')) {
        return 1;
    }
    if (!borg_lexer_take(
            l, '(', action->verb == BORG_GO ? "expected '(' and where to go" : "expected '(' and degrees")) {
        return 0;
    }
    const int taken =
        action->verb == BORG_GO ? take_way(action, l)
        : may ? borg_lexer_take_number(&action->a, l, 1, UINT16_MAX, "expected a speed in mm/s, 1 to 65535")
              : borg_lexer_take_number(&action->a, l, INT16_MIN, INT16_MAX,
                                       "expected degrees, -32768 to 32767");
    return taken && borg_lexer_take(l, ')', "expected ')'");
}

static int take_action(reading *r)
{
    borg_lexer *l = &r->lexer;
    borg_script *s = r->script;
    borg_action action = {0};
    const borg_place place = place_of(l);
    const int32_t verb = l->token.kind == BORG_TOKEN_WORD ? borg_verb_find(l->token.at, l->token.length) : -1;
    if (verb < 0 || verb == BORG_MULTICAST) {
        return borg_lexer_fail(
            l,
            "expected an action: LineFollow, ObjDetect, AutoExplore, MapBuild, Go, Turn, Stop, or ResetTime");
    }
    if (s->action_count == BORG_ACTIONS_MAX) {
        return borg_lexer_fail(l, "expected at most 256 actions in a script");
    }
    action.verb = (uint8_t)verb;
    borg_lexer_next(l);
    if (!take_argument(&action, l)) {
        return 0;
    }
    s->action_places[s->action_count] = place;
    s->actions[s->action_count++] = action;
    return 1;
}

/* [TIMEOUT=s] */
static int take_timeout(uint16_t *seconds, borg_lexer *l)
{
    int32_t number = 0;
    if (borg_lexer_skip_word(l, "TIMEOUT") &&
        (!borg_lexer_take(l, '=', "expected '='") ||
         !borg_lexer_take_number(&number, l, 1, UINT16_MAX, "expected seconds, 1 to 65535"))) {
        return 0;
    }
    *seconds = (uint16_t)number;
    return 1;
}

static int take_group(reading *r)
{
    borg_lexer *l = &r->lexer;
    borg_script *s = r->script;
    int32_t units = 0;
    borg_group group = {
        .place = place_of(l), .line = (uint16_t)l->number, .first = (uint16_t)s->action_count};
    if (r->depth > 0) {
        return borg_lexer_fail(l, "expected an effect, IF, or ']': groups stand outside of blocks");
    }
    if (!l->token.numbered || l->number == 0) {
        return borg_lexer_fail(l, "expected a line number from 1 before UNITS: REF names it");
    }
    if (s->group_count == BORG_GROUPS_MAX) {
        return borg_lexer_fail(l, "expected at most 32 groups in a script");
    }
    borg_lexer_next(l);
    if (!borg_lexer_take(l, '=', "expected UNITS=n") ||
        !borg_lexer_take_number(&units, l, 1, BORG_UNITS_MAX, "expected 1 to 255 units") ||
        !take_timeout(&group.timeout_s, l) || !borg_lexer_take(l, ':', "expected ':' and actions")) {
        return 0;
    }
    do {
        if (!take_action(r)) {
            return 0;
        }
    } while (borg_lexer_skip(l, ','));
    (void)borg_lexer_skip(l, ';');
    group.units = (uint8_t)units;
    group.count = (uint16_t)(s->action_count - group.first);
    s->groups[s->group_count++] = group;
    return 1;
}

static int16_t branch_now(const reading *r)
{
    return (int16_t)(r->depth > 0 ? r->branches[r->depth - 1] : -1);
}

static int take_effect(reading *r)
{
    borg_script *s = r->script;
    units_ref ref;
    borg_effect effect = {.place = place_of(&r->lexer), .branch = branch_now(r)};
    if (s->effect_count == BORG_EFFECTS_MAX) {
        return borg_lexer_fail(&r->lexer, "expected at most 128 effects in a script");
    }
    if (!take_ref(&ref, &r->lexer, 1)) {
        return 0;
    }
    effect.ref = ref.ref;
    effect.k = ref.k;
    effect.of = ref.of;
    effect.action = (uint16_t)s->action_count;
    s->effects[s->effect_count++] = effect;
    if (!take_action(r)) {
        return 0;
    }
    (void)borg_lexer_skip(&r->lexer, ';');
    return 1;
}

static int open_block(reading *r, int32_t branch)
{
    if (r->depth == BORG_NESTING_MAX) {
        return borg_lexer_fail(&r->lexer, "expected at most 8 blocks in blocks");
    }
    r->branches[r->depth++] = (int16_t)branch;
    return borg_lexer_take(&r->lexer, '[', "expected '['");
}

static int take_guard(reading *r, int repeats)
{
    borg_script *s = r->script;
    borg_lexer *l = &r->lexer;
    if (s->guard_count == BORG_GUARDS_MAX) {
        return borg_lexer_fail(l, "expected at most 64 IFs and WHILEs in a script");
    }
    borg_guard *guard = &s->guards[s->guard_count];
    *guard = (borg_guard){.place = place_of(l),
                          .around = branch_now(r),
                          .first = (uint16_t)s->term_count,
                          .repeats = (uint8_t)repeats};
    borg_lexer_next(l);
    borg_condition condition = {.terms = s->terms,
                                .places = s->term_places,
                                .count = s->term_count,
                                .room = BORG_TERMS_MAX,
                                .nesting_max = BORG_NESTING_MAX,
                                .take_signal = take_predicate,
                                .expected = "expected REF(line), NOT, or '('"};
    if (!borg_lexer_take(l, '(', "expected '('") || !borg_condition_take(&condition, l) ||
        !borg_lexer_take(l, ')', "expected AND, OR, or ')'")) {
        return 0;
    }
    s->term_count = condition.count;
    guard->count = (uint16_t)(s->term_count - guard->first);
    return open_block(r, 2 * s->guard_count++);
}

static int close_block(reading *r)
{
    borg_lexer *l = &r->lexer;
    if (r->depth == 0) {
        return borg_lexer_fail(l, "expected a statement or END: no block is open");
    }
    const int16_t branch = r->branches[--r->depth];
    borg_lexer_next(l);
    (void)borg_lexer_skip(l, ';');
    borg_guard *guard = &r->script->guards[branch / 2];
    if (branch % 2 == 0 && !guard->repeats && borg_lexer_skip_word(l, "ELSE")) {
        guard->has_else = 1;
        return open_block(r, branch + 1);
    }
    return 1;
}

/* One statement, or the end of a block. 0 at END, and when it complained. */
static int take_statement(reading *r)
{
    borg_lexer *l = &r->lexer;
    if (l->token.kind == ']') {
        return close_block(r);
    }
    if (borg_lexer_is(l, "UNITS")) {
        return take_group(r);
    }
    if (borg_lexer_is(l, "REF")) {
        return take_effect(r);
    }
    if (borg_lexer_is(l, "IF") || borg_lexer_is(l, "WHILE")) {
        return take_guard(r, borg_lexer_is(l, "WHILE"));
    }
    if (borg_lexer_is(l, "ELSE")) {
        return borg_lexer_fail(l, "expected ELSE only behind the block of an IF");
    }
    if (!borg_lexer_is(l, "END")) {
        return borg_lexer_fail(l, r->depth > 0 ? "expected REF, IF, WHILE, or ']'"
                                               : "expected UNITS, REF, IF, WHILE, or END");
    }
    if (r->depth > 0) {
        return borg_lexer_fail(l, "expected ']' before END");
    }
    return 0;
}

static int take_script(reading *r)
{
    borg_lexer *l = &r->lexer;
    l->takes_lines = 1;
    borg_lexer_next(l);
    if (!borg_lexer_take_word(l, "START", "expected START") || !take_timeout(&r->script->timeout_s, l)) {
        return 0;
    }
    (void)borg_lexer_skip(l, ';');
    while (take_statement(r)) {
    }
    if (l->has_failed) {
        return 0;
    }
    borg_lexer_next(l);
    (void)borg_lexer_skip(l, ';');
    if (l->token.kind != BORG_TOKEN_END) {
        return borg_lexer_fail(l, "expected nothing behind END: it would never run");
    }
    return !l->has_failed;
}

iris_status borg_script_read(borg_script *script, borg_problem *problem, const borg_text *text)
{
    if (!script || !problem || !text || (!text->at && text->length > 0) ||
        text->length > BORG_TEXT_BYTES_MAX) {
        return IRIS_ERR_ARG;
    }
    static const char nothing = '\0';
    const char *const from = text->at ? text->at : &nothing;
    reading r;
    r.script = script;
    r.depth = 0;
    script->group_count = script->action_count = script->effect_count = 0;
    script->guard_count = script->term_count = 0;
    borg_lexer_start(&r.lexer, from, from + text->length);
    if (!take_script(&r)) {
        *problem = r.lexer.problem;
        return IRIS_ERR_DATA;
    }
    return borg_script_check(script, problem) && borg_script_fits(script, problem) ? IRIS_OK : IRIS_ERR_DATA;
}
