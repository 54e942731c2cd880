/* The surface of a world of voxels as a PLY file. */
#include "iris/3d/carve.h"
#include "iris/3d/carve_photo.h"
#include "ply_text.h"
#include "voxel_parts.h"

static iris_status write_head(const iris_sink *sink, int32_t vertices, int colored)
{
    static const char before[] = "ply\nformat ascii 1.0\nelement vertex ";
    static const char places[] = "\nproperty double x\nproperty double y\nproperty double z\n";
    static const char colors[] = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    static const char behind[] = "end_header\n";
    char count[24];
    const char *end = iris_ply_put_whole(count, (uint64_t)vertices, 1);
    iris_status status = iris_sink_write(sink, before, sizeof before - 1);
    status = status == IRIS_OK ? iris_sink_write(sink, count, (size_t)(end - count)) : status;
    status = status == IRIS_OK ? iris_sink_write(sink, places, sizeof places - 1) : status;
    status = status == IRIS_OK && colored ? iris_sink_write(sink, colors, sizeof colors - 1) : status;
    return status == IRIS_OK ? iris_sink_write(sink, behind, sizeof behind - 1) : status;
}

/* *color: of the row's first vertex, and then of the next row's; null: without colors. */
static iris_status write_row(const iris_sink *sink, const iris_voxel_world *world, iris_voxel first,
                             const iris_carve_color **color)
{
    uint32_t surface[IRIS_VOXEL_ROW_WORDS(IRIS_VOXEL_SIDE_MAX)] = {0};
    iris_status status = iris_voxel_surface_row(surface, world, first.y, first.z);
    for (int32_t x = 0; x < world->counts[0] && status == IRIS_OK; x++) {
        if ((surface[x / 32] >> (x % 32) & 1u) != 0) {
            char line[IRIS_PLY_VERTEX_CHARS + 1];
            iris_vec3 center;
            (void)iris_voxel_center(&center, world, (iris_voxel){x, first.y, first.z});
            const char *end = iris_ply_put_vertex(line, center, *color);
            status = iris_sink_write(sink, line, (size_t)(end - line));
            *color = *color ? *color + 1 : NULL;
        }
    }
    return status;
}

static iris_status write_vertices(const iris_sink *sink, const iris_voxel_world *world,
                                  const iris_carve_color *colors)
{
    iris_status status = IRIS_OK;
    for (int32_t z = 0; status == IRIS_OK && z < world->counts[2]; z++) {
        for (int32_t y = 0; status == IRIS_OK && y < world->counts[1]; y++) {
            status = write_row(sink, world, (iris_voxel){0, y, z}, &colors);
        }
    }
    return status;
}

iris_status iris_carve_write_ply(iris_sink sink, const iris_voxel_world *world)
{
    int32_t vertices = 0;
    iris_status status = sink.write ? iris_voxel_surface(NULL, 0, &vertices, world) : IRIS_ERR_ARG;
    status = status == IRIS_OK ? write_head(&sink, vertices, 0) : status;
    return status == IRIS_OK ? write_vertices(&sink, world, NULL) : status;
}

iris_status iris_carve_write_colored_ply(iris_sink sink, const iris_voxel_world *world,
                                         const iris_carve_color *colors, int32_t count)
{
    int32_t vertices = 0;
    iris_status status = sink.write && colors ? iris_voxel_surface(NULL, 0, &vertices, world) : IRIS_ERR_ARG;
    status = status == IRIS_OK && vertices != count ? IRIS_ERR_ARG : status;
    status = status == IRIS_OK ? write_head(&sink, vertices, 1) : status;
    return status == IRIS_OK ? write_vertices(&sink, world, colors) : status;
}
