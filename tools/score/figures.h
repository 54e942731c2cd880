/* What other programs measured: text files that make leaves in one folder. A file that could not be made
 * begins with "skipped: " and says why. */
#ifndef SCORE_FIGURES_H
#define SCORE_FIGURES_H

#include <stddef.h>
#include <stdio.h>

#include "score.h"

/* Opens s->figures/name. Null: it is not there or was skipped, and `why` (of `bytes` bytes) says so. */
FILE *figures_open(char *why, size_t bytes, const score *s, const char *name);

#endif
