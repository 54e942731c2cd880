/* Circles: edge points made in double precision, drawn discs in noise, the coins, and everything that is wrong. */
#include "iris/xt/hough_circle.h"

#include <math.h>
#include <stdio.h>

#include "edge_picture.h"

#define POINTS_MAX 40000
#define W          320
#define H          240

static iris_edge_point points[POINTS_MAX];
static iris_size field = {W, H};
static int32_t count_of_points;
static iris_circle found[300];
static IRIS_SCRATCH_BUFFER(memory, 1 << 21);
static uint32_t seed = 1;

static double random_between(double low, double high)
{
    return low + (high - low) * next_random(&seed) / 16777216.0;
}

static int by_rows(const void *a, const void *b)
{
    const iris_edge_point *p = a, *q = b;
    return p->y != q->y ? p->y - q->y : p->x - q->x;
}

typedef struct {
    double x, y, r;
} disc;

/* The pixels of a circle from one angle to another (degrees), once each, as an edge finder would give them: brighter
 * inside with bright 1. blur: of the direction, in degrees. */
static void add_arc(disc at, double from, double to, int bright, double blur)
{
    const double turn = acos(-1) / 180, x = at.x, y = at.y, r = at.r;
    int32_t last_x = -1, last_y = -1;
    for (double a = from; a < to; a += 20 / r) {
        int32_t px = (int32_t)floor(x + r * cos(a * turn) + .5),
                py = (int32_t)floor(y + r * sin(a * turn) + .5);
        if ((px != last_x || py != last_y) && px >= 0 && py >= 0 && px < field.w && py < field.h) {
            double angle = atan2(py - y, px - x) / turn + (bright ? 180 : 0) + random_between(-blur, blur);
            assert_true(count_of_points < POINTS_MAX);
            points[count_of_points++] = (iris_edge_point){
                (int16_t)px, (int16_t)py, iris_angle_from_centidegrees((int32_t)(100 * angle))};
        }
        last_x = px;
        last_y = py;
    }
}

static void add_noise(int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        points[count_of_points++] =
            (iris_edge_point){(int16_t)random_between(0, W), (int16_t)random_between(0, H),
                              (iris_angle)random_between(-32768, 32767)};
    }
}

static iris_circle_config sensible(int32_t radius_min, int32_t radius_max)
{
    iris_circle_config config;
    iris_circle_defaults(&config);
    config.radius_min = radius_min;
    config.radius_max = radius_max;
    return config;
}

static size_t scratch_for(const iris_circle_config *config)
{
    return IRIS_CIRCLE_SCRATCH_BYTES(field.w, field.h, count_of_points, config->cell, config->max_hypotheses);
}

static iris_status run(int32_t capacity, int32_t *count, const iris_circle_config *config)
{
    iris_scratch scratch;
    const iris_edge_list edges = {points, count_of_points, field};
    qsort(points, (size_t)count_of_points, sizeof points[0], by_rows);
    assert_true(scratch_for(config) <= sizeof memory.memory);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, scratch_for(config)), IRIS_OK);
    iris_status status = iris_hough_circles(found, capacity, count, &edges, config, &scratch);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, scratch.bytes);
    return status;
}

static int32_t search(int32_t radius_min, int32_t radius_max)
{
    int32_t count = -1;
    const iris_circle_config config = sensible(radius_min, radius_max);
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    return count;
}

/* The index of the circle that is nowhere off by more than `most` pixels; -1. */
static int32_t find(int32_t count, double x, double y, double r, double most)
{
    for (int32_t i = 0; i < count; i++) {
        const iris_circle *c = &found[i];
        if (fabs(c->x_q16 / 65536.0 - x) <= most && fabs(c->y_q16 / 65536.0 - y) <= most &&
            fabs(c->r_q16 / 65536.0 - r) <= most) {
            return i;
        }
    }
    return -1;
}

static void sub_pixel(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        double r = i < 100 ? random_between(10, 50) : random_between(4, 110);
        double x = random_between(r, W - 1 - r), y = random_between(r, H - 1 - r);
        count_of_points = 0;
        add_arc((disc){x, y, r}, 0, 360, i % 2, 5);
        int32_t on_circle = count_of_points;
        add_noise(i % 3 * 200);
        int32_t count = i < 100 ? search(10, 50) : search(4, 110);
        assert_int_equal(count, 1);
        assert_int_equal(find(count, x, y, r, i % 3 ? .25 : .15), 0);
        assert_true(found[0].votes >= on_circle * 9 / 10 && found[0].votes <= on_circle + 20);
    }
}

/* Sums stay within their numbers: a ring as wide as what counts. */
static void huge(void **state)
{
    (void)state;
    int32_t count;
    iris_circle_config config = sensible(900, 1023);
    config.cell = 4;
    field = (iris_size){2200, 2200};
    for (int wide = 0; wide <= 6; wide += 6) {
        count_of_points = 0;
        for (int k = -wide; k <= wide; k += 3) {
            add_arc((disc){1100.25, 1099.5, 1000.5 + k}, 0, 360, 1, 5);
        }
        assert_int_equal(run(300, &count, &config), IRIS_OK);
        assert_int_equal(count, 1);
        assert_true(find(count, 1100.25, 1099.5, 1000.5, .2) == 0);
        assert_true(found[0].votes > 6000 + 1000 * wide);
    }
    field = (iris_size){W, H};
}

static void one_radius(void **state)
{
    (void)state;
    count_of_points = 0;
    add_arc((disc){100.3, 90.7, 30.2}, 0, 360, 1, 3);
    add_arc((disc){220.6, 120.2, 40}, 0, 360, 1, 3);
    assert_int_equal(search(30, 30), 1);
    assert_int_equal(find(1, 100.3, 90.7, 30.2, .1), 0);
    assert_int_equal(search(35, 35), 0);
    assert_int_equal(search(25, 45), 2);
    assert_int_equal(find(2, 220.6, 120.2, 40, .1), 0); /* more votes: first */
    assert_true(found[0].votes > found[1].votes);
}

static void polarity(void **state)
{
    (void)state;
    int32_t count;
    iris_circle_config config = sensible(10, 50);
    count_of_points = 0;
    add_arc((disc){80, 100, 25}, 0, 360, 1, 3);
    add_arc((disc){200, 100, 35}, 0, 360, 0, 3);
    add_arc((disc){260, 200, 30}, 0, 180, 0, 3); /* half and half */
    add_arc((disc){260, 200, 30}, 180, 360, 1, 3);
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 3);
    config.min_share_permil = 700;
    config.polarity = IRIS_CIRCLE_BRIGHT;
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 1);
    assert_int_equal(find(1, 80, 100, 25, .1), 0);
    config.polarity = IRIS_CIRCLE_DARK;
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 1);
    assert_int_equal(find(1, 200, 100, 35, .1), 0);
}

static void parts(void **state)
{
    (void)state;
    int32_t count;
    iris_circle_config config = sensible(10, 50);
    count_of_points = 0;
    add_arc((disc){3, 120, 40}, 0, 360, 1, 3);       /* a little more than half is inside */
    add_arc((disc){160, 100, 30}, 100, 260, 1, 3);   /* four ninths */
    add_arc((disc){280.5, 200.25, 22}, 0, 70, 1, 3); /* a fifth */
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 2);
    assert_true(find(2, 3, 120, 40, .4) >= 0 && find(2, 160, 100, 30, .4) >= 0);
    config.min_share_permil = 550; /* of pixels, which are more than the circumference is long */
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 1);
    config.min_share_permil = 300;
    config.min_votes = 120;
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 1);
    assert_true(find(1, 3, 120, 40, .4) >= 0);
}

static void distance(void **state)
{
    (void)state;
    int32_t count;
    iris_circle_config config = sensible(10, 50);
    count_of_points = 0;
    add_arc((disc){100, 100, 40}, 0, 360, 1, 3);
    add_arc((disc){103, 100, 30}, 0, 360, 1, 3);
    add_arc((disc){103, 113, 12}, 0, 360, 1, 3);
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 2);
    assert_true(find(2, 100, 100, 40, .2) == 0 && find(2, 103, 113, 12, .2) == 1);
    config.min_distance = 0;
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 3);
    config.min_distance = 14;
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 1);
}

/* A line of a drawn circle has an edge to each side. */
static void drawn_line(void **state)
{
    (void)state;
    count_of_points = 0;
    add_arc((disc){150.4, 110.2, 41.6}, 0, 360, 0, 3);
    add_arc((disc){150.4, 110.2, 38.4}, 0, 360, 1, 3);
    assert_int_equal(search(10, 50), 1);
    assert_int_equal(find(1, 150.4, 110.2, 40, .2), 0);
}

static void many(void **state)
{
    (void)state;
    int32_t count = 0;
    iris_circle_config config = sensible(8, 16);
    count_of_points = 0;
    for (int i = 0; i < 40; i++) {
        add_arc((disc){20 + i % 8 * 38, 20 + i / 8 * 45, 8 + i % 5 * 2}, 0, 360, 1, 3);
    }
    add_noise(300);
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 40);
    for (int32_t i = 1; i < count; i++) {
        double before = pow(found[i - 1].votes, 2) / found[i - 1].r_q16,
               here = pow(found[i].votes, 2) / found[i].r_q16;
        assert_true(before >= here);
    }
    iris_circle all[40];
    memcpy(all, found, sizeof all);
    memset(found, 0xA5, sizeof found);
    assert_int_equal(run(7, &count, &config), IRIS_ERR_FULL);
    assert_int_equal(count, 40);
    assert_memory_equal(found, all, 7 * sizeof all[0]);
    assert_int_equal(found[7].votes, (int32_t)0xA5A5A5A5);
    assert_int_equal(run(0, &count, &config), IRIS_ERR_FULL);
    config.max_hypotheses = 5;
    assert_int_equal(run(300, &count, &config), IRIS_OK);
    assert_int_equal(count, 5);
}

static void nothing(void **state)
{
    (void)state;
    int32_t wrong = 0;
    for (int i = 0; i < 20; i++) {
        count_of_points = 0;
        add_noise(1000 + 400 * i);
        wrong += search(4 + i, 60) > 0;
    }
    assert_int_equal(wrong, 0);
    count_of_points = 0;
    assert_int_equal(search(10, 50), 0);
    for (int32_t i = 0; i < 200; i++) { /* lines and a box */
        points[count_of_points++] = (iris_edge_point){(int16_t)(60 + i), 20, 16384};
        points[count_of_points++] = (iris_edge_point){(int16_t)(60 + i), 219, -16384};
        points[count_of_points++] = (iris_edge_point){60, (int16_t)(20 + i), 0};
        points[count_of_points++] = (iris_edge_point){259, (int16_t)(20 + i), -32768};
        points[count_of_points++] =
            (iris_edge_point){(int16_t)(100 + i / 2), (int16_t)(40 + i / 2), 8192 + 16384};
    }
    assert_int_equal(search(3, 200), 0);
}

/* Anything is survived, in finite time: points on one spot, a whole picture of points, every radius. */
static void hostile(void **state)
{
    (void)state;
    int32_t count;
    for (int i = 0; i < 6; i++) {
        iris_circle_config config = sensible(3, i % 2 ? 1023 : 20);
        config.cell = 1 + i * 3;
        config.min_share_permil = 1;
        config.max_hypotheses = i % 2 ? 1 : 300;
        config.min_distance = 0;
        count_of_points = 0;
        add_noise(i < 4 ? 38000 : 100);
        for (int32_t k = 0; i >= 2 && k < count_of_points; k++) {
            points[k].x = (int16_t)(i < 4 ? 100 + k % 7 : points[k].x);
            points[k].y = (int16_t)(i < 4 ? 100 + k % 3 : points[k].y);
            points[k].angle = (iris_angle)(i < 4 ? 0 : points[k].angle);
        }
        iris_status status = run(300, &count, &config);
        assert_true((status == IRIS_OK && count <= 300) || status == IRIS_ERR_FULL);
    }
}

/* --- the accumulator --- */

static void slice(void **state)
{
    (void)state;
    static uint16_t cells[W * H], expected[W * H];
    for (int i = 0; i < 24; i++) {
        iris_circle_config config = sensible(10, 50);
        config.polarity = (iris_circle_polarity)(i % 3);
        config.cell = 1 + i % 5 * 2;
        int32_t radius = 3 + i * 7, w = (W + config.cell - 1) / config.cell,
                h = (H + config.cell - 1) / config.cell;
        int32_t votes = 0, wanted = 0, differing = 0;
        count_of_points = 0;
        add_noise(2000);
        qsort(points, (size_t)count_of_points, sizeof points[0], by_rows);
        memset(cells, 0, sizeof cells);
        memset(expected, 0, sizeof expected);
        for (int32_t k = 0; k < 2 * count_of_points; k++) {
            const iris_edge_point *p = &points[k / 2];
            double a = (floor(p->angle / 256.0) * 256 + 128) / 32768.0 * acos(-1), sign = k % 2 ? -1 : 1;
            int32_t x = (int32_t)floor((p->x + .5 + sign * radius * cos(a)) / config.cell);
            int32_t y = (int32_t)floor((p->y + .5 + sign * radius * sin(a)) / config.cell);
            int counts = k % 2 ? config.polarity != IRIS_CIRCLE_BRIGHT : config.polarity != IRIS_CIRCLE_DARK;
            if (counts && x >= 0 && y >= 0 && x < w && y < h) {
                expected[y * w + x]++;
                wanted++;
            }
        }
        const iris_image view = {cells, w * 2, w, h, IRIS_GRAY_U16};
        const iris_edge_list edges = {points, count_of_points, {W, H}};
        iris_scratch scratch = arena(IRIS_CIRCLE_VOTE_SCRATCH_BYTES);
        assert_int_equal(iris_circle_vote(&view, &edges, radius, &config, &scratch), IRIS_OK);
        for (int32_t k = 0; k < w * h; k++) {
            votes += cells[k];
            differing += abs(cells[k] - expected[k]);
        }
        assert_true(abs(votes - wanted) <= 10); /* rounding, at the picture's edge and between cells */
        assert_true(differing <= wanted / 10);
    }
}

static void slice_saturates(void **state)
{
    (void)state;
    static uint16_t cells[W / 2 * H / 2];
    const iris_image view = {cells, W, W / 2, H / 2, IRIS_GRAY_U16};
    const iris_edge_list edges = {points, 3, {W, H}};
    for (int i = 0; i < W / 2 * H / 2; i++) {
        cells[i] = 65534;
    }
    for (int i = 0; i < 3; i++) {
        points[i] = (iris_edge_point){100, 100, 0};
    }
    iris_scratch scratch = arena(IRIS_CIRCLE_VOTE_SCRATCH_BYTES);
    assert_int_equal(iris_circle_vote(&view, &edges, 10, NULL, &scratch), IRIS_OK);
    assert_int_equal(cells[50 * W / 2 + 55], 65535);
    assert_int_equal(cells[50 * W / 2 + 45], 65535);
    assert_int_equal(cells[50 * W / 2 + 50], 65534);
}

/* --- pictures --- */

static uint8_t gray[W * H];

/* A disc whose pixels at the rim are covered in part. */
static void draw_disc(double x, double y, double r, int level)
{
    for (int i = 0; i < W * H; i++) {
        double inside = r - hypot(i % W - x, i / W - y) + .5;
        inside = inside < 0 ? 0 : inside > 1 ? 1 : inside;
        gray[i] = (uint8_t)(gray[i] + inside * (level - gray[i]) + .5);
    }
}

static int32_t search_picture(const iris_image *view, const iris_circle_config *config)
{
    iris_scratch scratch;
    int32_t count = -1;
    iris_edge_list edges = {points, 0, {view->w, view->h}};
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, sizeof memory.memory), IRIS_OK);
    assert_int_equal(iris_edge_points(points, POINTS_MAX, &edges.count, view, NULL, &scratch), IRIS_OK);
    assert_int_equal(iris_hough_circles(found, 300, &count, &edges, config, &scratch), IRIS_OK);
    return count;
}

static void discs_in_noise(void **state)
{
    (void)state;
    static const double discs[6][3] = {{60.3, 60.8, 30.5}, {150.1, 70.4, 22}, {185.5, 95.2, 28.25},
                                       {90.7, 180, 45.5},  {290, 40.5, 40},   {240.3, 180.6, 12.5}};
    for (int sigma = 0; sigma <= 30; sigma += 10) {
        memset(gray, 70, sizeof gray);
        for (int i = 0; i < 6; i++) {
            draw_disc(discs[i][0], discs[i][1], discs[i][2], 150 + 10 * i);
        }
        for (int i = 0; i < W * H; i++) {
            double noisy =
                gray[i] + sigma * (random_between(-1, 1) + random_between(-1, 1) + random_between(-1, 1));
            gray[i] = (uint8_t)(noisy < 0 ? 0 : noisy > 255 ? 255 : noisy);
        }
        const iris_image view = {gray, W, W, H, IRIS_GRAY8};
        assert_int_equal(search_picture(&view, NULL), 6);
        for (int i = 0; i < 6; i++) {
            assert_true(find(6, discs[i][0], discs[i][1], discs[i][2], .4) >= 0);
        }
    }
}

static void coins(void **state)
{
    (void)state;
    picture coin_picture = load_pnm(data_path("hough/coins.pgm"));
    FILE *truth = coin_picture.pixels ? fopen(data_path("hough/coins_circles.txt"), "r") : NULL;
    if (!truth) {
        skip();
    }
    const iris_image view = {coin_picture.pixels, coin_picture.w, coin_picture.w, coin_picture.h, IRIS_GRAY8};
    int32_t count = search_picture(&view, NULL), right = 0;
    char line[200];
    while (fgets(line, sizeof line, truth)) {
        double x, y, r;
        right += sscanf(line, "%lf %lf %lf", &x, &y, &r) == 3 && find(count, x, y, r, 3.5) >= 0;
    }
    fclose(truth);
    free(coin_picture.pixels);
    assert_int_equal(right, 24);
    assert_int_equal(count, 24);
}

/* --- what is wrong --- */

#define CIRCLES(circles, capacity, count, edges, config, scratch, status)                                    \
    assert_int_equal(iris_hough_circles(circles, capacity, count, edges, config, scratch), status)

static void bad_config(iris_circle_config bad)
{
    int32_t count = 7;
    iris_scratch scratch = arena(sizeof working.memory);
    const iris_edge_list edges = {points, 0, {64, 64}};
    CIRCLES(found, 3, &count, &edges, &bad, &scratch, IRIS_ERR_ARG);
    assert_int_equal(count, 7);
}

static void bad_configs(void **state)
{
    (void)state;
    static const int32_t wrong[][3] = {{0, 2, 1024}, {1, 9, 1024},   {2, -1, 3},     {3, 0, 17},
                                       {4, 0, 1001}, {5, -1, 65536}, {6, -1, 32768}, {7, 0, 4097}};
    for (int i = 0; i < 8; i++) {
        for (int k = 1; k < 3; k++) {
            iris_circle_config config = sensible(10, 50);
            int32_t value = wrong[i][k];
            config.radius_min = wrong[i][0] == 0 ? value : config.radius_min;
            config.radius_max = wrong[i][0] == 1 ? value : config.radius_max;
            config.polarity = wrong[i][0] == 2 ? (iris_circle_polarity)value : config.polarity;
            config.cell = wrong[i][0] == 3 ? value : config.cell;
            config.min_share_permil = wrong[i][0] == 4 ? value : config.min_share_permil;
            config.min_votes = wrong[i][0] == 5 ? value : config.min_votes;
            config.min_distance = wrong[i][0] == 6 ? value : config.min_distance;
            config.max_hypotheses = wrong[i][0] == 7 ? value : config.max_hypotheses;
            bad_config(config);
        }
    }
    iris_circle_defaults(NULL);
}

static void bad_calls(void **state)
{
    (void)state;
    int32_t count = 7;
    iris_scratch scratch = arena(sizeof working.memory);
    iris_edge_point list[3] = {{5, 5, 0}, {6, 5, 0}, {4, 6, 0}};
    iris_edge_list edges = {list, 3, {64, 64}};
    CIRCLES(NULL, 1, &count, &edges, NULL, &scratch, IRIS_ERR_ARG);
    CIRCLES(found, -1, &count, &edges, NULL, &scratch, IRIS_ERR_ARG);
    CIRCLES(found, 1, NULL, &edges, NULL, &scratch, IRIS_ERR_ARG);
    CIRCLES(found, 1, &count, NULL, NULL, &scratch, IRIS_ERR_ARG);
    CIRCLES(found, 1, &count, &edges, NULL, NULL, IRIS_ERR_ARG);
    const iris_edge_list none = {NULL, 0, {64, 64}}, null = {NULL, 1, {64, 64}},
                         negative = {list, -1, {64, 64}};
    CIRCLES(found, 1, &count, &null, NULL, &scratch, IRIS_ERR_ARG);
    CIRCLES(found, 1, &count, &negative, NULL, &scratch, IRIS_ERR_ARG);
    assert_int_equal(count, 7);
    CIRCLES(NULL, 0, &count, &none, NULL, &scratch, IRIS_OK);
    assert_int_equal(count, 0);
    count = 7;
    for (int i = 0; i < 6; i++) {
        iris_edge_point wrong[3] = {{5, 5, 0}, {6, 5, 0}, {4, 6, 0}};
        iris_edge_list bad = {wrong, 3, {i == 4 ? 0 : 64, i == 5 ? IRIS_SIDE_MAX + 1 : 64}};
        wrong[1].x = i == 0 ? 64 : i == 1 ? -1 : 6;
        wrong[2].y = i == 2 ? 64 : i == 3 ? 4 : 6; /* 4: above the one before */
        CIRCLES(found, 1, &count, &bad, NULL, &scratch, IRIS_ERR_RANGE);
    }
    iris_circle_config config = sensible(10, 50);
    size_t needed = IRIS_CIRCLE_SCRATCH_BYTES(64, 64, 3, config.cell, config.max_hypotheses);
    scratch = arena(needed - 1);
    memset(found, 0xA5, sizeof found);
    CIRCLES(found, 1, &count, &edges, NULL, &scratch, IRIS_ERR_SCRATCH);
    assert_int_equal(count, 7);
    assert_int_equal(found[0].votes, (int32_t)0xA5A5A5A5);
    assert_int_equal(scratch.used, 0);
    scratch = arena(needed);
    CIRCLES(found, 1, &count, &edges, NULL, &scratch, IRIS_OK);
}

static void bad_votes(void **state)
{
    (void)state;
    static uint16_t cells[32 * 32];
    iris_scratch scratch = arena(IRIS_CIRCLE_VOTE_SCRATCH_BYTES);
    iris_edge_point list[1] = {{5, 5, 0}};
    iris_edge_list edges = {list, 1, {64, 63}}, outside = {list, 1, {5, 5}};
    iris_image view = {cells, 64, 32, 32, IRIS_GRAY_U16}, narrow = {cells, 64, 31, 32, IRIS_GRAY_U16},
               bytes = {cells, 64, 32, 32, IRIS_GRAY8}, bad = {NULL, 64, 32, 32, IRIS_GRAY_U16};
    assert_int_equal(iris_circle_vote(NULL, &edges, 10, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_circle_vote(&view, NULL, 10, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_circle_vote(&view, &edges, 10, NULL, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_circle_vote(&view, &edges, 2, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_circle_vote(&view, &edges, 1024, NULL, &scratch), IRIS_ERR_ARG);
    assert_int_equal(iris_circle_vote(&bytes, &edges, 10, NULL, &scratch), IRIS_ERR_FORMAT);
    assert_int_equal(iris_circle_vote(&narrow, &edges, 10, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_equal(iris_circle_vote(&view, &outside, 10, NULL, &scratch), IRIS_ERR_RANGE);
    assert_int_not_equal(iris_circle_vote(&bad, &edges, 10, NULL, &scratch), IRIS_OK);
    scratch = arena(IRIS_CIRCLE_VOTE_SCRATCH_BYTES - 1);
    assert_int_equal(iris_circle_vote(&view, &edges, 10, NULL, &scratch), IRIS_ERR_SCRATCH);
    for (int i = 0; i < 32 * 32; i++) {
        assert_int_equal(cells[i], 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sub_pixel),      cmocka_unit_test(huge),      cmocka_unit_test(one_radius),
        cmocka_unit_test(polarity),       cmocka_unit_test(parts),     cmocka_unit_test(distance),
        cmocka_unit_test(drawn_line),     cmocka_unit_test(many),      cmocka_unit_test(nothing),
        cmocka_unit_test(hostile),        cmocka_unit_test(slice),     cmocka_unit_test(slice_saturates),
        cmocka_unit_test(discs_in_noise), cmocka_unit_test(coins),     cmocka_unit_test(bad_configs),
        cmocka_unit_test(bad_calls),      cmocka_unit_test(bad_votes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
