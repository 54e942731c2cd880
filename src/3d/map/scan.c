/* The beams of a sensor that measures ranges. */
#include "iris/3d/scan.h"

#include "map_parts.h"

static int is_near(iris_map_pose mount)
{
    const int32_t most = IRIS_SCAN_REACH_MAX_MM / 2;
    return mount.x_mm > -most && mount.x_mm < most && mount.y_mm > -most && mount.y_mm < most;
}

iris_status iris_scan_from_ranges(iris_beam *beams, int32_t *beam_count, const int32_t *ranges_mm,
                                  int32_t count, const iris_range_sensor *sensor)
{
    if (!beams || !beam_count || !ranges_mm || !sensor || sensor->least_mm <= 0 ||
        sensor->most_mm <= sensor->least_mm || sensor->most_mm >= IRIS_SCAN_REACH_MAX_MM / 2 ||
        sensor->quiet_mm < 0 || sensor->quiet_mm > sensor->most_mm || sensor->spread_mm < 0 ||
        sensor->spread_mm > sensor->most_mm || !is_near(sensor->mount)) {
        return IRIS_ERR_ARG;
    }
    if (count < 0 || count > IRIS_SCAN_BEAMS_MAX) {
        return IRIS_ERR_RANGE;
    }
    int32_t made = 0;
    for (int32_t i = 0; i < count; i++) {
        const int hit = ranges_mm[i] >= sensor->least_mm && ranges_mm[i] <= sensor->most_mm;
        const int32_t length = hit ? ranges_mm[i] : sensor->quiet_mm;
        const int64_t bearing =
            iris_round_shift(sensor->first_q16 + (int64_t)i * sensor->step_q16, 16) + sensor->mount.heading;
        if (length > 0) {
            const iris_heading turn = iris_heading_of(iris_angle_wrap((int32_t)bearing));
            beams[made++] = (iris_beam){sensor->mount.x_mm + iris_heading_x(turn, length, 0),
                                        sensor->mount.y_mm + iris_heading_y(turn, length, 0),
                                        hit ? sensor->spread_mm : 0, hit};
        }
    }
    *beam_count = made;
    return IRIS_OK;
}
