/* Hough transform: points that know their direction, and theta through the full circle. */
#include "line_mask.h"

static uint32_t seed = 5;

static int32_t any(int32_t low, int32_t high)
{
    return low + (int32_t)(next_random(&seed) % (uint32_t)(high - low + 1));
}

static iris_hough begun(iris_size size, const iris_hough_config *config, iris_scratch *scratch)
{
    iris_hough hough;
    *scratch = arena(sizeof memory);
    assert_int_equal(iris_hough_begin(&hough, size, config, scratch), IRIS_OK);
    return hough;
}

static iris_hough_config any_config(void)
{
    static const int16_t spreads[] = {0, 100, 1820, 8000, IRIS_HOUGH_SPREAD_MAX};
    iris_hough_config config = config_of(any(1, 60), 1 << any(0, 2), 1);
    config.full_circle = any(0, 1);
    config.spread = spreads[any(0, 4)];
    config.angle_min = config.angle_max = (iris_angle)any(-16384, 16384);
    if (any(0, 2)) {
        int32_t most = config.full_circle ? 32767 : 16384;
        config.angle_min = (iris_angle)any(-most, most);
        config.angle_max = (iris_angle)any(-most, most);
        config.rho_min = any(-30, 0);
        config.rho_max = any(1, 30);
    }
    return config;
}

/* 1 when the bin is in doubt. */
static int rho_bin(int *bin, const iris_hough *hough, const iris_edge_point *p, int32_t theta)
{
    const iris_hough_config *c = &hough->config;
    double angle = floor(c->angle_min + theta * hough->span / (double)c->theta_bins + 0.5) / 32768 * PI;
    double rho =
        (p->x - (hough->size.w - 1) / 2.0) * cos(angle) + (p->y - (hough->size.h - 1) / 2.0) * sin(angle);
    double at = (rho - c->rho_min) / c->rho_step;
    *bin = (int)floor(at);
    return fabs(at - floor(at + 0.5)) < 3e-3;
}

/* What the point should vote for: adds to `expected`, and returns the votes; -1 when a bin is in doubt. */
static int expect(uint16_t *expected, const iris_hough *hough, const iris_edge_point *p)
{
    const iris_hough_config *c = &hough->config;
    const int turn = c->full_circle ? 65536 : 32768;
    const double per = (double)c->theta_bins / hough->span;
    int votes = 0, bin;
    for (int32_t theta = 0; theta < c->theta_bins; theta++) {
        if (rho_bin(&bin, hough, p, theta)) {
            return -1;
        }
    }
    for (int32_t theta = 0; theta < c->theta_bins; theta++) {
        int wanted = 0;
        for (int k = -5; k <= 5; k++) {
            double middle = p->angle - c->angle_min + k * turn;
            wanted |= theta >= floor((middle - c->spread) * per + 0.5) &&
                      theta <= floor((middle + c->spread) * per + 0.5);
        }
        (void)rho_bin(&bin, hough, p, theta);
        if (wanted && bin >= 0 && bin < hough->rho_bins) {
            expected[theta * hough->rho_bins + bin]++;
            votes++;
        }
    }
    return votes;
}

static void votes_by_direction_are_the_formula(void **state)
{
    (void)state;
    static uint16_t expected[60 * 200];
    int votes = 0;
    for (int round = 0; round < 400; round++) {
        iris_size size = {any(1, 90), any(1, 70)};
        iris_scratch scratch;
        iris_hough_config config = any_config();
        iris_hough hough = begun(size, &config, &scratch);
        memset(expected, 0, sizeof expected);
        for (int i = 0; i < 20; i++) {
            iris_edge_point point = {(int16_t)any(0, size.w - 1), (int16_t)any(0, size.h - 1),
                                     (iris_angle)any(-32768, 32767)};
            int of_point = expect(expected, &hough, &point);
            if (of_point >= 0) {
                votes += of_point;
                assert_int_equal(iris_hough_vote_edges(&hough, &point, 1), IRIS_OK);
            }
        }
        assert_memory_equal(hough.votes, expected, (size_t)config.theta_bins * (size_t)hough.rho_bins * 2);
    }
    assert_true(votes > 20000);
}

/* With the largest spread, and a bin that stands for each direction, nearly all vote for all. */
static void the_direction_and_its_opposite_are_one_in_half_a_turn(void **state)
{
    (void)state;
    iris_hough_config config = config_of(45, 1, 1);
    iris_scratch scratch, more;
    iris_hough one = begun((iris_size){60, 40}, &config, &scratch), other = {0};
    more = scratch;
    assert_int_equal(iris_hough_begin(&other, (iris_size){60, 40}, &config, &more), IRIS_OK);
    for (int i = 0; i < 200; i++) {
        iris_edge_point point = {(int16_t)any(0, 59), (int16_t)any(0, 39), (iris_angle)any(-32768, 32767)};
        assert_int_equal(iris_hough_vote_edges(&one, &point, 1), IRIS_OK);
        point.angle = iris_angle_wrap(point.angle + 32768);
        assert_int_equal(iris_hough_vote_edges(&other, &point, 1), IRIS_OK);
    }
    assert_memory_equal(one.votes, other.votes, 45u * (size_t)one.rho_bins * 2);
}

/* A bright bar on dark ground, its middle line through the picture's middle: each edge has its brighter side. */
static void both_sides_of_a_bar(void **state)
{
    (void)state;
    static uint8_t pixels[160 * 120];
    static iris_edge_point points[2000];
    for (int degrees = -180; degrees < 180; degrees += 15) {
        double c = cos(degrees * PI / 180), s = sin(degrees * PI / 180);
        for (int32_t i = 0; i < 160 * 120; i++) {
            double off = (i % 160 - 79.5) * c + (i / 160 - 59.5) * s;
            double inside = fmin(fmin(off + 10.5, 20.5 - off), 1); /* from -10 to 20 */
            pixels[i] = (uint8_t)(40 + 150 * fmax(inside, 0));
        }
        iris_image gray;
        int32_t count, found;
        iris_scratch scratch = arena(sizeof memory);
        assert_int_equal(iris_image_wrap(&gray, pixels, sizeof pixels, (iris_size){160, 120}, 0, IRIS_GRAY8),
                         IRIS_OK);
        assert_int_equal(iris_edge_points(points, 2000, &count, &gray, NULL, &scratch), IRIS_OK);
        iris_hough_config config = config_of(360, 1, 50);
        config.full_circle = 1;
        config.angle_min = config.angle_max = 0;
        iris_hough hough = begun((iris_size){160, 120}, &config, &scratch);
        assert_int_equal(iris_hough_vote_edges(&hough, points, count), IRIS_OK);
        iris_hough_line lines[4];
        assert_int_equal(iris_hough_peaks(lines, 4, &found, &hough), IRIS_OK);
        assert_int_equal(found, 2);
        for (int i = 0; i < 2; i++) {
            int enters =
                fabs(lines[i].rho_q16 / 65536.0 + 10) < 1; /* where it gets brighter along the normal */
            double off = lines[i].angle / DEGREE - degrees + (enters ? 0 : 180);
            assert_true(enters || fabs(lines[i].rho_q16 / 65536.0 + 20) < 1);
            assert_true(fabs(remainder(off, 360)) < 1);
        }
        assert_true(labs((long)lines[0].rho_q16 - lines[1].rho_q16) > 8 * 65536);
        /* and in half a turn the same two without sides */
        config.full_circle = 0;
        config.theta_bins = 180;
        hough = begun((iris_size){160, 120}, &config, &scratch);
        assert_int_equal(iris_hough_vote_edges(&hough, points, count), IRIS_OK);
        assert_int_equal(iris_hough_peaks(lines, 4, &found, &hough), IRIS_OK);
        assert_int_equal(found, 2);
        assert_true(labs((long)labs((long)lines[0].rho_q16 - lines[1].rho_q16) - 30 * 65536) < 65536);
    }
}

/* The report's form: theta in a full turn, rho not negative, for points without direction. */
static void each_line_once_with_rho_from_0(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        double degrees = -180 + 360 * (i / 200.0) + 0.3, rho = i % 4 ? any(0, 400) / 10.0 : any(0, 10) / 20.0;
        iris_image mask = blank(160, 120);
        draw(&mask, degrees, rho);
        iris_hough_config config = config_of(360, 1, 45);
        config.full_circle = 1;
        config.angle_min = config.angle_max = 0;
        iris_hough_line lines[4];
        int32_t found;
        iris_scratch scratch = arena(sizeof memory);
        assert_int_equal(iris_hough_lines(lines, 4, &found, &mask, &config, &scratch), IRIS_OK);
        assert_int_equal(found, 2); /* both ways round */
        config.rho_min = 0;
        assert_int_equal(iris_hough_lines(lines, 4, &found, &mask, &config, &scratch), IRIS_OK);
        assert_int_equal(found, 1);
        double angle = lines[0].angle / DEGREE, at = lines[0].rho_q16 / 65536.0;
        assert_true(at >= 0);
        if (rho < 1 && fabs(remainder(angle - degrees, 360)) > 90) {
            angle += 180;
            at = -at;
        }
        assert_true(fabs(remainder(angle - degrees, 360)) < 1);
        assert_true(fabs(at - rho) < 1);
    }
}

/* 70000 points and more: what votes without a look at the bins stops in time. */
static void votes_saturate(void **state)
{
    (void)state;
    iris_hough_config config = config_of(3, 1, 65535);
    iris_scratch scratch;
    iris_hough hough = begun((iris_size){32, 64}, &config, &scratch);
    iris_image mask = blank(32, 64);
    for (int32_t y = 0; y < 64; y++) {
        set(&mask, 11, y);
    }
    iris_edge_point points[64];
    for (int32_t i = 0; i < 64; i++) {
        points[i] = (iris_edge_point){11, (int16_t)i, 0};
    }
    config.angle_min = config.angle_max = 0;
    hough = begun((iris_size){32, 64}, &config, &scratch);
    int32_t bin = (int32_t)floor(11 - 15.5) - hough.config.rho_min;
    for (int i = 0; i < 1023; i++) {
        assert_int_equal(
            i % 2 ? iris_hough_vote_mask(&hough, &mask) : iris_hough_vote_edges(&hough, points, 64), IRIS_OK);
    }
    assert_int_equal(hough.votes[bin], 65472);
    assert_int_equal(iris_hough_vote_mask(&hough, &mask), IRIS_OK);
    assert_int_equal(hough.votes[bin], 65535);
    assert_int_equal(iris_hough_vote_edges(&hough, points, 64), IRIS_OK);
    assert_int_equal(iris_hough_vote_mask(&hough, &mask), IRIS_OK);
    assert_int_equal(hough.votes[bin], 65535);
}

static void the_largest_image(void **state)
{
    (void)state;
    const int16_t far = IRIS_SIDE_MAX - 1;
    iris_hough_config config = config_of(16, 64, 1);
    config.spread = IRIS_HOUGH_SPREAD_MAX;
    iris_scratch scratch;
    iris_hough hough = begun((iris_size){IRIS_SIDE_MAX, IRIS_SIDE_MAX}, &config, &scratch);
    for (int i = 0; i < 8; i++) {
        iris_edge_point corner = {i % 2 ? far : 0, i / 2 % 2 ? far : 0, (iris_angle)(i * 8191)};
        assert_int_equal(iris_hough_vote_edges(&hough, &corner, 1), IRIS_OK);
    }
    int sum = 0;
    for (int32_t i = 0; i < 16 * hough.rho_bins; i++) {
        sum += hough.votes[i];
    }
    assert_int_equal(sum, 8 * 16); /* almost 90 degrees to both sides, rounded: all */
}

/* The formula in double precision; strewn points reach it nowhere. */
static void votes_by_chance(void **state)
{
    (void)state;
    iris_hough_config config = config_of(180, 1, 1);
    for (int i = 0; i < 2000; i++) {
        iris_size size = {any(1, 3000), any(1, 3000)};
        config.rho_step = 1 << any(0, 6);
        config.spread = (iris_angle)any(0, IRIS_HOUGH_SPREAD_MAX);
        config.full_circle = any(0, 1);
        int32_t points = i % 10 ? any(0, 100000) : any(0, 1 << 30), directed = any(0, 1);
        double mean = (double)points * config.rho_step * hypot(size.w, size.h) / size.w / size.h;
        double turn = config.full_circle ? 65536 : 32768;
        mean *= directed ? fmin((2.0 * config.spread + floor(32768.0 / 180)) / turn, 1) : 1;
        double votes = fmin(fmax(mean * 9 / 8 + 12 * sqrt(mean), 25), 65535);
        int32_t given = iris_hough_votes_beyond_chance(&config, size, points, directed);
        assert_true(fabs(given - votes) <= 2 + votes / 1000);
    }
    assert_int_equal(iris_hough_votes_beyond_chance(NULL, (iris_size){0, -5}, -9, 1), 25);
    assert_int_equal(iris_hough_votes_beyond_chance(NULL, (iris_size){1, 1}, INT32_MAX, 0), 65535);
    config = config_of(60, 1, 1);
    for (int round = 0; round < 20; round++) {
        iris_scratch scratch;
        iris_size size = {200, 150};
        int32_t points = any(100, 5000);
        config.min_votes = iris_hough_votes_beyond_chance(&config, size, points, 1);
        iris_hough hough = begun(size, &config, &scratch);
        for (int32_t i = 0; i < points; i++) {
            iris_edge_point point = {(int16_t)any(0, 199), (int16_t)any(0, 149),
                                     (iris_angle)any(-32768, 32767)};
            assert_int_equal(iris_hough_vote_edges(&hough, &point, 1), IRIS_OK);
        }
        int32_t found;
        assert_int_equal(iris_hough_peaks(NULL, 0, &found, &hough), IRIS_OK);
        assert_int_equal(found, 0);
    }
}

/* Edges of noise come in pieces, and more at some angles than at others: the larger the picture, the more that tells. */
static void noise_has_no_lines(void **state)
{
    (void)state;
    static const iris_size sizes[] = {{160, 120}, {320, 240}, {640, 480}, {1024, 768}};
    static const int32_t steps[] = {1, 1, 2, 4};
    static uint8_t pixels[1024 * 768];
    static iris_edge_point points[1024 * 768];
    iris_scratch scratch;
    for (int i = 0; i < 8; i++) {
        iris_image gray;
        int32_t found, count, levels = i < 4 ? 255 : 60;
        iris_size size = sizes[i % 4];
        iris_canny_config canny;
        iris_canny_defaults(&canny);
        canny.low = 12;
        canny.high = 30;
        for (int32_t k = 0; k < size.w * size.h; k++) {
            pixels[k] = (uint8_t)any(0, levels);
        }
        assert_int_equal(iris_image_wrap(&gray, pixels, sizeof pixels, size, 0, IRIS_GRAY8), IRIS_OK);
        scratch = arena(sizeof memory);
        assert_int_equal(iris_edge_points(points, 1024 * 768, &count, &gray, &canny, &scratch), IRIS_OK);
        assert_true(count > size.w * size.h / 100);
        iris_hough_config config = config_of(180, steps[i % 4], 1);
        config.min_votes = iris_hough_votes_beyond_chance(&config, size, count, 1);
        iris_hough hough = begun(size, &config, &scratch);
        assert_int_equal(iris_hough_vote_edges(&hough, points, count), IRIS_OK);
        assert_int_equal(iris_hough_peaks(NULL, 0, &found, &hough), IRIS_OK);
        assert_int_equal(found, 0);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_hough_config config = config_of(10, 1, 1);
    iris_scratch scratch;
    iris_hough hough = begun((iris_size){40, 30}, &config, &scratch);
    iris_image mask = blank(40, 30), gray, other = blank(40, 29);
    iris_edge_point points[3] = {{5, 5, 0}, {39, 29, 9}, {0, 0, 0}};
    assert_int_equal(iris_image_wrap(&gray, words, 1200, (iris_size){40, 30}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_hough_vote_mask(NULL, &mask), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_vote_mask(&hough, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_vote_mask(&hough, &gray), IRIS_ERR_FORMAT);
    assert_int_equal(iris_hough_vote_mask(&hough, &other), IRIS_ERR_RANGE);
    mask.w = 0;
    assert_int_equal(iris_hough_vote_mask(&hough, &mask), IRIS_ERR_RANGE);
    assert_int_equal(iris_hough_vote_edges(NULL, points, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_vote_edges(&hough, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_vote_edges(&hough, points, -1), IRIS_ERR_ARG);
    assert_int_equal(iris_hough_vote_edges(&hough, NULL, 0), IRIS_OK);
    const int16_t out[][2] = {{-1, 0}, {40, 0}, {0, -1}, {0, 30}, {INT16_MIN, INT16_MAX}};
    for (size_t i = 0; i < sizeof out / sizeof out[0]; i++) {
        points[2].x = out[i][0];
        points[2].y = out[i][1];
        assert_int_equal(iris_hough_vote_edges(&hough, points, 3), IRIS_ERR_RANGE);
    }
    for (int32_t i = 0; i < 10 * hough.rho_bins; i++) {
        assert_int_equal(hough.votes[i], 0);
    }
    for (int i = 0; i < 5; i++) {
        iris_hough_config bad = config;
        bad.full_circle = i == 0 ? 2 : i == 1 ? -1 : 0;
        bad.spread = i == 2 ? -1 : i == 3 ? 16384 : 0;
        bad.angle_min = i == 4 ? 16385 : 0; /* with a full circle only */
        assert_int_equal(iris_hough_begin(&hough, (iris_size){40, 30}, &bad, &scratch), IRIS_ERR_ARG);
    }
    config.angle_min = INT16_MIN;
    config.full_circle = 1;
    assert_int_equal(iris_hough_begin(&hough, (iris_size){40, 30}, &config, &scratch), IRIS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(votes_by_direction_are_the_formula),
        cmocka_unit_test(the_direction_and_its_opposite_are_one_in_half_a_turn),
        cmocka_unit_test(both_sides_of_a_bar),
        cmocka_unit_test(each_line_once_with_rho_from_0),
        cmocka_unit_test(votes_saturate),
        cmocka_unit_test(the_largest_image),
        cmocka_unit_test(votes_by_chance),
        cmocka_unit_test(noise_has_no_lines),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("hough, directed", tests, NULL, NULL);
}
