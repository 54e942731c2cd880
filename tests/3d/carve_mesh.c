/* Meshes of voxels: closed, turned outwards, where the voxels are, whatever touches whatever. */
#include "iris/3d/carve_mesh.h"

#include <math.h>
#include <stdio.h>

#include "random3d.h"
#include "test.h"

enum { NX = 9, NY = 7, NZ = 8, SIDE = 9, TEXT = 400000, VERTICES = 4000, TRIANGLES = 8000, SLOTS = 65536 };

static uint32_t bits[IRIS_VOXEL_ROW_WORDS(NX) * NY * NZ];
static IRIS_SCRATCH_BUFFER(working, IRIS_CARVE_MESH_SCRATCH_BYTES(SIDE));
static char text[TEXT];
static iris_carve_color colors[NX * NY * NZ];

static struct {
    int vertices, triangles;
    double at[VERTICES][3];
    int color[VERTICES][3];
    int corners[TRIANGLES][3];
} mesh;

/* Voxels are 2 x 3 x 4. */
static iris_voxel_world empty_world(void)
{
    static const int32_t counts[3] = {NX, NY, NZ};
    const iris_vec3 corners[2] = {{0, 0, 0},
                                  {2 * NX * IRIS_Q32_ONE, 3 * NY * IRIS_Q32_ONE, 4 * NZ * IRIS_Q32_ONE}};
    iris_voxel_world world;
    assert_int_equal(iris_voxel_world_init(&world, bits, sizeof bits, counts, corners), IRIS_OK);
    assert_int_equal(iris_voxel_fill(&world, 0), IRIS_OK);
    return world;
}

static char *expect_line(char *at, const char *line)
{
    const size_t length = strlen(line);
    assert_memory_equal(at, line, length);
    assert_int_equal(at[length], '\n');
    return at + length + 1;
}

static void read_mesh(size_t bytes, int colored)
{
    char *at = text;
    text[bytes] = '\0';
    at = expect_line(expect_line(at, "ply"), "format ascii 1.0");
    assert_memory_equal(at, "element vertex ", 15);
    mesh.vertices = (int)strtol(at + 15, &at, 10);
    at = expect_line(expect_line(expect_line(at + 1, "property double x"), "property double y"),
                     "property double z");
    if (colored) {
        at = expect_line(expect_line(expect_line(at, "property uchar red"), "property uchar green"),
                         "property uchar blue");
    }
    assert_memory_equal(at, "element face ", 13);
    mesh.triangles = (int)strtol(at + 13, &at, 10);
    at = expect_line(expect_line(at + 1, "property list uchar int vertex_indices"), "end_header");
    assert_true(mesh.vertices <= VERTICES && mesh.triangles <= TRIANGLES);
    for (int i = 0; i < mesh.vertices; i++) {
        for (int k = 0; k < 3; k++) {
            mesh.at[i][k] = strtod(at, &at);
        }
        for (int k = 0; k < 3 && colored; k++) {
            mesh.color[i][k] = (int)strtol(at, &at, 10);
        }
        assert_int_equal(*at++, '\n');
    }
    for (int i = 0; i < mesh.triangles; i++) {
        assert_int_equal(strtol(at, &at, 10), 3);
        for (int k = 0; k < 3; k++) {
            mesh.corners[i][k] = (int)strtol(at, &at, 10);
            assert_in_range(mesh.corners[i][k], 0, mesh.vertices - 1);
        }
        assert_int_equal(*at++, '\n');
    }
    assert_ptr_equal(at, text + bytes);
}

static void write_mesh(const iris_voxel_world *world, int32_t count)
{
    iris_memory_sink memory = {(uint8_t *)text, TEXT - 1, 0};
    iris_scratch scratch;
    int64_t vertices = 0, triangles = 0;
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(
        iris_carve_write_mesh(iris_sink_memory(&memory), world, count ? colors : NULL, count, &scratch),
        IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, sizeof working.memory);
    read_mesh(memory.used, count > 0);
    assert_int_equal(iris_carve_mesh_count(&vertices, &triangles, world), IRIS_OK);
    assert_int_equal(vertices, mesh.vertices);
    assert_int_equal(triangles, mesh.triangles);
}

/* Each edge is there once in each direction: closed, and all triangles the same way around. */
static void assert_closed(void)
{
    static uint32_t keys[SLOTS];
    memset(keys, 0, sizeof keys);
    for (int i = 0; i < 3 * mesh.triangles; i++) {
        const int *corner = mesh.corners[i / 3];
        const uint32_t key = (uint32_t)(corner[i % 3] * VERTICES + corner[(i + 1) % 3]) + 1;
        uint32_t slot = key * 2654435761u % SLOTS;
        assert_int_not_equal(corner[i % 3], corner[(i + 1) % 3]);
        for (; keys[slot] != 0; slot = (slot + 1) % SLOTS) {
            assert_int_not_equal(keys[slot], key);
        }
        keys[slot] = key;
    }
    for (int i = 0; i < 3 * mesh.triangles; i++) {
        const int *corner = mesh.corners[i / 3];
        const uint32_t back = (uint32_t)(corner[(i + 1) % 3] * VERTICES + corner[i % 3]) + 1;
        uint32_t slot = back * 2654435761u % SLOTS;
        while (keys[slot] != 0 && keys[slot] != back) {
            slot = (slot + 1) % SLOTS;
        }
        assert_int_equal(keys[slot], back);
    }
}

/* Of the solid that the mesh encloses. */
static double volume(void)
{
    double sum = 0;
    for (int i = 0; i < mesh.triangles; i++) {
        const double *a = mesh.at[mesh.corners[i][0]], *b = mesh.at[mesh.corners[i][1]],
                     *c = mesh.at[mesh.corners[i][2]];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6;
}

/* One voxel: at its corners three faces meet, whose middles' mean is a third of a half from the middle. */
static void one_voxel(void **state)
{
    (void)state;
    const iris_voxel_world world = empty_world();
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){4, 3, 2}, 1), IRIS_OK);
    write_mesh(&world, 0);
    assert_int_equal(mesh.vertices, 8);
    assert_int_equal(mesh.triangles, 12);
    for (int i = 0; i < 8; i++) {
        assert_true(fabs(fabs(mesh.at[i][0] - 9) - 1.0 / 3) < 1e-8 &&
                    fabs(fabs(mesh.at[i][1] - 10.5) - 0.5) < 1e-8 &&
                    fabs(fabs(mesh.at[i][2] - 10) - 2.0 / 3) < 1e-8);
    }
    assert_closed();
    assert_true(fabs(volume() - 2.0 / 3 * 1 * 4 / 3) < 1e-7);
}

/* A block at the world's edges: walls are where the voxels end. */
static void all_voxels(void **state)
{
    (void)state;
    const iris_voxel_world world = empty_world();
    double most[3] = {0, 0, 0};
    assert_int_equal(iris_voxel_fill(&world, 1), IRIS_OK);
    write_mesh(&world, 0);
    assert_int_equal(mesh.triangles, 4 * (NX * NY + NY * NZ + NX * NZ));
    assert_int_equal(mesh.vertices, mesh.triangles / 2 + 2); /* Euler */
    for (int i = 0; i < 3 * mesh.vertices; i++) {
        most[i % 3] = fmax(most[i % 3], mesh.at[i / 3][i % 3]);
        assert_true(mesh.at[i / 3][i % 3] >= 0);
    }
    assert_true(most[0] == 2 * NX && most[1] == 3 * NY && most[2] == 4 * NZ);
    assert_closed();
    assert_true(volume() < 24 * NX * NY * NZ && volume() > 24 * NX * NY * NZ * 0.93);
}

/* Two voxels that meet in an edge, between two plates: the worst that can be: the surface meets itself at both ends. */
static void a_touching_edge(void **state)
{
    (void)state;
    const iris_voxel_world world = empty_world();
    for (int32_t x = 2; x < 6; x++) {
        for (int32_t y = 2; y < 6; y++) {
            assert_int_equal(iris_voxel_set(&world, (iris_voxel){x, y, 2}, 1), IRIS_OK);
            assert_int_equal(iris_voxel_set(&world, (iris_voxel){x, y, 4}, 1), IRIS_OK);
        }
    }
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){3, 3, 3}, 1), IRIS_OK);
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){4, 4, 3}, 1), IRIS_OK);
    write_mesh(&world, 0);
    assert_closed();
}

static void anything_is_closed(void **state)
{
    (void)state;
    for (int round = 0; round < 40; round++) {
        const iris_voxel_world world = empty_world();
        int there = 0;
        for (int32_t i = 0; i < NX * NY * NZ; i++) {
            const iris_voxel v = {i % NX, i / NX % NY, i / NX / NY};
            const int is = random_u64() % 40 < (uint64_t)round;
            there += is;
            assert_int_equal(iris_voxel_set(&world, v, is), IRIS_OK);
        }
        write_mesh(&world, 0);
        assert_closed();
        assert_true(there == 0 ? mesh.triangles == 0 : mesh.triangles >= 12 && volume() > 0);
    }
}

/* A color for each voxel, by its place: that of a vertex is a mean of those around it. */
static void colors_follow(void **state)
{
    (void)state;
    static iris_voxel listed[NX * NY * NZ];
    const iris_voxel_world world = empty_world();
    int32_t count = 0;
    for (int32_t i = 0; i < NX * NY * NZ; i++) {
        assert_int_equal(
            iris_voxel_set(&world, (iris_voxel){i % NX, i / NX % NY, i / NX / NY}, random_u64() % 4 != 0),
            IRIS_OK);
    }
    assert_int_equal(iris_voxel_surface(listed, NX * NY * NZ, &count, &world), IRIS_OK);
    for (int32_t i = 0; i < count; i++) {
        colors[i] = (iris_carve_color){(uint8_t)(20 * listed[i].x + 20), (uint8_t)(30 * listed[i].y + 30),
                                       (uint8_t)(25 * listed[i].z + 25), 1};
    }
    write_mesh(&world, count);
    assert_closed();
    for (int i = 0; i < mesh.vertices; i++) {
        /* In voxels from the first one's middle; a vertex's voxels are at most half of one away. */
        const double x = mesh.at[i][0] / 2 - 0.5, y = mesh.at[i][1] / 3 - 0.5, z = mesh.at[i][2] / 4 - 0.5;
        assert_true(fabs(mesh.color[i][0] / 20.0 - 1 - x) < 0.6 &&
                    fabs(mesh.color[i][1] / 30.0 - 1 - y) < 0.6 &&
                    fabs(mesh.color[i][2] / 25.0 - 1 - z) < 0.6);
    }
}

static void refusals(void **state)
{
    (void)state;
    const iris_voxel_world world = empty_world();
    iris_voxel_world broken = world;
    iris_memory_sink memory = {(uint8_t *)text, TEXT - 1, 0};
    iris_scratch scratch;
    int64_t n = 77;
    assert_int_equal(iris_voxel_set(&world, (iris_voxel){4, 3, 2}, 1), IRIS_OK);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory - 1), IRIS_OK);
    assert_int_equal(iris_carve_write_mesh(iris_sink_memory(&memory), &world, NULL, 0, &scratch),
                     IRIS_ERR_SCRATCH);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(iris_scratch_init(&scratch, working.memory, sizeof working.memory), IRIS_OK);
    assert_int_equal(iris_carve_write_mesh(iris_sink_memory(&memory), &world, colors, 2, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_carve_write_mesh(iris_sink_memory(&memory), &world, NULL, 1, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_carve_write_mesh((iris_sink){NULL, NULL}, &world, NULL, 0, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_write_mesh(iris_sink_memory(&memory), &world, NULL, 0, NULL), IRIS_ERR_ARG);
    broken.counts[1] = 0;
    assert_int_equal(iris_carve_write_mesh(iris_sink_memory(&memory), &broken, NULL, 0, &scratch),
                     IRIS_ERR_ARG);
    assert_int_equal(iris_carve_mesh_count(&n, &n, &broken), IRIS_ERR_ARG);
    assert_int_equal(iris_carve_mesh_count(NULL, &n, &world), IRIS_ERR_ARG);
    assert_int_equal(n, 77);
    assert_int_equal(memory.used, 0);
    write_mesh(&world, 0);
    const size_t whole = strlen(text);
    for (size_t room = 0; room < whole; room += 13) {
        iris_memory_sink small = {(uint8_t *)text, room, 0};
        assert_int_equal(iris_carve_write_mesh(iris_sink_memory(&small), &world, NULL, 0, &scratch),
                         IRIS_ERR_IO);
        assert_int_equal(scratch.used, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_voxel),       cmocka_unit_test(all_voxels),
        cmocka_unit_test(a_touching_edge), cmocka_unit_test(anything_is_closed),
        cmocka_unit_test(colors_follow),   cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
