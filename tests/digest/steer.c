#include "digest.h"

#include "iris/xt/steer.h"

static void a_drive(void)
{
    iris_steer steer;
    digest_number(iris_steer_init(&steer, NULL));
    for (int32_t frame = 0; frame < 300; frame++) {
        iris_follow_result line = {0};
        iris_command command;
        line.state = frame % 90 > 70 ? IRIS_LINE_LOST : frame % 90 > 64 ? IRIS_LINE_STALE : IRIS_LINE_FOUND;
        line.angle = (iris_angle)digest_between(-12000, 12000);
        line.offset_q16 = digest_between(-80000, 80000);
        line.lookahead_offset_q16 = digest_between(-80000, 80000);
        line.has_next = frame % 40 < 5;
        line.next_angle = (iris_angle)digest_between(-16000, 16000);
        line.width_px = digest_between(5, 40);
        line.confidence_permil = digest_between(0, 1000);
        digest_number(iris_steer_update(&command, &steer, &line, digest_between(0, 60)));
        digest_number(command.seq);
        digest_number(command.state);
        digest_number(command.steer_permil);
        digest_number(command.speed_permil);
        digest_number(command.angle_centideg);
        digest_number(command.offset_permil);
        digest_number(iris_steer_wheel_centideg(&steer, &command));
    }
}

const digest_operation digest_steer[] = {
    {"steer.a_drive", a_drive},
    {NULL, NULL},
};
