/* Cameras from their own motion, in scenes that nobody has measured. */
#include "calls.h"
#include "iris/3d/calib_motion.h"
#include "space.h"

/* Seldom so many matches that they tell of a camera: that takes long. */
enum { PAIRS = 2, MATCHES = 9 };

static const iris_size usual = {640, 480};

/* The same points as the camera sees them from two poses, some pixels off, twice, or anything. */
static void see_both(iris_match *matches, iris_sensor camera, const iris_pose *before, const iris_pose *after)
{
    for (int i = 0; i < MATCHES; i++) {
        matches[i] = (iris_match){{0, 0}, {0, 0}};
        camera.pose = *before;
        iris_vec3 world = draw_seen(&camera, 2, 20);
        (void)iris_sensor_project(&matches[i].from, NULL, &camera, world);
        camera.pose = *after;
        (void)iris_sensor_project(&matches[i].to, NULL, &camera, world);
        matches[i].to.x += draw_chance(60) ? draw_q32(-99, 99) : draw_within(INT32_MIN, INT32_MAX) / 8;
        if (i > 0 && draw_chance(100)) {
            matches[i] = matches[draw_below((uint32_t)i)];
        }
        draw_spoiled(&matches[i].from.x, 4, 150);
    }
}

/* Some of the matches, or as many as are refused. */
static iris_motion_pair given_pair(const iris_match *matches, int tells)
{
    int32_t n = tells ? draw_within(6, MATCHES) : draw_within(0, 5);
    iris_motion_pair made = {.matches = OR_NULL(draw_given(matches, (size_t)n * sizeof *matches)),
                             .count = n};
    if (draw_chance(60)) {
        made.count = draw_chance(2) ? draw_within(INT32_MIN, -1) : draw_within(4097, INT32_MAX);
    }
    iris_mat3_identity(&made.turn);
    return made;
}

static iris_pose any_mount(void)
{
    iris_vec3 ahead = {draw_q32(-1, 1) / 4, draw_q32(-1, 1) / 4, draw_q32(-1, 1) / 4};
    iris_pose made = {.place = draw_vec3(1)};
    iris_rotation_from_vector(&made.turn, ahead);
    return made;
}

static iris_motion_config any_config(const iris_pose *mount)
{
    iris_motion_config config = {draw_chance(2) ? 0 : draw_below(draw_chance(20) ? 20 : 16), usual, *mount};
    if (draw_chance(10)) {
        *(draw_chance(2) ? &config.size.w : &config.size.h) = draw_int(0, IRIS_SIDE_MAX);
    }
    draw_spoiled(config.mount.turn.m, 9, 20);
    draw_spoiled(&config.mount.place.x, 3, 20);
    return config;
}

static iris_mat3 some_turn(void)
{
    iris_mat3 made;
    iris_vec3 axis = draw_direction();
    iris_rotation_about(&made, axis, draw_q32(-1, 1) / 3);
    return made;
}

/* How many pairs there are, mostly as many as there is room for. */
static int32_t any_count(size_t *room)
{
    int32_t count = draw_chance(3) ? draw_int(0, PAIRS) : draw_within(1, PAIRS);
    int fits = count >= 0 && count <= PAIRS;
    *room = (size_t)(fits ? count : 0);
    return fits || count < 0 || count > IRIS_MOTION_PAIRS_MAX ? count : 0;
}

static void rotation(void)
{
    iris_motion_pair pairs[PAIRS];
    iris_sensor camera = draw_sensor(usual, 0);
    iris_pose before = any_mount();
    iris_motion_config made = any_config(&before);
    size_t room;
    int32_t count = any_count(&room);
    int tells = draw_chance(12);
    camera.lens = (iris_lens){.k1 = 0};
    for (int v = 0; v < PAIRS; v++) {
        iris_match matches[MATCHES];
        iris_mat3 turn = some_turn();
        iris_pose after = before;
        iris_mat3_multiply(&after.turn, &turn, &before.turn);
        see_both(matches, camera, &before, &after);
        pairs[v] = given_pair(matches, tells);
    }
    iris_motion_fit *fit = OR_NULL(draw_results(sizeof *fit));
    iris_motion_turn *turns = OR_NULL(draw_results(room * sizeof *turns));
    const iris_motion_pair *given = OR_NULL(draw_given(pairs, room * sizeof *pairs));
    const iris_motion_config *config = draw_chance(8) ? NULL : draw_given(&made, sizeof made);
    iris_scratch *scratch = draw_scratch(IRIS_ROTATION_SCRATCH_BYTES(room));
    CALL(iris_rotation_calibrate(fit, turns, given, count, config, scratch));
}

static void known_motion(void)
{
    iris_motion_pair pairs[PAIRS];
    iris_sensor camera = draw_sensor(usual, 0);
    iris_pose mount = any_mount();
    iris_motion_config made = any_config(&mount);
    size_t room;
    int32_t count = any_count(&room);
    int tells = draw_chance(12);
    camera.lens = (iris_lens){.k1 = 0};
    for (int v = 0; v < PAIRS; v++) {
        iris_match matches[MATCHES];
        iris_mat3 turn = some_turn(), back;
        iris_vec3 shift = draw_vec3(1);
        iris_pose after = {.place = iris_vec3_add(shift, iris_mat3_vector(&turn, mount.place))};
        iris_mat3_transpose(&back, &turn);
        iris_mat3_multiply(&after.turn, &mount.turn, &back);
        see_both(matches, camera, &mount, &after);
        pairs[v] = given_pair(matches, tells);
        pairs[v].turn = turn;
        pairs[v].shift = shift;
        draw_spoiled(pairs[v].turn.m, 9, 30);
        draw_spoiled(&pairs[v].shift.x, 3, 30);
    }
    iris_motion_fit *fit = OR_NULL(draw_results(sizeof *fit));
    const iris_motion_pair *given = OR_NULL(draw_given(pairs, room * sizeof *pairs));
    const iris_motion_config *config = OR_NULL(draw_given(&made, sizeof made));
    iris_scratch *scratch = draw_scratch(IRIS_MOTION_SCRATCH_BYTES);
    CALL(iris_motion_calibrate(fit, given, count, config, scratch));
}

static void translation(void)
{
    iris_match matches[MATCHES];
    iris_sensor camera = draw_sensor(usual, 0);
    iris_pose before = any_mount(), after = before;
    after.place = iris_vec3_add(before.place, draw_vec3(1));
    see_both(matches, camera, &before, &after);
    iris_motion_pair pair = given_pair(matches, !draw_chance(4));
    iris_size size = draw_chance(4) ? draw_size() : draw_chance(2) ? usual : (iris_size){0, 0};
    iris_translation_fit *fit = OR_NULL(draw_results(sizeof *fit));
    CALL(iris_translation_focus(fit, pair.matches, pair.count, size));
}

const random_call calls_motion[] = {
    {"iris_rotation_calibrate", rotation},
    {"iris_motion_calibrate", known_motion},
    {"iris_translation_focus", translation},
    {NULL, NULL},
};
