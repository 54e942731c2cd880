#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "calibrate_json.h"
#include "commands.h"
#include "complain.h"
#include "file_write.h"
#include "frame_reader.h"
#include "iris/3d/stereo.h"
#include "json.h"
#include "one_line.h"
#include "picture_write.h"
#include "rectified_pair.h"
#include "stereo_space.h"
#include "system.h"

static const char help[] =
    "usage: iris stereo LEFT RIGHT [--method block|quadtree|semiglobal] [--max-disparity N]\n"
    "                   [--no-fill] [--unique PERCENT] [--speckle AREA]\n"
    "                   [--scale N] [--of left|right] [--planes]\n"
    "                   [-o DISPARITY] [--preview PICTURE] [--json]\n"
    "                   [--calib PAIR [--depth DEPTH] [--depth-scale N] [--points CLOUD.ply]]\n\n"
    "How far things are, from the rectified pictures of two cameras side by side: by how many pixels\n"
    "each place of the left picture lies further to the left in the right one. Color becomes gray.\n"
    "With --calib the pictures are rectified first, as iris rectify does it, and distances are real ones.\n\n"
    "  --method block|quadtree|semiglobal\n"
    "                       block: fixed windows of 13x13 pixels; quadtree: windows as large as the\n"
    "                       picture is even, in less time; semiglobal (the default):\n"
    "                       smooth surfaces with sharp edges, in about twice the time\n"
    "  --max-disparity N    of the nearest things, in pixels, 1 to 255 (default 63)\n"
    "  --no-fill            block, semiglobal: what one camera alone sees, and what is doubtful, stays 0;\n"
    "                       else it takes the disparity of what is beside it, the farther one\n"
    "  --unique PERCENT     block, semiglobal: doubtful is, too, where the second best match is not worse "
    "by\n"
    "                       so many percent; 0 to 99 (default 0)\n"
    "  --speckle AREA       block, semiglobal: pieces of fewer pixels, which differ from what is around by\n"
    "                       more than one pixel, become 0 (default 0: none)\n"
    "  --scale N            quadtree: 1 (the default), 2, 4, 8, or 16: disparities of every Nth pixel of\n"
    "                       every Nth row, from pictures of that size: the larger, the quicker;\n"
    "                       they are those of the whole picture, in its pixels\n"
    "  --of left|right      quadtree: whose places the disparities are of (default left)\n"
    "  --planes             quadtree: surfaces that recede become planes, where one disparity for each "
    "window\n"
    "                       explains them worse: finer, in half as much time again\n"
    "  -o DISPARITY         a PGM of 16 bits: 256 for a pixel, 0 where there is no match; -: to standard\n"
    "                       output, and nothing else\n"
    "  --preview PICTURE    the same in colors, from blue (far) to red (--max-disparity); black: no match\n"
    "  --json               one JSON object\n"
    "  --calib PAIR         the two cameras: a file of iris calibrate pair\n"
    "  --depth DEPTH        a PGM of 16 bits: how far each place is before the left camera, in the unit of\n"
    "                       the board that the pair was calibrated with (millimeters by --square 25mm); 0:\n"
    "                       nobody knows, or more than 65535. Places that are filled are not known\n"
    "                       (quadtree does not tell them)\n"
    "  --depth-scale N      of --depth: N to a unit instead of one: 1000 for a board in meters; 1 to 65535\n"
    "  --points CLOUD.ply   the same places as points, in the unit, with gray levels: x right, y down, z "
    "forward\n"
    "                       of the left camera as it stands\n\n"
    "JSON has matched (the share of places that have a disparity), and the mean of these, least, and most\n"
    "disparities in pixels (null when there is none); with --calib also baseline, focal (pixels), u0 and v0\n"
    "of the rectified pictures, and nearest and farthest, depths in the unit.\n\n"
    "example: iris stereo left.pgm right.pgm --max-disparity 63 -o disparity.pgm --preview seen.bmp\n"
    "         iris stereo left.pgm right.pgm --calib rig.pair --depth depth.pgm --points cloud.ply\n";

typedef struct {
    const char *left, *right, *method, *output, *preview, *of, *calib, *depth, *points;
    int32_t max_disparity, scale, depth_scale, unique, speckle;
    int json, planes, no_fill;
} wishes;

typedef struct {
    int64_t matched, sum;
    int32_t least, most; /* 256ths of a pixel */
} summary;

/* --- methods --- */

typedef struct {
    const char *name;
    size_t (*bytes)(const wishes *w, iris_size size);
    iris_status (*match)(const wishes *w, const iris_image *disparity, const iris_image *left,
                         const iris_image *right, iris_scratch *scratch);
} stereo_method;

static void set_common(iris_stereo_config *config, const wishes *w)
{
    config->max_disparity = w->max_disparity;
    config->uniqueness_percent = w->unique;
    config->fill = !w->no_fill;
}

static size_t block_bytes(const wishes *w, iris_size size)
{
    return IRIS_STEREO_BLOCK_SCRATCH_BYTES(size.w, w->max_disparity);
}

static iris_status block(const wishes *w, const iris_image *disparity, const iris_image *left,
                         const iris_image *right, iris_scratch *scratch)
{
    iris_stereo_block_config config;
    iris_stereo_block_defaults(&config);
    set_common(&config.stereo, w);
    return iris_stereo_block(disparity, left, right, &config, scratch);
}

static size_t semiglobal_bytes(const wishes *w, iris_size size)
{
    return IRIS_STEREO_SEMIGLOBAL_SCRATCH_BYTES(size.w, w->max_disparity);
}

static iris_status semiglobal(const wishes *w, const iris_image *disparity, const iris_image *left,
                              const iris_image *right, iris_scratch *scratch)
{
    iris_stereo_semiglobal_config config;
    iris_stereo_semiglobal_defaults(&config);
    set_common(&config.stereo, w);
    return iris_stereo_semiglobal(disparity, left, right, &config, scratch);
}

/* The level of the pyramid that has 1/scale of the size. */
static int32_t level_of(int32_t scale)
{
    int32_t level = 0;
    while (level < IRIS_STEREO_LEVELS_MAX - 1 && 1 << level < scale) {
        level++;
    }
    return level;
}

static iris_stereo_quadtree_config quadtree_config(const wishes *w)
{
    iris_stereo_quadtree_config config;
    iris_stereo_quadtree_defaults(&config);
    config.max_disparity = w->max_disparity;
    config.divided = w->of && strcmp(w->of, "right") == 0 ? IRIS_STEREO_RIGHT : IRIS_STEREO_LEFT;
    config.planes = w->planes;
    if (config.levels <= level_of(w->scale)) {
        config.levels = level_of(w->scale) + 1;
    }
    return config;
}

static size_t quadtree_bytes(const wishes *w, iris_size size)
{
    iris_stereo_quadtree_config config = quadtree_config(w);
    return IRIS_STEREO_QUADTREE_SCRATCH_BYTES(size.w, size.h, w->max_disparity, config.levels) +
           (config.divided == IRIS_STEREO_RIGHT ? IRIS_STEREO_MIRROR_BYTES(size.w, size.h) : 0);
}

static iris_status quadtree(const wishes *w, const iris_image *disparity, const iris_image *left,
                            const iris_image *right, iris_scratch *scratch)
{
    iris_stereo_quadtree_config config = quadtree_config(w);
    iris_image maps[IRIS_STEREO_LEVELS_MAX] = {{0}};
    maps[level_of(w->scale)] = *disparity;
    return iris_stereo_quadtree_maps(maps, level_of(w->scale) + 1, left, right, &config, scratch);
}

static const stereo_method methods[] = {{"block", block_bytes, block},
                                        {"quadtree", quadtree_bytes, quadtree},
                                        {"semiglobal", semiglobal_bytes, semiglobal}};
#define METHODS      (sizeof methods / sizeof methods[0])
#define METHOD_NAMES "block, quadtree, or semiglobal"

static const stereo_method *method_of(const char *name)
{
    for (size_t i = 0; i < METHODS; i++) {
        if (strcmp(methods[i].name, name) == 0) {
            return &methods[i];
        }
    }
    complain("--method", METHOD_NAMES ", not '%s'", name);
    return NULL;
}

/* --- what is written --- */

static int write_disparity(FILE *file, const void *user)
{
    iris_sink sink = {file_write_bytes, file};
    return iris_pnm_write(sink, user) == IRIS_OK && fflush(file) == 0;
}

static summary summarize(const iris_image *disparity)
{
    summary s = {0, 0, 65536, 0};
    for (int32_t y = 0; y < disparity->h; y++) {
        const uint16_t *row = iris_image_row(disparity, y);
        for (int32_t x = 0; x < disparity->w; x++) {
            s.matched += row[x] != 0;
            s.sum += row[x];
            s.least = row[x] != 0 && row[x] < s.least ? row[x] : s.least;
            s.most = row[x] > s.most ? row[x] : s.most;
        }
    }
    return s;
}

/* How much of a color there is at a place (0 to 1023) of the rainbow: 255 within 128 around its center. */
static uint8_t shade(int32_t place, int32_t center)
{
    int32_t apart = abs(place - center), level = 383 - apart;
    return (uint8_t)(level < 0 ? 0 : level > 255 ? 255 : level);
}

/* Blue, cyan, green, yellow, red: from 0 to `most`, pixels. */
static int show(const char *path, const iris_image *disparity, int32_t most)
{
    picture_buffer picture = {0};
    iris_size size = {disparity->w, disparity->h};
    iris_status status = picture_reserve(&picture, size, IRIS_RGB888);
    if (status != IRIS_OK) {
        complain(path, "%s", picture_problem(status, size));
        return 0;
    }
    for (int32_t y = 0; y < size.h; y++) {
        const uint16_t *row = iris_image_row(disparity, y);
        uint8_t *to = iris_image_row(&picture.image, y);
        for (int32_t x = 0; x < size.w; x++, to += 3) {
            const int32_t part = row[x] * 4 / most, place = part < 1023 ? part : 1023; /* of 256ths */
            to[0] = row[x] ? shade(place, 896) : 0;
            to[1] = row[x] ? shade(place, 512) : 0;
            to[2] = row[x] ? shade(place, 128) : 0;
        }
    }
    int written = picture_write(path, &picture.image);
    picture_free(&picture);
    return written;
}

/* What the calibration adds; space null: nothing. */
static void print_space(json_writer *json, const stereo_space *space)
{
    double range[2];
    int known = space && stereo_depth_range(range, space);
    static const char *const keys[2] = {"nearest", "farthest"};
    if (space) {
        calibrate_number(json, "baseline", space->rectified->baseline);
        calibrate_number(json, "focal", space->rectified->focal);
        calibrate_number(json, "u0", space->rectified->views[0].intrinsics.u0);
        calibrate_number(json, "v0", space->rectified->views[0].intrinsics.v0);
    }
    for (int i = 0; i < 2 && space; i++) {
        json_key(json, keys[i]);
        if (known) {
            json_number(json, range[i], 6);
        } else {
            json_null(json);
        }
    }
}

static void print(const wishes *w, const iris_image *disparity, const summary *s, const stereo_space *space)
{
    double range[2];
    double pixels = (double)disparity->w * disparity->h, count = (double)s->matched;
    if (!w->json) {
        one_line(stdout, w->left);
        printf(": %.1f %% matched", 100 * count / pixels);
        if (s->matched > 0) {
            printf(", disparities %.2f to %.2f, mean %.2f", s->least / 256.0, s->most / 256.0,
                   (double)s->sum / 256 / count);
        }
        if (space && stereo_depth_range(range, space)) {
            printf(", depths %.6g to %.6g", range[0], range[1]);
        }
        if (space && space->beyond > 0) {
            printf(", %d beyond 65535 left out", (int)space->beyond);
        }
        putchar('\n');
        return;
    }
    const struct {
        const char *key;
        double value;
    } numbers[] = {
        {"mean", (double)s->sum / 256 / count}, {"least", s->least / 256.0}, {"most", s->most / 256.0}};
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "left");
    json_string(&json, w->left);
    json_key(&json, "right");
    json_string(&json, w->right);
    json_key(&json, "output");
    json_string(&json, w->output);
    json_key(&json, "method");
    json_string(&json, w->method);
    json_key(&json, "width");
    json_integer(&json, disparity->w);
    json_key(&json, "height");
    json_integer(&json, disparity->h);
    json_key(&json, "matched");
    json_number(&json, count / pixels, 4);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        json_key(&json, numbers[i].key);
        if (s->matched > 0) {
            json_number(&json, numbers[i].value, 3);
        } else {
            json_null(&json);
        }
    }
    print_space(&json, space);
    json_close(&json, '}');
}

/* --- from files to files --- */

static int read_picture(picture_buffer *picture, const char *path)
{
    static frame_reader reader;
    iris_status status = frame_reader_open(&reader, path);
    status = status == IRIS_OK ? frame_reader_next(&reader, picture, IRIS_GRAY8) : status;
    frame_reader_close(&reader);
    if (status != IRIS_OK) {
        complain(path, "%s", frame_reader_problem(&reader));
    }
    return status == IRIS_OK;
}

static int is_output(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

/* What is known of the places: disparities, and the same without those that are filled. */
typedef struct {
    const iris_image *disparity, *sure;
} matched;

/* Writes and prints what was found. made null: without --calib. */
static int tell(const wishes *w, const matched *found, const iris_image *left, const iris_rectified *made)
{
    summary s = summarize(found->disparity);
    stereo_space space = {made, found->sure, left, w->depth_scale, 0};
    if ((w->output && !file_write(w->output, write_disparity, found->disparity)) ||
        (w->preview && !show(w->preview, found->disparity, w->max_disparity)) ||
        (w->depth && !stereo_depth_write(w->depth, &space)) ||
        (w->points && !stereo_points_write(w->points, &space))) {
        return EXIT_BAD_DATA;
    }
    if (!is_output(w->output) && !is_output(w->depth) && !is_output(w->points)) {
        print(w, found->disparity, &s, made ? &space : NULL);
    }
    return EXIT_DONE;
}

static iris_status take_specks(const wishes *w, const iris_image *disparity)
{
    const size_t bytes = IRIS_STEREO_SPECKLE_SCRATCH_BYTES(disparity->w, disparity->h);
    void *memory = system_scratch(bytes);
    iris_scratch scratch;
    iris_status status = memory ? iris_scratch_init(&scratch, memory, bytes) : IRIS_ERR_SCRATCH;
    status = status == IRIS_OK ? iris_stereo_speckle(disparity, w->speckle, 256, &scratch) : status;
    free(memory);
    return status;
}

static int find(picture_buffer *disparity, const wishes *w, const stereo_method *method,
                const iris_image *left, const iris_image *right)
{
    iris_scratch scratch;
    const iris_size size = {left->w, left->h};
    const iris_size smaller = {(size.w + w->scale - 1) / w->scale, (size.h + w->scale - 1) / w->scale};
    const size_t bytes = method->bytes(w, size);
    iris_status status = picture_reserve(disparity, smaller, IRIS_GRAY_U16);
    void *memory = status == IRIS_OK ? system_scratch(bytes) : NULL;
    if (!memory) {
        complain(w->left, "%s", picture_problem(status == IRIS_OK ? IRIS_ERR_SCRATCH : status, size));
        return 0;
    }
    iris_scratch_init(&scratch, memory, bytes);
    status = method->match(w, &disparity->image, left, right, &scratch);
    free(memory);
    status = status == IRIS_OK && w->speckle > 0 ? take_specks(w, &disparity->image) : status;
    if (status != IRIS_OK) {
        complain(w->left, "%s", iris_status_text(status));
    }
    return status == IRIS_OK;
}

/* Depths are of places that are not filled: where the map is to be filled, these are found once more. */
static int match(const wishes *w, const stereo_method *method, const iris_image *left,
                 const iris_image *right, const iris_rectified *made)
{
    picture_buffer pictures[2];
    wishes sure = *w;
    const int both = !w->no_fill && (w->depth || w->points) && strcmp(w->method, "quadtree") != 0;
    memset(pictures, 0, sizeof pictures);
    if (right->w != left->w || right->h != left->h) {
        complain(w->right, "%dx%d pixels, but the left picture has %dx%d: both must have one size",
                 (int)right->w, (int)right->h, (int)left->w, (int)left->h);
        return EXIT_BAD_DATA;
    }
    sure.no_fill |= both;
    int exit_code = EXIT_BAD_DATA;
    if (find(&pictures[0], &sure, method, left, right) &&
        (!both || !(w->output || w->preview) || find(&pictures[1], w, method, left, right))) {
        const iris_image *second = pictures[1].image.data ? &pictures[1].image : &pictures[0].image;
        const matched found = {second, &pictures[0].image};
        exit_code = tell(w, &found, left, made);
    }
    picture_free(&pictures[0]);
    picture_free(&pictures[1]);
    return exit_code;
}

static int run(const wishes *w, const stereo_method *method)
{
    const char *const names[2] = {w->left, w->right};
    picture_buffer pictures[2];
    iris_rectified made;
    int exit_code = EXIT_BAD_DATA;
    memset(pictures, 0, sizeof pictures);
    if (read_picture(&pictures[0], w->left) && read_picture(&pictures[1], w->right)) {
        exit_code =
            w->calib ? rectified_pair_make(&made, pictures, names, w->calib, IRIS_RECTIFY_VALID) : EXIT_DONE;
    }
    if (exit_code == EXIT_DONE) {
        exit_code = match(w, method, &pictures[0].image, &pictures[1].image, w->calib ? &made : NULL);
    }
    picture_free(&pictures[0]);
    picture_free(&pictures[1]);
    return exit_code;
}

/* Is the call one that can be carried out? */
static int check_windows(const wishes *w)
{
    int quadtree_only = w->scale != 1 || w->of || w->planes;
    if (quadtree_only && strcmp(w->method, "quadtree") != 0) {
        complain(NULL, "--scale, --of, and --planes are for --method quadtree");
        return 0;
    }
    if ((w->no_fill || w->unique > 0 || w->speckle > 0) && strcmp(w->method, "quadtree") == 0) {
        complain(NULL, "--no-fill, --unique, and --speckle are for --method block and semiglobal");
        return 0;
    }
    if (1 << level_of(w->scale) != w->scale) {
        complain("--scale", "1, 2, 4, 8, or 16, not %d", (int)w->scale);
        return 0;
    }
    if (w->of && strcmp(w->of, "left") != 0 && strcmp(w->of, "right") != 0) {
        complain("--of", "left or right, not '%s'", w->of);
        return 0;
    }
    if (w->calib && (w->scale != 1 || w->of)) {
        complain("--calib", "depths are those of the whole left picture: no --scale, no --of");
        return 0;
    }
    return 1;
}

static int check_names(const wishes *w, const char *depth_scale)
{
    const char *const names[] = {w->output, w->preview, w->depth, w->points};
    if (depth_scale && !w->depth) {
        complain("--depth-scale", "is of --depth, which is missing");
        return 0;
    }
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < i; k++) {
            if (names[i] && names[k] && !is_output(names[i]) && strcmp(names[i], names[k]) == 0) {
                complain(names[i], "is named for two outputs: give each a name of its own");
                return 0;
            }
        }
    }
    return 1;
}

static int check_files(const wishes *w)
{
    picture_container output = w->output ? picture_container_of(w->output) : CONTAINER_PGM;
    if (w->output && strcmp(w->output, "-") != 0 && output != CONTAINER_PGM && output != CONTAINER_PNM) {
        complain(w->output, "disparities have 16 bits, which takes a .pgm (--preview writes colors)");
        return 0;
    }
    if (w->preview && picture_container_of(w->preview) == CONTAINER_UNKNOWN) {
        complain(w->preview, "expected is .bmp, .ppm, or .pgm");
        return 0;
    }
    if (w->depth && strcmp(w->depth, "-") != 0 && picture_container_of(w->depth) != CONTAINER_PGM &&
        picture_container_of(w->depth) != CONTAINER_PNM) {
        complain(w->depth, "depths have 16 bits, which takes a .pgm");
        return 0;
    }
    if ((w->depth || w->points) && !w->calib) {
        complain(w->depth ? "--depth" : "--points", "the cameras are needed, too: --calib PAIR");
        return 0;
    }
    if (is_output(w->output) + is_output(w->preview) + is_output(w->depth) + is_output(w->points) + w->json >
        1) {
        complain(NULL, "one of --json, -o -, --preview -, --depth -, and --points - only");
        return 0;
    }
    return 1;
}

int cmd_stereo(int argc, char **argv)
{
    wishes w = {.method = "semiglobal", .max_disparity = 63, .scale = 1, .depth_scale = 1};
    const char *most = NULL, *scale = NULL, *depth_scale = NULL, *unique = NULL, *speckle = NULL;
    const args_option options[] = {{"method", 0, NULL, &w.method},
                                   {"max-disparity", 0, NULL, &most},
                                   {"scale", 0, NULL, &scale},
                                   {"of", 0, NULL, &w.of},
                                   {"no-fill", 0, &w.no_fill, NULL},
                                   {"unique", 0, NULL, &unique},
                                   {"speckle", 0, NULL, &speckle},
                                   {"planes", 0, &w.planes, NULL},
                                   {"output", 'o', NULL, &w.output},
                                   {"preview", 0, NULL, &w.preview},
                                   {"calib", 0, NULL, &w.calib},
                                   {"depth", 0, NULL, &w.depth},
                                   {"depth-scale", 0, NULL, &depth_scale},
                                   {"points", 0, NULL, &w.points},
                                   {"json", 0, &w.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    const args_whole wholes[] = {{"--max-disparity", most, &w.max_disparity, 1, IRIS_STEREO_DISPARITY_MAX},
                                 {"--scale", scale, &w.scale, 1, 16},
                                 {"--unique", unique, &w.unique, 0, 99},
                                 {"--speckle", speckle, &w.speckle, 0, INT32_MAX},
                                 {"--depth-scale", depth_scale, &w.depth_scale, 1, 65535}};
    if (args.operand_count != 2) {
        complain(NULL, "two pictures are expected: LEFT RIGHT (see --help)");
        return EXIT_BAD_CALL;
    }
    w.left = args.operands[0];
    w.right = args.operands[1];
    const stereo_method *method = method_of(w.method);
    if (!method || !args_wholes(wholes, 5) || !check_windows(&w) || !check_files(&w) ||
        !check_names(&w, depth_scale)) {
        return EXIT_BAD_CALL;
    }
    return run(&w, method);
}
