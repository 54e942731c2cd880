/* Yellow dashes by one range of colors: how far is the found line from the points that people marked? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "change.h"
#include "find.h"
#include "picture.h"

#define FRAMES_MAX 16
#define ALLOWED    10.0 /* pixels, mean of a frame */

typedef struct {
    char name[32];
    iris_image rgb;
    double at[3][2]; /* near to far */
} dashes_frame;

static int load_frames(dashes_frame frames[FRAMES_MAX])
{
    char line[256], path[64];
    int count = 0;
    FILE *list = data_open("line/yellow_dashes/labels.txt");
    while (list && count < FRAMES_MAX && fgets(line, sizeof line, list)) {
        dashes_frame *f = &frames[count];
        if (line[0] == '#' ||
            sscanf(line, "%27[^.].bmp %lf %lf %lf %lf %lf %lf", f->name, &f->at[0][0], &f->at[0][1],
                   &f->at[1][0], &f->at[1][1], &f->at[2][0], &f->at[2][1]) != 7) {
            continue;
        }
        snprintf(path, sizeof path, "line/yellow_dashes/%s.bmp", f->name);
        if (picture_load(&f->rgb, path, IRIS_RGB888) == IRIS_OK) {
            count++;
        }
    }
    if (list) {
        fclose(list);
    }
    return count;
}

/* Mean distance, over the three points, to the nearest segment when it is extended; in pixels of the
 * original. 999: none. */
static double mean_distance(const score *s, const dashes_frame *frame, const change *how)
{
    iris_follow_config config;
    double at[3][2], sum = 0;
    char name[128];
    iris_follow_defaults(&config);
    config.kind = IRIS_FOLLOW_COLOR;
    config.format = IRIS_RGB888;
    config.color = (iris_hsl_range){.h0 = 50, .h1 = 90, .s0 = 20, .s1 = 100, .l0 = 20, .l1 = 70};
    iris_image changed = change_frame(how, &frame->rgb, 0);
    found result = find_line(&changed, &config);
    for (int i = 0; i < 3; i++) {
        memcpy(at[i], frame->at[i], sizeof at[i]);
        change_point(how, (iris_size){frame->rgb.w, frame->rgb.h}, &at[i][0], &at[i][1]);
        const iris_segment *nearest = NULL;
        for (int k = 0; k < result.line.segment_count; k++) {
            const iris_segment *segment = &result.line.segments[k];
            if (!nearest || segment_distance(segment, at[i][0], at[i][1]) <
                                segment_distance(nearest, at[i][0], at[i][1])) {
                nearest = segment;
            }
        }
        sum += nearest ? extended_distance(nearest, at[i][0], at[i][1]) / change_scale(how) : 999;
    }
    if (how == changes || sum / 3 > ALLOWED) {
        snprintf(name, sizeof name, "dashes %s, %s.bmp", frame->name, how->name);
        save_found(s, name, &changed, &result, at, 3);
    }
    free(changed.data);
    return sum / 3;
}

void score_dashes(score *s)
{
    static dashes_frame frames[FRAMES_MAX];
    char what[96];
    int count = load_frames(frames);
    if (count == 0) {
        score_row(s, "dashes: mean distance", "10 px", SCORE_SKIPPED, "no shared data");
        return;
    }
    for (int i = 0; i < count; i++) {
        double distance = mean_distance(s, &frames[i], changes);
        snprintf(what, sizeof what, "dashes, frame %.30s: mean distance of the points", frames[i].name);
        score_row(s, what, "at most 10 px", score_if(distance <= ALLOWED), "%.1f px", distance);
    }
    for (int k = 1; k < change_count; k++) {
        int near = 0;
        for (int i = 0; i < count && changes[k].required; i++) {
            near += mean_distance(s, &frames[i], &changes[k]) <= ALLOWED;
        }
        if (changes[k].required) { /* of the tape; here for information */
            snprintf(what, sizeof what, "dashes, %s: frames within 10 px", changes[k].name);
            score_row(s, what, NULL, SCORE_INFORMATION, "%d of %d", near, count);
        }
    }
    for (int i = 0; i < count; i++) {
        free(frames[i].rgb.data);
    }
}
