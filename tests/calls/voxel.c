/* Worlds of voxels, and carving. */
#include "iris/3d/carve.h"

#include "calls.h"
#include "space.h"

/* A world of 1 to 40 voxels along an axis, 3000 at most, in memory that a call may change; rarely an invalid one, or none. */
static iris_voxel_world *any_world(int is_changed)
{
    iris_voxel_world made = {
        .counts = {draw_within(1, draw_chance(4) ? 70 : 40), draw_within(1, 8), draw_within(1, 8)}};
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

static void write_ply(void)
{
    iris_memory_sink memory = {.capacity = draw_below(draw_chance(2) ? 300 : 60000)};
    memory.data = draw_results(memory.capacity);
    iris_sink sink = iris_sink_memory(draw_state(&memory, sizeof memory));
    const iris_voxel_world *world = any_world(0);
    if (draw_chance(60)) {
        sink.write = NULL;
    }
    CALL(iris_carve_write_ply(sink, world));
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
    {NULL, NULL},
};
