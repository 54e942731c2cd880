#include "iris/3d/triangulate.h"

#include "../../foundation/triangle.h"

#define UNIT     ((iris_q32)1 << 20) /* 2^-12: so far may a direction's length be off 1 */
#define FARTHEST ((iris_q32)1 << 60)
#define NEAREST  ((iris_q32)1 << 16) /* of the rays' origins to each other */
#define PARALLEL ((iris_q32)1 << 18) /* a sine of 2^-14 */

static int is_near(iris_vec3 p)
{
    return p.x <= FARTHEST && p.x >= -FARTHEST && p.y <= FARTHEST && p.y >= -FARTHEST && p.z <= FARTHEST &&
           p.z >= -FARTHEST;
}

static int is_unit(iris_vec3 direction)
{
    const iris_q32 length = iris_vec3_length(direction);
    return length > IRIS_Q32_ONE - UNIT && length < IRIS_Q32_ONE + UNIT;
}

/* How far the rays' origins are from the first one, and the largest sine between it and the others. */
static iris_triangulation_flaw spread(iris_q32 *apart, const iris_line3 *rays, int32_t count)
{
    iris_q32 sine = 0;
    *apart = 0;
    for (int32_t i = 1; i < count; i++) {
        iris_q32 from = iris_vec3_length(iris_vec3_sub(rays[i].origin, rays[0].origin));
        iris_q32 turned = iris_vec3_length(iris_vec3_cross(rays[i].direction, rays[0].direction));
        *apart = from > *apart ? from : *apart;
        sine = turned > sine ? turned : sine;
    }
    return *apart < NEAREST  ? IRIS_TRIANGULATION_ONE_PLACE
           : sine < PARALLEL ? IRIS_TRIANGULATION_PARALLEL
                             : IRIS_TRIANGULATION_FINE;
}

/* What a ray says of the point, with places as shares of `unit` from the first origin: across its direction they are
 * the same. */
static void add_ray(const iris_triangle *triangle, const iris_line3 *ray, iris_vec3 from, iris_q32 unit)
{
    const iris_vec3 way = iris_vec3_sub(ray->origin, from);
    const iris_q32 d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const iris_q32 place[3] = {iris_q32_div_sat(way.x, unit), iris_q32_div_sat(way.y, unit),
                               iris_q32_div_sat(way.z, unit)};
    for (int i = 0; i < 3; i++) {
        iris_q32 row[4];
        iris_wide right = {0, 0};
        for (int k = 0; k < 3; k++) {
            row[k] = (i == k ? IRIS_Q32_ONE : 0) - iris_q32_mul_sat(d[i], d[k]);
            right = iris_wide_add(right, iris_wide_mul(row[k], place[k]));
        }
        row[3] = iris_wide_round_shift_sat(right, 32);
        iris_triangle_add(triangle, row);
    }
}

static iris_triangulation_flaw triangulate(iris_triangulation *made, const iris_line3 *rays, int32_t count)
{
    iris_q32 numbers[IRIS_TRIANGLE_NUMBERS(3)], p[3], unit;
    iris_triangle triangle;
    iris_triangulation_flaw flaw = spread(&unit, rays, count);
    if (flaw != IRIS_TRIANGULATION_FINE) {
        return flaw;
    }
    iris_triangle_init(&triangle, numbers, 3);
    for (int32_t i = 0; i < count; i++) {
        add_ray(&triangle, &rays[i], rays[0].origin, unit);
    }
    if (!iris_triangle_solve(p, &triangle, 1)) {
        return IRIS_TRIANGULATION_PARALLEL;
    }
    made->point = iris_vec3_add(rays[0].origin, iris_vec3_scale((iris_vec3){p[0], p[1], p[2]}, unit));
    for (int32_t i = 0; i < count; i++) {
        const iris_vec3 way = iris_vec3_sub(made->point, rays[i].origin);
        const iris_q32 off = iris_line3_distance(&rays[i], made->point);
        made->off = off > made->off ? off : made->off;
        if (iris_vec3_dot(way, rays[i].direction) <= 0) {
            made->flawed = i;
            return IRIS_TRIANGULATION_BEHIND;
        }
    }
    return IRIS_TRIANGULATION_FINE;
}

iris_status iris_triangulate(iris_triangulation *made, const iris_line3 *rays, int32_t count)
{
    if (!made || !rays) {
        return IRIS_ERR_ARG;
    }
    if (count < 2) {
        return IRIS_ERR_RANGE;
    }
    for (int32_t i = 0; i < count; i++) {
        if (!is_near(rays[i].origin) || !is_unit(rays[i].direction)) {
            return IRIS_ERR_RANGE;
        }
    }
    *made = (iris_triangulation){.flawed = -1};
    made->flaw = triangulate(made, rays, count);
    return made->flaw == IRIS_TRIANGULATION_FINE ? IRIS_OK : IRIS_ERR_DATA;
}
