/* Meshes: vertices corner by corner, then the faces of the voxels. */
#include "iris/3d/carve_mesh.h"

#include "mesh_corner.h"
#include "ply_text.h"
#include "voxel_parts.h"

typedef struct {
    const iris_sink *sink;
    const iris_voxel_world *world;
    const iris_carve_color *colors; /* null: none */
    const int32_t *rows;            /* where the colors of each row of voxels begin */
    uint32_t *firsts[2];            /* the first vertex of each corner, of two layers of corners */
    iris_status status;
} mesh;

static iris_voxel moved(iris_voxel at, int axis)
{
    return (iris_voxel){at.x + (axis == 0), at.y + (axis == 1), at.z + (axis == 2)};
}

/* --- faces as polygons --- */

typedef struct {
    iris_mesh_corner corners[4];
    iris_voxel at[4];
    unsigned solid[4]; /* the face's voxel that is there, as each corner numbers it */
    int face[4];       /* the face, as each corner numbers it */
    int axis, is_low;  /* is the lower voxel there? */
} square;

/* The face across the axis that goes from the corner `at` along the next axes; 0: it is no surface. */
static int square_at(square *s, const iris_voxel_world *world, const iris_mesh_corner *corner, iris_voxel at,
                     int axis)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const unsigned low = 1u << u | 1u << v;
    if (corner->solid == 0 || corner->solid == 255 ||
        (corner->solid >> low & 1u) == (corner->solid >> 7 & 1u)) {
        return 0;
    }
    s->axis = axis;
    s->is_low = (corner->solid >> low & 1u) != 0;
    s->at[0] = at;
    s->at[1] = moved(at, u);
    s->at[2] = moved(s->at[1], v);
    s->at[3] = moved(at, v);
    for (int i = 0; i < 4; i++) {
        const unsigned bits = (i == 0 || i == 3 ? 1u << u : 0u) | (i < 2 ? 1u << v : 0u);
        s->solid[i] = bits | (s->is_low ? 0u : 1u << axis);
        s->face[i] = iris_mesh_face(axis, bits);
        iris_mesh_corner_look(&s->corners[i], world, s->at[i]);
    }
    return 1;
}

/* Is there a vertex in the middle of side i, from corner i to the next? It belongs to the lower one of them. */
static int has_middle(const square *s, int i, int *corner, int *axis)
{
    *corner = i == 2 ? 3 : i == 3 ? 0 : i;
    *axis = i % 2 == 0 ? (s->axis + 1) % 3 : (s->axis + 2) % 3;
    return (s->corners[*corner].split >> *axis & 1u) != 0;
}

static int square_triangles(const square *s)
{
    int triangles = 2, corner, axis;
    for (int i = 0; i < 4; i++) {
        triangles += has_middle(s, i, &corner, &axis);
    }
    return triangles;
}

/* --- counting --- */

static iris_voxel corner_of(const iris_voxel_world *world, int64_t i)
{
    const int64_t nx = world->counts[0] + 1, ny = world->counts[1] + 1;
    return (iris_voxel){(int32_t)(i % nx), (int32_t)(i / nx % ny), (int32_t)(i / nx / ny)};
}

static int64_t corner_count(const iris_voxel_world *world)
{
    return ((int64_t)world->counts[0] + 1) * (world->counts[1] + 1) * (world->counts[2] + 1);
}

iris_status iris_carve_mesh_count(int64_t *vertices, int64_t *triangles, const iris_voxel_world *world)
{
    iris_status status = vertices && triangles ? iris_voxel_check(world) : IRIS_ERR_ARG;
    int64_t corners = 0, faces = 0;
    if (status != IRIS_OK) {
        return status;
    }
    for (int64_t i = 0; i < corner_count(world); i++) {
        const iris_voxel at = corner_of(world, i);
        iris_mesh_corner corner;
        square s;
        iris_mesh_corner_look(&corner, world, at);
        corners += iris_mesh_corner_vertices(&corner);
        for (int axis = 0; axis < 3; axis++) {
            faces += square_at(&s, world, &corner, at, axis) ? square_triangles(&s) : 0;
        }
    }
    *vertices = corners;
    *triangles = faces;
    return IRIS_OK;
}

/* --- vertices --- */

/* The faces' middles, and the colors of what is behind them. Places in lattice points (halves of a voxel). */
typedef struct {
    int32_t place[3], color[3], count;
} face_sum;

static void add_color(face_sum *sum, const mesh *m, iris_voxel voxel)
{
    uint32_t surface[IRIS_VOXEL_ROW_WORDS(IRIS_VOXEL_SIDE_MAX)] = {0};
    (void)iris_voxel_surface_row(surface, m->world, voxel.y, voxel.z);
    const iris_carve_color *color =
        &m->colors[m->rows[voxel.z * m->world->counts[1] + voxel.y] + iris_voxel_row_rank(surface, voxel.x)];
    sum->color[0] += color->r;
    sum->color[1] += color->g;
    sum->color[2] += color->b;
}

/* A face at the corner `at` of the lattice. */
static void add_face(face_sum *sum, const mesh *m, const iris_mesh_corner *corner, iris_voxel at, int face)
{
    const int axis = face / 4;
    const unsigned low = iris_mesh_face_low(face);
    const unsigned solid = (corner->solid >> low & 1u) != 0 ? low : low | 1u << axis;
    for (int i = 0; i < 3; i++) {
        const int32_t corner_place = 2 * (i == 0 ? at.x : i == 1 ? at.y : at.z);
        sum->place[i] += corner_place + (i == axis ? 0 : (low >> i & 1u) != 0 ? 1 : -1);
    }
    if (m->colors) {
        add_color(sum, m,
                  (iris_voxel){at.x - 1 + (int32_t)(solid & 1u), at.y - 1 + (int32_t)(solid >> 1 & 1u),
                               at.z - 1 + (int32_t)(solid >> 2)});
    }
    sum->count++;
}

static void write_vertex(mesh *m, const face_sum *sum)
{
    const iris_voxel_world *world = m->world;
    iris_q32 place[3];
    char line[IRIS_PLY_VERTEX_CHARS + 1];
    for (int i = 0; i < 3; i++) {
        const iris_q32 least = iris_voxel_coordinate(world->least, i);
        const iris_q32 side = iris_voxel_coordinate(world->most, i) - least;
        place[i] = least + iris_wide_div_sat(iris_wide_mul(side, sum->place[i]),
                                             2 * (int64_t)world->counts[i] * sum->count);
    }
    const int32_t half = sum->count / 2;
    const iris_carve_color color = {(uint8_t)((sum->color[0] + half) / sum->count),
                                    (uint8_t)((sum->color[1] + half) / sum->count),
                                    (uint8_t)((sum->color[2] + half) / sum->count), 0};
    const char *end =
        iris_ply_put_vertex(line, (iris_vec3){place[0], place[1], place[2]}, m->colors ? &color : NULL);
    m->status = iris_sink_write(m->sink, line, (size_t)(end - line));
}

static void write_corner(mesh *m, iris_voxel at)
{
    iris_mesh_corner corner;
    iris_mesh_corner_look(&corner, m->world, at);
    for (int sheet = 0; sheet < corner.sheets && m->status == IRIS_OK; sheet++) {
        face_sum sum = {{0}, {0}, 0};
        for (int face = 0; face < 12; face++) {
            if (corner.sheet[face] == sheet) {
                add_face(&sum, m, &corner, at, face);
            }
        }
        write_vertex(m, &sum);
    }
    for (int i = 0; i < 12 && m->status == IRIS_OK; i++) { /* voxels at split edges, by axis and number */
        const int axis = i / 4, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
        const unsigned voxel = 1u << axis | (unsigned)(i & 1) << u | (unsigned)(i >> 1 & 1) << v;
        if ((corner.split >> axis & 1u) != 0 && (corner.solid >> voxel & 1u) != 0) {
            face_sum sum = {{0}, {0}, 0};
            add_face(&sum, m, &corner, at, iris_mesh_face(u, voxel & ~(1u << u)));
            add_face(&sum, m, &corner, at, iris_mesh_face(v, voxel & ~(1u << v)));
            write_vertex(m, &sum);
        }
    }
}

/* --- triangles --- */

static uint32_t first_of(const mesh *m, iris_voxel at)
{
    return m->firsts[at.z % 2][(size_t)at.y * ((size_t)m->world->counts[0] + 1) + (size_t)at.x];
}

static void write_triangle(mesh *m, const uint32_t corners[3])
{
    char line[48], *to = line;
    *to++ = '3';
    for (int i = 0; i < 3; i++) {
        *to++ = ' ';
        to = iris_ply_put_whole(to, corners[i], 1);
    }
    *to++ = '\n';
    m->status = iris_sink_write(m->sink, line, (size_t)(to - line));
}

/* A fan from one of the middles of sides, if there is any: its neighbors are not on one line with it. */
static void write_square(mesh *m, const square *s)
{
    uint32_t around[8];
    int count = 0, apex = 0;
    for (int i = 0; i < 4; i++) {
        int corner, axis;
        around[count++] = first_of(m, s->at[i]) + s->corners[i].sheet[s->face[i]];
        if (has_middle(s, i, &corner, &axis)) {
            apex = count;
            around[count++] = first_of(m, s->at[corner]) +
                              (uint32_t)iris_mesh_corner_middle(&s->corners[corner], axis, s->solid[corner]);
        }
    }
    for (int i = 1; i + 1 < count && m->status == IRIS_OK; i++) {
        const uint32_t second = around[(apex + i) % count], third = around[(apex + i + 1) % count];
        const uint32_t corners[3] = {around[apex], s->is_low ? second : third, s->is_low ? third : second};
        write_triangle(m, corners);
    }
}

/* The first vertices of a layer of corners; where the next layer's begin. */
static uint32_t number_layer(const mesh *m, int32_t z, uint32_t first)
{
    const int32_t nx = m->world->counts[0] + 1, ny = m->world->counts[1] + 1;
    for (int32_t i = 0; i < nx * ny; i++) {
        iris_mesh_corner corner;
        iris_mesh_corner_look(&corner, m->world, (iris_voxel){i % nx, i / nx, z});
        m->firsts[z % 2][i] = first;
        first += (uint32_t)iris_mesh_corner_vertices(&corner);
    }
    return first;
}

static void write_triangles(mesh *m)
{
    const int32_t nx = m->world->counts[0] + 1, ny = m->world->counts[1] + 1;
    uint32_t next = number_layer(m, 0, 0);
    for (int32_t z = 0; z <= m->world->counts[2]; z++) {
        next = z < m->world->counts[2] ? number_layer(m, z + 1, next) : next;
        for (int32_t i = 0; i < nx * ny; i++) {
            const iris_voxel at = {i % nx, i / nx, z};
            iris_mesh_corner corner;
            square s;
            iris_mesh_corner_look(&corner, m->world, at);
            for (int axis = 0; axis < 3 && m->status == IRIS_OK; axis++) {
                if (square_at(&s, m->world, &corner, at, axis)) {
                    write_square(m, &s);
                }
            }
        }
    }
}

/* --- the file --- */

static void write_text(mesh *m, const char *text, size_t length)
{
    m->status = m->status == IRIS_OK ? iris_sink_write(m->sink, text, length) : m->status;
}

static void write_number(mesh *m, int64_t number)
{
    char digits[24];
    const char *end = iris_ply_put_whole(digits, (uint64_t)number, 1);
    write_text(m, digits, (size_t)(end - digits));
}

static void write_all(mesh *m, int64_t vertices, int64_t triangles)
{
    static const char before[] = "ply\nformat ascii 1.0\nelement vertex ";
    static const char places[] = "\nproperty double x\nproperty double y\nproperty double z\n";
    static const char colors[] = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    static const char faces[] = "element face ";
    static const char behind[] = "\nproperty list uchar int vertex_indices\nend_header\n";
    write_text(m, before, sizeof before - 1);
    write_number(m, vertices);
    write_text(m, places, sizeof places - 1);
    if (m->colors) {
        write_text(m, colors, sizeof colors - 1);
    }
    write_text(m, faces, sizeof faces - 1);
    write_number(m, triangles);
    write_text(m, behind, sizeof behind - 1);
    for (int64_t i = 0; i < corner_count(m->world) && m->status == IRIS_OK; i++) {
        write_corner(m, corner_of(m->world, i));
    }
    write_triangles(m);
}

static iris_status take_memory(mesh *m, iris_scratch *scratch)
{
    size_t side = 0;
    for (int axis = 0; axis < 3; axis++) {
        side = (size_t)m->world->counts[axis] > side ? (size_t)m->world->counts[axis] : side;
    }
    uint32_t *firsts = iris_scratch_take(scratch, (side + 1) * (side + 1) * 8);
    int32_t *rows = iris_scratch_take(scratch, side * side * 4);
    if (!firsts || !rows) {
        return IRIS_ERR_SCRATCH;
    }
    m->firsts[0] = firsts;
    m->firsts[1] = firsts + (side + 1) * (side + 1);
    iris_voxel_surface_rows(rows, m->world);
    m->rows = rows;
    return IRIS_OK;
}

iris_status iris_carve_write_mesh(iris_sink sink, const iris_voxel_world *world,
                                  const iris_carve_color *colors, int32_t count, iris_scratch *scratch)
{
    mesh m = {.sink = &sink, .world = world, .colors = colors, .status = IRIS_OK};
    int64_t vertices = 0, triangles = 0;
    int32_t surface = 0;
    iris_status status = sink.write && scratch ? iris_voxel_surface(NULL, 0, &surface, world) : IRIS_ERR_ARG;
    if (status != IRIS_OK || count != (colors ? surface : 0)) {
        return IRIS_ERR_ARG;
    }
    (void)iris_carve_mesh_count(&vertices, &triangles, world);
    if (vertices > INT32_MAX || triangles > INT32_MAX) {
        return IRIS_ERR_RANGE;
    }
    const size_t mark = iris_scratch_mark(scratch);
    status = take_memory(&m, scratch);
    if (status == IRIS_OK) {
        write_all(&m, vertices, triangles);
        status = m.status;
    }
    iris_scratch_release(scratch, mark);
    return status;
}
