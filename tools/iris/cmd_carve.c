#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "carve_photos.h"
#include "carve_pieces.h"
#include "carve_shows.h"
#include "carve_views.h"
#include "commands.h"
#include "complain.h"
#include "file_write.h"
#include "inputs.h"
#include "iris/3d/carve.h"
#include "iris/3d/carve_mesh.h"
#include "json.h"
#include "number_file.h"
#include "one_line.h"
#include "progress.h"
#include "system.h"

static const char help[] =
    "usage: iris carve CAMERAS SILHOUETTE... [--photos PHOTO...] --box X0,Y0,Z0,X1,Y1,Z1 [--voxels N]\n"
    "                  [--levels N] [-o MODEL.ply] [--mesh MESH.ply] [--json]\n\n"
    "The shape of a thing from its silhouettes (white: the thing) and photographs, seen by cameras that are\n"
    "known: from a box of voxels all are taken away whose middles a silhouette does not have, and then "
    "those\n"
    "on whose colors the photographs do not agree. What a picture does not show is kept; one that shows\n"
    "nothing of the box is named.\n\n"
    "  CAMERAS        a text: how many there are; then for each a name, K (3 x 3), R (3 x 3), and t, row\n"
    "                 by row, with blanks between. K [R | t] leads to pixels of the pictures\n"
    "  SILHOUETTE...  black and white pictures, or folders of them: by name, when one's name begins with a "
    "camera's name\n"
    "                 (without extension): view1_mask.bmp is of view1.png; else by order, one for each.\n"
    "                 None are needed with photos, but they help\n"
    "  --photos PHOTO...\n"
    "                 photographs, or folders of them, up to the next option, as large as the silhouettes\n"
    "  --levels N     by how many gray levels photographs may differ and still agree, 0 to 255 (default\n"
    "                 16): more for noise and shine, fewer for plain things\n"
    "  --box X0,Y0,Z0,X1,Y1,Z1\n"
    "                 two corners of the box, in the cameras' unit\n"
    "  --voxels N     along the longest side of the box, 1 to 1024 (default 110); they are nearly cubes\n"
    "  -o MODEL.ply   the middles of the voxels at the surface, as a cloud of points, with photographs\n"
    "                 colored; -: to standard output, and nothing else\n"
    "  --mesh MESH.ply\n"
    "                 the surface as a closed mesh of triangles, with photographs colored\n"
    "  --json         one JSON object\n\n"
    "JSON has counts (along x, y, z), views, matched (name or order), photos, removed (voxels by photos),\n"
    "rounds (of six sweeps), voxels (that are left), surface (how many of them), pieces (that hang "
    "together),\n"
    "largest (voxels of the largest), and its box (least and most corner; null when nothing is left).\n\n"
    "example: iris carve cameras.txt masks/ --photos photos/ --box -0.1,-0.1,-0.1,0.1,0.1,0.1 -o model.ply\n";

typedef struct {
    const char *cameras, *output, *mesh;
    iris_vec3 corners[2];
    int32_t counts[3];
    int32_t levels;
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

static int carve_view_of(const iris_voxel_world *world, carve_view *view)
{
    picture_buffer mask = {0};
    int done = carve_silhouette_read(&mask, view->silhouette);
    if (done) {
        const size_t bytes = IRIS_CARVE_SCRATCH_BYTES(mask.image.w, mask.image.h);
        void *memory = system_scratch(bytes);
        iris_scratch scratch;
        iris_status status = memory ? iris_scratch_init(&scratch, memory, bytes) : IRIS_ERR_SCRATCH;
        status = status == IRIS_OK ? iris_carve_view(world, &mask.image, view->m, &scratch) : status;
        done = status == IRIS_OK;
        if (!done) {
            complain(view->silhouette, "%s",
                     picture_problem(status, (iris_size){mask.image.w, mask.image.h}));
        }
        view->shows = done && carve_shows(world, view->m, (iris_size){mask.image.w, mask.image.h});
        free(memory);
    }
    picture_free(&mask);
    return done;
}

static int carve_all(const iris_voxel_world *world, carve_views *views, int silhouettes)
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

/* Names the views that show nothing of the box; 0 when none shows any of it. */
static int check_views(const wishes *w, const iris_voxel_world *world, carve_views *views,
                       const carve_photos *photos)
{
    int showing = 0, photo = 0;
    for (int i = 0; i < views->count; i++) {
        carve_view *view = &views->views[i];
        if (view->photo) {
            const iris_image *picture = &photos->photos[photo++].picture;
            view->shows = view->silhouette ? view->shows
                                           : carve_shows(world, view->m, (iris_size){picture->w, picture->h});
        }
        showing += view->shows;
    }
    if (showing == 0) {
        complain(w->cameras,
                 "no view shows any of the box: is --box in the cameras' unit, do K, R, and t lead from "
                 "there to pixels, and are the pictures whole?");
        return 0;
    }
    for (int i = 0; i < views->count; i++) {
        const carve_view *view = &views->views[i];
        if ((view->silhouette || view->photo) && !view->shows) {
            complain(view->silhouette ? view->silhouette : view->photo,
                     "warning: by its camera (%s) it shows nothing of the box", view->name);
        }
    }
    return 1;
}

/* --- what is told and written --- */

typedef struct {
    const iris_voxel_world *world;
    const carve_photos *photos;
} model;

static int write_points(FILE *file, const void *user)
{
    const model *m = user;
    const iris_sink sink = {file_write_bytes, file};
    const iris_status status =
        m->photos->colors
            ? iris_carve_write_colored_ply(sink, m->world, m->photos->colors, m->photos->colored)
            : iris_carve_write_ply(sink, m->world);
    return status == IRIS_OK && fflush(file) == 0;
}

static int write_mesh(FILE *file, const void *user)
{
    const model *m = user;
    size_t side = 0;
    for (int i = 0; i < 3; i++) {
        side = (size_t)m->world->counts[i] > side ? (size_t)m->world->counts[i] : side;
    }
    const size_t bytes = IRIS_CARVE_MESH_SCRATCH_BYTES(side);
    void *memory = system_scratch(bytes);
    iris_scratch scratch;
    iris_status status = memory ? iris_scratch_init(&scratch, memory, bytes) : IRIS_ERR_SCRATCH;
    status = status == IRIS_OK ? iris_carve_write_mesh((iris_sink){file_write_bytes, file}, m->world,
                                                       m->photos->colors, m->photos->colored, &scratch)
                               : status;
    free(memory);
    return status == IRIS_OK && fflush(file) == 0;
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

/* What is told: views, how they were matched, and what is left. */
typedef struct {
    const iris_voxel_world *world;
    const carve_photos *photos;
    int silhouettes, by_name;
    int32_t voxels, surface;
    carve_pieces pieces;
    double edges[6];
} result;

static void json_count(json_writer *json, const char *key, int64_t number)
{
    json_key(json, key);
    json_integer(json, number);
}

static void print_json(const result *r)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "counts");
    json_open(&json, '[');
    for (int i = 0; i < 3; i++) {
        json_integer(&json, r->world->counts[i]);
    }
    json_close(&json, ']');
    json_count(&json, "views", r->silhouettes);
    json_key(&json, "matched");
    json_string(&json, r->by_name ? "name" : "order");
    json_count(&json, "photos", r->photos->count);
    json_count(&json, "removed", r->photos->removed);
    json_count(&json, "rounds", r->photos->rounds);
    json_count(&json, "voxels", r->voxels);
    json_count(&json, "surface", r->surface);
    json_count(&json, "pieces", r->pieces.pieces);
    json_count(&json, "largest", r->pieces.largest);
    json_key(&json, "box");
    if (r->pieces.largest > 0) {
        json_open(&json, '[');
        for (int i = 0; i < 6; i++) {
            json_number(&json, r->edges[i], 9);
        }
        json_close(&json, ']');
    } else {
        json_null(&json);
    }
    json_close(&json, '}');
}

static void print_text(const result *r, const char *cameras)
{
    const int32_t *counts = r->world->counts;
    one_line(stdout, cameras);
    printf(": %d views by %s, %d of %dx%dx%d voxels left, %d at the surface\n", r->silhouettes,
           r->by_name ? "name" : "order", (int)r->voxels, (int)counts[0], (int)counts[1], (int)counts[2],
           (int)r->surface);
    if (r->photos->count > 0) {
        printf("  %d photos took %d away, in %d rounds\n", r->photos->count, (int)r->photos->removed,
               (int)r->photos->rounds);
    }
    if (r->pieces.pieces > 1) {
        printf("  %d pieces, the largest of %d voxels\n", (int)r->pieces.pieces, (int)r->pieces.largest);
    }
    if (r->pieces.largest > 0) {
        printf("  from %.6g %.6g %.6g to %.6g %.6g %.6g\n", r->edges[0], r->edges[1], r->edges[2],
               r->edges[3], r->edges[4], r->edges[5]);
    }
}

static int tell(const wishes *w, result *r)
{
    if (!carve_pieces_find(&r->pieces, r->world)) {
        complain("--voxels", "not enough memory: take fewer");
        return 0;
    }
    edges_of(r->edges, r->world, r->pieces.first, r->pieces.last);
    (void)iris_voxel_count(&r->voxels, r->world);
    (void)iris_voxel_surface(NULL, 0, &r->surface, r->world);
    if (w->json) {
        print_json(r);
    } else {
        print_text(r, w->cameras);
    }
    return 1;
}

/* --- all of it --- */

static int match(carve_views *views, const wishes *w, const input_list *silhouettes, const input_list *photos)
{
    return carve_views_read(views, w->cameras) &&
           (photos->count == 0 ||
            carve_views_match(views, CARVE_PHOTOS, photos->paths, photos->count, w->cameras)) &&
           (silhouettes->count == 0 ||
            carve_views_match(views, CARVE_SILHOUETTES, silhouettes->paths, silhouettes->count, w->cameras));
}

static int make(const wishes *w, const iris_voxel_world *world, carve_views *views, int silhouettes,
                carve_photos *photos)
{
    int has_photos = 0;
    for (int i = 0; i < views->count; i++) {
        has_photos |= views->views[i].photo != NULL;
    }
    const model made = {world, photos};
    result r = {.world = world, .photos = photos, .silhouettes = silhouettes, .by_name = views->by_name};
    return (!has_photos || carve_photos_read(photos, views)) && carve_all(world, views, silhouettes) &&
           check_views(w, world, views, photos) &&
           (!has_photos || carve_photos_carve(photos, world, w->levels)) &&
           (!w->output || file_write(w->output, write_points, &made)) &&
           (!w->mesh || file_write(w->mesh, write_mesh, &made)) &&
           ((w->output && strcmp(w->output, "-") == 0) || tell(w, &r));
}

static int run(const wishes *w, const input_list *silhouettes, const input_list *photographs)
{
    static carve_views views;
    iris_voxel_world world;
    carve_photos photos = {.photos = NULL};
    if (!match(&views, w, silhouettes, photographs)) {
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
    const int done = make(w, &world, &views, silhouettes->count, &photos);
    carve_photos_free(&photos);
    free(bits);
    return done ? EXIT_DONE : EXIT_BAD_DATA;
}

/* Takes --photos and what follows it up to the next option out of the call. They end up behind the rest, from argv[*argc]
 * on; how many, or -1: given twice, or without any. */
static int take_photos(int *argc, char **argv)
{
    int first = 0, count = 0;
    for (int i = 1; i < *argc && strcmp(argv[i], "--") != 0; i++) {
        if (strcmp(argv[i], "--photos") == 0) {
            if (first > 0) {
                return -1;
            }
            first = i;
        }
    }
    while (first > 0 && first + 1 + count < *argc && argv[first + 1 + count][0] != '-') {
        count++;
    }
    if (first == 0 || count == 0) {
        return first > 0 ? -1 : 0;
    }
    for (int step = 0; step <= count; step++) { /* one after another to the end: --photos goes last of all */
        const int from = step < count ? first + 1 : first;
        char *moved = argv[from];
        memmove(&argv[from], &argv[from + 1], (size_t)(*argc - 1 - from) * sizeof *argv);
        argv[*argc - 1] = moved;
    }
    *argc -= count + 1;
    return count;
}

static int check(const wishes *w, int operands, int photos)
{
    if (photos < 0) {
        complain("--photos", "is given once, with pictures or folders behind it");
    } else if (operands < (photos > 0 ? 1 : 2)) {
        complain(NULL, "expected are CAMERAS and a SILHOUETTE at least (see --help)");
    } else if (w->output && strcmp(w->output, "-") == 0 &&
               (w->json || (w->mesh && strcmp(w->mesh, "-") == 0))) {
        complain(NULL, "one of --json, -o -, and --mesh - only");
    } else if (w->mesh && strcmp(w->mesh, "-") == 0) {
        complain("--mesh", "a file, not standard output");
    } else {
        return 1;
    }
    return 0;
}

int cmd_carve(int argc, char **argv)
{
    wishes w = {.cameras = NULL, .levels = 16};
    int32_t most = 110;
    const char *box = NULL, *voxels = NULL, *levels = NULL;
    input_list silhouettes, photographs = {0};
    const int photos = take_photos(&argc, argv);
    char **photo_names = argv + argc;
    const args_option options[] = {{"box", 0, NULL, &box},       {"voxels", 0, NULL, &voxels},
                                   {"levels", 0, NULL, &levels}, {"output", 'o', NULL, &w.output},
                                   {"mesh", 0, NULL, &w.mesh},   {"json", 0, &w.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = photos < 0 ? ARGS_GO : args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    const args_whole wholes[] = {{"--voxels", voxels, &most, 1, IRIS_VOXEL_SIDE_MAX},
                                 {"--levels", levels, &w.levels, 0, 255}};
    if (!check(&w, args.operand_count, photos) || !args_wholes(wholes, 2) || !read_box(w.corners, box)) {
        return EXIT_BAD_CALL;
    }
    w.cameras = args.operands[0];
    choose_counts(&w, most);
    exit_code = inputs_expand(&silhouettes, args.operand_count - 1, args.operands + 1);
    if (exit_code == EXIT_DONE) {
        exit_code = photos > 0 ? inputs_expand(&photographs, photos, photo_names) : EXIT_DONE;
        exit_code = exit_code == EXIT_DONE ? run(&w, &silhouettes, &photographs) : exit_code;
        if (photos > 0) {
            inputs_free(&photographs);
        }
    }
    inputs_free(&silhouettes);
    return exit_code;
}
