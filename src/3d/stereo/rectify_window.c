#include "rectify_window.h"

#define SAMPLES  IRIS_RECTIFY_SAMPLES
#define SIDE     (SAMPLES / 4)
#define BESIDE   4                   /* the axis, in focal lengths */
#define HALVINGS 8                   /* on the way from the picture's middle to its edge */
#define CELLS    16                  /* of the first search, a side */
#define FINER    12                  /* halvings of its step */
#define LONGEST  ((iris_q32)1 << 52) /* focal length */

/* Place number i of the edge, clockwise from the top left corner. */
static iris_vec2 edge_pixel(iris_size size, int i)
{
    const iris_q32 right = (size.w - 1) * IRIS_Q32_ONE, down = (size.h - 1) * IRIS_Q32_ONE;
    const iris_q32 x = right / SIDE * (i % SIDE), y = down / SIDE * (i % SIDE);
    switch (i / SIDE) {
    case 0:
        return (iris_vec2){x, 0};
    case 1:
        return (iris_vec2){right, y};
    case 2:
        return (iris_vec2){right - x, down};
    default:
        return (iris_vec2){0, down - y};
    }
}

/* Where the views see what the camera sees at the pixel. */
static int place_of(iris_plane_place *place, const iris_sensor *camera, const iris_mat3 *turn,
                    iris_vec2 pixel)
{
    iris_vec2 seen, straight;
    if (iris_intrinsics_plane(&seen, &camera->intrinsics, pixel) != IRIS_OK ||
        iris_lens_straighten(&straight, &camera->lens, seen) != IRIS_OK) {
        return 0;
    }
    const iris_vec3 at = iris_mat3_vector(turn, (iris_vec3){straight.x, straight.y, IRIS_Q32_ONE});
    const iris_q32 x = iris_q32_div_sat(at.x, at.z), y = iris_q32_div_sat(at.y, at.z);
    if (at.z <= 0 || x > BESIDE * IRIS_Q32_ONE || x < -BESIDE * IRIS_Q32_ONE || y > BESIDE * IRIS_Q32_ONE ||
        y < -BESIDE * IRIS_Q32_ONE) {
        return 0;
    }
    *place = (iris_plane_place){(int32_t)(x >> 8), (int32_t)(y >> 8)};
    return 1;
}

/* The place at the pixel, or as near to it as can be on the way from the middle. */
static int place_towards(iris_plane_place *place, const iris_sensor *camera, const iris_mat3 *turn,
                         const iris_vec2 middle_pixel[2])
{
    const iris_vec2 middle = middle_pixel[0], pixel = middle_pixel[1];
    int found = place_of(place, camera, turn, pixel), share = 0;
    for (int step = 1 << (HALVINGS - 1); step > 0 && !found; step >>= 1) {
        iris_vec2 at = {middle.x + ((pixel.x - middle.x) >> HALVINGS) * (share + step),
                        middle.y + ((pixel.y - middle.y) >> HALVINGS) * (share + step)};
        share += place_of(place, camera, turn, at) ? step : 0;
    }
    return found || share > 0;
}

int iris_rectify_outline(iris_plane_place *outline, const iris_sensor *camera, const iris_mat3 *turn,
                         iris_size size)
{
    int good = 1;
    const iris_vec2 middle = {(size.w - 1) * (IRIS_Q32_ONE / 2), (size.h - 1) * (IRIS_Q32_ONE / 2)};
    for (int i = 0; i < SAMPLES && good; i++) {
        const iris_vec2 way[2] = {middle, edge_pixel(size, i)};
        good = place_towards(&outline[i], camera, turn, way);
    }
    return good;
}

/* Is the place within the outline? A ray to the right crosses it an odd number of times. */
static int is_inside(iris_plane_place p, const iris_plane_place *outline)
{
    int inside = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const iris_plane_place a = outline[i], b = outline[(i + 1) % SAMPLES];
        if ((a.y > p.y) != (b.y > p.y)) {
            int64_t side = (int64_t)(b.x - a.x) * (p.y - a.y) - (int64_t)(p.x - a.x) * (b.y - a.y);
            inside ^= (side > 0) == (b.y > a.y);
        }
    }
    return inside;
}

/* By how much a window around p with the sides of `size` is larger or smaller than one that reaches to q. */
static int64_t reach(iris_plane_place p, iris_plane_place q, iris_size size)
{
    int64_t x = (int64_t)q.x - p.x, y = (int64_t)q.y - p.y;
    x = (x < 0 ? -x : x) * (size.h - 1);
    y = (y < 0 ? -y : y) * (size.w - 1);
    return x > y ? x : y;
}

static int64_t smaller(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t larger(int64_t a, int64_t b)
{
    return a > b ? a : b;
}

/* Where a diagonal of the window around p, along (right, down), goes through the outline from a to b: how far the window
 * may reach for that. INT64_MAX: it does not. */
static int64_t corner_reach(iris_plane_place p, iris_plane_place a, iris_plane_place b, iris_size way,
                            iris_size size)
{
    const int64_t from = ((int64_t)way.w * (a.y - p.y) - (int64_t)way.h * (a.x - p.x)) >> 14;
    const int64_t to = ((int64_t)way.w * (b.y - p.y) - (int64_t)way.h * (b.x - p.x)) >> 14;
    if (from == to || (from > 0) == (to > 0)) {
        return INT64_MAX;
    }
    const iris_plane_place q = {(int32_t)(a.x + (b.x - a.x) * from / (from - to)),
                                (int32_t)(a.y + (b.y - a.y) * from / (from - to))};
    return reach(p, q, size);
}

/* The largest window around p that is within both outlines: it reaches to none of their places, and its corners to none
 * of the lines between these. */
static int64_t room_around(iris_plane_place p, iris_plane_place *const outlines[2], iris_size size)
{
    int64_t least = INT64_MAX;
    for (int k = 0; k < 2; k++) {
        if (!is_inside(p, outlines[k])) {
            return 0;
        }
        for (int i = 0; i < SAMPLES; i++) {
            const iris_plane_place a = outlines[k][i], b = outlines[k][(i + 1) % SAMPLES];
            const iris_size rising = {size.w - 1, 1 - size.h}, falling = {size.w - 1, size.h - 1};
            least = smaller(least, reach(p, a, size));
            least = smaller(least, corner_reach(p, a, b, rising, size));
            least = smaller(least, corner_reach(p, a, b, falling, size));
        }
    }
    return least;
}

typedef struct {
    int64_t left, top, right, bottom;
} box;

static box box_of(const iris_plane_place *outline)
{
    box b = {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN};
    for (int i = 0; i < SAMPLES; i++) {
        const iris_plane_place p = outline[i];
        b.left = p.x < b.left ? p.x : b.left;
        b.right = p.x > b.right ? p.x : b.right;
        b.top = p.y < b.top ? p.y : b.top;
        b.bottom = p.y > b.bottom ? p.y : b.bottom;
    }
    return b;
}

/* The window with most room: among the middles of 16 x 16 cells of what both boxes have in common, and from there in
 * ever smaller steps. Returns its reach; 0: there is none. */
static int64_t valid_window(iris_plane_place *middle, iris_plane_place *const outlines[2], iris_size size)
{
    const box a = box_of(outlines[0]), b = box_of(outlines[1]);
    const box both = {larger(a.left, b.left), larger(a.top, b.top), smaller(a.right, b.right),
                      smaller(a.bottom, b.bottom)};
    int64_t w = both.right - both.left, h = both.bottom - both.top, most = 0;
    for (int i = 0; i < CELLS * CELLS && w > 0 && h > 0; i++) {
        iris_plane_place p = {(int32_t)(both.left + w * (2 * (i % CELLS) + 1) / (2 * CELLS)),
                              (int32_t)(both.top + h * (2 * (i / CELLS) + 1) / (2 * CELLS))};
        int64_t room = room_around(p, outlines, size);
        if (room > most) {
            most = room;
            *middle = p;
        }
    }
    for (int bits = 5; bits < 5 + FINER && most > 0; bits++) {
        const iris_plane_place from = *middle;
        for (int i = 0; i < 9; i++) {
            iris_plane_place p = {(int32_t)(from.x + (w >> bits) * (i % 3 - 1)),
                                  (int32_t)(from.y + (h >> bits) * (i / 3 - 1))};
            int64_t room = room_around(p, outlines, size);
            if (room > most) {
                most = room;
                *middle = p;
            }
        }
    }
    return most;
}

/* The window that has all of both outlines in it. */
static int64_t whole_window(iris_plane_place *middle, iris_plane_place *const outlines[2], iris_size size)
{
    const box a = box_of(outlines[0]), b = box_of(outlines[1]);
    const box all = {smaller(a.left, b.left), smaller(a.top, b.top), larger(a.right, b.right),
                     larger(a.bottom, b.bottom)};
    const iris_plane_place corner = {(int32_t)all.left, (int32_t)all.top};
    *middle =
        (iris_plane_place){(int32_t)((all.left + all.right) / 2), (int32_t)((all.top + all.bottom) / 2)};
    return reach(*middle, corner, size);
}

int iris_rectify_window(iris_intrinsics *made, iris_plane_place *const outlines[2], iris_size size,
                        iris_rectify_keep keep)
{
    iris_plane_place middle = {0, 0};
    const int64_t most = keep == IRIS_RECTIFY_ALL ? whole_window(&middle, outlines, size)
                                                  : valid_window(&middle, outlines, size);
    if (most <= 0) {
        return 0;
    }
    /* half a side of the window is most / 2^24 / the other side, in focal lengths */
    const iris_wide area = iris_wide_mul((int64_t)(size.w - 1) * (size.h - 1), (int64_t)1 << 55);
    const iris_q32 focal = iris_wide_div_sat(area, most);
    if (focal > LONGEST) {
        return 0;
    }
    const iris_q32 right = iris_wide_round_shift_sat(iris_wide_mul(focal, middle.x), 24);
    const iris_q32 down = iris_wide_round_shift_sat(iris_wide_mul(focal, middle.y), 24);
    *made = (iris_intrinsics){focal, focal, 0, (size.w - 1) * (IRIS_Q32_ONE / 2) - right,
                              (size.h - 1) * (IRIS_Q32_ONE / 2) - down};
    return 1;
}
