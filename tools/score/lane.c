/* A lane between two lines of tape: does the steering agree with another program's, and turn around with the
 * picture? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "change.h"
#include "find.h"
#include "picture.h"

#define NEAR 15.0 /* degrees */
#define ZERO 1.0  /* degrees: steering so close to straight has no side */

/* Steering for the frame, and for its mirror image. */
static int steer_both(double steer[2], const score *s, const char *name)
{
    char path[64], picture[64];
    iris_follow_config config;
    iris_image rgb;
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_COLOR;
    config.format = IRIS_RGB888;
    config.lane = 1;
    config.color = (iris_hsl_range){.h0 = 0, .h1 = 360, .s0 = 0, .s1 = 45, .l0 = 15, .l1 = 45};
    snprintf(path, sizeof path, "line/tape_lane/%s.bmp", name);
    if (picture_load(&rgb, path, IRIS_RGB888) != IRIS_OK) {
        free(rgb.data);
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        iris_image changed = change_frame(&(change){.mirrored = i}, &rgb, 0);
        found result = find_line(&changed, &config);
        steer[i] = result.steer_deg;
        snprintf(picture, sizeof picture, "lane %s%s.bmp", name, i ? ", mirrored" : "");
        save_found(s, picture, &changed, &result, NULL, 0);
        free(changed.data);
    }
    free(rgb.data);
    return 1;
}

void score_lane(score *s)
{
    char line[128], name[32], what[96];
    int count = 0, near = 0, sided = 0, flipped = 0;
    double angle, steer[2];
    FILE *list = data_open("line/tape_lane/angles.txt");
    while (list && fgets(line, sizeof line, list)) {
        if (line[0] == '#' || sscanf(line, "%27[^.].bmp %lf", name, &angle) != 2 ||
            !steer_both(steer, s, name)) {
            continue;
        }
        int has_side = fabs(steer[0]) > ZERO;
        count++;
        near += fabs(steer[0] - (angle - 90)) <= NEAR;
        sided += has_side;
        flipped += has_side && steer[0] * steer[1] < 0;
        snprintf(what, sizeof what, "lane, %s: steering", name);
        score_row(s, what, NULL, SCORE_INFORMATION, "%.1f, label %.0f, mirrored %.1f, sum %.1f degrees",
                  steer[0], angle - 90, steer[1], steer[0] + steer[1]);
    }
    if (list) {
        fclose(list);
    }
    if (count == 0) {
        score_row(s, "lane: steering within 15 degrees of the labels", "2 of 3", SCORE_SKIPPED,
                  "no shared data");
        score_row(s, "lane: the sign flips with the frame", "all", SCORE_SKIPPED, "no shared data");
        return;
    }
    score_row(s, "lane: steering within 15 degrees of the labels", "2 of 3", score_if(3 * near >= 2 * count),
              "%d of %d", near, count);
    score_row(s, "lane: the sign flips with the frame", "all", score_if(flipped == sided && sided > 0),
              "%d of %d that steer at all", flipped, sided);
}
