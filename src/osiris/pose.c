#include "iris/osiris/pose.h"

#include "rounded.h"

static int32_t turned(int32_t a, iris_q30 of_a, int32_t b, iris_q30 of_b)
{
    return iris_sat_s32(iris_round_shift((int64_t)a * of_a + (int64_t)b * of_b, 30));
}

osiris_pose osiris_pose_after(osiris_pose pose, osiris_pose step)
{
    const iris_q30 cosine = iris_cos_q30(pose.heading), sine = iris_sin_q30(pose.heading);
    osiris_pose after;
    after.x_mm = iris_add_sat(pose.x_mm, turned(step.x_mm, cosine, step.y_mm, -sine));
    after.y_mm = iris_add_sat(pose.y_mm, turned(step.x_mm, sine, step.y_mm, cosine));
    after.heading = iris_angle_wrap(pose.heading + step.heading);
    return after;
}

osiris_pose osiris_pose_step(osiris_pose from, osiris_pose to)
{
    const iris_q30 cosine = iris_cos_q30(from.heading), sine = iris_sin_q30(from.heading);
    const int32_t x = iris_sub_sat(to.x_mm, from.x_mm), y = iris_sub_sat(to.y_mm, from.y_mm);
    osiris_pose step;
    step.x_mm = turned(x, cosine, y, sine);
    step.y_mm = turned(x, -sine, y, cosine);
    step.heading = iris_angle_wrap(to.heading - from.heading);
    return step;
}

osiris_track osiris_track_from(osiris_pose pose)
{
    osiris_track track = {(int64_t)pose.x_mm * 65536, (int64_t)pose.y_mm * 65536,
                          (uint32_t)(uint16_t)pose.heading << 16};
    return track;
}

osiris_pose osiris_track_pose(const osiris_track *track)
{
    osiris_pose pose = {iris_sat_s32(iris_round_shift(track->x_q16, 16)),
                        iris_sat_s32(iris_round_shift(track->y_q16, 16)),
                        iris_angle_wrap((int32_t)((track->heading_q16 + 0x8000u) >> 16))};
    return pose;
}

/* A chord goes in the direction of its arc's middle. */
static void move_chord(osiris_track *track, const osiris_velocity *v, int32_t ms)
{
    const int32_t turn_q16 = (int32_t)osiris_quotient(-(int64_t)v->turn_q8 * ms * 32, 125);
    const uint32_t middle = track->heading_q16 + (uint32_t)(turn_q16 / 2);
    const iris_angle direction = iris_angle_wrap((int32_t)((middle + 0x8000u) >> 16));
    const iris_q30 cosine = iris_cos_q30(direction), sine = iris_sin_q30(direction);
    const int64_t ahead = osiris_quotient((int64_t)v->ahead_q16 * ms, 1000);
    const int64_t left = osiris_quotient((int64_t)v->left_q16 * ms, 1000);
    const int64_t x = iris_round_shift(ahead * cosine - left * sine, 30);
    const int64_t y = iris_round_shift(ahead * sine + left * cosine, 30);
    track->x_q16 = (int64_t)((uint64_t)track->x_q16 + (uint64_t)x);
    track->y_q16 = (int64_t)((uint64_t)track->y_q16 + (uint64_t)y);
    track->heading_q16 += (uint32_t)turn_q16;
}

void osiris_track_move(osiris_track *track, const osiris_velocity *velocity, int32_t elapsed_ms)
{
    if (!track || !velocity) {
        return;
    }
    for (int32_t left = osiris_within(elapsed_ms, 0, 60000); left > 0; left -= 10) {
        move_chord(track, velocity, left < 10 ? left : 10);
    }
}
