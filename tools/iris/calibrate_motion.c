/* iris calibrate rotation, translation, and motion. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "calibrate.h"
#include "calibrate_json.h"
#include "complain.h"
#include "file_write.h"
#include "iris/3d/calib_motion.h"
#include "iris/3d/camera_text.h"
#include "mounting_option.h"
#include "number_file.h"
#include "one_line.h"

#define SHARED_HELP                                                                                          \
    "  MATCHES          a text per pair of pictures, a line per thing that both show: x y X Y, where the\n"  \
    "                   first one shows it and where the second one does, pixels. Blanks, tabs, commas,\n"   \
    "                   or semicolons stand between numbers; what stands behind a # does not count\n"        \
    "  --image-size WxH of the pictures: their middle is the principal point, if that is not looked for\n"   \
    "  --json           one JSON object\n"

#define CAMERA_HELP "  -o CAMERA        writes a camera file; --image-size is needed with it\n"

static const char rotation_help[] =
    "usage: iris calibrate rotation [--model TERMS] [--image-size WxH] [--json] MATCHES... [-o CAMERA]\n\n"
    "From pictures of a camera that only turns, about its lens, by unknown angles, to the camera and\n"
    "these angles. Nothing of the scene has to be known. Turns of 10 degrees and more, about both axes,\n"
    "are good; a turn about the optical axis tells nothing of the focal length. A lens that bends is\n"
    "to be corrected before (iris undistort).\n\n" SHARED_HELP
    "  --model TERMS    what is looked for beside one focal length: any of center, aspect, and skew, with\n"
    "                   commas between, or none. Default: none with one pair, else center\n" CAMERA_HELP
    "\nJSON has fx, fy, skew, u0, v0, rms_px, deviations (null: not looked for), and pairs: file, rms_px,\n"
    "turn (a vector in radians, from the first picture to the second).\n\n"
    "example: iris calibrate rotation --image-size 640x480 left.txt right.txt up.txt -o pan.camera\n";

static const char translation_help[] =
    "usage: iris calibrate translation [--image-size WxH] [--json] MATCHES...\n\n"
    "From two pictures of a camera that moves without turning to where it moves: the point of the picture\n"
    "from which everything comes (the focus of expansion), or to which everything goes. Of the camera\n"
    "itself that says nothing; with known directions iris calibrate motion does.\n\n" SHARED_HELP
    "\nJSON has pairs: file, x, y (null where it is nowhere), moves (\"to\" it, or \"from\" it),\n"
    "deviation_x, deviation_y, rms_px, focus (the same point, of three numbers).\n\n"
    "example: iris calibrate translation --image-size 640x480 forward.txt\n";

static const char motion_help[] =
    "usage: iris calibrate motion --height MM --tilt DEG [--pan DEG] [--roll DEG] [--ahead MM] [--right MM]\n"
    "                             [--model TERMS] [--image-size WxH] [--json] MOTIONS MATCHES...\n"
    "                             [-o CAMERA]\n\n"
    "From what a camera on a robot sees while that moves in a known way to the camera and how it is\n"
    "mounted. Nothing of the scene has to be known; turns and drives are needed both.\n\n"
    "  MOTIONS          a line for each of the MATCHES, in this order: RX RY RZ X Y Z, how the robot moved\n"
    "                   in its own frame: its turn about x (right), y (ahead), and z (up; positive: to\n"
    "                   the left), degrees; and where it is then, in millimeters\n"
    "  --height MM, --tilt DEG, --pan DEG, --roll DEG, --ahead MM, --right MM\n"
    "                   how it is mounted, angles within 20 degrees: as for iris floor\n" SHARED_HELP
    "  --model TERMS    what is looked for beside one focal length and the mount's angles: any of center,\n"
    "                   aspect, skew, and lever (where the camera is on the robot, but for its height if\n"
    "                   the robot stays on the floor), or none. Default: center\n" CAMERA_HELP
    "\nJSON has fx, fy, skew, u0, v0, rms_px, deviations, and mount: tilt, pan, roll (degrees), right,\n"
    "ahead, height (millimeters), and turn_deviation (degrees about the camera's axes).\n\n"
    "example: iris calibrate motion --height 200 --tilt 25 --image-size 640x480 moves.txt pair?.txt\n";

typedef struct {
    char **files;
    iris_motion_pair pairs[IRIS_MOTION_PAIRS_MAX];
    iris_motion_turn turns[IRIS_MOTION_PAIRS_MAX];
    int32_t count;
    int known; /* motions are */
    iris_motion_config config;
    iris_motion_fit fit;
} session;

typedef struct {
    const char *model, *size, *output;
    int json;
} texts;

static const struct {
    const char *name;
    uint32_t bit;
} terms[] = {{"center", IRIS_MOTION_CENTER},
             {"aspect", IRIS_MOTION_ASPECT},
             {"skew", IRIS_MOTION_SHEAR},
             {"lever", IRIS_MOTION_LEVER}};

/* The first `known` of the terms. */
static int read_model(uint32_t *model, const char *text, size_t known)
{
    *model = 0;
    if (strcmp(text, "none") == 0) {
        return 1;
    }
    for (const char *at = text;; at++) {
        const size_t length = strcspn(at, ",");
        size_t k = 0;
        while (k < known && (strlen(terms[k].name) != length || strncmp(terms[k].name, at, length) != 0)) {
            k++;
        }
        if (k == known) {
            complain("--model", "any of center, aspect, skew%s with commas between, or none, not '%s'",
                     known > 3 ? ", lever" : "", text);
            return 0;
        }
        *model |= terms[k].bit;
        at += length;
        if (!*at) {
            return 1;
        }
    }
}

static int read_size(iris_size *size, const char *text)
{
    int32_t sides[2];
    if (!text) {
        return 1;
    }
    if (!args_numbers(sides, 2, 'x', text) || sides[0] < 1 || sides[0] > IRIS_SIDE_MAX || sides[1] < 1 ||
        sides[1] > IRIS_SIDE_MAX) {
        complain("--image-size", "WxH in pixels, not '%s'", text);
        return 0;
    }
    *size = (iris_size){sides[0], sides[1]};
    return 1;
}

static int read_pairs(session *s)
{
    static iris_q32 numbers[4 * IRIS_MOTION_MATCHES_MAX];
    for (int32_t v = 0; v < s->count; v++) {
        number_table table = {numbers, NULL, 0, IRIS_MOTION_MATCHES_MAX, 4};
        if (!number_file_read(&table, s->files[v])) {
            return 0;
        }
        iris_match *matches = malloc((size_t)(table.rows + 1) * sizeof *matches); /* until the program ends */
        if (!matches) {
            complain(s->files[v], "not enough memory");
            return 0;
        }
        for (int i = 0; i < table.rows; i++) {
            const iris_q32 *n = numbers + 4 * i;
            matches[i] = (iris_match){{n[0], n[1]}, {n[2], n[3]}};
        }
        s->pairs[v].matches = matches;
        s->pairs[v].count = table.rows;
    }
    return 1;
}

static void complain_flaw(const session *s)
{
    static const char *const said[] = {
        [IRIS_MOTION_FINE] = "",
        [IRIS_MOTION_TOO_FEW] = "too few matches: four of each pair at least, and more for more parameters",
        [IRIS_MOTION_IN_LINE] =
            "the matches are on one line, or at fewer than four places: add some beside it",
        [IRIS_MOTION_STILL] = "the camera hardly moves: turn or move it more",
        [IRIS_MOTION_ROLLS] =
            "the camera turns about its optical axis alone, which tells nothing of its focal length",
        [IRIS_MOTION_UNDETERMINED] =
            "these motions leave open what is looked for: move about other axes, or look for less (--model)",
        [IRIS_MOTION_OTHER] = "no such motion: matches may be wrong, or the camera moves otherwise"};
    complain(s->fit.flawed >= 0 ? s->files[s->fit.flawed] : NULL, "%s", said[s->fit.flaw]);
}

static void print_numbers_json(json_writer *json, const session *s)
{
    const iris_intrinsics *k = &s->fit.intrinsics;
    static const char *const names[] = {"fx", "fy", "skew", "u0", "v0"};
    const iris_q32 values[] = {k->alpha_u, k->alpha_v, k->shear, k->u0, k->v0};
    for (int i = 0; i < IRIS_MOTION_INTRINSICS; i++) {
        calibrate_number(json, names[i], values[i]);
    }
    calibrate_number(json, "rms_px", s->fit.rms);
    json_key(json, "deviations");
    json_open(json, '{');
    for (int i = 0; i < IRIS_MOTION_INTRINSICS; i++) {
        json_key(json, names[i]);
        if (s->fit.deviations[i] == 0) {
            json_null(json);
        } else {
            json_number(json, calibrate_real(s->fit.deviations[i]), 9);
        }
    }
    json_close(json, '}');
}

static double degrees(iris_q32 radians)
{
    return calibrate_real(radians) * 57.29577951308232;
}

/* The angles of a mount, as iris_mounting has them. */
static void angles_of(double angles[3], const iris_mat3 *turn)
{
    const iris_q32 *m = turn->m;
    angles[0] =
        atan2(calibrate_real(-m[8]), hypot(calibrate_real(m[6]), calibrate_real(m[7]))) * 57.29577951308232;
    angles[1] = atan2(calibrate_real(m[6]), calibrate_real(m[7])) * 57.29577951308232;
    angles[2] = atan2(calibrate_real(-m[2]), calibrate_real(-m[5])) * 57.29577951308232;
}

static void print_mount_json(json_writer *json, const session *s)
{
    static const char *const names[] = {"tilt", "pan", "roll"};
    const iris_vec3 *d = &s->fit.mount_deviation;
    double angles[3];
    angles_of(angles, &s->fit.mount.turn);
    json_key(json, "mount");
    json_open(json, '{');
    for (int i = 0; i < 3; i++) {
        json_key(json, names[i]);
        json_number(json, angles[i], 6);
    }
    calibrate_number(json, "right", s->fit.mount.place.x);
    calibrate_number(json, "ahead", s->fit.mount.place.y);
    calibrate_number(json, "height", s->fit.mount.place.z);
    json_key(json, "turn_deviation");
    json_open(json, '[');
    json_number(json, degrees(d->x), 6);
    json_number(json, degrees(d->y), 6);
    json_number(json, degrees(d->z), 6);
    json_close(json, ']');
    json_close(json, '}');
}

static void print_json(const session *s)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    print_numbers_json(&json, s);
    if (s->known) {
        print_mount_json(&json, s);
    } else {
        json_key(&json, "pairs");
        json_open(&json, '[');
        for (int32_t v = 0; v < s->count; v++) {
            const iris_vec3 turn = iris_rotation_to_vector(&s->turns[v].turn);
            json_open(&json, '{');
            json_key(&json, "file");
            json_string(&json, s->files[v]);
            calibrate_number(&json, "rms_px", s->turns[v].rms);
            calibrate_numbers(&json, "turn", (const iris_q32[3]){turn.x, turn.y, turn.z}, 1, 3);
            json_close(&json, '}');
        }
        json_close(&json, ']');
    }
    json_close(&json, '}');
}

static void print_text(const session *s)
{
    static const char *const names[] = {"fx", "fy", "skew", "u0", "v0"};
    const iris_intrinsics *k = &s->fit.intrinsics;
    const iris_q32 values[] = {k->alpha_u, k->alpha_v, k->shear, k->u0, k->v0};
    double angles[3];
    printf("%d pair%s, off by %.4f pixels (root mean square)\n", (int)s->count, s->count == 1 ? "" : "s",
           calibrate_real(s->fit.rms));
    for (int i = 0; i < IRIS_MOTION_INTRINSICS; i++) {
        printf("%-5s %12.6g", names[i], calibrate_real(values[i]));
        if (s->fit.deviations[i]) {
            printf("  +- %.2g\n", calibrate_real(s->fit.deviations[i]));
        } else {
            printf("  not looked for\n");
        }
    }
    for (int32_t v = 0; v < s->count && !s->known; v++) {
        const iris_vec3 turn = iris_rotation_to_vector(&s->turns[v].turn);
        one_line(stdout, s->files[v]);
        printf(": turned by %.3f degrees, off by %.4f pixels\n", degrees(iris_vec3_length(turn)),
               calibrate_real(s->turns[v].rms));
    }
    if (s->known) {
        angles_of(angles, &s->fit.mount.turn);
        printf("mounted with tilt %.3f, pan %.3f, roll %.3f degrees, %.4g mm to the right, %.4g ahead, %.4g "
               "up\n",
               angles[0], angles[1], angles[2], calibrate_real(s->fit.mount.place.x),
               calibrate_real(s->fit.mount.place.y), calibrate_real(s->fit.mount.place.z));
    }
}

static int write_camera(FILE *file, const void *user)
{
    const session *s = user;
    const iris_camera_model model = {s->config.size, s->fit.intrinsics, {.direction = IRIS_LENS_BENDS}};
    char text[IRIS_CAMERA_TEXT_BYTES];
    size_t length = 0;
    if (iris_camera_write_text(text, sizeof text, &length, &model) != IRIS_OK) {
        return 0;
    }
    fputs(text, file);
    fprintf(file, "\n# from motion: %d pairs, off by %.4f pixels (root mean square)\n", (int)s->count,
            calibrate_real(s->fit.rms));
    return !ferror(file) && fflush(file) == 0;
}

static int finish(const session *s, const texts *t, iris_status status)
{
    if (status != IRIS_OK) {
        complain_flaw(s);
        return EXIT_BAD_DATA;
    }
    if (t->output && !file_write(t->output, write_camera, s)) {
        return EXIT_BAD_DATA;
    }
    if (t->json) {
        print_json(s);
    } else if (!t->output || strcmp(t->output, "-") != 0) {
        print_text(s);
    }
    return EXIT_DONE;
}

static int check_call(session *s, const texts *t, const arguments *args, int before)
{
    s->files = args->operands + before;
    s->count = args->operand_count - before;
    if (s->count < 1 || s->count > IRIS_MOTION_PAIRS_MAX) {
        complain(NULL, "%s1 to %d texts of matches are needed (see --help)", before ? "MOTIONS and " : "",
                 IRIS_MOTION_PAIRS_MAX);
        return 0;
    }
    if (!read_size(&s->config.size, t->size)) {
        return 0;
    }
    if (t->output && !t->size) {
        complain("-o", "the size of the pictures is needed with it: --image-size WxH");
        return 0;
    }
    if (t->json && t->output && strcmp(t->output, "-") == 0) {
        complain("-o", "not to standard output together with --json");
        return 0;
    }
    return 1;
}

int calibrate_rotation(int argc, char **argv)
{
    static session s;
    static IRIS_SCRATCH_BUFFER(memory, IRIS_ROTATION_SCRATCH_BYTES(IRIS_MOTION_PAIRS_MAX));
    texts t = {NULL, NULL, NULL, 0};
    iris_scratch scratch;
    const args_option options[] = {{"model", 0, NULL, &t.model},
                                   {"image-size", 0, NULL, &t.size},
                                   {"json", 0, &t.json, NULL},
                                   {"output", 'o', NULL, &t.output}};
    arguments args = {rotation_help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (!check_call(&s, &t, &args, 0) || !read_model(&s.config.model,
                                                     t.model       ? t.model
                                                     : s.count > 1 ? "center"
                                                                   : "none",
                                                     3)) {
        return EXIT_BAD_CALL;
    }
    if (!read_pairs(&s)) {
        return EXIT_BAD_DATA;
    }
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    return finish(&s, &t, iris_rotation_calibrate(&s.fit, s.turns, s.pairs, s.count, &s.config, &scratch));
}

/* Turns and shifts of all pairs. */
static int read_motions(session *s, const char *path)
{
    static iris_q32 numbers[6 * IRIS_MOTION_PAIRS_MAX];
    number_table table = {numbers, NULL, 0, IRIS_MOTION_PAIRS_MAX, 6};
    if (!number_file_read(&table, path)) {
        return 0;
    }
    if (table.rows != s->count) {
        complain(path, "%d motions, but there are %d texts of matches", table.rows, (int)s->count);
        return 0;
    }
    for (int32_t v = 0; v < s->count; v++) {
        const iris_q32 *n = numbers + 6 * v;
        iris_q32 turn[3];
        for (int i = 0; i < 3; i++) {
            turn[i] = iris_q32_div_sat(iris_q32_mul_sat(n[i], IRIS_PI_Q32), 180 * IRIS_Q32_ONE);
        }
        iris_rotation_from_vector(&s->pairs[v].turn, (iris_vec3){turn[0], turn[1], turn[2]});
        s->pairs[v].shift = (iris_vec3){n[3], n[4], n[5]};
    }
    return 1;
}

int calibrate_motion(int argc, char **argv)
{
    static session s;
    static IRIS_SCRATCH_BUFFER(memory, IRIS_MOTION_SCRATCH_BYTES);
    texts t = {"center", NULL, NULL, 0};
    mounting_texts mount = {NULL};
    iris_mounting mounting;
    iris_scratch scratch;
    const args_option options[] = {MOUNTING_PLACE_OPTIONS(mount),
                                   {"model", 0, NULL, &t.model},
                                   {"image-size", 0, NULL, &t.size},
                                   {"json", 0, &t.json, NULL},
                                   {"output", 'o', NULL, &t.output}};
    arguments args = {motion_help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    mount.calib = ""; /* is what is looked for */
    s.known = 1;
    if (!check_call(&s, &t, &args, 1) || !read_model(&s.config.model, t.model, 4) ||
        !mounting_option_read(&mounting, &mount)) {
        return EXIT_BAD_CALL;
    }
    (void)iris_mounting_pose(&s.config.mount, &mounting);
    if (!read_motions(&s, args.operands[0]) || !read_pairs(&s)) {
        return EXIT_BAD_DATA;
    }
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    return finish(&s, &t, iris_motion_calibrate(&s.fit, s.pairs, s.count, &s.config, &scratch));
}

/* So far off that a picture has no such place: the camera moves along it. */
static int is_sideways(const iris_translation_fit *fit)
{
    const double most = 1e6, x = fabs(calibrate_real(fit->pixel.x)), y = fabs(calibrate_real(fit->pixel.y));
    return fit->focus.z == 0 || x > most || y > most;
}

/* Where to, in words. */
static void print_focus(const char *path, const iris_translation_fit *fit)
{
    one_line(stdout, path);
    if (is_sideways(fit)) {
        printf(": the camera moves sideways, along the picture: %.6f to the right, %.6f down, of 1 in all; "
               "off by %.4f "
               "pixels\n",
               calibrate_real(fit->focus.x), calibrate_real(fit->focus.y), calibrate_real(fit->rms));
        return;
    }
    printf(": the camera moves %s what is at %.2f %.2f (+- %.2g %.2g), off by %.4f pixels\n",
           fit->ahead ? "to" : "away from", calibrate_real(fit->pixel.x), calibrate_real(fit->pixel.y),
           calibrate_real(fit->deviation.x), calibrate_real(fit->deviation.y), calibrate_real(fit->rms));
}

static void print_focus_json(json_writer *json, const char *path, const iris_translation_fit *fit)
{
    json_open(json, '{');
    json_key(json, "file");
    json_string(json, path);
    if (is_sideways(fit)) {
        json_key(json, "x");
        json_null(json);
        json_key(json, "y");
        json_null(json);
    } else {
        calibrate_number(json, "x", fit->pixel.x);
        calibrate_number(json, "y", fit->pixel.y);
    }
    json_key(json, "moves");
    json_string(json, fit->ahead ? "to" : "from");
    calibrate_number(json, "deviation_x", fit->deviation.x);
    calibrate_number(json, "deviation_y", fit->deviation.y);
    calibrate_number(json, "rms_px", fit->rms);
    calibrate_numbers(json, "focus", (const iris_q32[3]){fit->focus.x, fit->focus.y, fit->focus.z}, 1, 3);
    json_close(json, '}');
}

int calibrate_translation(int argc, char **argv)
{
    static session s;
    static iris_translation_fit fits[IRIS_MOTION_PAIRS_MAX];
    texts t = {NULL, NULL, NULL, 0};
    const args_option options[] = {{"image-size", 0, NULL, &t.size}, {"json", 0, &t.json, NULL}};
    arguments args = {translation_help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (!check_call(&s, &t, &args, 0)) {
        return EXIT_BAD_CALL;
    }
    if (!read_pairs(&s)) {
        return EXIT_BAD_DATA;
    }
    for (int32_t v = 0; v < s.count; v++) {
        if (iris_translation_focus(&fits[v], s.pairs[v].matches, s.pairs[v].count, s.config.size) !=
            IRIS_OK) {
            s.fit.flaw = fits[v].flaw;
            s.fit.flawed = v;
            complain_flaw(&s);
            return EXIT_BAD_DATA;
        }
    }
    json_writer json = json_to(stdout);
    if (t.json) {
        json_open(&json, '{');
        json_key(&json, "pairs");
        json_open(&json, '[');
    }
    for (int32_t v = 0; v < s.count; v++) {
        if (t.json) {
            print_focus_json(&json, s.files[v], &fits[v]);
            continue;
        }
        print_focus(s.files[v], &fits[v]);
    }
    if (t.json) {
        json_close(&json, ']');
        json_close(&json, '}');
    }
    return EXIT_DONE;
}
