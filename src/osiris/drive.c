#include "iris/osiris/drive.h"

#include "wheels.h"

#define RIM_TURN_MAX_Q8 (OSIRIS_TURN_RATE_MAX * 256)

void osiris_drive_defaults(osiris_drive_config *config, osiris_drive_kind kind)
{
    if (config) {
        config->kind = kind;
        config->track_mm = 150;
        config->wheelbase_mm = 160;
        config->radius_mm = 100;
        config->wheels = 3;
        config->steering_max = 5461;
        config->steering_rate = 32768;
        config->speed_max_mms = 500;
        config->turn_rate_max = 32768;
        config->acceleration_mms2 = 1000;
        config->turn_acceleration = 131072;
    }
}

static int is_from_1(int32_t value, int32_t most)
{
    return value >= 1 && value <= most;
}

iris_status osiris_drive_check(const osiris_drive_config *config)
{
    if (!config || (unsigned)config->kind > OSIRIS_OMNI) {
        return IRIS_ERR_ARG;
    }
    int good = is_from_1(config->speed_max_mms, OSIRIS_SPEED_MAX_MMS) &&
               is_from_1(config->turn_rate_max, OSIRIS_TURN_RATE_MAX) &&
               is_from_1(config->acceleration_mms2, 1000000);
    if (config->kind == OSIRIS_OMNI) {
        good = good && is_from_1(config->radius_mm, OSIRIS_SIDE_MAX_MM) &&
               (config->wheels == 3 || config->wheels == 4);
    } else {
        good = good && is_from_1(config->track_mm, OSIRIS_SIDE_MAX_MM);
    }
    if (config->kind == OSIRIS_ACKERMANN) {
        good = good && is_from_1(config->wheelbase_mm, OSIRIS_SIDE_MAX_MM) && config->steering_max >= 182 &&
               config->steering_max <= 14563 && is_from_1(config->steering_rate, OSIRIS_TURN_RATE_MAX);
    } else {
        good = good && is_from_1(config->turn_acceleration, 100000000);
    }
    return good ? IRIS_OK : IRIS_ERR_ARG;
}

/* Sines and cosines of where the wheels are. */
#define HALF   536870912
#define ROOT_3 929887697 /* a half of it */
#define ROOT_2 759250125
static const iris_q30 sine3[3] = {ROOT_3, 0, -ROOT_3}, cosine3[3] = {HALF, -IRIS_Q30_ONE, HALF};
static const iris_q30 sine4[4] = {ROOT_2, ROOT_2, -ROOT_2, -ROOT_2};
static const iris_q30 cosine4[4] = {ROOT_2, -ROOT_2, -ROOT_2, ROOT_2};

static iris_angle steering_for(const osiris_drive_config *config, int32_t ahead_q16, int64_t turn_q8)
{
    const int64_t side =
        osiris_rim_q16(turn_q8, config->wheelbase_mm); /* as far to the side as ahead in a second */
    const int32_t across = iris_sat_s32(ahead_q16 < 0 ? -side : side);
    return (iris_angle)osiris_within(iris_atan2_angle(across, osiris_size_of(ahead_q16)),
                                     -config->steering_max, config->steering_max);
}

static int64_t turn_of_steering(const osiris_drive_config *config, int32_t ahead_q16, iris_angle steering)
{
    const int64_t across = (int64_t)ahead_q16 * iris_sin_q30(steering);
    return osiris_turn_q8(osiris_quotient(across, iris_cos_q30(steering)), config->wheelbase_mm);
}

/* Both wheels of an axle: they differ by what the turn is at its width. */
static void axle(osiris_wheels *wheels, int32_t ahead_q16, int64_t turn_q8, int32_t track_mm)
{
    const int64_t apart = osiris_rim_q16(turn_q8, track_mm);
    const int64_t left = ahead_q16 + iris_round_shift(apart, 1);
    wheels->speed_q16[0] = iris_sat_s32(left);
    wheels->speed_q16[1] = iris_sat_s32(left - apart);
}

static void omni_wheels(osiris_wheels *wheels, const osiris_drive_config *config, const osiris_velocity *v,
                        int32_t turn_q8)
{
    const iris_q30 *sine = config->wheels == 3 ? sine3 : sine4;
    const iris_q30 *cosine = config->wheels == 3 ? cosine3 : cosine4;
    const int64_t rim = osiris_rim_q16(turn_q8, config->radius_mm);
    for (int32_t i = 0; i < config->wheels; i++) {
        const int64_t along = (int64_t)v->left_q16 * cosine[i] - (int64_t)v->ahead_q16 * sine[i];
        wheels->speed_q16[i] = iris_sat_s32(iris_round_shift(along, 30) - rim);
    }
}

iris_status osiris_drive_wheels(osiris_wheels *wheels, const osiris_drive_config *config,
                                const osiris_velocity *velocity)
{
    if (!wheels || !velocity || osiris_drive_check(config) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    const int32_t turn_q8 = osiris_within(velocity->turn_q8, -RIM_TURN_MAX_Q8, RIM_TURN_MAX_Q8);
    osiris_wheels made = {2, {0, 0, 0, 0}, 0};
    if (config->kind == OSIRIS_OMNI) {
        made.count = config->wheels;
        omni_wheels(&made, config, velocity, turn_q8);
    } else if (config->kind == OSIRIS_DIFFERENTIAL) {
        axle(&made, velocity->ahead_q16, turn_q8, config->track_mm);
    } else if (velocity->ahead_q16 != 0) {
        made.steering = steering_for(config, velocity->ahead_q16, turn_q8);
        axle(&made, velocity->ahead_q16, turn_of_steering(config, velocity->ahead_q16, made.steering),
             config->track_mm);
    }
    *wheels = made;
    return IRIS_OK;
}

static osiris_velocity omni_velocity(const osiris_drive_config *config, const osiris_wheels *wheels)
{
    const iris_q30 *sine = config->wheels == 3 ? sine3 : sine4;
    const iris_q30 *cosine = config->wheels == 3 ? cosine3 : cosine4;
    int64_t ahead = 0, left = 0, rims = 0; /* the first two with 36 fraction bits */
    for (int32_t i = 0; i < config->wheels; i++) {
        ahead -= iris_round_shift((int64_t)wheels->speed_q16[i] * sine[i], 10);
        left += iris_round_shift((int64_t)wheels->speed_q16[i] * cosine[i], 10);
        rims += wheels->speed_q16[i];
    }
    osiris_velocity v;
    v.ahead_q16 = iris_sat_s32(iris_round_shift(osiris_quotient(ahead * 2, config->wheels), 20));
    v.left_q16 = iris_sat_s32(iris_round_shift(osiris_quotient(left * 2, config->wheels), 20));
    v.turn_q8 = iris_sat_s32(-osiris_turn_q8(rims, config->radius_mm * config->wheels));
    return v;
}

iris_status osiris_drive_velocity(osiris_velocity *velocity, const osiris_drive_config *config,
                                  const osiris_wheels *wheels)
{
    if (!velocity || !wheels || osiris_drive_check(config) != IRIS_OK ||
        wheels->count != (config->kind == OSIRIS_OMNI ? config->wheels : 2)) {
        return IRIS_ERR_ARG;
    }
    if (config->kind == OSIRIS_OMNI) {
        *velocity = omni_velocity(config, wheels);
        return IRIS_OK;
    }
    const int64_t left = wheels->speed_q16[0], right = wheels->speed_q16[1];
    const int32_t ahead_q16 = (int32_t)iris_round_shift(left + right, 1);
    const iris_angle steering = (iris_angle)osiris_within(wheels->steering, -14563, 14563);
    velocity->ahead_q16 = ahead_q16;
    velocity->left_q16 = 0;
    velocity->turn_q8 =
        iris_sat_s32(config->kind == OSIRIS_DIFFERENTIAL ? osiris_turn_q8(left - right, config->track_mm)
                                                         : turn_of_steering(config, ahead_q16, steering));
    return IRIS_OK;
}

int32_t osiris_drive_radius_min(const osiris_drive_config *config)
{
    if (!config || config->kind != OSIRIS_ACKERMANN || osiris_drive_check(config) != IRIS_OK) {
        return 0;
    }
    const iris_angle most = (iris_angle)config->steering_max;
    return (int32_t)osiris_quotient((int64_t)config->wheelbase_mm * iris_cos_q30(most), iris_sin_q30(most));
}

/* --- limits --- */

static int32_t scaled(int32_t value, int32_t limit, int32_t largest)
{
    return (int32_t)((int64_t)value * limit / largest); /* towards 0: never above the limit */
}

static void scale(osiris_velocity *v, int32_t limit, int32_t largest)
{
    if (largest > limit && largest > 0) {
        v->ahead_q16 = scaled(v->ahead_q16, limit, largest);
        v->left_q16 = scaled(v->left_q16, limit, largest);
        v->turn_q8 = scaled(v->turn_q8, limit, largest);
    }
}

static void limit_wheels(osiris_velocity *v, const osiris_drive_config *config)
{
    osiris_wheels wheels = {0, {0, 0, 0, 0}, 0};
    int32_t largest = 0;
    (void)osiris_drive_wheels(&wheels, config, v);
    for (int32_t i = 0; i < wheels.count; i++) {
        const int32_t size = osiris_size_of(wheels.speed_q16[i]);
        largest = size > largest ? size : largest;
    }
    scale(v, config->speed_max_mms * 65536, largest);
}

iris_status osiris_drive_limit(osiris_velocity *velocity, const osiris_drive_config *config)
{
    if (!velocity || osiris_drive_check(config) != IRIS_OK) {
        return IRIS_ERR_ARG;
    }
    osiris_velocity v = *velocity;
    const int32_t fastest = config->speed_max_mms * 65536;
    if (config->kind != OSIRIS_OMNI) {
        v.left_q16 = 0;
    }
    scale(&v, config->turn_rate_max * 256, osiris_size_of(v.turn_q8));
    scale(&v, fastest, osiris_size_of(v.ahead_q16));
    scale(&v, fastest, osiris_size_of(v.left_q16));
    if (config->kind == OSIRIS_ACKERMANN) {
        const iris_angle steering = v.ahead_q16 == 0 ? 0 : steering_for(config, v.ahead_q16, v.turn_q8);
        v.turn_q8 = iris_sat_s32(turn_of_steering(config, v.ahead_q16, steering));
    }
    limit_wheels(&v, config);
    *velocity = v;
    return IRIS_OK;
}
