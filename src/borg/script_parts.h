/* What reads, checks, and takes apart a script, in pieces. */
#ifndef IRIS_BORG_SCRIPT_PARTS_H
#define IRIS_BORG_SCRIPT_PARTS_H

#include "iris/borg/script.h"
#include "lexer.h"

/* The terms of a branch with those of the branches around it, as one condition; START outside of all. How many, at most
 * BORG_CHAIN_MAX; -1: more. */
int32_t borg_branch_terms(borg_term terms[BORG_CHAIN_MAX], const borg_script *script, int32_t branch);

/* The group of a line; null when there is none. */
const borg_group *borg_group_find(const borg_script *script, uint16_t line);

/* What is wrong with a script that was read; 0 with *problem, or 1. */
int borg_script_check(borg_script *script, borg_problem *problem);

/* Whether every group of a script that is right has a chunk that machines can run; 0 with *problem, or 1. */
int borg_script_fits(const borg_script *script, borg_problem *problem);

#endif
