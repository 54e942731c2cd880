/* The closed loop, as the demo reported it. */
#include <string.h>

#include "figures.h"

typedef struct {
    double laps, of, rms, largest, allowed; /* laps and centimeters */
    int passed;
} drive_report;

static void read_report(drive_report *report, FILE *file)
{
    char line[256];
    *report = (drive_report){0};
    while (fgets(line, sizeof line, file)) {
        sscanf(line, "laps %lf of %lf", &report->laps, &report->of);
        sscanf(line, "error rms %lf cm, largest %lf cm (%*[^)]), allowed %lf", &report->rms, &report->largest,
               &report->allowed);
        report->passed |= strncmp(line, "PASSED", 6) == 0;
    }
    fclose(file);
}

void score_drive(score *s)
{
    char why[128];
    drive_report r;
    FILE *file = figures_open(why, sizeof why, s, "drive");
    if (!file) {
        score_row(s, "closed loop: laps", "all", SCORE_SKIPPED, "%s", why);
        score_row(s, "closed loop: largest error", "half the robot", SCORE_SKIPPED, "%s", why);
    } else {
        read_report(&r, file);
        score_row(s, "closed loop: laps", "all", score_if(r.of >= 1 && r.laps >= r.of), "%.2f of %.0f",
                  r.laps, r.of);
        score_row(s, "closed loop: largest error", "half the robot",
                  score_if(r.allowed > 0 && r.largest < r.allowed && r.passed), "%.1f cm of %.1f, rms %.1f",
                  r.largest, r.allowed, r.rms);
    }
    file = figures_open(why, sizeof why, s, "blank");
    if (!file) {
        score_row(s, "closed loop with the lens covered", "fails", SCORE_SKIPPED, "%s", why);
    } else {
        read_report(&r, file);
        score_row(s, "closed loop with the lens covered", "fails",
                  score_if(r.of >= 1 && !r.passed && r.laps < 1), "%.2f laps, %s", r.laps,
                  r.passed ? "passed" : "failed");
    }
}
