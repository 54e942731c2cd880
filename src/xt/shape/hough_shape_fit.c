/* Hypotheses of a shape, fitted to edge points: each outline point is drawn to the nearest edge point of its direction,
 * across the edge only, as edge points along it are as good (Y. Chen and G. Medioni 1992). Least squares with four
 * unknowns: right, down, turn, and scale, the last two as what they move at the outline's farthest point, so that all
 * are pixels.
 */
#include "hough_shape_parts.h"

#define LIKE     4096 /* edges whose directions differ by less than 22.5 degrees are alike */
#define EXACT    (LIKE / 2)
#define UNKNOWNS 4

static int32_t index_cell(const iris_hough_shape *shape, int32_t x, int32_t y)
{
    return (y >> INDEX_SHIFT) * shape->indexes_w + (x >> INDEX_SHIFT);
}

void iris_hough_shape_index(const iris_hough_shape *shape, const iris_edge_point *points, int32_t count)
{
    int32_t cells = shape->indexes_w * shape->indexes_h, *first = shape->first;
    for (int32_t i = 0; i <= cells; i++) {
        first[i] = 0;
    }
    for (int32_t i = 0; i < count; i++) {
        first[index_cell(shape, points[i].x, points[i].y)]++;
    }
    for (int32_t i = 1; i <= cells; i++) {
        first[i] += first[i - 1];
    }
    for (int32_t i = count - 1; i >= 0; i--) {
        int32_t at = --first[index_cell(shape, points[i].x, points[i].y)];
        shape->edges[at] = (iris_hough_shape_edge){points[i].x, points[i].y, points[i].angle, 0};
    }
}

static int32_t limit(int32_t value, int32_t low, int32_t high)
{
    return value < low ? low : value > high ? high : value;
}

/* An outline point in the picture, and an edge point near it. */
typedef struct {
    int32_t from_x, from_y; /* seen from the reference point, pixels, 4 fraction bits */
    int32_t x_q4, y_q4;
    int32_t normal_x, normal_y; /* 10 fraction bits */
    iris_angle angle;
    int32_t reach2;  /* squared distance that an edge point must fall below; then that of the nearest */
    int32_t nearest; /* -1: none */
    int32_t dx_q4, dy_q4;
    int32_t unlike; /* how many edge points of other directions are within reach */
} pair;

static int is_alike(iris_angle a, iris_angle b)
{
    return (uint16_t)((uint32_t)(uint16_t)a - (uint32_t)(uint16_t)b + LIKE) < 2 * LIKE;
}

static void search_cells(pair *p, const iris_hough_shape *shape, int32_t from, int32_t to)
{
    for (int32_t i = shape->first[from]; i < shape->first[to + 1]; i++) {
        const iris_hough_shape_edge *edge = &shape->edges[i];
        int32_t dx = edge->x * 16 - p->x_q4, dy = edge->y * 16 - p->y_q4;
        if (dx * dx + dy * dy >= p->reach2 || edge->is_used) {
            continue;
        }
        if (is_alike(edge->angle, p->angle)) {
            p->reach2 = dx * dx + dy * dy;
            p->nearest = i;
            p->dx_q4 = dx;
            p->dy_q4 = dy;
        } else {
            p->unlike++;
        }
    }
}

/* Cells of edge points, the last ones included. */
typedef struct {
    int32_t left, right, top, bottom;
} cells;

/* Those within reach; 0: none. */
static int cells_near(cells *c, const iris_hough_shape *shape, const pair *p, int32_t reach_q4)
{
    int32_t right = (shape->size.w - 1) * 16, bottom = (shape->size.h - 1) * 16;
    *c = (cells){limit(p->x_q4 - reach_q4, 0, right) >> (4 + INDEX_SHIFT),
                 limit(p->x_q4 + reach_q4, 0, right) >> (4 + INDEX_SHIFT),
                 limit(p->y_q4 - reach_q4, 0, bottom) >> (4 + INDEX_SHIFT),
                 limit(p->y_q4 + reach_q4, 0, bottom) >> (4 + INDEX_SHIFT)};
    return p->x_q4 >= -reach_q4 && p->y_q4 >= -reach_q4 && p->x_q4 <= right + reach_q4 &&
           p->y_q4 <= bottom + reach_q4;
}

/* The nearest edge point of like direction within less than reach_q4. */
static void find_nearest(pair *p, const iris_hough_shape *shape, int32_t reach_q4)
{
    cells c;
    p->reach2 = reach_q4 * reach_q4;
    p->nearest = -1;
    p->unlike = 0;
    if (cells_near(&c, shape, p, reach_q4)) {
        for (int32_t row = c.top; row <= c.bottom; row++) {
            search_cells(p, shape, row * shape->indexes_w + c.left, row * shape->indexes_w + c.right);
        }
    }
}

/* A place as matrices. */
typedef struct {
    iris_hough_shape_turn turn, rotation;
    int32_t x_q4, y_q4, angle;
} frame;

static frame frame_of(const iris_hough_shape_place *place)
{
    return (frame){turn_of(place->angle, place->scale_q16), turn_of(place->angle, IRIS_Q16_ONE),
                   (int32_t)iris_round_shift(place->x_q16, 12), (int32_t)iris_round_shift(place->y_q16, 12),
                   place->angle + (place->is_reversed ? 32768 : 0)};
}

/* An outline point in the picture. */
static void lay(pair *p, const iris_hough_shape *shape, const frame *f, int32_t index)
{
    const iris_hough_shape_entry *entry = &shape->turned[index];
    turn_entry(&p->from_x, &p->from_y, shape->table, index, f->turn);
    p->x_q4 = p->from_x + f->x_q4;
    p->y_q4 = p->from_y + f->y_q4;
    p->angle = iris_angle_wrap((int32_t)table_u16(table_entry(shape->table, index), 4) + f->angle);
    p->normal_x = (entry->normal_x * f->rotation.c - entry->normal_y * f->rotation.s) >> 18;
    p->normal_y = (entry->normal_x * f->rotation.s + entry->normal_y * f->rotation.c) >> 18;
}

/* How far across the edge the nearest edge point is. */
static int32_t distance_across(const pair *p)
{
    return (p->normal_x * p->dx_q4 + p->normal_y * p->dy_q4) >> 10;
}

/* Sums for least squares: of products of the derivatives, 20 fraction bits, and with the distances, 14. */
typedef struct {
    int64_t products[UNKNOWNS][UNKNOWNS];
    int64_t sides[UNKNOWNS];
} equations;

static void add_pair(equations *e, const int32_t derivatives[UNKNOWNS], int32_t distance_q4, int32_t weight)
{
    for (int i = 0; i < UNKNOWNS; i++) {
        int64_t weighted = (int64_t)derivatives[i] * weight;
        e->sides[i] += weighted * distance_q4;
        for (int j = i; j < UNKNOWNS; j++) {
            e->products[i][j] += weighted * derivatives[j];
        }
    }
}

/* Gauss elimination of the symmetric equations; what the outline does not decide stays near 0, as each unknown is held
 * by 1/64 of the weight. solution: pixels, 16 fraction bits. */
static void solve(int32_t solution[UNKNOWNS], equations *e, int64_t weights)
{
    for (int i = 0; i < UNKNOWNS; i++) {
        e->products[i][i] += (weights << 14) + 1;
    }
    for (int k = 0; k < UNKNOWNS; k++) { /* what remains of the diagonal is not below 1/64 of the weight */
        for (int i = k + 1; i < UNKNOWNS; i++) {
            int64_t factor = e->products[k][i] * 65536 / e->products[k][k];
            for (int j = i; j < UNKNOWNS; j++) {
                e->products[i][j] -= iris_round_shift(factor * e->products[k][j], 16);
            }
            e->sides[i] -= iris_round_shift(factor * e->sides[k], 16);
        }
    }
    for (int k = UNKNOWNS - 1; k >= 0; k--) {
        int64_t rest = e->sides[k];
        for (int j = k + 1; j < UNKNOWNS; j++) {
            rest -= iris_round_shift(e->products[k][j] * solution[j], 22);
        }
        int64_t most = e->products[k][k] / 4; /* 16 pixels */
        rest = rest > most ? most : rest < -most ? -most : rest;
        solution[k] = (int32_t)(rest * 4194304 / e->products[k][k]);
    }
}

/* One round: pairs and their equations. Returns the sum of weights. */
static int64_t collect(equations *e, const iris_hough_shape_place *place, const iris_hough_shape *shape,
                       int32_t reach_q4, int32_t step)
{
    frame f = frame_of(place);
    int32_t radius_q4 = (int32_t)((int64_t)shape->reach_q4 * place->scale_q16 >> 16) + 1;
    int32_t reach2 = reach_q4 * reach_q4;
    int64_t weights = 0;
    *e = (equations){0};
    for (int32_t i = 0; i < shape->entries; i += step) {
        pair p;
        lay(&p, shape, &f, i);
        find_nearest(&p, shape, reach_q4);
        if (p.nearest < 0) {
            continue;
        }
        int64_t nx = p.normal_x, ny = p.normal_y;
        const int32_t derivatives[UNKNOWNS] = {p.normal_x, p.normal_y,
                                               (int32_t)((ny * p.from_x - nx * p.from_y) / radius_q4),
                                               (int32_t)((nx * p.from_x + ny * p.from_y) / radius_q4)};
        int32_t weight = 1 + 15 * (reach2 - p.reach2) / reach2;
        add_pair(e, derivatives, distance_across(&p), weight);
        weights += weight;
    }
    return weights;
}

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static void move(iris_hough_shape_place *place, const iris_hough_shape *shape,
                 const int32_t solution[UNKNOWNS])
{
    const iris_hough_shape_config *c = &shape->config;
    int32_t radius_q4 = (int32_t)((int64_t)shape->reach_q4 * place->scale_q16 >> 16) + 1;
    int64_t angle = (int64_t)solution[2] * 16 / radius_q4 * 10430 / 65536;
    int64_t scale = place->scale_q16 + (int64_t)place->scale_q16 * solution[3] / radius_q4 / 4096;
    int32_t least = c->scale_min_q16 - smaller(c->scale_step_q16 / 2, c->scale_min_q16 / 8);
    int32_t most = c->scale_max_q16 + smaller(c->scale_step_q16 / 2, c->scale_max_q16 / 8);
    place->x_q16 = limit(iris_add_sat(place->x_q16, solution[0]), 0, (shape->size.w - 1) * 65536);
    place->y_q16 = limit(iris_add_sat(place->y_q16, solution[1]), 0, (shape->size.h - 1) * 65536);
    place->angle = iris_angle_wrap(place->angle + (int32_t)limit((int32_t)angle, -16384, 16384));
    place->scale_q16 = (iris_q16)(scale < least ? least : scale > most ? most : scale);
}

void iris_hough_shape_fit(iris_hough_shape_place *place, const iris_hough_shape *shape, int32_t reach_q4,
                          int32_t step)
{
    equations e;
    int32_t solution[UNKNOWNS] = {0};
    int64_t weights = collect(&e, place, shape, reach_q4, step);
    if (weights > 0) {
        solve(solution, &e, weights);
        move(place, shape, solution);
    }
}

void iris_hough_shape_rate(iris_hough_shape_place *place, const iris_hough_shape *shape, int32_t reach_q4,
                           int32_t step)
{
    frame f = frame_of(place);
    int32_t fit = 0, all = 0, exact2 = reach_q4 * reach_q4 * 9 / 16;
    for (int32_t i = 0; i < shape->entries; i += step) {
        pair p;
        all++;
        lay(&p, shape, &f, i);
        find_nearest(&p, shape, reach_q4);
        int32_t across = p.nearest < 0 ? reach_q4 : distance_across(&p);
        if (across * across < exact2) {
            fit += 1000 * (exact2 - across * across) / exact2;
        }
    }
    if (all > 0) {
        place->fit = (int32_t)((int64_t)fit / all * place->scale_q16 / 65536);
    }
}

/* How exactly the nearest edge point agrees, 0 to EXACT: in full up to `full_q4` across the edge and half of LIKE, and
 * not at all at twice that. */
static int32_t exactness(const pair *p, const iris_hough_shape *shape, int32_t full_q4)
{
    int32_t across = distance_across(p);
    int32_t turn = iris_angle_wrap(shape->edges[p->nearest].angle - p->angle);
    int32_t place = limit(2 * full_q4 - (across < 0 ? -across : across), 0, full_q4);
    int32_t direction = limit(LIKE - (turn < 0 ? -turn : turn), 0, LIKE / 2);
    return place * direction / full_q4;
}

void iris_hough_shape_score(iris_hough_shape_place *place, const iris_hough_shape *shape)
{
    frame f = frame_of(place);
    int32_t full_q4 = limit((int32_t)((int64_t)place->scale_q16 * 8 / 65536), 8, 16), sum = 0;
    for (int32_t i = 0; i < shape->entries; i++) {
        pair p;
        lay(&p, shape, &f, i);
        find_nearest(&p, shape, TOLERANCE);
        if (p.nearest >= 0) {
            sum += exactness(&p, shape, full_q4);
        } else if (p.unlike > 0) {
            sum -= EXACT / 2;
        }
    }
    place->score = sum > 0 ? (int32_t)((int64_t)1000 * sum / EXACT / shape->entries) : 0;
}

/* The edge points of like direction around an outline point are used. */
static void use_near(const pair *p, const iris_hough_shape *shape, int32_t from, int32_t to)
{
    for (int32_t i = shape->first[from]; i < shape->first[to + 1]; i++) {
        iris_hough_shape_edge *edge = &shape->edges[i];
        int32_t dx = edge->x * 16 - p->x_q4, dy = edge->y * 16 - p->y_q4;
        if (dx * dx + dy * dy < p->reach2 && is_alike(edge->angle, p->angle)) {
            edge->is_used = 1;
        }
    }
}

void iris_hough_shape_use(const iris_hough_shape_place *place, const iris_hough_shape *shape)
{
    frame f = frame_of(place);
    for (int32_t i = 0; i < shape->entries; i++) {
        pair p;
        cells c;
        lay(&p, shape, &f, i);
        p.reach2 = TOLERANCE * TOLERANCE;
        if (!cells_near(&c, shape, &p, TOLERANCE)) {
            continue;
        }
        for (int32_t row = c.top; row <= c.bottom; row++) {
            use_near(&p, shape, row * shape->indexes_w + c.left, row * shape->indexes_w + c.right);
        }
    }
}
