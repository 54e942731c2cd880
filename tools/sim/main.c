/* iris-demo: a simulated robot drives around a taped course, steered by IRIS from its camera's pictures alone. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "branch.h"
#include "explore.h"
#include "frames.h"
#include "picture.h"

static const char HELP[] =
    "usage: iris-demo [--laps N] [--out DIR] [--seed N] [--quick] [--blank] [--floor] [--walls]\n"
    "                 [--frames DIR [--count N]]\n"
    "\n"
    "Drives a simulated robot around a taped course by its camera alone, and writes pictures of the drive.\n"
    "Exit code 0 when all laps are done and the robot was never off the line by half its width, else 1.\n"
    "\n"
    "  --laps N      laps to drive, 1 to 20 (default 2)\n"
    "  --out DIR     where the pictures go (default build/demo)\n"
    "  --seed N      another floor and other noise (default 1)\n"
    "  --quick       one lap, no pictures\n"
    "  --blank       cover the lens: the robot must not find its way\n"
    "  --floor       steer by millimeters, from eight marks on the floor as iris floor takes them\n"
    "  --junction J  drive over one junction instead: t, left, right, y, or crossing, as --take says\n"
    "  --take TURN   left, right, or straight: exit code 0 when the robot ends on that branch\n"
    "  --robot R     over one junction: demo (default), over (camera over the axle), ahead, or slow\n"
    "  --frames DIR  no drive: write camera frames along the course, and where the tape is in them\n"
    "  --count N     how many, 1 to 9999 (default 120)\n"
    "  --walls       another course instead, with walls: the robot maps it by disparities, and finds itself "
    "in\n"
    "                that map; exit code 0 when it is never off by a cell. With --frames both laps for iris "
    "map\n"
    "\n"
    "example: iris-demo --laps 3 --seed 7 --out /tmp/drive\n";

typedef struct {
    int laps, count, quick, blank, floor, walls;
    uint32_t seed;
    const char *out, *frames, *junction, *take, *robot;
} options;

static int whole_number(long *number, const char *text, long low, long high)
{
    char *end;
    errno = 0;
    *number = strtol(text, &end, 10);
    return errno == 0 && end != text && *end == 0 && *number >= low && *number <= high;
}

/* -1: go on; else the exit code. */
static int read_options(options *o, int argc, char **argv)
{
    long number = 0;
    for (int i = 1; i < argc; i++) {
        const char *name = argv[i], *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(name, "--help") == 0) {
            fputs(HELP, stdout);
            return 0;
        }
        if (strcmp(name, "--quick") == 0) {
            o->quick = 1;
        } else if (strcmp(name, "--blank") == 0) {
            o->blank = 1;
        } else if (strcmp(name, "--floor") == 0) {
            o->floor = 1;
        } else if (strcmp(name, "--walls") == 0) {
            o->walls = 1;
        } else if (strcmp(name, "--laps") == 0 && whole_number(&number, value, 1, 20)) {
            o->laps = (int)number;
            i++;
        } else if (strcmp(name, "--count") == 0 && whole_number(&number, value, 1, 9999)) {
            o->count = (int)number;
            i++;
        } else if (strcmp(name, "--seed") == 0 && whole_number(&number, value, 0, 1000000)) {
            o->seed = (uint32_t)number;
            i++;
        } else if (strcmp(name, "--out") == 0 && *value) {
            o->out = argv[++i];
        } else if (strcmp(name, "--junction") == 0 && *value) {
            o->junction = argv[++i];
        } else if (strcmp(name, "--take") == 0 && *value) {
            o->take = argv[++i];
        } else if (strcmp(name, "--robot") == 0 && *value) {
            o->robot = argv[++i];
        } else if (strcmp(name, "--frames") == 0 && *value) {
            o->frames = argv[++i];
        } else {
            fprintf(stderr, "iris-demo: bad option or value: %s %s (--help tells more)\n", name, value);
            return 2;
        }
    }
    return -1;
}

/* Makes the folder and the ones above it. 0 when it cannot. */
static int make_folder(const char *folder)
{
    char path[400];
    size_t length = strlen(folder);
    if (length >= sizeof path) {
        return 0;
    }
    for (size_t i = 1; i <= length; i++) {
        if (folder[i] == '/' || folder[i] == 0) {
            memcpy(path, folder, i);
            path[i] = 0;
            if (mkdir(path, 0777) != 0 && errno != EEXIST) {
                return 0;
            }
        }
    }
    return 1;
}

static void print_course(const sim_track *track, const sim_robot *robot, const sim_camera *camera)
{
    printf("course    %.2f m of %.0f cm tape: radius 25 cm at the tightest, one square corner, 5 cm gap, 8 "
           "cm glare,\n"
           "          light 4:1, noise sigma %.0f\n",
           track->length / 100, track->tape, camera->noise);
    printf("robot     %.0f cm wide, two driven wheels, reference point: the middle of the axle\n",
           robot->width_cm);
    printf("camera    %dx%d gray, 30 frames/s, %.0f cm high, %.0f degrees down, one frame of latency\n",
           SIM_W, SIM_H, camera->height_cm, camera->pitch_deg);
}

/* Prints what came of it; 1 when the drive is good. */
static int judge(const sim_record *record, int laps, double allowed)
{
    int good = !record->end && record->laps >= laps && record->largest_cm < allowed;
    printf("laps      %.2f of %d in %.1f s, on average %.0f cm/s\n", record->laps, laps, record->seconds,
           record->seconds > 0 ? record->laps * record->length / record->seconds : 0);
    printf("error     rms %.2f cm, largest %.2f cm (%.0f cm into the lap), allowed %.1f cm: half the robot\n"
           "          mean %.2f cm\n",
           sqrt(record->mean_square), record->largest_cm, record->largest_at, allowed, record->mean_cm);
    printf("frames    %d found, %d stale, %d lost\n", record->count[IRIS_LINE_FOUND],
           record->count[IRIS_LINE_STALE], record->count[IRIS_LINE_LOST]);
    printf("library   %.0f frames/s on this machine: follow, steer, sentence out and in\n",
           record->vision_seconds > 0 ? record->frames / record->vision_seconds : 0);
    return good;
}

static int drive(const options *o, const sim_floor *floor, sim_camera *camera)
{
    static sim_record record;
    sim_robot robot;
    sim_robot_init(&robot, sim_track_at(floor->track, 0));
    const sim_robot start = robot;
    iris_floor marked;
    const iris_pursuit pursuit = {&marked, NULL};
    const sim_plan plan = {.laps = o->quick ? 1 : o->laps,
                           .frames_per_second = 30,
                           .pursuit = o->floor && sim_camera_marks(&marked, camera, 8) ? &pursuit : NULL};
    camera->blank = o->blank;
    if (!o->quick && !make_folder(o->out)) {
        fprintf(stderr, "iris-demo: %s: cannot make this folder\n", o->out);
        return 1;
    }
    print_course(floor->track, &robot, camera);
    if (plan.pursuit) {
        printf("steering  by millimeters: floor from eight marks\n");
    }
    if (o->blank) {
        printf("          the lens is covered: this must fail\n");
    }
    sim_drive(&record, &plan, camera, floor, &robot);
    int good = judge(&record, plan.laps, robot.width_cm / 2);
    if (!o->quick &&
        (!sim_map_save(o->out, &record, floor, camera, &start) || !sim_overlay_save(o->out, &record))) {
        fprintf(stderr, "iris-demo: %s: cannot write the pictures\n", o->out);
        return 1;
    }
    if (!o->quick) {
        printf("pictures  %s/track.bmp (from above), frames.bmp (what the camera saw), frame-1.bmp ...\n",
               o->out);
    }
    const char *why = record.end ? record.end : "the robot was too far off the line";
    printf("%s%s\n", good ? "PASSED" : "FAILED: ", good ? "" : why);
    return good ? 0 : 1;
}

static int explore(const options *o)
{
    char first[300], second[300];
    const char *picture = o->quick ? NULL : o->out, *frames = o->frames;
    snprintf(first, sizeof first, "%s/first", frames ? frames : "");
    snprintf(second, sizeof second, "%s/second", frames ? frames : "");
    if ((picture && !make_folder(picture)) || (frames && (!make_folder(first) || !make_folder(second)))) {
        fprintf(stderr, "iris-demo: %s: cannot make this folder\n", frames ? frames : picture);
        return 1;
    }
    return sim_explore(o->seed, picture, frames);
}

int main(int argc, char **argv)
{
    static sim_track track;
    static sim_camera camera;
    sim_floor floor;
    options o = {.laps = 2, .count = 120, .seed = 1, .out = "build/demo"};
    int code = read_options(&o, argc, argv);
    if (code >= 0) {
        return code;
    }
    if (o.junction || o.take || o.robot) {
        code = sim_branch_drive(o.junction ? o.junction : "", o.take ? o.take : "",
                                o.robot ? o.robot : "demo", o.seed);
        if (code < 0) {
            fprintf(stderr,
                    "iris-demo: --junction, --take, --robot: no such turn or robot (--help tells more)\n");
        }
        return code < 0 ? 2 : !code;
    }
    if (o.walls) {
        return explore(&o);
    }
    sim_track_build(&track);
    sim_camera_init(&camera, o.seed);
    if (!sim_floor_make(&floor, &track, o.seed)) {
        fprintf(stderr, "iris-demo: not enough memory\n");
        return 1;
    }
    if (!o.frames) {
        code = drive(&o, &floor, &camera);
    } else if (make_folder(o.frames) && sim_frames_write(o.frames, o.count, &camera, &floor)) {
        code = 0;
    } else {
        fprintf(stderr, "iris-demo: %s: cannot write the frames\n", o.frames);
        code = 1;
    }
    sim_floor_free(&floor);
    return code;
}
