/* What the follower costs: instructions, memory, flash. */
#include <string.h>

#include "figures.h"
#include "iris/command.h"
#include "iris/xt/follow.h"
#include "iris/xt/steer.h"

/* The first number of the first line of the file that contains `name`; -1 when there is none. */
static double number_before(FILE *file, const char *name)
{
    char line[256];
    double number = -1;
    while (number < 0 && fgets(line, sizeof line, file)) {
        if (strstr(line, name)) {
            sscanf(line, "%lf", &number);
        }
    }
    fclose(file);
    return number;
}

/* One row: the number before `name` in a file of figures is at most `most`; most 0: for information. Above `most`, up to
 * `known` is a known shortfall. */
static void score_number(score *s, const char *what, const char *figure, const char *name, double most,
                         double known)
{
    char why[128], required[32];
    FILE *file = figures_open(why, sizeof why, s, figure);
    snprintf(required, sizeof required, "at most %g", most);
    if (!file) {
        score_row(s, what, required, most > 0 ? SCORE_SKIPPED : SCORE_INFORMATION, "%s", why);
        return;
    }
    double number = number_before(file, name);
    if (most > 0) {
        score_verdict missed = number > 0 && number <= known ? SCORE_SHORT : SCORE_MISSED;
        score_row(s, what, required, number > 0 && number <= most ? SCORE_REACHED : missed,
                  number < 0 ? "not measured" : "%g", number);
    } else if (number >= 0) {
        score_row(s, what, NULL, SCORE_INFORMATION, "%g", number);
    }
}

void score_cost_row(score *s, const char *what, const char *bench_case, size_t memory)
{
    char why[128], row[160];
    FILE *file = figures_open(why, sizeof why, s, "1-M4");
    double number = file ? number_before(file, bench_case) : -1;
    snprintf(row, sizeof row, "cost at 160x120: %s", what);
    if (number < 0) {
        score_row(s, row, NULL, SCORE_INFORMATION, "%lu bytes; instructions on M4: %s", (unsigned long)memory,
                  file ? "no such case" : why);
    } else {
        score_row(s, row, NULL, SCORE_INFORMATION, "%lu bytes; %.0f thousand instructions a frame on M4",
                  (unsigned long)memory, number * 160 * 120 / 1000);
    }
}

void score_cost(score *s)
{
    const size_t frame_memory = IRIS_FOLLOW_SCRATCH_BYTES(160, 120);
    const size_t all = frame_memory + sizeof(iris_follow) + sizeof(iris_follow_result) + sizeof(iris_steer) +
                       sizeof(iris_command) + IRIS_COMMAND_SENTENCE_BYTES;
    score_number(s, "160x120 gray frame to sentence, instructions/pixel, M4", "1-M4", "frame to sentence", 12,
                 0);
    score_number(s, "160x120 gray frame to sentence, instructions/pixel, M0", "2-M0", "frame to sentence", 20,
                 0);
    score_number(s, "the same by Hough transform, instructions/pixel, M4", "1-M4", "the same by Hough", 0, 0);
    score_number(s, "the same by Hough transform, instructions/pixel, M0", "2-M0", "the same by Hough", 0, 0);
    score_row(s, "memory for it beyond the frame, bytes", "at most 4096", score_if(all <= 4096),
              "%lu: rows %lu, follower %lu, steering %lu, the rest %lu", (unsigned long)all,
              (unsigned long)frame_memory, (unsigned long)sizeof(iris_follow),
              (unsigned long)sizeof(iris_steer),
              (unsigned long)(all - frame_memory - sizeof(iris_follow) - sizeof(iris_steer)));
    score_number(s, "flash of the firmware follower, M0 at -Os, bytes", "size", "follower", 8192, 9600);
}
