/* An exploration as a picture, and as files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "explore.h"
#include "iris/3d/camera_text.h"
#include "iris/pnm.h"
#include "picture.h"

#define PI    3.14159265358979323846
#define SCALE 8 /* pixels to a cell */

static ptrdiff_t write_file(void *user, const uint8_t *data, size_t bytes)
{
    return (ptrdiff_t)fwrite(data, 1, bytes, user);
}

static void stroke(const iris_image *picture, const iris_grid *grid, const double from[2], const double to[2],
                   double width, iris_color color)
{
    double ends[2][2];
    for (int i = 0; i < 2; i++) {
        const double *at = i ? to : from;
        ends[i][0] = SCALE * (at[0] - grid->left_mm) / grid->cell_mm - 0.5;
        ends[i][1] = picture->h - 0.5 - SCALE * (at[1] - grid->bottom_mm) / grid->cell_mm;
    }
    sim_picture_stroke(picture, ends[0], ends[1], width, color, 1);
}

static void draw_poses(const iris_image *picture, const iris_grid *grid, const iris_map_pose *poses,
                       int count, iris_color color)
{
    for (int i = 1; i < count; i++) {
        const double from[2] = {poses[i - 1].x_mm, poses[i - 1].y_mm}, to[2] = {poses[i].x_mm, poses[i].y_mm};
        stroke(picture, grid, from, to, 2, color);
    }
}

int sim_explore_save(const char *folder, const sim_exploration *e)
{
    static const iris_color red = {230, 40, 40}, green = {0, 150, 60}, orange = {240, 150, 30},
                            blue = {40, 90, 230};
    const iris_grid *grid = &e->grid;
    const sim_lap *lap = &e->lap[1];
    iris_image picture = sim_picture_make(SCALE * grid->w, SCALE * grid->h, blue);
    uint8_t *gray = malloc((size_t)grid->w * (size_t)grid->h);
    const iris_image cells = {gray, grid->w, grid->w, grid->h, IRIS_GRAY8};
    int good = picture.data && gray && iris_grid_to_picture(&cells, grid) == IRIS_OK;
    for (int y = 0; y < picture.h && good; y++) {
        uint8_t *row = iris_image_row(&picture, y);
        for (int x = 0; x < 3 * picture.w; x++) {
            row[x] = gray[y / SCALE * grid->w + x / 3 / SCALE];
        }
    }
    if (good) {
        for (int s = 0; s < sim_solid_count; s++) {
            for (int i = 0; i < sim_solids[s].corners; i++) {
                stroke(&picture, grid, sim_solids[s].corner[i],
                       sim_solids[s].corner[(i + 1) % sim_solids[s].corners], 1.5, red);
            }
        }
        draw_poses(&picture, grid, lap->odometry, lap->frames, orange);
        for (int i = 1; i < lap->frames; i++) {
            const double from[2] = {lap->truth[i - 1].x, lap->truth[i - 1].y},
                         to[2] = {lap->truth[i].x, lap->truth[i].y};
            stroke(&picture, grid, from, to, 4, green);
        }
        draw_poses(&picture, grid, lap->found, lap->frames, blue);
        good = sim_picture_save(&picture, folder, "map.bmp");
    }
    free(picture.data);
    free(gray);
    return good;
}

static FILE *open_in(const char *folder, const char *name)
{
    char path[600];
    return snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path ? fopen(path, "wb") : NULL;
}

static int write_poses(const char *folder, const char *name, const sim_lap *lap, int truth)
{
    FILE *file = open_in(folder, name);
    for (int i = 0; i < lap->frames && file; i++) {
        const iris_map_pose *o = &lap->odometry[i];
        const sim_pose *t = &lap->truth[i];
        fprintf(file, "%.1f %.1f %.3f\n", truth ? t->x : o->x_mm, truth ? t->y : o->y_mm,
                truth ? t->heading * 180 / PI : o->heading * 360 / 65536.0);
    }
    return file && fclose(file) == 0;
}

static int write_lap(const char *folder, const char *name, const sim_lap *lap)
{
    char path[500];
    int good = snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path;
    good = good && write_poses(path, "truth.txt", lap, 1) && write_poses(path, "odometry.txt", lap, 0);
    for (int i = 0; i < lap->frames && good; i++) {
        char frame[32];
        const iris_image image = {(void *)(uintptr_t)lap->disparity[i], 2 * SIM_DEPTH_W, SIM_DEPTH_W,
                                  SIM_DEPTH_H, IRIS_GRAY_U16};
        snprintf(frame, sizeof frame, "%04d.pgm", i);
        FILE *file = open_in(path, frame);
        good = file && iris_pnm_write((iris_sink){write_file, file}, &image) == IRIS_OK;
        good = file && fclose(file) == 0 && good;
    }
    return good;
}

int sim_explore_frames(const char *folder, const sim_exploration *e)
{
    const iris_depth_camera camera = sim_depth_camera();
    const iris_q32 focal = (iris_q32)camera.focal_q16 * 65536;
    const iris_camera_model model = {
        {SIM_DEPTH_W, SIM_DEPTH_H},
        {focal, focal, 0, (iris_q32)camera.u0_q16 * 65536, (iris_q32)camera.v0_q16 * 65536},
        {.k1 = 0}};
    char text[IRIS_CAMERA_TEXT_BYTES];
    size_t length = 0;
    FILE *file = open_in(folder, "camera.txt");
    int good = file && iris_camera_write_text(text, sizeof text, &length, &model) == IRIS_OK &&
               fwrite(text, 1, length, file) == length;
    good = file && fclose(file) == 0 && good;
    return good && write_lap(folder, "first", &e->lap[0]) && write_lap(folder, "second", &e->lap[1]);
}
