/* Cameras from their motion, with a scene that nobody has measured: simulated ones, whose matches have noise. */
#include <math.h>

#include "iris/3d/calib_motion.h"
#include "iris/3d/mounting.h"
#include "score.h"

#define PAIRS   6
#define MATCHES 60
#define RUNS    15
#define FOCAL   600.0
#define NOISE   0.3 /* pixels, in both pictures */

static uint64_t state = 2463534242u;
static iris_match matches[PAIRS][MATCHES];
static iris_motion_pair pairs[PAIRS];

static double uniform(double low, double high)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

static double noise(void)
{
    const double u = uniform(1e-12, 1), v = uniform(0, 6.283185307179586);
    return NOISE * sqrt(-2 * log(u)) * cos(v);
}

static double real(iris_q32 a)
{
    return (double)a / 4294967296.0;
}

static iris_q32 q32_of(double value)
{
    return (iris_q32)llround(value * 4294967296.0);
}

/* A turn about x, and then one about y or z, by degrees. */
static void turn_of(double m[9], double first, int second_axis, double second)
{
    const double a = first / 57.29577951308232, b = second / 57.29577951308232;
    const double x[9] = {1, 0, 0, 0, cos(a), -sin(a), 0, sin(a), cos(a)};
    const double y[9] = {cos(b), 0, sin(b), 0, 1, 0, -sin(b), 0, cos(b)};
    const double z[9] = {cos(b), -sin(b), 0, sin(b), cos(b), 0, 0, 0, 1};
    for (int i = 0; i < 9; i++) {
        m[i] = 0;
        for (int k = 0; k < 3; k++) {
            m[i] += (second_axis == 1 ? y : z)[i / 3 * 3 + k] * x[3 * k + i % 3];
        }
    }
}

/* m v, or with the transposed m. */
static void turned(double to[3], const double m[9], const double v[3], int transposed)
{
    for (int i = 0; i < 3; i++) {
        to[i] = 0;
        for (int k = 0; k < 3; k++) {
            to[i] += m[transposed ? 3 * k + i : 3 * i + k] * v[k];
        }
    }
}

/* The robot's motion, and how its camera is mounted: a point of the frame before, seen from after. */
typedef struct {
    double turn[9], shift[3], mount[9], place[3];
} motion;

static void move(double after[3], const motion *of, const double before[3])
{
    double robot[3], at[3];
    turned(robot, of->mount, before, 1);
    for (int i = 0; i < 3; i++) {
        robot[i] += of->place[i] - of->shift[i];
    }
    turned(at, of->turn, robot, 1);
    for (int i = 0; i < 3; i++) {
        at[i] -= of->place[i];
    }
    turned(after, of->mount, at, 0);
}

static void simulate(int v, const motion *of)
{
    for (int i = 0; i < MATCHES;) {
        const double u = uniform(0, 639), w = uniform(0, 479), z = uniform(300, 3000);
        const double before[3] = {z * (u - 319.5) / FOCAL, z * (w - 239.5) / FOCAL, z};
        double after[3];
        move(after, of, before);
        const double right = FOCAL * after[0] / after[2] + 319.5, down = FOCAL * after[1] / after[2] + 239.5;
        if (after[2] > 0 && right >= 0 && right <= 639 && down >= 0 && down <= 479) {
            matches[v][i++] = (iris_match){{q32_of(u + noise()), q32_of(w + noise())},
                                           {q32_of(right + noise()), q32_of(down + noise())}};
        }
    }
    pairs[v].matches = matches[v];
    pairs[v].count = MATCHES;
    for (int i = 0; i < 9; i++) {
        pairs[v].turn.m[i] = q32_of(of->turn[i]);
    }
    pairs[v].shift = (iris_vec3){q32_of(of->shift[0]), q32_of(of->shift[1]), q32_of(of->shift[2])};
}

static const motion resting = {
    {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

static void score_turns(score *s)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_ROTATION_SCRATCH_BYTES(PAIRS));
    static const double angles[PAIRS][2] = {{3, 18}, {-12, 5}, {10, 12}, {-9, -14}, {14, -4}, {2, -20}};
    const iris_motion_config plain = {.size = {640, 480}},
                             config = {.model = IRIS_MOTION_CENTER, .size = {640, 480}};
    double focal[2] = {0, 0}, center = 0;
    int good = 1;
    for (int run = 0; run < 2 * RUNS; run++) { /* one pair, and six */
        iris_motion_fit fit;
        iris_motion_turn turns[PAIRS];
        iris_scratch scratch;
        const int several = run % 2;
        for (int v = 0; v < (several ? PAIRS : 1); v++) {
            motion of = resting;
            turn_of(of.turn, several ? angles[v][0] : 1, 1, several ? angles[v][1] : 20);
            simulate(v, &of);
        }
        (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
        good &= iris_rotation_calibrate(&fit, turns, pairs, several ? PAIRS : 1, several ? &config : &plain,
                                        &scratch) == IRIS_OK;
        focal[several] += pow(real(fit.intrinsics.alpha_u) - FOCAL, 2) / RUNS;
        center += several
                      ? pow(hypot(real(fit.intrinsics.u0) - 319.5, real(fit.intrinsics.v0) - 239.5), 2) / RUNS
                      : 0;
    }
    score_row(s, "camera that turns by 20 degrees once, 60 matches, 0.3 px of noise: focal length of 600",
              "rms within 3 px", score_if(good && sqrt(focal[0]) <= 3), "%.2f px off (root mean square)",
              sqrt(focal[0]));
    score_row(s, "camera that turns six times: focal length, center", "rms within 2, 3 px",
              score_if(good && sqrt(focal[1]) <= 2 && sqrt(center) <= 3), "%.2f, %.2f px off", sqrt(focal[1]),
              sqrt(center));
}

static void score_focus(score *s)
{
    double sum = 0;
    int good = 1;
    for (int run = 0; run < RUNS; run++) {
        motion of = resting;
        iris_translation_fit fit;
        of.shift[0] = 20; /* in the camera's frame: the mount is none */
        of.shift[1] = -5;
        of.shift[2] = 150;
        simulate(0, &of);
        good &=
            iris_translation_focus(&fit, matches[0], MATCHES, (iris_size){640, 480}) == IRIS_OK && fit.ahead;
        sum += pow(hypot(real(fit.pixel.x) - 399.5, real(fit.pixel.y) - 219.5), 2) / RUNS;
    }
    score_row(s, "camera that moves 150 mm ahead: focus of expansion", "rms within 2 px",
              score_if(good && sqrt(sum) <= 2), "%.2f px off", sqrt(sum));
}

static void score_robot(score *s)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_MOTION_SCRATCH_BYTES);
    static const double drives[PAIRS][3] = {{0, 0, 150},    {15, 0, 0},   {-12, 10, 80},
                                            {20, -20, 120}, {0, 0, -120}, {-18, 15, 60}};
    static const double level[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0};
    const iris_mounting roughly = {
        .height = q32_of(200), .tilt = q32_of(0.26), .right = q32_of(30), .ahead = q32_of(90)};
    iris_motion_config config = {.size = {640, 480}};
    double focal = 0, off = 0, tilted[9], column[3];
    motion of = resting;
    int good = iris_mounting_pose(&config.mount, &roughly) == IRIS_OK;
    turn_of(tilted, 25, 2, 3);
    for (int k = 0; k < 3; k++) { /* tilt 25 degrees, and a roll of 3 */
        const double from[3] = {level[k], level[3 + k], level[6 + k]};
        turned(column, tilted, from, 0);
        for (int i = 0; i < 3; i++) {
            of.mount[3 * i + k] = column[i];
        }
    }
    of.place[0] = 30;
    of.place[1] = 90;
    of.place[2] = 200;
    for (int run = 0; run < RUNS; run++) {
        iris_motion_fit fit;
        iris_scratch scratch;
        for (int v = 0; v < PAIRS; v++) {
            turn_of(of.turn, 0, 2, drives[v][0]);
            of.shift[0] = drives[v][1];
            of.shift[1] = drives[v][2];
            simulate(v, &of);
        }
        (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
        good &= iris_motion_calibrate(&fit, pairs, PAIRS, &config, &scratch) == IRIS_OK;
        focal += pow(real(fit.intrinsics.alpha_u) - FOCAL, 2) / RUNS;
        for (int i = 0; i < 9; i++) {
            off = fmax(off, fabs(real(fit.mount.turn.m[i]) - of.mount[i]));
        }
    }
    score_row(s, "camera on a robot that drives and turns as it knows: focal length, mount",
              "rms within 2 px, 0.2 degrees", score_if(good && sqrt(focal) <= 2 && off <= 0.0035),
              "%.2f px, %.3f degrees off at most", sqrt(focal), off * 57.29577951308232);
}

void score_motion(score *s)
{
    score_turns(s);
    score_focus(s);
    score_robot(s);
}
