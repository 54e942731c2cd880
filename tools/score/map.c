/* The other closed loop, as the demo reported it: a walled course is mapped, and the robot finds itself in the map. */
#include <string.h>

#include "figures.h"

typedef struct {
    double found, near, wrong, known; /* percent */
    double drift;                     /* of odometry alone, mm */
    double largest, mean, turn, cell; /* of poses, mm and degrees */
    int passed;
} walls_report;

static int read_report(walls_report *r, FILE *file)
{
    char line[256];
    int read = 0;
    *r = (walls_report){0};
    while (fgets(line, sizeof line, file)) {
        read += sscanf(line,
                       "map %*d wall cells seen: %lf %% found, %lf %% within a cell; %*d free cells: %lf %% "
                       "wrong, %lf",
                       &r->found, &r->near, &r->wrong, &r->known) == 4;
        read += sscanf(line, "odometry alone: largest error %lf", &r->drift) == 1;
        read += sscanf(line, "pose largest error %lf mm, mean %lf mm, heading %lf degrees; a cell is %lf",
                       &r->largest, &r->mean, &r->turn, &r->cell) == 4;
        r->passed |= strncmp(line, "PASSED", 6) == 0;
    }
    fclose(file);
    return read == 3;
}

void score_map(score *s)
{
    static const char *const map =
        "walled course mapped by noisy disparities: wall cells within a cell; free cells wrong";
    static const char *const pose =
        "closed loop: found in that map by odometry and disparities, largest error";
    char why[128];
    walls_report r;
    FILE *file = figures_open(why, sizeof why, s, "walls");
    if (!file) {
        score_row(s, map, "90 %, 1 %", SCORE_SKIPPED, "%s", why);
        score_row(s, pose, "a cell", SCORE_SKIPPED, "%s", why);
        return;
    }
    const int read = read_report(&r, file);
    score_row(s, map, "90 %, 1 %", score_if(read && r.near >= 90 && r.wrong <= 1),
              "%.1f %%, %.2f %%; %.1f %% in the very cell, %.1f %% known free", r.near, r.wrong, r.found,
              r.known);
    score_row(s, pose, "a cell", score_if(read && r.passed && r.largest < r.cell),
              "%.0f mm of %.0f, mean %.0f; %.1f degrees; odometry alone %.0f mm", r.largest, r.cell, r.mean,
              r.turn, r.drift);
}
