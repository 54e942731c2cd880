/* iris calibrate scene. */
#include <stdio.h>

#include "args.h"
#include "calibrate.h"
#include "calibrate_json.h"
#include "complain.h"
#include "iris/3d/calib_scene.h"
#include "number_file.h"
#include "one_line.h"

static const char help[] =
    "usage: iris calibrate scene POINTS3D POINTS2D [--json]\n\n"
    "From points whose places in space are known, and where a picture shows them, to the camera: six\n"
    "at least, not all (nor all but one) on one plane.\n\n"
    "  POINTS3D  a point per line: X Y Z, in any unit. Blanks, tabs, commas, or semicolons stand\n"
    "            between numbers; what stands behind a # does not count. -: standard input\n"
    "  POINTS2D  where the picture shows them, in the same order: x y, pixels or any other unit, y down\n"
    "  --json    one JSON object\n\n"
    "Two solutions are printed: the linear one, and the refined one, which makes the sum of squared\n"
    "distances in the picture least: the better one of the two, unless it is to be compared. JSON has M\n"
    "(3 x 4), K, R (3 x 3), t, center, residual (the sum of the distances in the picture), and rms of\n"
    "the linear one, and the same as an object in refined. M = K [R | t]; center = -R' t is where the\n"
    "camera is. With twelve points and more, those that are far off (up to three of ten) are left out:\n"
    "left_out has their lines in POINTS3D.\n\n"
    "example: iris calibrate scene corners3d.txt corners2d.txt --json\n";

typedef struct {
    iris_scene_point points[IRIS_SCENE_POINTS_MAX];
    uint8_t used[IRIS_SCENE_POINTS_MAX];
    int lines[IRIS_SCENE_POINTS_MAX];
    int32_t count;
    iris_scene_fit fit;
} scene;

static int read_points(scene *s, char **paths)
{
    static iris_q32 places[3 * IRIS_SCENE_POINTS_MAX], pixels[2 * IRIS_SCENE_POINTS_MAX];
    number_table space = {places, s->lines, 0, IRIS_SCENE_POINTS_MAX, 3};
    number_table image = {pixels, NULL, 0, IRIS_SCENE_POINTS_MAX, 2};
    if (!number_file_read(&space, paths[0]) || !number_file_read(&image, paths[1])) {
        return 0;
    }
    if (space.rows != image.rows) {
        complain(paths[1], "%d points, but there are %d in %s", image.rows, space.rows, paths[0]);
        return 0;
    }
    s->count = space.rows;
    for (int i = 0; i < s->count; i++) {
        s->points[i].world = (iris_vec3){places[3 * i], places[3 * i + 1], places[3 * i + 2]};
        s->points[i].image = (iris_vec2){pixels[2 * i], pixels[2 * i + 1]};
    }
    return 1;
}

static void complain_flaw(const char *path, const scene *s)
{
    static const char *const said[] = {
        [IRIS_SCENE_FINE] = "",
        [IRIS_SCENE_TOO_FEW] = "six different points are needed at least, in space and in the picture",
        [IRIS_SCENE_FLAT] = "all points but one are on one plane, or nearly: add points beside it",
        [IRIS_SCENE_UNDETERMINED] =
            "many cameras would see these points so: add points, nearer and farther ones",
        [IRIS_SCENE_BEHIND] =
            "no camera sees these points so: are the lines of both files in the same order?",
        [IRIS_SCENE_MIRRORED] =
            "only a mirror shows these points so: y points down in the picture, and space is right-handed"};
    const int may_disagree = s->count >= 12 && s->fit.flaw >= IRIS_SCENE_UNDETERMINED;
    complain(path, "%s%s (%d %s)", said[s->fit.flaw],
             may_disagree ? "; or too many points disagree: at most three of ten may be wrong" : "",
             (int)s->count, s->count == 1 ? "point" : "points");
}

/* The translation: -R times the center. */
static iris_vec3 translation(const iris_pose *pose)
{
    return iris_pose_into(pose, (iris_vec3){0, 0, 0});
}

static void print_camera_json(json_writer *json, const iris_scene_camera *camera)
{
    const iris_intrinsics *k = &camera->sensor.intrinsics;
    const iris_vec3 t = translation(&camera->sensor.pose), c = camera->sensor.pose.place;
    const iris_q32 matrix[9] = {k->alpha_u, k->shear, k->u0, 0, k->alpha_v, k->v0, 0, 0, IRIS_Q32_ONE};
    iris_q32 m[12];
    iris_sensor_matrix(m, &camera->sensor);
    calibrate_numbers(json, "M", m, 3, 4);
    calibrate_numbers(json, "K", matrix, 3, 3);
    calibrate_numbers(json, "R", camera->sensor.pose.turn.m, 3, 3);
    calibrate_numbers(json, "t", (const iris_q32[3]){t.x, t.y, t.z}, 1, 3);
    calibrate_numbers(json, "center", (const iris_q32[3]){c.x, c.y, c.z}, 1, 3);
    calibrate_number(json, "residual", camera->total);
    calibrate_number(json, "rms", camera->rms);
}

static void print_json(const scene *s)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    print_camera_json(&json, &s->fit.linear);
    json_key(&json, "refined");
    json_open(&json, '{');
    print_camera_json(&json, &s->fit.refined);
    json_close(&json, '}');
    json_key(&json, "points");
    json_integer(&json, s->count);
    json_key(&json, "left_out");
    json_open(&json, '[');
    for (int32_t i = 0; i < s->count; i++) {
        if (!s->used[i]) {
            json_integer(&json, s->lines[i]);
        }
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_camera(const char *name, const iris_scene_camera *camera)
{
    const iris_intrinsics *k = &camera->sensor.intrinsics;
    const iris_vec3 c = camera->sensor.pose.place;
    const iris_q32 *r = camera->sensor.pose.turn.m;
    printf("%s: residual %.6g in all, %.6g root mean square\n", name, calibrate_real(camera->total),
           calibrate_real(camera->rms));
    printf("  focal length %.6g %.6g, skew %.6g, principal point %.6g %.6g\n", calibrate_real(k->alpha_u),
           calibrate_real(k->alpha_v), calibrate_real(k->shear), calibrate_real(k->u0),
           calibrate_real(k->v0));
    printf("  center %.6g %.6g %.6g\n", calibrate_real(c.x), calibrate_real(c.y), calibrate_real(c.z));
    for (int i = 0; i < 3; i++) {
        printf("  %s %9.6f %9.6f %9.6f\n", i == 0 ? "rotation" : "        ", calibrate_real(r[3 * i]),
               calibrate_real(r[3 * i + 1]), calibrate_real(r[3 * i + 2]));
    }
}

static void print_text(const scene *s, const char *path)
{
    one_line(stdout, path);
    printf(": %d points", (int)s->count);
    for (int32_t i = 0, n = 0; i < s->count; i++) {
        if (!s->used[i]) {
            printf("%s %d", n++ ? "," : "; far off and left out: line", s->lines[i]);
        }
    }
    printf("\n");
    print_camera("linear", &s->fit.linear);
    print_camera("refined", &s->fit.refined);
}

int calibrate_scene(int argc, char **argv)
{
    static scene s;
    static IRIS_SCRATCH_BUFFER(memory, IRIS_SCENE_SCRATCH_BYTES(IRIS_SCENE_POINTS_MAX));
    iris_scratch scratch;
    int json = 0;
    const args_option options[] = {{"json", 0, &json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (args.operand_count != 2) {
        complain(
            NULL,
            "scene takes two files: points in space, and in the picture (see iris calibrate scene --help)");
        return EXIT_BAD_CALL;
    }
    if (!read_points(&s, args.operands)) {
        return EXIT_BAD_DATA;
    }
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (iris_scene_calibrate(&s.fit, s.used, s.points, s.count, &scratch) != IRIS_OK) {
        complain_flaw(args.operands[0], &s);
        return EXIT_BAD_DATA;
    }
    if (json) {
        print_json(&s);
    } else {
        print_text(&s, args.operands[0]);
    }
    return EXIT_DONE;
}
