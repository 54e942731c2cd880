/* The words of BorgCode as they are written: actions and predicates. */
#ifndef IRIS_BORG_WORDS_H
#define IRIS_BORG_WORDS_H

#include <stddef.h>
#include <stdint.h>

/* "LineFollow"; a Go to a target is a Go, too. */
const char *borg_verb_name(int32_t verb);

/* -1 when no action is called so. */
int32_t borg_verb_find(const char *name, size_t length);

/* The signal of a predicate such as ObjDetect; -1. */
int32_t borg_predicate_find(const char *name, size_t length);

/* Any word of scripts as it is written; null when it is none. */
const char *borg_word_written(const char *name, size_t length);

#endif
