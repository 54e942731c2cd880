#include "script_parts.h"

const borg_group *borg_group_find(const borg_script *script, uint16_t line)
{
    for (int32_t i = 0; i < script->group_count; i++) {
        if (script->groups[i].line == line) {
            return &script->groups[i];
        }
    }
    return NULL;
}

int32_t borg_branch_terms(borg_term terms[BORG_CHAIN_MAX], const borg_script *script, int32_t branch)
{
    int32_t chain[BORG_NESTING_MAX], depth = 0, count = 0;
    if (branch < 0) {
        terms[0] = (borg_term){BORG_START, 1, 0};
        return 1;
    }
    for (; branch >= 0 && depth < BORG_NESTING_MAX; branch = script->guards[branch / 2].around) {
        chain[depth++] = branch;
    }
    for (int32_t i = depth - 1; i >= 0; i--) {
        const borg_guard *guard = &script->guards[chain[i] / 2];
        if (count + guard->count + 2 > BORG_CHAIN_MAX) {
            return -1;
        }
        for (int32_t j = 0; j < guard->count; j++) {
            const borg_term *from = &script->terms[guard->first + j];
            terms[count++] = from->op == BORG_TIME_OUT ? (borg_term){BORG_TIME_OUT, 1, 0} : *from;
        }
        if (chain[i] % 2 == 1) {
            terms[count++] = (borg_term){BORG_NOT, 0, 0};
        }
        if (i < depth - 1) {
            terms[count++] = (borg_term){BORG_AND, 0, 0};
        }
    }
    return count;
}

static int fail(borg_problem *problem, borg_place place, const char *expected)
{
    *problem = (borg_problem){place.line, place.column, expected};
    return 0;
}

/* The different predicates of a condition. */
typedef struct {
    borg_term terms[BORG_CHAIN_MAX];
    uint8_t which[BORG_CHAIN_MAX]; /* of the different ones each term is */
    borg_term different[BORG_DIFFERENT_MAX];
    int32_t count, different_count;
} formula;

static int find_different(formula *f)
{
    f->different_count = 0;
    for (int32_t i = 0; i < f->count; i++) {
        const borg_term *t = &f->terms[i];
        int32_t j = 0;
        if (t->op >= BORG_AND) {
            continue;
        }
        while (j < f->different_count && (f->different[j].op != t->op || f->different[j].ref != t->ref ||
                                          f->different[j].machines != t->machines)) {
            j++;
        }
        if (j == BORG_DIFFERENT_MAX) {
            return 0;
        }
        f->different[j] = *t;
        f->different_count += j == f->different_count;
        f->which[i] = (uint8_t)j;
    }
    return 1;
}

/* Its value when exactly the predicates of `holds` hold. */
static int evaluate(const formula *f, uint32_t holds)
{
    uint64_t stack = 0; /* the top is bit 0 */
    for (int32_t i = 0; i < f->count; i++) {
        const uint8_t op = f->terms[i].op;
        if (op < BORG_AND) {
            stack = stack << 1 | (holds >> f->which[i] & 1u);
        } else if (op == BORG_NOT) {
            stack ^= 1;
        } else {
            const uint64_t top = stack & 1;
            stack >>= 1;
            stack = op == BORG_AND ? stack & (top | ~(uint64_t)1) : stack | top;
        }
    }
    return (int)(stack & 1);
}

/* Whether one signal can make it true: one that begins to hold, or an object that is lost. */
static int can_become_true(const formula *f)
{
    for (uint32_t holds = 0; holds < 1u << f->different_count; holds++) {
        if (!evaluate(f, holds)) {
            continue;
        }
        for (int32_t i = 0; i < f->different_count; i++) {
            const int can_change = (holds >> i & 1) || f->different[i].op == BORG_OBJ_DETECT_TRUE;
            if (can_change && !evaluate(f, holds ^ 1u << i)) {
                return 1;
            }
        }
    }
    return 0;
}

static int stack_is_good(const formula *f)
{
    int32_t depth = 0;
    for (int32_t i = 0; i < f->count; i++) {
        depth += f->terms[i].op < BORG_AND ? 1 : f->terms[i].op == BORG_NOT ? 0 : -1;
        if (depth > BORG_STACK_MAX) {
            return 0;
        }
    }
    return 1;
}

static int check_branch(const borg_script *s, borg_problem *problem, int32_t branch)
{
    const borg_place place = s->guards[branch / 2].place;
    formula f;
    f.count = borg_branch_terms(f.terms, s, branch);
    if (f.count < 0 || !stack_is_good(&f)) {
        return fail(problem, place, "expected a simpler condition, with those of the blocks around it");
    }
    if (!find_different(&f)) {
        return fail(problem, place,
                    "expected at most 8 different predicates, with those of the blocks around it");
    }
    return can_become_true(&f) ||
           fail(problem, place,
                branch % 2 ? "expected a condition that can stop being true: the ELSE can never run"
                           : "expected a condition that can become true: this block can never run");
}

static int check_ref(const borg_script *s, borg_problem *problem, borg_place place, uint16_t ref, int32_t k)
{
    const borg_group *group = borg_group_find(s, ref);
    if (!group) {
        return fail(problem, place, "expected the line of a group: none has this number");
    }
    return k <= group->units || fail(problem, place, "expected no more units than the group has");
}

static int check_terms(const borg_script *s, borg_problem *problem)
{
    for (int32_t i = 0; i < s->term_count; i++) {
        const borg_term *t = &s->terms[i];
        if (t->op >= BORG_AND) {
            continue;
        }
        if (!check_ref(s, problem, s->term_places[i], t->ref, t->machines)) {
            return 0;
        }
        if (t->op == BORG_OBJ_DETECT_TRUE && !borg_group_find(s, t->ref)->detects) {
            return fail(problem, s->term_places[i], "expected a group that does ObjDetect");
        }
    }
    return 1;
}

static int check_actions(const borg_script *s, borg_problem *problem)
{
    for (int32_t i = 0; i < s->action_count; i++) {
        const borg_action *a = &s->actions[i];
        if (a->verb != BORG_GO_TARGET) {
            continue;
        }
        if (!check_ref(s, problem, s->action_places[i], a->ref, a->which)) {
            return 0;
        }
        if (!borg_group_find(s, a->ref)->detects) {
            return fail(problem, s->action_places[i], "expected the target of a group that does ObjDetect");
        }
    }
    return 1;
}

static int check_effects(const borg_script *s, borg_problem *problem)
{
    for (int32_t i = 0; i < s->effect_count; i++) {
        const borg_effect *e = &s->effects[i];
        const borg_group *group = borg_group_find(s, e->ref);
        if (group && e->k > group->units && e->of) {
            return fail(problem, e->place, "expected no more winners than the group has units");
        }
        if (!check_ref(s, problem, e->place, e->ref, e->k)) {
            return 0;
        }
        if (e->of && e->of != group->units) {
            return fail(problem, e->place, "expected behind OF as many units as the group has");
        }
    }
    return 1;
}

/* 0 where none is named: the same for all that name none. */
static uint16_t timeout_of(const borg_script *s, uint16_t ref)
{
    const borg_group *group = borg_group_find(s, ref);
    return group->timeout_s ? group->timeout_s : s->timeout_s;
}

/* Each machine counts its own time: another group's TimeOut is the machine's own, which is meant where both are equal. */
static int check_clocks(const borg_script *s, borg_problem *problem)
{
    for (int32_t i = 0; i < s->effect_count; i++) {
        const borg_effect *e = &s->effects[i];
        for (int32_t branch = e->branch; branch >= 0; branch = s->guards[branch / 2].around) {
            const borg_guard *guard = &s->guards[branch / 2];
            for (int32_t t = guard->first; t < guard->first + guard->count; t++) {
                if (s->terms[t].op == BORG_TIME_OUT &&
                    timeout_of(s, s->terms[t].ref) != timeout_of(s, e->ref)) {
                    return fail(
                        problem, s->term_places[t],
                        "expected a TimeOut of the group that acts, or of one with the same TIMEOUT: each "
                        "machine counts its own time");
                }
            }
        }
    }
    return 1;
}

static void find_detecting(borg_script *s)
{
    for (int32_t i = 0; i < s->group_count; i++) {
        borg_group *group = &s->groups[i];
        for (int32_t j = 0; j < group->count; j++) {
            group->detects |= s->actions[group->first + j].verb == BORG_OBJ_DETECT;
        }
        for (int32_t j = 0; j < s->effect_count; j++) {
            group->detects |=
                s->effects[j].ref == group->line && s->actions[s->effects[j].action].verb == BORG_OBJ_DETECT;
        }
    }
}

int borg_script_check(borg_script *s, borg_problem *problem)
{
    find_detecting(s);
    if (!check_effects(s, problem) || !check_terms(s, problem) || !check_actions(s, problem) ||
        !check_clocks(s, problem)) {
        return 0;
    }
    for (int32_t i = 0; i < s->guard_count; i++) {
        if (!check_branch(s, problem, 2 * i) ||
            (s->guards[i].has_else && !check_branch(s, problem, 2 * i + 1))) {
            return 0;
        }
    }
    return 1;
}
