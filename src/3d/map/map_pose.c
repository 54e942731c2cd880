#include "map_parts.h"

iris_map_pose iris_map_pose_after(iris_map_pose pose, iris_map_pose step)
{
    const iris_heading turn = iris_heading_of(pose.heading);
    return (iris_map_pose){iris_add_sat(pose.x_mm, iris_heading_x(turn, step.x_mm, step.y_mm)),
                           iris_add_sat(pose.y_mm, iris_heading_y(turn, step.x_mm, step.y_mm)),
                           iris_angle_wrap(pose.heading + step.heading)};
}

iris_map_pose iris_map_pose_step(iris_map_pose from, iris_map_pose to)
{
    const int32_t x = iris_sub_sat(to.x_mm, from.x_mm), y = iris_sub_sat(to.y_mm, from.y_mm);
    iris_heading back = iris_heading_of(from.heading);
    back.sine = -back.sine;
    return (iris_map_pose){iris_heading_x(back, x, y), iris_heading_y(back, x, y),
                           iris_angle_wrap(to.heading - from.heading)};
}
