/* Conditions as they are read, in scripts and in chunks: AND, OR, NOT, and parentheses, to postfix terms. */
#ifndef IRIS_BORG_CONDITION_H
#define IRIS_BORG_CONDITION_H

#include "iris/borg/script.h"
#include "lexer.h"

typedef struct {
    borg_term *terms;
    borg_place *places; /* null: of no interest */
    int32_t count, room;
    int32_t nesting_max;                                    /* of parentheses */
    int (*take_signal)(borg_term *term, borg_lexer *lexer); /* 0 when it complained */
    const char *expected;                                   /* where a signal is to stand */
} borg_condition;

/* Reads one up to the word that can belong to it no more; 0 when it complained. Terms are added. */
int borg_condition_take(borg_condition *c, borg_lexer *lexer);

int borg_condition_put(borg_condition *c, borg_lexer *lexer, borg_term term);

#endif
