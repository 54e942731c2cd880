#include "drive.h"

#include <math.h>
#include <string.h>
#include <time.h>

#include "iris/xt/follow.h"

static const double OFF_COURSE = 40; /* cm */
static const double PATIENCE = 5;    /* s without a new centimeter */

/* The library's side of the loop. */
typedef struct {
    iris_follow follow;
    iris_follow_result line;
    iris_steer steer;
    const iris_pursuit *pursuit;
    iris_command_parser parser;
    iris_image image;
    uint8_t gray[SIM_W * SIM_H];
} driver;

static int init(driver *d, const sim_plan *plan)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_FOLLOW_SCRATCH_BYTES(SIM_W, SIM_H));
    iris_scratch scratch;
    iris_size size = {SIM_W, SIM_H};
    iris_command_parser_init(&d->parser);
    d->pursuit = plan->pursuit;
    return iris_image_wrap(&d->image, d->gray, sizeof d->gray, size, 0, IRIS_GRAY8) == IRIS_OK &&
           iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) == IRIS_OK &&
           iris_follow_init(&d->follow, size, NULL, &scratch) == IRIS_OK &&
           iris_steer_init(&d->steer, plan->steer) == IRIS_OK;
}

static iris_status steer(iris_command *command, driver *d, int32_t elapsed_ms)
{
    iris_pursuit_goal goal;
    return d->pursuit ? iris_pursuit_update(command, &goal, &d->steer, &d->line, d->pursuit, elapsed_ms)
                      : iris_steer_update(command, &d->steer, &d->line, elapsed_ms);
}

/* From pixels to what the robot's side reads off the wire. 0 when a step fails, which no input may cause. */
static int look(iris_command *command, driver *d, uint32_t now_ms, int32_t elapsed_ms)
{
    iris_command sent;
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length = 0;
    if (iris_follow_frame(&d->line, &d->follow, &d->image, now_ms) != IRIS_OK ||
        steer(&sent, d, elapsed_ms) != IRIS_OK ||
        iris_command_format(sentence, sizeof sentence, &length, &sent) != IRIS_OK) {
        return 0;
    }
    iris_status status = IRIS_ERR_TRUNCATED;
    for (size_t i = 0; i < length; i++) {
        status = iris_command_parse(command, &d->parser, sentence[i]);
    }
    return status == IRIS_OK;
}

/* Keeps the frame when the robot is the first time 30 cm, or 14 cm, before a difficult place. */
static void keep_shot(sim_record *record, const driver *d, const sim_track *track,
                      const iris_command *command, double way)
{
    for (int i = 0; i < SIM_SHOTS; i++) {
        const sim_mark *mark = &track->mark[i / 2];
        sim_shot *shot = &record->shot[i];
        double ahead_cm = mark->s - way;
        if (shot->mark || ahead_cm > (i % 2 == 0 ? 30 : 14)) {
            continue;
        }
        memcpy(shot->gray, d->gray, sizeof shot->gray);
        shot->line = d->line;
        shot->line.rows = NULL;
        shot->command = *command;
        shot->mark = mark;
        shot->ahead_cm = ahead_cm;
        for (int y = 0; y < SIM_H; y++) {
            shot->rows[y] = d->line.rows ? d->line.rows[y] : (iris_span){0, -1};
        }
    }
}

static void keep_step(sim_record *record, const sim_robot *robot, double lateral, double at,
                      const iris_command *command)
{
    record->mean_cm += (fabs(lateral) - record->mean_cm) / (record->frames + 1);
    record->mean_square += (lateral * lateral - record->mean_square) / (record->frames + 1);
    if (fabs(lateral) > record->largest_cm) {
        record->largest_cm = fabs(lateral);
        record->largest_at = at;
    }
    record->frames++;
    record->count[command->state]++;
    if (record->steps < SIM_STEPS_MAX) {
        record->step[record->steps++] =
            (sim_step){(float)robot->pose.x, (float)robot->pose.y, (float)lateral, (uint8_t)command->state};
    }
}

void sim_drive(sim_record *record, const sim_plan *plan, sim_camera *camera, const sim_floor *floor,
               sim_robot *robot)
{
    static driver d;
    const sim_track *track = floor->track;
    iris_command next, command = {.speed_permil = 0};
    double way = 0, farthest = 0, last_progress = 0;
    memset(record, 0, sizeof *record);
    record->end = init(&d, plan) ? NULL : "the library refused its configuration";
    for (int frame = 0; !record->end && way < plan->laps * track->length; frame++) {
        double now = (double)frame / plan->frames_per_second;
        int32_t now_ms = frame * 1000 / plan->frames_per_second;
        int32_t elapsed_ms = frame == 0 ? 0 : now_ms - (frame - 1) * 1000 / plan->frames_per_second;
        sim_camera_render(d.gray, camera, floor, robot->pose);
        clock_t start = clock();
        if (!look(&next, &d, (uint32_t)now_ms, elapsed_ms)) {
            record->end = "the library failed";
            break;
        }
        record->vision_seconds += (double)(clock() - start) / CLOCKS_PER_SEC;
        keep_shot(record, &d, track, &next, way);
        for (int k = 0; k < 8; k++) { /* one frame of latency: the robot still follows the last command */
            sim_robot_drive(robot, &command, 0.125 / plan->frames_per_second);
        }
        command = next;
        double lateral = sim_track_lateral(track, robot->pose.x, robot->pose.y, 30, &way);
        keep_step(record, robot, lateral, fmod(way, track->length), &command);
        if (way > farthest + 1) {
            farthest = way;
            last_progress = now;
        }
        record->seconds = now;
        record->end = fabs(lateral) > OFF_COURSE       ? "the robot left the course"
                      : now - last_progress > PATIENCE ? "the robot does not get on"
                                                       : NULL;
    }
    record->length = track->length;
    record->laps = way / track->length;
}
