/* The surface of a world of voxels as a PLY file. */
#include "iris/3d/carve.h"
#include "voxel_parts.h"

#define DECIMALS 9

/* Writes digits of n, at least `least` of them; where they end. */
static char *put_whole(char *to, uint64_t n, int least)
{
    char digits[20];
    int count = 0;
    do {
        digits[count++] = (char)('0' + n % 10);
        n /= 10;
    } while (n > 0 || count < least);
    while (count > 0) {
        *to++ = digits[--count];
    }
    return to;
}

/* 21 characters at most. */
static char *put_number(char *to, iris_q32 a)
{
    const uint64_t scale = 1000000000, size = a < 0 ? 0u - (uint64_t)a : (uint64_t)a;
    uint64_t whole = size >> 32, fraction = ((size & UINT32_MAX) * scale + ((uint64_t)1 << 31)) >> 32;
    whole += fraction == scale;
    fraction = fraction == scale ? 0 : fraction;
    if (a < 0 && (whole | fraction) != 0) {
        *to++ = '-';
    }
    to = put_whole(to, whole, 1);
    *to++ = '.';
    return put_whole(to, fraction, DECIMALS);
}

static iris_status write_head(const iris_sink *sink, int32_t vertices)
{
    static const char before[] = "ply\nformat ascii 1.0\nelement vertex ";
    static const char behind[] = "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
    char count[24];
    const char *end = put_whole(count, (uint64_t)vertices, 1);
    iris_status status = iris_sink_write(sink, before, sizeof before - 1);
    status = status == IRIS_OK ? iris_sink_write(sink, count, (size_t)(end - count)) : status;
    return status == IRIS_OK ? iris_sink_write(sink, behind, sizeof behind - 1) : status;
}

static iris_status write_vertex(const iris_sink *sink, const iris_voxel_world *world, iris_voxel voxel)
{
    char line[72];
    iris_vec3 center;
    (void)iris_voxel_center(&center, world, voxel);
    char *to = put_number(line, center.x);
    *to++ = ' ';
    to = put_number(to, center.y);
    *to++ = ' ';
    to = put_number(to, center.z);
    *to++ = '\n';
    return iris_sink_write(sink, line, (size_t)(to - line));
}

static iris_status write_row(const iris_sink *sink, const iris_voxel_world *world, int32_t y, int32_t z)
{
    uint32_t surface[IRIS_VOXEL_ROW_WORDS(IRIS_VOXEL_SIDE_MAX)] = {0};
    iris_status status = iris_voxel_surface_row(surface, world, y, z);
    for (int32_t x = 0; x < world->counts[0] && status == IRIS_OK; x++) {
        if ((surface[x / 32] >> (x % 32) & 1u) != 0) {
            status = write_vertex(sink, world, (iris_voxel){x, y, z});
        }
    }
    return status;
}

iris_status iris_carve_write_ply(iris_sink sink, const iris_voxel_world *world)
{
    int32_t vertices = 0;
    iris_status status = sink.write ? iris_voxel_surface(NULL, 0, &vertices, world) : IRIS_ERR_ARG;
    status = status == IRIS_OK ? write_head(&sink, vertices) : status;
    for (int32_t z = 0; status == IRIS_OK && z < world->counts[2]; z++) {
        for (int32_t y = 0; status == IRIS_OK && y < world->counts[1]; y++) {
            status = write_row(&sink, world, y, z);
        }
    }
    return status;
}
