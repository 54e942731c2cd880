/* Worlds of voxels, carving by silhouettes and by photographs, and meshes. */
#include "iris/3d/carve.h"
#include "iris/3d/carve_mesh.h"
#include "iris/3d/carve_photo.h"

#include "calls.h"
#include "space.h"

/* A world of 1 to 40 voxels along an axis, 3000 at most, in memory that a call may change; rarely an invalid one, or none. */
static iris_voxel_world *any_world(int is_changed)
{
    iris_voxel_world made = {
        .counts = {draw_within(1, draw_chance(4) ? 70 : 40), draw_within(1, 6), draw_within(1, 6)}};
    size_t bytes = IRIS_VOXEL_BYTES(made.counts[0], made.counts[1], made.counts[2]);
    made.least = draw_vec3(4);
    made.most = iris_vec3_add(made.least, (iris_vec3){draw_q32(2, 9), draw_q32(2, 9), draw_q32(2, 9)});
    if (draw_chance(12)) {
        made.most = (iris_vec3){made.least.x + 1, made.least.y + draw_within(1, 1000), INT64_MAX >> 4};
    }
    made.bits = OR_NULL(is_changed ? draw_results(bytes) : draw_given(NULL, bytes));
    if (draw_chance(20)) {
        made.counts[draw_below(3)] =
            draw_chance(2) ? draw_within(INT32_MIN, 0) : draw_within(1025, INT32_MAX);
    }
    draw_spoiled(&made.least.x, 6, 30);
    return OR_NULL(draw_state(&made, sizeof made));
}

static int32_t count_of(const iris_voxel_world *world, int axis)
{
    return world && world->counts[axis] > 0 ? world->counts[axis] : 1;
}

static iris_voxel any_voxel(const iris_voxel_world *world)
{
    iris_voxel voxel = {draw_within(0, count_of(world, 0) - 1), draw_within(0, count_of(world, 1) - 1),
                        draw_within(0, count_of(world, 2) - 1)};
    if (draw_chance(4)) {
        int32_t *numbers[] = {&voxel.x, &voxel.y, &voxel.z};
        *numbers[draw_below(3)] = draw_int(0, 40);
    }
    return voxel;
}

static void init(void)
{
    int32_t counts[3] = {draw_int(1, IRIS_VOXEL_SIDE_MAX), draw_int(1, 9), draw_int(1, 9)};
    iris_vec3 corners[2] = {draw_vec3(2), draw_vec3(9)};
    size_t bytes = 4 * draw_below(20000);
    if (!draw_chance(4)) {
        corners[1] = iris_vec3_add(corners[0], (iris_vec3){draw_q32(1, 9), draw_q32(1, 9), draw_q32(1, 9)});
        counts[0] = draw_within(1, IRIS_VOXEL_SIDE_MAX);
    }
    draw_spoiled(&corners[0].x, 6, 5);
    iris_voxel_world *world = OR_NULL(draw_results(sizeof *world));
    uint32_t *bits = OR_NULL(draw_given(NULL, bytes));
    const int32_t *with = OR_NULL(draw_given(counts, sizeof counts));
    const iris_vec3 *between = OR_NULL(draw_given(corners, sizeof corners));
    CALL(iris_voxel_world_init(world, bits, bytes, with, between));
}

static void fill(void)
{
    const iris_voxel_world *world = any_world(1);
    int there = draw_int(0, 1);
    CALL(iris_voxel_fill(world, there));
}

static void set(void)
{
    const iris_voxel_world *world = any_world(1);
    iris_voxel voxel = any_voxel(world);
    int there = draw_int(0, 1);
    CALL(iris_voxel_set(world, voxel, there));
}

static void count(void)
{
    int32_t *sum = OR_NULL(draw_results(sizeof *sum));
    const iris_voxel_world *world = any_world(0);
    CALL(iris_voxel_count(sum, world));
}

static void center(void)
{
    iris_vec3 *middle = OR_NULL(draw_results(sizeof *middle));
    const iris_voxel_world *world = any_world(0);
    iris_voxel voxel = any_voxel(world);
    CALL(iris_voxel_center(middle, world, voxel));
}

static void surface_row(void)
{
    const iris_voxel_world *world = any_world(0);
    size_t words = IRIS_VOXEL_ROW_WORDS(count_of(world, 0));
    uint32_t *surface = OR_NULL(draw_results((words < 3 ? words : 3) * 4));
    iris_voxel at = any_voxel(world);
    CALL(iris_voxel_surface_row(surface, world, at.y, at.z));
}

static void surface(void)
{
    const iris_voxel_world *world = any_world(0);
    int32_t room = draw_int(0, draw_chance(2) ? 20 : 3000);
    int fits = room >= 0 && room <= 3000;
    iris_voxel *voxels = OR_NULL(draw_results((size_t)(fits ? room : 0) * sizeof *voxels));
    int32_t *sum = OR_NULL(draw_results(sizeof *sum));
    room = fits ? room : draw_within(-1, 0);
    CALL(iris_voxel_surface(voxels, room, sum, world));
}

/* The matrix of a camera that mostly looks at the world; rarely null. */
static const iris_q32 *any_matrix(iris_size size)
{
    iris_q32 m[12] = {0};
    iris_sensor camera = draw_sensor(size, 4);
    if (draw_chance(2)) {
        iris_vec3 away =
            iris_pose_out_of(&(iris_pose){.turn = camera.pose.turn}, (iris_vec3){0, 0, draw_q32(-30, -3)});
        camera.pose.place = iris_vec3_add(camera.pose.place, away);
    }
    if (!draw_chance(30)) {
        iris_sensor_matrix(m, &camera);
    }
    draw_spoiled(m, 12, 10);
    return OR_NULL(draw_given(m, sizeof m));
}

static void view_init(void)
{
    iris_voxel_view *view = OR_NULL(draw_results(sizeof *view));
    const iris_voxel_world *world = any_world(0);
    const iris_q32 *m = any_matrix(draw_size());
    CALL(iris_voxel_view_init(view, world, m));
}

static void footprint(void)
{
    iris_voxel_view made;
    iris_voxel_bounds *bounds = OR_NULL(draw_results(sizeof *bounds));
    const iris_voxel_world *world = any_world(0);
    iris_voxel voxel = any_voxel(world);
    const iris_q32 *m = any_matrix((iris_size){64, 48});
    int is_made = world && m && iris_voxel_view_init(&made, world, m) == IRIS_OK;
    const iris_voxel_view *view = OR_NULL(draw_given(is_made ? &made : NULL, sizeof made));
    CALL(iris_voxel_footprint(bounds, world, view, voxel));
}

static void plane_matrix(void)
{
    iris_q32 *m = OR_NULL(draw_results(12 * sizeof *m));
    iris_pose made = {draw_turn(), draw_vec3(20)};
    iris_vec3 eye = iris_pose_out_of(&made, (iris_vec3){0, 0, draw_q32(-9, draw_chance(3) ? 2 : -1)});
    draw_spoiled(made.turn.m, 9, 10);
    draw_spoiled(&made.place.x, 3, 10);
    draw_spoiled(&eye.x, 3, 10);
    const iris_pose *plane = OR_NULL(draw_given(&made, sizeof made));
    CALL(iris_voxel_plane_matrix(m, plane, eye));
}

static void carve_view(void)
{
    iris_size size = draw_size();
    const iris_voxel_world *world = any_world(1);
    const iris_image *silhouette = draw_input(IRIS_MASK1, size);
    const iris_q32 *m = any_matrix(size);
    iris_scratch *scratch = draw_scratch(IRIS_CARVE_SCRATCH_BYTES(size.w, size.h));
    CALL(iris_carve_view(world, silhouette, m, scratch));
}

/* Bytes go to memory that may be too small. */
static iris_sink any_sink(void)
{
    iris_memory_sink memory = {.capacity = draw_below(draw_chance(2) ? 300 : 60000)};
    memory.data = draw_results(memory.capacity);
    iris_sink sink = iris_sink_memory(draw_state(&memory, sizeof memory));
    if (draw_chance(60)) {
        sink.write = NULL;
    }
    return sink;
}

static void write_ply(void)
{
    iris_sink sink = any_sink();
    const iris_voxel_world *world = any_world(0);
    CALL(iris_carve_write_ply(sink, world));
}

/* ---- carve_photo.h ---- */

enum { PHOTOS = 3 };

/* Pictures of up to PHOTOS cameras; rarely null, or others than such that belong together. */
static const iris_carve_photos *any_photos(iris_size size, int32_t *count)
{
    iris_carve_photo photos[PHOTOS];
    iris_format format = draw_gray_or_color();
    iris_carve_photos made = {.count = draw_within(1, PHOTOS)};
    *count = made.count;
    for (int i = 0; i < made.count; i++) {
        const iris_q32 *m = any_matrix(size);
        const iris_image *picture = draw_input(format, size);
        photos[i] = (iris_carve_photo){.silhouette = draw_chance(2) ? NULL : draw_input(IRIS_MASK1, size)};
        for (int k = 0; k < 12 && m; k++) {
            photos[i].m[k] = m[k];
        }
        if (picture) {
            photos[i].picture = *picture;
        }
    }
    made.photos = OR_NULL(draw_given(photos, (size_t)made.count * sizeof *photos));
    if (draw_chance(30)) {
        made.count = draw_chance(2) ? draw_within(INT32_MIN, 0) : draw_within(256, INT32_MAX);
    }
    return OR_NULL(draw_given(&made, sizeof made));
}

/* The most voxels along an axis; 1 of a world that is none. */
static size_t side_of(const iris_voxel_world *world)
{
    int32_t side = 1;
    for (int axis = 0; axis < 3; axis++) {
        int32_t count = count_of(world, axis);
        side = count > side && count <= IRIS_VOXEL_SIDE_MAX ? count : side;
    }
    return (size_t)side;
}

static const iris_carve_photo_config *any_photo_config(void)
{
    iris_carve_photo_config made = {draw_int(0, 255), draw_within(1, 3)};
    if (draw_chance(20)) {
        made.rounds = draw_within(INT32_MIN, 0);
    }
    return draw_chance(8) ? NULL : draw_given(&made, sizeof made);
}

static iris_size photo_size(void)
{
    return (iris_size){draw_within(1, 40), draw_within(1, 30)};
}

static void photo_sweep(void)
{
    int32_t views;
    iris_size size = photo_size();
    int32_t *removed = OR_NULL(draw_results(sizeof *removed));
    const iris_voxel_world *world = any_world(1);
    const iris_carve_photos *photos = any_photos(size, &views);
    iris_sweep direction = (iris_sweep)draw_int(IRIS_SWEEP_X_UP, IRIS_SWEEP_Z_DOWN);
    const iris_carve_photo_config *config = any_photo_config();
    iris_scratch *scratch =
        draw_scratch(IRIS_CARVE_PHOTO_SCRATCH_BYTES(side_of(world), views, size.w, size.h));
    CALL(iris_carve_photo_sweep(removed, world, photos, direction, config, scratch));
}

static void photo_world(void)
{
    int32_t views;
    iris_size size = photo_size();
    int32_t *removed = OR_NULL(draw_results(sizeof *removed));
    const iris_voxel_world *world = any_world(1);
    const iris_carve_photos *photos = any_photos(size, &views);
    const iris_carve_photo_config *config = any_photo_config();
    iris_scratch *scratch =
        draw_scratch(IRIS_CARVE_PHOTO_SCRATCH_BYTES(side_of(world), views, size.w, size.h));
    CALL(iris_carve_photo_world(removed, world, photos, config, scratch));
}

/* How many voxels are at the surface; 0 of a world that is none. */
static int32_t surface_of(const iris_voxel_world *world)
{
    int32_t sum = 0;
    return world && iris_voxel_surface(NULL, 0, &sum, world) == IRIS_OK ? sum : 0;
}

static void colors(void)
{
    int32_t views, room = draw_within(-1, 2000);
    iris_size size = photo_size();
    size_t places = (size_t)(room > 0 ? room : 0);
    iris_carve_color *made = OR_NULL(draw_results(places * sizeof *made));
    int32_t *sum = OR_NULL(draw_results(sizeof *sum));
    const iris_voxel_world *world = any_world(0);
    const iris_carve_photos *photos = any_photos(size, &views);
    iris_scratch *scratch =
        draw_scratch(IRIS_CARVE_COLORS_SCRATCH_BYTES(side_of(world), views, size.w, size.h, places));
    CALL(iris_carve_colors(made, room, sum, world, photos, scratch));
}

/* Of all voxels at the surface, or of a wrong number of them. */
static const iris_carve_color *any_colors(const iris_voxel_world *world, int32_t *count)
{
    *count = surface_of(world);
    const iris_carve_color *made = OR_NULL(draw_given(NULL, (size_t)*count * sizeof *made));
    if (draw_chance(10)) {
        *count = draw_int(0, 100);
    }
    return made;
}

static void colored_ply(void)
{
    int32_t sum;
    iris_sink sink = any_sink();
    const iris_voxel_world *world = any_world(0);
    const iris_carve_color *of = any_colors(world, &sum);
    CALL(iris_carve_write_colored_ply(sink, world, of, sum));
}

/* ---- carve_mesh.h ---- */

static void mesh_count(void)
{
    int64_t *vertices = OR_NULL(draw_results(sizeof *vertices));
    int64_t *triangles = OR_NULL(draw_results(sizeof *triangles));
    const iris_voxel_world *world = any_world(0);
    CALL(iris_carve_mesh_count(vertices, triangles, world));
}

static void write_mesh(void)
{
    int32_t sum = 0;
    iris_sink sink = any_sink();
    const iris_voxel_world *world = any_world(0);
    const iris_carve_color *of = draw_chance(2) ? NULL : any_colors(world, &sum);
    iris_scratch *scratch = draw_scratch(IRIS_CARVE_MESH_SCRATCH_BYTES(side_of(world)));
    CALL(iris_carve_write_mesh(sink, world, of, sum, scratch));
}

const random_call calls_voxel[] = {
    {"iris_voxel_world_init", init},
    {"iris_voxel_fill", fill},
    {"iris_voxel_set", set},
    {"iris_voxel_count", count},
    {"iris_voxel_center", center},
    {"iris_voxel_surface_row", surface_row},
    {"iris_voxel_surface", surface},
    {"iris_voxel_view_init", view_init},
    {"iris_voxel_footprint", footprint},
    {"iris_voxel_plane_matrix", plane_matrix},
    {"iris_carve_view", carve_view},
    {"iris_carve_write_ply", write_ply},
    {"iris_carve_photo_sweep", photo_sweep},
    {"iris_carve_photo_world", photo_world},
    {"iris_carve_colors", colors},
    {"iris_carve_write_colored_ply", colored_ply},
    {"iris_carve_mesh_count", mesh_count},
    {"iris_carve_write_mesh", write_mesh},
    {NULL, NULL},
};
