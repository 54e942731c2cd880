/* Calibration: cameras from known points, beside what others found in the same data. */
#include <math.h>
#include <stdlib.h>

#include "iris/3d/calib_scene.h"
#include "picture.h"
#include "score.h"

static double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

/* At most `room` numbers of a file, those behind a # left out. -1: there is none. */
static int read_numbers(iris_q32 *numbers, int room, const char *name)
{
    FILE *file = data_open(name);
    char word[64];
    int count = 0;
    while (file && count < room && fscanf(file, "%63s", word) == 1) {
        if (word[0] == '#') {
            (void)fscanf(file, "%*[^\n]");
        } else {
            numbers[count++] = (iris_q32)llround(strtod(word, NULL) * 4294967296.0);
        }
    }
    if (file) {
        fclose(file);
    }
    return file ? count : -1;
}

static double away(const iris_scene_camera *camera, const iris_q32 place[3])
{
    iris_vec3 truth = {place[0], place[1], place[2]};
    return real(iris_vec3_length(iris_vec3_sub(camera->sensor.pose.place, truth)));
}

static void score_scene(score *s)
{
    static const char what[] = "camera from 20 known points, linear: sum of distances";
    static IRIS_SCRATCH_BUFFER(memory, IRIS_SCENE_SCRATCH_BYTES(20));
    iris_q32 space[60], image[40], truth[15];
    iris_scene_point points[20];
    uint8_t used[20];
    iris_scene_fit fit;
    iris_scratch scratch;
    if (read_numbers(space, 60, "calib/scene3d/pts3d-norm.txt") != 60 ||
        read_numbers(image, 40, "calib/scene3d/pts2d-norm-pic_a.txt") != 40 ||
        read_numbers(truth, 15, "calib/scene3d/expected.txt") != 15) {
        score_row(s, what, "at most 0.0446", SCORE_SKIPPED, "no data (IRIS_DATA)");
        return;
    }
    for (int i = 0; i < 20; i++) {
        points[i] = (iris_scene_point){{space[3 * i], space[3 * i + 1], space[3 * i + 2]},
                                       {image[2 * i], image[2 * i + 1]}};
    }
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    int good = iris_scene_calibrate(&fit, used, points, 20, &scratch) == IRIS_OK && fit.left_out == 0;
    if (!good) {
        score_row(s, what, "at most 0.0446", SCORE_MISSED, "flaw %d, %d points left out", (int)fit.flaw,
                  (int)fit.left_out);
        return;
    }
    score_row(s, what, "at most 0.0446", score_if(real(fit.linear.total) <= 0.0446), "%.6f; refined %.6f",
              real(fit.linear.total), real(fit.refined.total));
    score_row(s, "the same: its center", "within 0.001", score_if(away(&fit.linear, truth + 12) <= 0.001),
              "%.6f off; refined, by other errors, %.6f", away(&fit.linear, truth + 12),
              away(&fit.refined, truth + 12));
}

void score_calib(score *s)
{
    score_scene(s);
}
