/* Cameras from their motion, against simulated ones in double precision: matches with noise of a known size. */
#include "iris/3d/calib_motion.h"

#include <stdio.h>

#include "random3d.h"
#include "test.h"

enum { PAIRS = 8, MATCHES = 50 };

static iris_match matches[PAIRS][MATCHES];
static iris_motion_pair pairs[PAIRS];

typedef struct {
    double au, av, skew, u0, v0;
} camera;

static const camera usual = {600, 600, 0, 319.5, 239.5}, odd = {620, 590, 0, 331, 226};

static double uniform(double low, double high)
{
    return low + (high - low) * (double)(random_u64() >> 11) / 9007199254740992.0;
}

static double normal(double sigma)
{
    double u = uniform(1e-12, 1), v = uniform(0, 6.283185307179586);
    return sigma * sqrt(-2 * log(u)) * cos(v);
}

static iris_q32 q32_of(double value)
{
    return (iris_q32)llround(value * 4294967296.0);
}

typedef struct {
    double m[9];
} matrix;

/* A turn by Rodrigues' formula, of a vector in degrees. */
static matrix turn_of(double x, double y, double z)
{
    const double degree = 3.14159265358979323846 / 180;
    const double a[3] = {x * degree, y * degree, z * degree};
    const double angle = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double s = angle > 0 ? sin(angle) / angle : 1,
                 c = angle > 0 ? (1 - cos(angle)) / (angle * angle) : 0.5;
    matrix r;
    for (int i = 0; i < 9; i++) {
        int row = i / 3, column = i % 3;
        double cross = row == column ? 0 : (column == (row + 1) % 3 ? -1 : 1) * a[(6 - row - column) % 3];
        r.m[i] = (row == column ? cos(angle) : 0) + s * cross + c * a[row] * a[column];
    }
    return r;
}

static void apply(double to[3], const matrix *r, const double from[3])
{
    for (int i = 0; i < 3; i++) {
        to[i] = r->m[3 * i] * from[0] + r->m[3 * i + 1] * from[1] + r->m[3 * i + 2] * from[2];
    }
}

static void pixel_of(double uv[2], const camera *c, const double p[3])
{
    uv[0] = c->au * p[0] / p[2] + c->skew * p[1] / p[2] + c->u0;
    uv[1] = c->av * p[1] / p[2] + c->v0;
}

static int is_seen(const double uv[2])
{
    return uv[0] >= 0 && uv[0] <= 639 && uv[1] >= 0 && uv[1] <= 479;
}

/* Pair v of a camera that turns by `turn` and is `shift` farther then, in its frame after: X after = turn X + shift.
 * depths: from near to far. */
static void simulate(int v, const camera *c, const matrix *turn, const double shift[3],
                     const double depths[2], double noise)
{
    for (int i = 0, tries = 0; i < MATCHES && tries < 1000000; tries++) {
        double from[2] = {uniform(0, 639), uniform(0, 479)}, to[2], after[3];
        double z = uniform(depths[0], depths[1]), y = (from[1] - c->v0) / c->av;
        double before[3] = {z * (from[0] - c->u0 - c->skew * y) / c->au, z * y, z};
        apply(after, turn, before);
        for (int k = 0; k < 3; k++) {
            after[k] += shift[k];
        }
        pixel_of(to, c, after);
        if (after[2] > 0 && is_seen(to)) {
            matches[v][i++] = (iris_match){{q32_of(from[0] + normal(noise)), q32_of(from[1] + normal(noise))},
                                           {q32_of(to[0] + normal(noise)), q32_of(to[1] + normal(noise))}};
        }
    }
    pairs[v].matches = matches[v];
    pairs[v].count = MATCHES;
}

static const double no_shift[3] = {0, 0, 0}, some_depths[2] = {300, 3000};

static iris_status rotation(iris_motion_fit *fit, iris_motion_turn *turns, int count, uint32_t model)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_ROTATION_SCRATCH_BYTES(PAIRS));
    const iris_motion_config config = {.model = model, .size = {640, 480}};
    iris_scratch scratch;
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, IRIS_ROTATION_SCRATCH_BYTES(count)), IRIS_OK);
    return iris_rotation_calibrate(fit, turns, pairs, count, &config, &scratch);
}

static double turn_error(const iris_mat3 *found, const matrix *truth)
{
    double most = 0;
    for (int i = 0; i < 9; i++) {
        most = fmax(most, fabs(real(found->m[i]) - truth->m[i]));
    }
    return most;
}

/* Without noise all is exact. */
static void exact_turns(void **state)
{
    (void)state;
    const double angles[4][3] = {{3, 18, -2}, {-12, 5, 8}, {10, 12, 20}, {-9, -14, 3}};
    matrix turn[4];
    iris_motion_fit fit;
    iris_motion_turn turns[4];
    for (int v = 0; v < 4; v++) {
        turn[v] = turn_of(angles[v][0], angles[v][1], angles[v][2]);
        simulate(v, &odd, &turn[v], no_shift, some_depths, 0);
    }
    assert_int_equal(rotation(&fit, turns, 4, IRIS_MOTION_CENTER | IRIS_MOTION_ASPECT | IRIS_MOTION_SHEAR),
                     IRIS_OK);
    const iris_intrinsics *k = &fit.intrinsics;
    printf("#: exact turns: focal lengths %.1e %.1e, skew %.1e, center %.1e %.1e px off, rms %.1e\n",
           fabs(real(k->alpha_u) - odd.au), fabs(real(k->alpha_v) - odd.av), fabs(real(k->shear)),
           fabs(real(k->u0) - odd.u0), fabs(real(k->v0) - odd.v0), real(fit.rms));
    assert_true(fabs(real(k->alpha_u) - odd.au) < 1e-3 && fabs(real(k->alpha_v) - odd.av) < 1e-3);
    assert_true(fabs(real(k->shear)) < 1e-3 && fabs(real(k->u0) - odd.u0) < 1e-3 &&
                fabs(real(k->v0) - odd.v0) < 1e-3);
    for (int v = 0; v < 4; v++) {
        assert_true(turn_error(&turns[v].turn, &turn[v]) < 1e-6);
    }
}

/* One pair of 20 degrees, 0.3 pixels of noise, a focal length alone: within 1 % most of the time, and as its deviation says. */
static void one_turn_with_noise(void **state)
{
    (void)state;
    double squares = 0, said = 0, worst = 0;
    enum { RUNS = 12 };
    for (int i = 0; i < RUNS; i++) {
        matrix turn = turn_of(uniform(-3, 3), i % 2 ? 20 : -20, uniform(-3, 3));
        iris_motion_fit fit;
        iris_motion_turn turns[1];
        simulate(0, &usual, &turn, no_shift, some_depths, 0.3);
        assert_int_equal(rotation(&fit, turns, 1, 0), IRIS_OK);
        double off = real(fit.intrinsics.alpha_u) - usual.au;
        squares += off * off / RUNS;
        said += real(fit.deviations[IRIS_MOTION_ALPHA_U]) * real(fit.deviations[IRIS_MOTION_ALPHA_U]) / RUNS;
        worst = fmax(worst, fabs(off));
        assert_true(real(fit.intrinsics.u0) == 319.5 && fit.intrinsics.alpha_u == fit.intrinsics.alpha_v);
    }
    printf("#: a turn of 20 degrees, 0.3 px: focal length of 600 off by %.2f (root mean square), said %.2f, "
           "at most %.2f\n",
           sqrt(squares), sqrt(said), worst);
    assert_true(sqrt(squares) < 6 && sqrt(squares) < 1.5 * sqrt(said) && sqrt(said) < 1.5 * sqrt(squares));
}

/* What only rotates about its optical axis, does not turn, or has too little to look at. */
static void turns_that_say_nothing(void **state)
{
    (void)state;
    iris_motion_fit fit;
    iris_motion_turn turns[2];
    matrix turn = turn_of(0, 0, 25);
    simulate(0, &usual, &turn, no_shift, some_depths, 0.2);
    assert_int_equal(rotation(&fit, turns, 1, 0), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_ROLLS);
    turn = turn_of(0, 0, 0);
    simulate(0, &usual, &turn, no_shift, some_depths, 0.2);
    assert_int_equal(rotation(&fit, turns, 1, 0), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_STILL);
    turn = turn_of(0, 15, 0); /* about y alone: the heights of pixels stay open */
    simulate(0, &usual, &turn, no_shift, some_depths, 0.2);
    assert_int_equal(rotation(&fit, turns, 1, IRIS_MOTION_ASPECT), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_UNDETERMINED);
    assert_int_equal(rotation(&fit, turns, 1, 0), IRIS_OK);
    pairs[0].count = 3;
    assert_int_equal(rotation(&fit, turns, 1, 0), IRIS_ERR_DATA);
    assert_true(fit.flaw == IRIS_MOTION_TOO_FEW && fit.flawed == 0);
    assert_int_equal(rotation(&fit, turns, 0, 0), IRIS_ERR_DATA);
    assert_true(fit.flaw == IRIS_MOTION_TOO_FEW && fit.flawed == -1);
    simulate(0, &usual, &turn, no_shift, some_depths, 0);
    simulate(1, &usual, &turn, no_shift, some_depths, 0);
    for (int i = 0; i < MATCHES; i++) { /* a line */
        matches[1][i].from.y = matches[1][i].from.x / 2;
        matches[1][i].to.y = matches[1][i].to.x / 2;
    }
    assert_int_equal(rotation(&fit, turns, 2, 0), IRIS_ERR_DATA);
    assert_true(fit.flaw == IRIS_MOTION_IN_LINE && fit.flawed == 1);
    for (int i = 0; i < MATCHES; i++) { /* one place */
        matches[1][i] = matches[1][0];
    }
    assert_int_equal(rotation(&fit, turns, 2, 0), IRIS_ERR_DATA);
    assert_true(fit.flaw == IRIS_MOTION_IN_LINE && fit.flawed == 1);
    for (int i = 0; i < MATCHES; i++) { /* others' partners */
        matches[0][i].to = matches[0][(i * 7 + 3) % MATCHES].to;
    }
    assert_int_equal(rotation(&fit, turns, 1, 0), IRIS_ERR_DATA);
    assert_true(fit.flaw == IRIS_MOTION_OTHER || fit.flaw == IRIS_MOTION_IN_LINE);
}

/* --- translation --- */

static void focus_of_a_translation(void **state)
{
    (void)state;
    const double shifts[4][3] = {{-20, 5, -150}, {60, 20, 90}, {-120, 10, -30}, {100, -60, 0}};
    const matrix none = turn_of(0, 0, 0);
    for (int v = 0; v < 4; v++) {
        double squares = 0, said = 0;
        const double *s = shifts[v]; /* where points go: the camera moves the other way */
        for (int i = 0; i < 20; i++) {
            iris_translation_fit fit;
            simulate(0, &usual, &none, s, some_depths, i ? 0.3 : 0);
            assert_int_equal(iris_translation_focus(&fit, matches[0], MATCHES, (iris_size){640, 480}),
                             IRIS_OK);
            assert_true(v == 3 || fit.ahead == (v != 1)); /* the last one moves aside: any */
            double truth[3] = {-600 * s[0] - 319.5 * s[2], -600 * s[1] - 239.5 * s[2], -s[2]};
            double length = sqrt(truth[0] * truth[0] + truth[1] * truth[1] + truth[2] * truth[2]);
            double off =
                fabs(real(fit.focus.x) - truth[0] / length) + fabs(real(fit.focus.y) - truth[1] / length);
            assert_true(off < (i ? 0.05 : 1e-6));
            if (s[2] != 0 && i > 0) {
                double x = real(fit.pixel.x) - truth[0] / truth[2];
                squares += x * x / 19;
                said += real(fit.deviation.x) * real(fit.deviation.x) / 19;
            }
        }
        if (s[2] != 0) {
            printf("#: focus of expansion at %.0f: off by %.2f px (root mean square), said %.2f\n",
                   600 * s[0] / s[2] + 319.5, sqrt(squares), sqrt(said));
            assert_true(sqrt(squares) < 1.5 * sqrt(said) && sqrt(said) < 1.5 * sqrt(squares));
        }
    }
}

static void translations_that_say_nothing(void **state)
{
    (void)state;
    const double shift[3] = {-20, 5, -150};
    const iris_size size = {640, 480};
    iris_translation_fit fit;
    matrix turn = turn_of(0, 0, 0);
    simulate(0, &usual, &turn, no_shift, some_depths, 0.01);
    assert_int_equal(iris_translation_focus(&fit, matches[0], MATCHES, size), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_STILL);
    simulate(0, &usual, &turn, shift, some_depths, 0);
    assert_int_equal(iris_translation_focus(&fit, matches[0], 3, size), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_TOO_FEW);
    for (int i = 0; i < MATCHES; i++) {
        matches[0][i] = matches[0][0];
    }
    assert_int_equal(iris_translation_focus(&fit, matches[0], MATCHES, size), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_IN_LINE);
    turn = turn_of(0, 0, 30);
    simulate(0, &usual, &turn, no_shift, some_depths, 0);
    assert_int_equal(iris_translation_focus(&fit, matches[0], MATCHES, size), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_OTHER);
    assert_int_equal(iris_translation_focus(NULL, matches[0], 4, size), IRIS_ERR_ARG);
    assert_int_equal(iris_translation_focus(&fit, NULL, 4, size), IRIS_ERR_ARG);
    assert_int_equal(iris_translation_focus(&fit, matches[0], -1, size), IRIS_ERR_RANGE);
    assert_int_equal(iris_translation_focus(&fit, matches[0], IRIS_MOTION_MATCHES_MAX + 1, size),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_translation_focus(&fit, matches[0], 4, (iris_size){-1, 3}), IRIS_ERR_RANGE);
}

/* --- known motions --- */

typedef struct {
    matrix turn;
    double place[3];
} pose;

static matrix transposed(const matrix *r)
{
    matrix t;
    for (int i = 0; i < 9; i++) {
        t.m[i] = r->m[i % 3 * 3 + i / 3];
    }
    return t;
}

static matrix product(const matrix *a, const matrix *b)
{
    matrix c;
    for (int i = 0; i < 9; i++) {
        c.m[i] = 0;
        for (int k = 0; k < 3; k++) {
            c.m[i] += a->m[i / 3 * 3 + k] * b->m[k * 3 + i % 3];
        }
    }
    return c;
}

/* Pair v of a robot that turns by `turn` degrees to the left and drives: with the camera mounted so. */
static void drive(int v, const camera *c, const pose *mount, const double turn[3], const double shift[3],
                  double noise)
{
    const matrix robot = turn_of(turn[0], turn[1], turn[2]), back = transposed(&robot),
                 out = transposed(&mount->turn);
    matrix way = product(&mount->turn, &back);
    double at[3], moved[3], before[3];
    for (int i = 0; i < 3; i++) {
        at[i] = mount->place[i] - shift[i];
        pairs[v].turn.m[i] = q32_of(robot.m[i]);
        pairs[v].turn.m[3 + i] = q32_of(robot.m[3 + i]);
        pairs[v].turn.m[6 + i] = q32_of(robot.m[6 + i]);
    }
    apply(moved, &way, at);
    apply(before, &mount->turn, mount->place);
    const double gone[3] = {moved[0] - before[0], moved[1] - before[1], moved[2] - before[2]};
    way = product(&way, &out);
    simulate(v, c, &way, gone, some_depths, noise);
    pairs[v].shift = (iris_vec3){q32_of(shift[0]), q32_of(shift[1]), q32_of(shift[2])};
}

static void to_q32(iris_mat3 *to, const matrix *from)
{
    for (int i = 0; i < 9; i++) {
        to->m[i] = q32_of(from->m[i]);
    }
}

/* A robot with x right, y ahead, z up, whose camera looks ahead and down. */
static pose mount_of(double tilt, double pan, double roll)
{
    const matrix level = {{1, 0, 0, 0, 0, -1, 0, 1, 0}};
    const matrix a = turn_of(tilt, 0, 0), b = turn_of(0, -pan, 0), c = turn_of(0, 0, -roll);
    matrix turn = product(&b, &level);
    turn = product(&a, &turn);
    pose made = {product(&c, &turn), {30, 90, 200}};
    return made;
}

static iris_status known(iris_motion_fit *fit, int count, uint32_t model, const pose *roughly)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_MOTION_SCRATCH_BYTES);
    iris_motion_config config = {.model = model, .size = {640, 480}};
    iris_scratch scratch;
    to_q32(&config.mount.turn, &roughly->turn);
    config.mount.place =
        (iris_vec3){q32_of(roughly->place[0]), q32_of(roughly->place[1]), q32_of(roughly->place[2])};
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, IRIS_MOTION_SCRATCH_BYTES), IRIS_OK);
    return iris_motion_calibrate(fit, pairs, count, &config, &scratch);
}

static const double motions[6][2][3] = {{{0, 0, 0}, {0, 150, 0}},   {{0, 0, 15}, {0, 0, 0}},
                                        {{0, 0, -12}, {10, 80, 0}}, {{0, 0, 20}, {-20, 120, 0}},
                                        {{0, 0, 0}, {0, -120, 0}},  {{0, 0, -18}, {15, 60, 0}}};

/* A robot on wheels: exact without noise, lever and all; and with noise. */
static void a_robot_that_drives(void **state)
{
    (void)state;
    enum { RUNS = 4 };
    const pose mount = mount_of(25, 4, -2);
    pose roughly = mount_of(15, 0, 0), placed = roughly; /* where it is, or not even that */
    iris_motion_fit fit;
    double off = 0, turned = 0, said = 0;
    roughly.place[0] = 0;
    roughly.place[1] = 60;
    roughly.place[2] = 170;
    for (int v = 0; v < 6; v++) {
        drive(v, &usual, &mount, motions[v][0], motions[v][1], 0);
    }
    assert_int_equal(known(&fit, 6, IRIS_MOTION_LEVER | IRIS_MOTION_CENTER, &roughly), IRIS_OK);
    const iris_intrinsics *k = &fit.intrinsics;
    printf("#: exact drives: focal length %.1e, center %.1e %.1e px off, mount %.1e, lever %.1e %.1e\n",
           fabs(real(k->alpha_u) - 600), fabs(real(k->u0) - 319.5), fabs(real(k->v0) - 239.5),
           turn_error(&fit.mount.turn, &mount.turn), fabs(real(fit.mount.place.x) - 30),
           fabs(real(fit.mount.place.y) - 90));
    assert_true(fabs(real(k->alpha_u) - 600) < 1e-3 && k->alpha_u == k->alpha_v && k->shear == 0);
    assert_true(fabs(real(k->u0) - 319.5) < 1e-3 && fabs(real(k->v0) - 239.5) < 1e-3);
    assert_true(turn_error(&fit.mount.turn, &mount.turn) < 1e-6);
    assert_true(fabs(real(fit.mount.place.x) - 30) < 1e-3 && fabs(real(fit.mount.place.y) - 90) < 1e-3);
    assert_true(fabs(real(fit.mount.place.z) - 170) < 1e-3); /* as it was given: no motion tells it */
    for (int i = 0; i < RUNS; i++) {
        for (int v = 0; v < 6; v++) {
            drive(v, &usual, &mount, motions[v][0], motions[v][1], 0.3);
        }
        assert_int_equal(known(&fit, 6, 0, &placed), IRIS_OK);
        off += pow(real(fit.intrinsics.alpha_u) - 600, 2) / RUNS;
        said += pow(real(fit.deviations[0]), 2) / RUNS;
        turned = fmax(turned, turn_error(&fit.mount.turn, &mount.turn));
    }
    printf("#: known motions, 0.3 px: focal length of 600 off by %.2f (root mean square), said %.2f; mount "
           "by %.1e\n",
           sqrt(off), sqrt(said), turned);
    assert_true(sqrt(off) < 2 && sqrt(off) < 2 * sqrt(said) && sqrt(said) < 2 * sqrt(off) && turned < 0.003);
}

static void motions_that_say_nothing(void **state)
{
    (void)state;
    const pose mount = mount_of(25, 4, -2);
    iris_motion_fit fit;
    for (int v = 0; v < 2; v++) { /* straight ahead alone */
        drive(v, &usual, &mount, motions[0][0], motions[v ? 0 : 4][1], 0.1);
    }
    assert_int_equal(known(&fit, 2, 0, &mount), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_UNDETERMINED);
    drive(0, &usual, &mount, no_shift, no_shift, 0.1);
    assert_int_equal(known(&fit, 1, 0, &mount), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_STILL);
    assert_int_equal(known(&fit, 0, 0, &mount), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_TOO_FEW);
    drive(0, &usual, &mount, motions[1][0], motions[1][1], 0.1);
    pairs[0].count = 3;
    assert_int_equal(known(&fit, 1, 0, &mount), IRIS_ERR_DATA);
    assert_int_equal(fit.flaw, IRIS_MOTION_TOO_FEW);
    for (int v = 0; v < 4; v++) { /* motions of another robot */
        drive(v, &usual, &mount, motions[v][0], motions[v][1], 0.1);
        pairs[v].turn = pairs[0].turn;
        pairs[v].shift = (iris_vec3){pairs[v].shift.z, pairs[v].shift.x, 90 * IRIS_Q32_ONE};
    }
    assert_int_equal(known(&fit, 4, 0, &mount), IRIS_ERR_DATA);
    assert_true(fit.flaw == IRIS_MOTION_OTHER || fit.flaw == IRIS_MOTION_UNDETERMINED);
}

/* --- calls --- */

static void refusals(void **state)
{
    (void)state;
    static IRIS_SCRATCH_BUFFER(memory, IRIS_ROTATION_SCRATCH_BYTES(PAIRS));
    const matrix turn = turn_of(5, 15, 0);
    iris_motion_config config = {.model = 0, .size = {640, 480}}, wrong = config;
    iris_motion_fit fit;
    iris_motion_turn turns[PAIRS];
    iris_scratch scratch;
    simulate(0, &usual, &turn, no_shift, some_depths, 0);
    iris_mat3_identity(&pairs[0].turn);
    iris_mat3_identity(&config.mount.turn);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, IRIS_ROTATION_SCRATCH_BYTES(1) - 1), IRIS_OK);
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, 1, &config, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, IRIS_MOTION_SCRATCH_BYTES - 1), IRIS_OK);
    assert_int_equal(iris_motion_calibrate(&fit, pairs, 1, &config, &scratch), IRIS_ERR_SCRATCH);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, sizeof memory.memory), IRIS_OK);
    assert_int_equal(iris_rotation_calibrate(NULL, turns, pairs, 1, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_rotation_calibrate(&fit, NULL, pairs, 1, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_rotation_calibrate(&fit, turns, NULL, 1, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, 1, &config, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_motion_calibrate(NULL, pairs, 1, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_motion_calibrate(&fit, NULL, 1, &config, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_motion_calibrate(&fit, pairs, 1, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_motion_calibrate(&fit, pairs, 1, &config, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, -1, &config, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(
        iris_rotation_calibrate(&fit, turns, pairs, IRIS_MOTION_PAIRS_MAX + 1, &config, &scratch),
        IRIS_ERR_RANGE);
    wrong.model = IRIS_MOTION_LEVER; /* of known motions alone */
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, 1, &wrong, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_motion_calibrate(&fit, pairs, 1, &wrong, &scratch),
                     IRIS_ERR_RANGE); /* no rotation */
    wrong = config;
    wrong.size.h = 0;
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, 1, &wrong, &scratch), IRIS_ERR_RANGE);
    matches[0][5].to.x = ((iris_q32)1 << 60) + 1;
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, 1, &config, &scratch), IRIS_ERR_RANGE);
    matches[0][5].to.x = 0;
    pairs[0].matches = NULL;
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, 1, &config, &scratch), IRIS_ERR_ARG);
    pairs[0].matches = matches[0];
    assert_int_equal(iris_rotation_calibrate(&fit, turns, pairs, 1, NULL, &scratch),
                     IRIS_ERR_DATA); /* one is off */
}

/* Any numbers: the sanitizers look on. */
static void any_numbers(void **state)
{
    (void)state;
    static IRIS_SCRATCH_BUFFER(memory, IRIS_ROTATION_SCRATCH_BYTES(PAIRS));
    iris_motion_config config = {.size = {0, 0}};
    iris_motion_fit fit;
    iris_translation_fit focus;
    iris_motion_turn turns[PAIRS];
    iris_scratch scratch;
    for (int i = 0; i < 40; i++) {
        const int bits = (int)(random_u64() % 4);
        for (int v = 0; v < 2; v++) {
            for (int k = 0; k < 12; k++) {
                iris_q32 n[4];
                for (int j = 0; j < 4; j++) {
                    n[j] = bits == 0   ? any_q32() >> 4
                           : bits == 1 ? any_q32() >> 24
                                       : random_q32(320 * IRIS_Q32_ONE);
                }
                matches[v][k] = (iris_match){{n[0], n[1]}, {n[2], n[3]}};
            }
            pairs[v].matches = matches[v];
            pairs[v].count = 12;
            random_rotation(&pairs[v].turn);
            pairs[v].shift = (iris_vec3){any_q32() >> 4, any_q32() >> 4, any_q32() >> 4};
        }
        config.model = (uint32_t)(i & 7);
        assert_int_equal(iris_scratch_init(&scratch, memory.memory, sizeof memory.memory), IRIS_OK);
        (void)iris_rotation_calibrate(&fit, turns, pairs, 2, &config, &scratch);
        config.model = (uint32_t)(i & 15);
        random_rotation(&config.mount.turn);
        config.mount.place = (iris_vec3){any_q32() >> 4, any_q32() >> 4, any_q32() >> 4};
        (void)iris_motion_calibrate(&fit, pairs, 2, &config, &scratch);
        (void)iris_translation_focus(&focus, matches[0], 12, config.size);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_turns),
        cmocka_unit_test(one_turn_with_noise),
        cmocka_unit_test(turns_that_say_nothing),
        cmocka_unit_test(focus_of_a_translation),
        cmocka_unit_test(translations_that_say_nothing),
        cmocka_unit_test(a_robot_that_drives),
        cmocka_unit_test(motions_that_say_nothing),
        cmocka_unit_test(refusals),
        cmocka_unit_test(any_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
