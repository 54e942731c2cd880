/* What a drive looked like: the course from above with the driven path, and camera frames with what was found. */
#ifndef SIM_PICTURE_H
#define SIM_PICTURE_H

#include "drive.h"
#include "iris/draw.h"
#include "iris/image.h"

/* A picture of w x h pixels filled with `color`; data is null when memory is short. Give it back with free(data). */
iris_image sim_picture_make(int32_t w, int32_t h, iris_color color);

/* Writes a BMP; 0 when it cannot. */
int sim_picture_save(const iris_image *picture, const char *folder, const char *name);

/* Mixes `share` (0..1) of `color` into pixel (x, y); nothing outside. */
void sim_picture_mix(const iris_image *picture, int x, int y, iris_color color, double share);

/* A smooth line of any width; positions and width in pixels, pixel (0, 0) has its center at 0, 0. */
void sim_picture_stroke(const iris_image *picture, const double from[2], const double to[2], double width,
                        iris_color color, double share);

/* The course from above. `start` is the robot as it stood at the start. */
int sim_map_save(const char *folder, const sim_record *record, const sim_floor *floor,
                 const sim_camera *camera, const sim_robot *start);

/* One big picture per difficult place, and a sheet of all kept frames. */
int sim_overlay_save(const char *folder, const sim_record *record);

#endif
