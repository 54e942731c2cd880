/* The table as Markdown for people, or as TAP for the tests. */
#include <stdarg.h>
#include <stdio.h>

#include "score.h"

static const char RULE[] = "----------------------------------------------------------------------";
static const char *const VERDICTS[] = {"**NO**", "yes", "skipped", "**NO**", ""};

void score_head(const score *s)
{
    if (!s->tap) {
        printf("| %-66s | %-16s | %-60s | %-7s |\n", "what", "required", "reached", "verdict");
        printf("|%.68s|%.18s|%.62s|%.9s|\n", RULE, RULE, RULE, RULE);
    }
}

void score_row(score *s, const char *what, const char *required, score_verdict verdict, const char *format,
               ...)
{
    char reached[256];
    va_list values;
    va_start(values, format);
    /* clang-tidy 14 forgets va_start when it reads several files. */
    /* NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized) */
    vsnprintf(reached, sizeof reached, format, values);
    va_end(values);
    s->reached += verdict == SCORE_REACHED;
    s->missed += verdict == SCORE_MISSED;
    s->skipped += verdict == SCORE_SKIPPED;
    s->falls_short += verdict == SCORE_SHORT;
    if (!s->tap) {
        printf("| %-66s | %-16s | %-60s | %-7s |\n", what, required ? required : "", reached,
               VERDICTS[verdict]);
    } else if (verdict == SCORE_SKIPPED) {
        printf("ok - %s # SKIP %s\n", what, reached);
    } else if (verdict == SCORE_SHORT) {
        printf("ok - %s # SKIP known to fall short: %s, required %s\n", what, reached, required);
    } else if (verdict != SCORE_INFORMATION) {
        printf("%s - %s, required %s: %s\n", verdict == SCORE_REACHED ? "ok" : "not ok", what, required,
               reached);
    }
    fflush(stdout);
}

void score_totals(const score *s)
{
    if (!s->tap) {
        printf("\n%d of %d figures reached", s->reached, s->reached + s->missed + s->falls_short);
        if (s->falls_short > 0) {
            printf(", %d known to fall short", s->falls_short);
        }
        if (s->skipped > 0) {
            printf(", %d skipped", s->skipped);
        }
        printf("\n");
    }
}
