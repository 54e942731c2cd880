#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "carve_views.h"
#include "commands.h"
#include "complain.h"
#include "file_write.h"
#include "frame_reader.h"
#include "inputs.h"
#include "iris/3d/carve.h"
#include "iris/xt/threshold.h"
#include "json.h"
#include "number_file.h"
#include "one_line.h"
#include "progress.h"
#include "system.h"

static const char help[] =
    "usage: iris carve CAMERAS SILHOUETTE... --box X0,Y0,Z0,X1,Y1,Z1 [--voxels N] [-o MODEL.ply] [--json]\n\n"
    "The shape of a thing from its silhouettes (white: the thing), seen by cameras that are known: from a\n"
    "box of voxels all are taken away whose middles a silhouette does not have. What a picture does not\n"
    "show is kept.\n\n"
    "  CAMERAS        a text: how many there are; then for each a name, K (3 x 3), R (3 x 3), and t, row\n"
    "                 by row, with blanks between. K [R | t] leads to pixels of the silhouettes\n"
    "  SILHOUETTE...  pictures, or folders of them: by name, when one's name begins with a camera's name\n"
    "                 (without extension): view1_mask.bmp is of view1.png; else by order, one for each\n"
    "  --box X0,Y0,Z0,X1,Y1,Z1\n"
    "                 two corners of the box, in the cameras' unit\n"
    "  --voxels N     along the longest side of the box, 1 to 1024 (default 110); they are nearly cubes\n"
    "  -o MODEL.ply   the middles of the voxels at the surface, as a cloud of points; -: to standard\n"
    "                 output, and nothing else\n"
    "  --json         one JSON object\n\n"
    "JSON has counts (along x, y, z), views, matched (name or order), voxels (that are left), surface\n"
    "(how many of them), and box (least and most corner of what is left; null when nothing is).\n\n"
    "example: iris carve cameras.txt silhouettes/ --box -0.07,-0.02,-0.07,0.02,0.07,0.02 -o model.ply\n";

typedef struct {
    const char *cameras, *output;
    iris_vec3 corners[2];
    int32_t counts[3];
    int json;
} wishes;

/* --- the call --- */

static int read_box(iris_vec3 corners[2], const char *text)
{
    iris_q32 n[6] = {0};
    char copy[256], *rest = copy;
    int count = 0;
    if (text && strlen(text) < sizeof copy) {
        memcpy(copy, text, strlen(text) + 1);
        for (char *word = strtok_r(copy, ",", &rest); word; word = strtok_r(NULL, ",", &rest), count++) {
            if (count == 6 || !number_text_read(&n[count], word)) {
                count = 7;
                break;
            }
        }
    }
    if (count != 6 || n[3] <= n[0] || n[4] <= n[1] || n[5] <= n[2]) {
        complain("--box", "x0,y0,z0,x1,y1,z1 with the second corner above the first in each, not '%s'",
                 text ? text : "");
        return 0;
    }
    corners[0] = (iris_vec3){n[0], n[1], n[2]};
    corners[1] = (iris_vec3){n[3], n[4], n[5]};
    return 1;
}

/* Nearly cubes: `most` of them along the longest side. */
static void choose_counts(wishes *w, int32_t most)
{
    const iris_vec3 size = iris_vec3_sub(w->corners[1], w->corners[0]);
    const iris_q32 sides[3] = {size.x, size.y, size.z};
    iris_q32 longest = sides[0] > sides[1] ? sides[0] : sides[1];
    longest = sides[2] > longest ? sides[2] : longest;
    for (int i = 0; i < 3; i++) {
        const int64_t count = iris_wide_div_sat(iris_wide_mul(sides[i], most), longest);
        w->counts[i] = count < 1 ? 1 : (int32_t)count;
    }
}

/* --- carving --- */

static int carve_view_of(const iris_voxel_world *world, const carve_view *view)
{
    static frame_reader reader;
    picture_buffer picture = {0}, mask = {0};
    iris_scratch scratch;
    void *memory = NULL;
    int done = 0;
    iris_status status = frame_reader_open(&reader, view->silhouette);
    status = status == IRIS_OK ? frame_reader_next(&reader, &picture, IRIS_GRAY8) : status;
    frame_reader_close(&reader);
    if (status != IRIS_OK) {
        complain(view->silhouette, "%s", frame_reader_problem(&reader));
    } else {
        const iris_size size = {picture.image.w, picture.image.h};
        const size_t bytes = IRIS_CARVE_SCRATCH_BYTES(size.w, size.h);
        status = picture_reserve(&mask, size, IRIS_MASK1);
        memory = status == IRIS_OK ? system_scratch(bytes) : NULL;
        status = status == IRIS_OK && !memory ? IRIS_ERR_SCRATCH : status;
        if (status == IRIS_OK) {
            (void)iris_scratch_init(&scratch, memory, bytes);
            status = iris_threshold(&mask.image, &picture.image, 127, IRIS_SELECT_BRIGHT);
            status = status == IRIS_OK ? iris_carve_view(world, &mask.image, view->m, &scratch) : status;
        }
        done = status == IRIS_OK;
        if (!done) {
            complain(view->silhouette, "%s", picture_problem(status, size));
        }
    }
    free(memory);
    picture_free(&picture);
    picture_free(&mask);
    return done;
}

static int carve_all(const iris_voxel_world *world, const carve_views *views, int silhouettes)
{
    int done = 1, part = 0;
    for (int i = 0; i < views->count && done; i++) {
        if (views->views[i].silhouette) {
            progress_show("carve", ++part, silhouettes, views->views[i].silhouette);
            done = carve_view_of(world, &views->views[i]);
        }
    }
    progress_clear();
    return done;
}

/* --- what is told and written --- */

static ptrdiff_t write_bytes(void *user, const uint8_t *data, size_t bytes)
{
    size_t written = fwrite(data, 1, bytes, user);
    return written > 0 ? (ptrdiff_t)written : -1;
}

static int write_model(FILE *file, const void *user)
{
    return iris_carve_write_ply((iris_sink){write_bytes, file}, user) == IRIS_OK && fflush(file) == 0;
}

/* From the first to the last voxel along each axis; 0 when there is none. */
static int box_of(iris_voxel *first, iris_voxel *last, const iris_voxel_world *world)
{
    *first = (iris_voxel){INT32_MAX, INT32_MAX, INT32_MAX};
    *last = (iris_voxel){-1, -1, -1};
    for (int32_t z = 0; z < world->counts[2]; z++) {
        for (int32_t y = 0; y < world->counts[1]; y++) {
            for (int32_t x = 0; x < world->counts[0]; x++) {
                if (iris_voxel_get(world, (iris_voxel){x, y, z})) {
                    first->x = x < first->x ? x : first->x;
                    first->y = y < first->y ? y : first->y;
                    first->z = z < first->z ? z : first->z;
                    last->x = x > last->x ? x : last->x;
                    last->y = y > last->y ? y : last->y;
                    last->z = z;
                }
            }
        }
    }
    return last->z >= 0;
}

static double edge(iris_q32 least, iris_q32 most, int32_t at, int32_t count)
{
    return ((double)least + ((double)most - (double)least) * at / count) / 4294967296.0;
}

static void edges_of(double edges[6], const iris_voxel_world *world, iris_voxel first, iris_voxel last)
{
    const iris_vec3 a = world->least, b = world->most;
    const int32_t *n = world->counts;
    edges[0] = edge(a.x, b.x, first.x, n[0]);
    edges[1] = edge(a.y, b.y, first.y, n[1]);
    edges[2] = edge(a.z, b.z, first.z, n[2]);
    edges[3] = edge(a.x, b.x, last.x + 1, n[0]);
    edges[4] = edge(a.y, b.y, last.y + 1, n[1]);
    edges[5] = edge(a.z, b.z, last.z + 1, n[2]);
}

static void print_json(const iris_voxel_world *world, const carve_views *views, int silhouettes,
                       const int32_t left[2], const double *edges)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "counts");
    json_open(&json, '[');
    for (int i = 0; i < 3; i++) {
        json_integer(&json, world->counts[i]);
    }
    json_close(&json, ']');
    json_key(&json, "views");
    json_integer(&json, silhouettes);
    json_key(&json, "matched");
    json_string(&json, views->by_name ? "name" : "order");
    json_key(&json, "voxels");
    json_integer(&json, left[0]);
    json_key(&json, "surface");
    json_integer(&json, left[1]);
    json_key(&json, "box");
    if (edges) {
        json_open(&json, '[');
        for (int i = 0; i < 6; i++) {
            json_number(&json, edges[i], 9);
        }
        json_close(&json, ']');
    } else {
        json_null(&json);
    }
    json_close(&json, '}');
}

static void tell(const wishes *w, const iris_voxel_world *world, const carve_views *views, int silhouettes)
{
    int32_t left[2] = {0, 0};
    iris_voxel first, last;
    double edges[6] = {0};
    int any = box_of(&first, &last, world);
    edges_of(edges, world, first, last);
    (void)iris_voxel_count(&left[0], world);
    (void)iris_voxel_surface(NULL, 0, &left[1], world);
    if (w->json) {
        print_json(world, views, silhouettes, left, any ? edges : NULL);
        return;
    }
    one_line(stdout, w->cameras);
    printf(": %d views by %s, %d of %dx%dx%d voxels left, %d at the surface\n", silhouettes,
           views->by_name ? "name" : "order", (int)left[0], (int)world->counts[0], (int)world->counts[1],
           (int)world->counts[2], (int)left[1]);
    if (any) {
        printf("  from %.6g %.6g %.6g to %.6g %.6g %.6g\n", edges[0], edges[1], edges[2], edges[3], edges[4],
               edges[5]);
    }
}

static int run(const wishes *w, const input_list *silhouettes)
{
    static carve_views views;
    iris_voxel_world world;
    if (!carve_views_read(&views, w->cameras) ||
        !carve_views_match(&views, silhouettes->paths, silhouettes->count, w->cameras)) {
        return EXIT_BAD_DATA;
    }
    const size_t bytes = IRIS_VOXEL_BYTES(w->counts[0], w->counts[1], w->counts[2]);
    uint32_t *bits = malloc(bytes);
    if (!bits || iris_voxel_world_init(&world, bits, bytes, w->counts, w->corners) != IRIS_OK) {
        complain("--voxels", bits ? "the box is too large" : "not enough memory: take fewer");
        free(bits);
        return EXIT_BAD_DATA;
    }
    (void)iris_voxel_fill(&world, 1);
    int done = carve_all(&world, &views, silhouettes->count) &&
               (!w->output || file_write(w->output, write_model, &world));
    if (done && (!w->output || strcmp(w->output, "-") != 0)) {
        tell(w, &world, &views, silhouettes->count);
    }
    free(bits);
    return done ? EXIT_DONE : EXIT_BAD_DATA;
}

int cmd_carve(int argc, char **argv)
{
    wishes w = {.cameras = NULL};
    int32_t most = 110;
    const char *box = NULL, *voxels = NULL;
    input_list silhouettes;
    const args_option options[] = {{"box", 0, NULL, &box},
                                   {"voxels", 0, NULL, &voxels},
                                   {"output", 'o', NULL, &w.output},
                                   {"json", 0, &w.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    const args_whole wholes[] = {{"--voxels", voxels, &most, 1, IRIS_VOXEL_SIDE_MAX}};
    if (args.operand_count < 2) {
        complain(NULL, "expected are CAMERAS and a SILHOUETTE at least (see --help)");
        return EXIT_BAD_CALL;
    }
    if (!args_wholes(wholes, 1) || !read_box(w.corners, box)) {
        return EXIT_BAD_CALL;
    }
    if (w.json && w.output && strcmp(w.output, "-") == 0) {
        complain(NULL, "one of --json and -o - only");
        return EXIT_BAD_CALL;
    }
    w.cameras = args.operands[0];
    choose_counts(&w, most);
    exit_code = inputs_expand(&silhouettes, args.operand_count - 1, args.operands + 1);
    exit_code = exit_code == EXIT_DONE ? run(&w, &silhouettes) : exit_code;
    inputs_free(&silhouettes);
    return exit_code;
}
