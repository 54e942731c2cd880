#include "frames.h"

#include <math.h>
#include <stdio.h>

#define PI 3.14159265358979323846

static int write_pgm(const char *folder, int number, const uint8_t *gray)
{
    char path[512];
    if (snprintf(path, sizeof path, "%s/%04d.pgm", folder, number) >= (int)sizeof path) {
        return 0;
    }
    FILE *file = fopen(path, "wb");
    if (!file) {
        return 0;
    }
    int good =
        fprintf(file, "P5\n%d %d\n255\n", SIM_W, SIM_H) > 0 && fwrite(gray, SIM_W, SIM_H, file) == SIM_H;
    return (fclose(file) == 0) & good;
}

/* Where the center line crosses image row y nearest to the course's way: cm to the left of the robot's axis.
 */
static void write_truth(FILE *file, int number, const sim_camera *camera, const sim_track *track,
                        sim_pose robot, double s)
{
    double at = s;
    fprintf(file, "frame %04d s %.1f lateral_cm %.2f heading_deg %.1f\n", number, s,
            sim_track_lateral(track, robot.x, robot.y, 40, &at),
            (robot.heading - sim_track_at(track, s).heading) * 180 / PI);
    for (int y = 0; y < SIM_H; y++) {
        double run[8][2];
        int count = sim_camera_truth(run, 8, camera, track, robot, y);
        fprintf(file, "row %d", y);
        for (int i = 0; i < count; i++) {
            fprintf(file, " %.1f-%.1f", run[i][0], run[i][1]);
        }
        fprintf(file, "\n");
    }
}

int sim_frames_write(const char *folder, int count, sim_camera *camera, const sim_floor *floor)
{
    static uint8_t gray[SIM_W * SIM_H];
    char path[512];
    if (snprintf(path, sizeof path, "%s/truth.txt", folder) >= (int)sizeof path) {
        return 0;
    }
    FILE *truth = fopen(path, "w");
    if (!truth) {
        return 0;
    }
    fprintf(truth, "# lateral: robot left of the center line; heading: robot turned left of it\n"
                   "# row Y: the tape's first-last column, 0.0 = center of the first pixel; nothing where no "
                   "tape lies\n");
    int good = 1;
    for (int i = 0; i < count && good; i++) {
        double s = floor->track->length * i / count;
        sim_pose pose = sim_track_at(floor->track, s);
        double aside = 4 * sin(i * 0.37);
        pose.x -= aside * sin(pose.heading);
        pose.y += aside * cos(pose.heading);
        pose.heading += 10 * PI / 180 * sin(i * 0.23 + 1);
        sim_camera_render(gray, camera, floor, pose);
        good = write_pgm(folder, i, gray);
        write_truth(truth, i, camera, floor->track, pose, s);
    }
    return (fclose(truth) == 0) & good;
}
