/* IRIS - BorgCode: one script for a team of robots, checked, formatted, and taken apart into a chunk for each group.
 * From the report's section 6.2.3, with AND, OR, NOT, ELSE, WHILE, time-outs, and parameters.
 *
 *     script    = START [TIMEOUT=s] {statement} END
 *     statement = group | if | while | effect
 *     group     = UNITS=n [TIMEOUT=s] : action {, action} [;]       its line has a number, which REF names
 *     if        = IF (condition) block [ELSE block]
 *     while     = WHILE (condition) block
 *     block     = "[" {if | while | effect} "]"
 *     effect    = REF(line):UNITS(k).action [;] | REF(line):UNITS(k OF n).action [;]
 *     action    = LineFollow | LineFollow(mm/s) | ObjDetect | AutoExplore | AutoExplore(mm/s) | MapBuild |
 *                 Go(x, y) in mm | Go(REF(line):UNITS(k).Target) | Turn(degrees to the right) | Stop | ResetTime
 *     condition = {AND and OR, AND first} of [NOT] ( "(" condition ")" | REF(line):UNITS(k).predicate [==TRUE |
 *                 ==FALSE] )
 *     predicate = ObjDetect | TimeOut | Reached | LineEnd | Bumped | BatteryLow
 *
 * Spaces, line breaks, and // comments stand anywhere between words, words in any case. A number at the beginning of
 * a line is that line's number; numbers rise.
 *
 * Meaning: every group does its actions at START. An IF's block runs once, when a signal makes its condition true; a
 * WHILE's each time that it becomes true again; an ELSE's when a condition that was true stops being so (inside of
 * another block: when the outer one is true and the inner one is not). Effects outside of blocks happen at START.
 * UNITS(k OF n) with k < n: k machines are chosen; n OF n: all; UNITS(k): the k-th machine of the group, and in a
 * condition or a target the k-th one that says so. What one group sees and another one needs is multicast, but TimeOut:
 * there every machine counts its own time.
 */
#ifndef IRIS_BORG_SCRIPT_H
#define IRIS_BORG_SCRIPT_H

#include "iris/borg/chunk.h"
#include "iris/borg/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_GROUPS_MAX    32
#define BORG_ACTIONS_MAX   256 /* of all groups and effects */
#define BORG_EFFECTS_MAX   128
#define BORG_GUARDS_MAX    64  /* IFs and WHILEs */
#define BORG_TERMS_MAX     256 /* words of all conditions */
#define BORG_CHAIN_MAX     48  /* words of a condition with those of the blocks around it */
#define BORG_NESTING_MAX   8   /* blocks in blocks, and parentheses in parentheses */
#define BORG_DIFFERENT_MAX 8   /* predicates of a condition with those of the blocks around it */

/* A physical place in the text. */
typedef struct {
    int32_t line, column;
} borg_place;

typedef struct {
    borg_place place;
    uint16_t line;      /* its number */
    uint16_t timeout_s; /* 0: the script's */
    uint8_t units, detects;
    uint16_t first, count; /* of actions */
} borg_group;

/* A branch of a guard: twice its number, and 1 more for its ELSE; -1: outside of all blocks. */
typedef struct {
    borg_place place;
    int16_t around;        /* the branch that it stands in */
    uint16_t first, count; /* of terms, postfix */
    uint8_t repeats, has_else;
} borg_guard;

typedef struct {
    borg_place place;
    int16_t branch;
    uint16_t ref;    /* line of the group */
    uint8_t k, of;   /* of: 0 where none is written */
    uint16_t action; /* its number */
} borg_effect;

/* A script as it was read; some 13 KB in the caller's memory. */
typedef struct {
    borg_group groups[BORG_GROUPS_MAX];
    borg_action actions[BORG_ACTIONS_MAX];
    borg_place action_places[BORG_ACTIONS_MAX];
    borg_effect effects[BORG_EFFECTS_MAX];
    borg_guard guards[BORG_GUARDS_MAX];
    borg_term terms[BORG_TERMS_MAX];
    borg_place term_places[BORG_TERMS_MAX];
    int32_t group_count, action_count, effect_count, guard_count, term_count;
    uint16_t timeout_s;
} borg_script;

/* Reads and checks a script: unknown REFs, more winners than units, targets of groups that do not detect, blocks
 * that can never run, a TimeOut of a group with another TIMEOUT than the one that acts, numbers that do not rise, what
 * stands after END, and groups whose chunk would be too long, or more
 * than a member (member.h) can run. IRIS_ERR_ARG: a null pointer, or more than
 * BORG_TEXT_BYTES_MAX bytes; IRIS_ERR_DATA: *problem says where and what, script is undefined.
 * O(length + blocks * 2^BORG_DIFFERENT_MAX). */
iris_status borg_script_read(borg_script *script, borg_problem *problem, const borg_text *text);

/* Writes a script, which is read first, in one form: a statement a line, blocks indented by 4, words as above;
 * comments stay.
 * A 0 ends it; *length without the 0. Formatted again, it stays as it is. Working memory: `script`, which is as
 * borg_script_read leaves it. IRIS_ERR_RANGE: more than `capacity` bytes, out is undefined; others as
 * borg_script_read. */
iris_status borg_script_format(char *out, size_t capacity, size_t *length, borg_script *script,
                               borg_problem *problem, const borg_text *text);

/* The chunk of the group with this index, from 0; *bytes: its length. script: as borg_script_read left it.
 * IRIS_ERR_ARG: a null pointer or no such group; IRIS_ERR_RANGE: more than `capacity` bytes; chunk is undefined.
 * O(effects * terms). */
iris_status borg_script_decompose(uint8_t *chunk, size_t capacity, size_t *bytes, const borg_script *script,
                                  int32_t group);

#ifdef __cplusplus
}
#endif

#endif
