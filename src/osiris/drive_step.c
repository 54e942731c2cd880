/* Ramps, and the turn on the spot of a drive that cannot. */
#include "iris/osiris/drive.h"

#include "wheels.h"

iris_status osiris_drive_init(osiris_drive *drive, const osiris_drive_config *config)
{
    if (!drive || osiris_drive_check(config) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    drive->config = *config;
    drive->steering = 0;
    drive->steering_q8 = 0;
    osiris_drive_halt(drive);
    return IRIS_OK;
}

void osiris_drive_halt(osiris_drive *drive)
{
    if (drive) {
        const osiris_velocity none = {0, 0, 0};
        drive->velocity = none;
        drive->shuffled_q8 = 0;
        drive->shuffle = 0;
    }
}

/* From `now` towards `wanted` by `rate` a second, in 1/2^bits of its unit: at least by one of them, unless no time passed. */
static int32_t towards(int32_t now, int32_t wanted, int64_t rate, int32_t ms)
{
    int64_t most = rate * ms / 1000;
    if (ms > 0 && most == 0) {
        most = 1;
    }
    const int64_t way = (int64_t)wanted - now;
    return (int32_t)(now + (way > most ? most : way < -most ? -most : way));
}

static void steer(osiris_drive *drive, int32_t steering, int32_t ms)
{
    drive->steering_q8 =
        towards(drive->steering_q8, steering * 256, (int64_t)drive->config.steering_rate * 256, ms);
    drive->steering = (iris_angle)iris_round_shift_s32(drive->steering_q8, 8);
}

/* What a car does to turn where it stands: the speed that it should have now. */
static int32_t shuffle(osiris_drive *drive, int32_t turn_q8, int32_t ms)
{
    const osiris_drive_config *config = &drive->config;
    const int32_t piece_q8 = config->wheelbase_mm * 128;
    const int32_t ahead_q16 = drive->velocity.ahead_q16;
    if (drive->shuffle == 0) {
        drive->shuffle = 1;
        drive->shuffled_q8 = piece_q8 / 2;
    }
    if (drive->shuffled_q8 >= piece_q8) {
        drive->shuffle = (int8_t)-drive->shuffle;
        drive->shuffled_q8 = 0;
    }
    if ((int64_t)ahead_q16 * drive->shuffle < 0) {
        return 0; /* the last piece is still rolling out */
    }
    const int32_t most = (turn_q8 < 0) == (drive->shuffle < 0) ? config->steering_max : -config->steering_max;
    steer(drive, most, ms);
    if (osiris_size_of(drive->steering - most) > config->steering_max / 8) {
        return 0;
    }
    drive->shuffled_q8 += (int32_t)((int64_t)osiris_size_of(ahead_q16) * ms / 256000) + (ms > 0);
    const int64_t fit =
        osiris_rim_q16(osiris_size_of(turn_q8), osiris_within(osiris_drive_radius_min(config), 1, 4096));
    const int64_t fastest = (int64_t)config->speed_max_mms * 65536 / 2;
    return (int32_t)(fit < fastest ? fit : fastest) * drive->shuffle;
}

static void step_ackermann(osiris_drive *drive, const osiris_velocity *wanted, int32_t ms)
{
    const osiris_drive_config *config = &drive->config;
    osiris_velocity limited = *wanted;
    osiris_wheels wheels;
    int32_t ahead_q16 = 0;
    (void)osiris_drive_limit(&limited, config);
    if (wanted->ahead_q16 == 0 && wanted->turn_q8 != 0) {
        const int32_t most = config->turn_rate_max * 256;
        ahead_q16 = shuffle(drive, osiris_within(wanted->turn_q8, -most, most), ms);
    } else {
        drive->shuffle = 0;
        ahead_q16 = limited.ahead_q16;
        if (ahead_q16 != 0) {
            (void)osiris_drive_wheels(&wheels, config, &limited);
            steer(drive, wheels.steering, ms);
        }
    }
    drive->velocity.ahead_q16 =
        towards(drive->velocity.ahead_q16, ahead_q16, (int64_t)config->acceleration_mms2 * 65536, ms);
    wheels.count = 2;
    wheels.speed_q16[0] = wheels.speed_q16[1] = drive->velocity.ahead_q16;
    wheels.steering = drive->steering;
    (void)osiris_drive_velocity(&drive->velocity, config, &wheels);
    (void)osiris_drive_limit(&drive->velocity, config); /* the outer wheel's speed */
}

iris_status osiris_drive_step(osiris_drive *drive, const osiris_velocity *wanted, int32_t elapsed_ms)
{
    if (!drive || !wanted || osiris_drive_check(&drive->config) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    const osiris_drive_config *config = &drive->config;
    const int32_t ms = osiris_within(elapsed_ms, 0, 1000);
    if (config->kind == OSIRIS_ACKERMANN) {
        step_ackermann(drive, wanted, ms);
        return IRIS_OK;
    }
    osiris_velocity limited = *wanted, *now = &drive->velocity;
    const int64_t rate_q16 = (int64_t)config->acceleration_mms2 * 65536;
    (void)osiris_drive_limit(&limited, config);
    now->ahead_q16 = towards(now->ahead_q16, limited.ahead_q16, rate_q16, ms);
    now->left_q16 = towards(now->left_q16, limited.left_q16, rate_q16, ms);
    now->turn_q8 = towards(now->turn_q8, limited.turn_q8, (int64_t)config->turn_acceleration * 256, ms);
    return osiris_drive_limit(now, config);
}
