#include "walls.h"

#include <math.h>

#define PI       3.14159265358979323846
#define HITS_MAX 6 /* walls behind each other that a column looks at */
#define FINE     2 /* columns that are looked along, to a pixel */

#define FOCAL    104.25 /* pixels: 75 degrees */
#define BASELINE 150.0
#define HEIGHT   300.0
#define AHEAD    120.0
#define TILT     (8 * PI / 180)

const sim_solid sim_solids[] = {
    {{{-1537, -1223}, {4663, -1223}, {4663, 3377}, {-1537, 3377}}, 4, 900}, /* the room */
    {{{463, 477}, {2463, 377}, {2463, 1477}, {463, 1477}}, 4, 900},         /* a block to drive around */
    {{{-1537, 1750}, {-620, 1990}, {-635, 2040}, {-1537, 1800}}, 4, 900}, /* walls that stand into the room */
    {{{1440, 3377}, {1440, 2690}, {1490, 2690}, {1490, 3377}}, 4, 900},
    {{{1000, -1223}, {1000, -860}, {1050, -860}, {1050, -1223}}, 4, 900},
    {{{3850, -640}, {4250, -640}, {4250, -240}, {3850, -240}}, 4, 250}, /* boxes */
    {{{-500, -960}, {-197, -785}, {-322, -568}, {-625, -743}}, 4, 220},
    {{{2150, 2750}, {2500, 2750}, {2500, 3000}, {2150, 3000}}, 4, 180},
    {{{4010, 2500},
      {3951, 2641},
      {3810, 2700},
      {3669, 2641},
      {3610, 2500},
      {3669, 2359},
      {3810, 2300},
      {3951, 2359}},
     8,
     900}, /* a pillar */
};
const int sim_solid_count = sizeof sim_solids / sizeof sim_solids[0];

const double sim_way[][2] = {{-400, -150}, {600, -330},  {1900, -330}, {3150, -150}, {3250, 1000},
                             {2950, 2050}, {1500, 2150}, {-150, 2200}, {-500, 1200}};
const int sim_way_points = sizeof sim_way / sizeof sim_way[0];

double sim_gauss(sim_random *random)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        sum += sim_random_next(random) / 4294967296.0;
    }
    return sum;
}

static int is_in(const sim_solid *solid, double x, double y)
{
    int in = 0;
    for (int i = 0; i < solid->corners; i++) {
        const double *a = solid->corner[i], *b = solid->corner[(i + 1) % solid->corners];
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])) {
            in = !in;
        }
    }
    return in;
}

int sim_is_free(double x, double y)
{
    int is_free = is_in(&sim_solids[0], x, y);
    for (int i = 1; i < sim_solid_count; i++) {
        is_free = is_free && !is_in(&sim_solids[i], x, y);
    }
    return is_free;
}

double sim_wall_distance(double x, double y)
{
    double nearest = 1e9;
    for (int s = 0; s < sim_solid_count; s++) {
        for (int i = 0; i < sim_solids[s].corners; i++) {
            const double *a = sim_solids[s].corner[i],
                         *b = sim_solids[s].corner[(i + 1) % sim_solids[s].corners];
            const double dx = b[0] - a[0], dy = b[1] - a[1];
            const double along = fmax(0, fmin(1, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy)));
            nearest = fmin(nearest, hypot(x - a[0] - along * dx, y - a[1] - along * dy));
        }
    }
    return nearest;
}

iris_depth_camera sim_depth_camera(void)
{
    iris_depth_camera camera;
    iris_depth_camera_defaults(&camera, (iris_size){SIM_DEPTH_W, SIM_DEPTH_H}, (iris_q16)(FOCAL * 65536),
                               (iris_q16)(BASELINE * 65536));
    camera.mount = (iris_map_pose){(int32_t)AHEAD, 0, 0};
    camera.height_mm = (int32_t)HEIGHT;
    camera.tilt = iris_angle_from_degrees(8);
    return camera;
}

/* The walls along a column of a level camera, the nearest first: how far ahead, and how high. */
typedef struct {
    double ahead[HITS_MAX], height[HITS_MAX];
    int solid[HITS_MAX];
    int count;
} column_view;

static void keep_hit(column_view *view, double ahead, int solid)
{
    int at = view->count < HITS_MAX ? view->count++ : HITS_MAX - 1;
    if (view->count == HITS_MAX && at == HITS_MAX - 1 && view->ahead[at] > 0 && view->ahead[at] < ahead) {
        return;
    }
    for (; at > 0 && view->ahead[at - 1] > ahead; at--) {
        view->ahead[at] = view->ahead[at - 1];
        view->height[at] = view->height[at - 1];
        view->solid[at] = view->solid[at - 1];
    }
    view->ahead[at] = ahead;
    view->height[at] = sim_solids[solid].height;
    view->solid[at] = solid;
}

/* Looks from (x, y) along (dx, dy), which is 1 ahead. */
static column_view look_along(double x, double y, double dx, double dy)
{
    column_view view = {{0}, {0}, {0}, 0};
    for (int s = 0; s < sim_solid_count; s++) {
        const sim_solid *solid = &sim_solids[s];
        for (int i = 0; i < solid->corners; i++) {
            const double *a = solid->corner[i], *b = solid->corner[(i + 1) % solid->corners];
            const double wx = b[0] - a[0], wy = b[1] - a[1], across = dx * wy - dy * wx;
            const double ahead = ((a[0] - x) * wy - (a[1] - y) * wx) / across;
            const double along = ((a[0] - x) * dy - (a[1] - y) * dx) / across;
            if (across != 0 && ahead > 1 && along >= 0 && along <= 1) {
                keep_hit(&view, ahead, s);
            }
        }
    }
    return view;
}

double sim_wall_ahead(double at[2], sim_pose robot, double left)
{
    const double c = cos(robot.heading), s = sin(robot.heading), x = robot.x + AHEAD * c,
                 y = robot.y + AHEAD * s, dx = c - left * s, dy = s + left * c;
    const column_view view = look_along(x, y, dx, dy);
    at[0] = x + view.ahead[0] * dx;
    at[1] = y + view.ahead[0] * dy;
    return view.ahead[0];
}

/* The depth of a pixel that looks `down` for each unit of depth, and comes `ahead`; 0: nothing is there. */
static double depth_of(const column_view *view, double ahead, double down)
{
    const double floor_depth = down > 1e-9 ? HEIGHT / down : 0;
    for (int i = 0; i < view->count; i++) {
        const double z = view->ahead[i] / ahead, height = HEIGHT - z * down;
        if (i > 0 && view->solid[i] == view->solid[i - 1] && height < view->height[i]) {
            return (HEIGHT - view->height[i]) / down; /* came in above it, and goes out below: its top */
        }
        if (height >= 0 && height <= view->height[i]) {
            return z;
        }
        if (height < 0) {
            break;
        }
    }
    return floor_depth;
}

static void erase(uint16_t *disparity, sim_random *random)
{
    const int x0 = (int)(sim_random_next(random) % SIM_DEPTH_W), w = 5 + (int)(sim_random_next(random) % 15);
    const int y0 = (int)(sim_random_next(random) % SIM_DEPTH_H), h = 5 + (int)(sim_random_next(random) % 30);
    for (int y = y0; y < y0 + h && y < SIM_DEPTH_H; y++) {
        for (int x = x0; x < x0 + w && x < SIM_DEPTH_W; x++) {
            disparity[y * SIM_DEPTH_W + x] = 0;
        }
    }
}

void sim_depth_render(uint16_t *disparity, sim_random *random, sim_pose robot)
{
    static column_view columns[SIM_DEPTH_W * FINE * 2];
    const int middle = SIM_DEPTH_W * FINE; /* twice as wide as the picture */
    const double c = cos(robot.heading), s = sin(robot.heading), x = robot.x + AHEAD * c,
                 y = robot.y + AHEAD * s;
    for (int i = 0; i < 2 * middle; i++) {
        const double left = (middle - i) / (double)FINE / FOCAL;
        columns[i] = look_along(x, y, c - left * s, s + left * c);
    }
    for (int v = 0; v < SIM_DEPTH_H; v++) {
        const double below = (v - (SIM_DEPTH_H - 1) / 2.0) / FOCAL;
        const double ahead = cos(TILT) - below * sin(TILT), down = sin(TILT) + below * cos(TILT);
        for (int u = 0; u < SIM_DEPTH_W; u++) {
            const int column = (int)lround(middle + FINE * (u - (SIM_DEPTH_W - 1) / 2.0) / ahead);
            const double z = depth_of(&columns[column], ahead, down);
            const double d = 256 * (FOCAL * BASELINE / z + SIM_DISPARITY_NOISE * sim_gauss(random));
            const uint32_t luck = sim_random_next(random) % 1000;
            disparity[v * SIM_DEPTH_W + u] = (uint16_t)(luck < 80 || z <= 0 || d < 1 ? 0
                                                        : luck < 85 ? 256 + sim_random_next(random) % 12000
                                                                    : fmin(d, 65535));
        }
    }
    for (int i = 0; i < 8; i++) {
        erase(disparity, random);
    }
}
