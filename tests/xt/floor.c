/* The floor against double precision: cameras of every kind, exact and noisy marks, and marks that are none. */
#include "iris/xt/floor.h"

#include "xt/floor_camera.h"

static const double DEGREES = 360.0 / 65536;

static double mm(iris_q16 value)
{
    return value / 65536.0;
}

static double distance(iris_place a, double x, double y)
{
    return hypot(mm(a.x_q16) - x, mm(a.y_q16) - y);
}

/* The largest distance in the picture between the floor and the camera, over the floor in sight up to 2 m. */
static double largest_error_px(const iris_floor *floor, const test_camera *c)
{
    double most = 0;
    for (int j = 0; j <= 12; j++) {
        for (int i = 0; i <= 12; i++) {
            double x, y, u = i * c->w / 12.0, v = j * c->h / 12.0;
            if (camera_floor(&x, &y, c, u, v) && hypot(x, y) < 2000) {
                iris_place at;
                assert_int_equal(iris_floor_image(&at, floor, place_at(x, y)), IRIS_OK);
                camera_sees(&u, &v, c, mm(q16_of(x)), mm(q16_of(y)));
                most = fmax(most, distance(at, u, v));
            }
        }
    }
    return most;
}

static void points_are_those_of_double_precision(void **state)
{
    (void)state;
    int above = 0, seen = 0;
    for (int k = 0; k < 300; k++) {
        test_camera c = any_camera();
        iris_floor floor = true_floor(&c);
        for (int i = 0; i < 60; i++) {
            double x, y, u = uniform(-20, c.w + 20), v = uniform(-80, c.h + 20);
            iris_place image = place_at(u, v), at, back;
            u = mm(image.x_q16);
            v = mm(image.y_q16);
            iris_status status = iris_floor_point(&at, &floor, image);
            if (!camera_floor(&x, &y, &c, u, v)) {
                assert_int_equal(status, IRIS_ERR_RANGE);
                above++;
            } else if (hypot(x, y) < 2000) {
                assert_int_equal(status, IRIS_OK);
                assert_true(distance(at, x, y) < 0.02);
                assert_int_equal(iris_floor_image(&back, &floor, at), IRIS_OK);
                assert_true(distance(back, u, v) < 0.001);
                seen++;
            }
        }
        assert_true(largest_error_px(&floor, &c) < 0.001);
    }
    assert_true(above > 500 && seen > 5000);
}

static void angles_are_true(void **state)
{
    (void)state;
    for (int k = 0; k < 300; k++) {
        test_camera c = any_camera();
        iris_floor floor = true_floor(&c);
        for (int i = 0; i < 30; i++) {
            double x, y, x2, y2, u = uniform(0, c.w), v = uniform(c.h / 3.0, c.h);
            iris_angle direction = (iris_angle)uniform(-32768, 32767), angle = 0;
            double turn = direction * DEGREES * 3.14159265358979323846 / 180, step = 1e-4;
            if (!camera_floor(&x, &y, &c, u, v) || hypot(x, y) > 3000) {
                continue;
            }
            camera_floor(&x, &y, &c, u - step * sin(turn), v + step * cos(turn));
            camera_floor(&x2, &y2, &c, u + step * sin(turn), v - step * cos(turn));
            double expected = atan2(x2 - x, y2 - y) * 180 / 3.14159265358979323846;
            assert_int_equal(iris_floor_angle(&angle, &floor, place_at(u, v), direction), IRIS_OK);
            assert_true(fabs(remainder(angle * DEGREES - expected, 360)) < 0.02);

            iris_floor_line line;
            double far_u = u + 20 * sin(turn), far_v = v - 20 * cos(turn);
            if (camera_floor(&x2, &y2, &c, far_u, far_v) && hypot(x2, y2) < 3000) {
                camera_floor(&x, &y, &c, u, v);
                assert_int_equal(iris_floor_segment(&line, &floor, place_at(u, v), place_at(far_u, far_v)),
                                 IRIS_OK);
                assert_true(distance(line.a, x, y) < 0.05 && distance(line.b, x2, y2) < 0.05);
                assert_true(fabs(mm(line.length_q16) - hypot(x2 - x, y2 - y)) < 0.1);
                expected = atan2(x2 - x, y2 - y) * 180 / 3.14159265358979323846;
                assert_true(fabs(remainder(line.angle * DEGREES - expected, 360)) < 0.05);
            }
        }
    }
}

static void exact_marks_give_the_camera(void **state)
{
    (void)state;
    static const int counts[] = {4, 5, 6, 8, 12, 20, 33, 64};
    iris_floor_mark marks[64];
    for (int k = 0; k < 400; k++) {
        test_camera c = any_camera();
        iris_floor floor;
        iris_floor_quality quality;
        int count = counts[k % 8];
        draw_marks(marks, count, &c, 0);
        assert_int_equal(iris_floor_fit(&floor, &quality, (iris_size){c.w, c.h}, marks, count), IRIS_OK);
        assert_int_equal(quality.flaw, IRIS_FLOOR_FINE);
        assert_int_equal(floor.size.w, c.w);
        assert_true(mm(quality.max_px_q16) < 0.001 && mm(quality.rms_px_q16) < 0.001);
        assert_true(mm(quality.max_mm_q16) < 0.1);
        assert_true(largest_error_px(&floor, &c) < 0.02);
    }
}

/* Gauss-Jordan: each unknown alone. */
static void eliminate(double a[8][9])
{
    for (int p = 0; p < 8; p++) {
        int best = p;
        for (int r = p; r < 8; r++) {
            best = fabs(a[r][p]) > fabs(a[best][p]) ? r : best;
        }
        for (int q = 0; q < 9; q++) {
            double kept = a[p][q];
            a[p][q] = a[best][q];
            a[best][q] = kept;
        }
        for (int r = 0; r < 8; r++) {
            double factor = r == p ? 0 : a[r][p] / a[p][p];
            for (int q = 0; q < 9; q++) {
                a[r][q] -= factor * a[p][q];
            }
        }
    }
}

/* Least squares by Gauss-Newton in double precision, from the camera itself. Returns the sum of squares. */
static double best_sum(const iris_floor_mark *marks, int count, const test_camera *c)
{
    double h[9], sum = 0;
    camera_numbers(h, c);
    double near =
        c->ahead + 300; /* in front of the camera: where it sees the floor, nothing there is near 0 */
    for (int i = 0; i < 9; i += 3) {
        h[i + 2] += near * h[i + 1];
    }
    for (int i = 0; i < 9; i++) { /* in units of 500 mm and of the picture's width, from its middle */
        h[i] = i / 3 == 2 ? h[i] : (h[i] - h[6 + i % 3] * (i / 3 ? c->cy : c->cx)) / c->w;
    }
    for (int i = 0; i < 9; i++) {
        h[i] *= i % 3 == 2 ? 1 : 500;
    }
    for (int round = 0; round < 30; round++) {
        double a[8][9] = {{0}};
        double eight = h[8];
        sum = 0;
        for (int i = 0; i < 9; i++) {
            h[i] /= eight;
        }
        for (int i = 0; i < count; i++) {
            double x = mm(marks[i].floor.x_q16) / 500, y = (mm(marks[i].floor.y_q16) - near) / 500;
            double w = h[6] * x + h[7] * y + h[8];
            for (int k = 0; k < 2; k++) {
                double put = (h[3 * k] * x + h[3 * k + 1] * y + h[3 * k + 2]) / w, row[9] = {0};
                row[3 * k] = x / w;
                row[3 * k + 1] = y / w;
                row[3 * k + 2] = 1 / w;
                row[6] = -put * x / w;
                row[7] = -put * y / w;
                row[8] = k ? mm(marks[i].image.y_q16) - c->cy : mm(marks[i].image.x_q16) - c->cx;
                row[8] = row[8] / c->w - put;
                sum += row[8] * row[8];
                for (int p = 0; p < 8; p++) {
                    for (int q = 0; q < 9; q++) {
                        a[p][q] += row[p] * row[q];
                    }
                }
            }
        }
        eliminate(a);
        for (int p = 0; p < 8; p++) {
            h[p] += a[p][8] / a[p][p];
        }
    }
    return sum * c->w * c->w;
}

static void noisy_marks_give_the_least_squares(void **state)
{
    (void)state;
    static const int counts[] = {5, 6, 8, 12, 20, 33, 64, 200};
    iris_floor_mark marks[200];
    for (int k = 0; k < 240; k++) {
        test_camera c = any_camera();
        iris_floor floor;
        iris_floor_quality quality;
        int count = counts[k % 8];
        draw_marks(marks, count, &c, 0.3);
        assert_int_equal(iris_floor_fit(&floor, &quality, (iris_size){c.w, c.h}, marks, count), IRIS_OK);
        double best = sqrt(best_sum(marks, count, &c) / count), most = 0, sum = 0;
        double rms = mm(quality.rms_px_q16);
        if (!(fabs(rms - best) < 0.0005 + 0.001 * best)) {
            print_error("%d marks: rms %g px, possible %g\n", count, rms, best);
            fail();
        }
        for (int i = 0; i < count; i++) { /* the figures are those of the floor */
            iris_place put;
            assert_int_equal(iris_floor_image(&put, &floor, marks[i].floor), IRIS_OK);
            double away = distance(put, mm(marks[i].image.x_q16), mm(marks[i].image.y_q16));
            most = fmax(most, away);
            sum += away * away;
        }
        assert_true(fabs(most - mm(quality.max_px_q16)) < 0.001 && fabs(sqrt(sum / count) - rms) < 0.002);
    }
}

static iris_floor_flaw flaw_of(const iris_floor_mark *marks, int32_t count)
{
    iris_floor floor, kept;
    iris_floor_quality quality = {.flaw = IRIS_FLOOR_FINE};
    memset(&floor, 0x5A, sizeof floor);
    kept = floor;
    iris_status status = iris_floor_fit(&floor, &quality, (iris_size){320, 240}, marks, count);
    assert_int_equal(status, quality.flaw == IRIS_FLOOR_FINE ? IRIS_OK : IRIS_ERR_DATA);
    assert_true(status == IRIS_OK || memcmp(&floor, &kept, sizeof floor) == 0);
    return quality.flaw;
}

static void what_is_no_floor_is_refused(void **state)
{
    (void)state;
    iris_floor_mark marks[40], changed[40];
    for (int k = 0; k < 300; k++) {
        test_camera c = any_camera();
        int count = 4 + k % 12;
        double noise = k % 2 ? 0.3 : 0;
        draw_marks(marks, count, &c, noise);
        assert_int_equal(flaw_of(marks, count), IRIS_FLOOR_FINE);
        assert_int_equal(flaw_of(marks, k % 4), IRIS_FLOOR_TOO_FEW);

        memcpy(changed, marks, sizeof marks);
        for (int i = 3; i < count; i++) { /* three different marks, again and again */
            changed[i] = changed[i % 3];
        }
        assert_int_equal(flaw_of(changed, count), IRIS_FLOOR_TOO_FEW);

        memcpy(changed, marks, sizeof marks);
        int odd = (int)uniform(0, count - 0.001); /* all but this one between the first two of the others */
        int first = odd == 0, second = first + 1 + (first + 1 == odd);
        for (int i = 0; i < count; i++) {
            double t = uniform(-0.3, 1.3), x, y, u, v;
            if (i != odd && i != first && i != second) {
                x = mm(marks[first].floor.x_q16) * (1 - t) + mm(marks[second].floor.x_q16) * t;
                y = mm(marks[first].floor.y_q16) * (1 - t) + mm(marks[second].floor.y_q16) * t;
                if (camera_sees(&u, &v, &c, x, y) < 1) {
                    i--;
                    continue;
                }
                changed[i] =
                    (iris_floor_mark){place_at(u + normal(noise), v + normal(noise)), place_at(x, y)};
            }
        }
        assert_int_equal(flaw_of(changed, count), IRIS_FLOOR_IN_LINE);

        memcpy(changed, marks, sizeof marks);
        for (int i = 0; i < count; i++) {
            changed[i].floor.x_q16 = -marks[i].floor.x_q16;
        }
        assert_int_equal(flaw_of(changed, count), IRIS_FLOOR_MIRRORED);

        memcpy(changed, marks, 4 * sizeof marks[0]); /* two of four corners interchanged: a bow tie */
        changed[0].floor = marks[1].floor;
        changed[1].floor = marks[0].floor;
        assert_int_equal(flaw_of(changed, 4), IRIS_FLOOR_HORIZON);
    }
}

static void hostile_numbers_stay_harmless(void **state)
{
    (void)state;
    static const int32_t extremes[] = {INT32_MIN, INT32_MAX, 0, 1, -1, 65536, INT32_MIN + 1, 32767 * 65536};
    iris_floor_mark marks[16];
    iris_floor floor;
    iris_floor_quality quality;
    int fine = 0;
    for (int k = 0; k < 20000; k++) {
        int count = 4 + k % 13;
        for (int i = 0; i < count; i++) {
            int32_t v[4];
            for (int j = 0; j < 4; j++) {
                double reach = k % 3 == 0 ? 2147483647.0 : k % 3 == 1 ? 40 : 20000000;
                v[j] = k % 5 == 0 ? extremes[(int)uniform(0, 7.999)] : (int32_t)uniform(-reach, reach);
            }
            marks[i] = (iris_floor_mark){{v[0], v[1]}, {v[2], v[3]}};
        }
        if (iris_floor_fit(&floor, &quality, (iris_size){320, 240}, marks, count) == IRIS_OK) {
            iris_place at;
            iris_angle angle;
            iris_floor_line line;
            fine++;
            (void)iris_floor_point(&at, &floor, marks[0].image);
            (void)iris_floor_image(&at, &floor, marks[1].floor);
            (void)iris_floor_angle(&angle, &floor, marks[1].image, (iris_angle)k);
            (void)iris_floor_segment(&line, &floor, marks[0].image, marks[1].image);
        }
    }
    assert_true(fine > 20);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    test_camera c = any_camera();
    iris_floor_mark marks[4];
    iris_floor floor, other;
    iris_floor_quality quality;
    iris_place at = {0, 0};
    iris_angle angle;
    iris_floor_line line;
    iris_size size = {c.w, c.h};
    draw_marks(marks, 4, &c, 0);
    assert_int_equal(iris_floor_fit(NULL, &quality, size, marks, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_fit(&floor, NULL, size, marks, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_fit(&floor, &quality, size, NULL, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_fit(&floor, &quality, size, marks, -1), IRIS_ERR_RANGE);
    assert_int_equal(iris_floor_fit(&floor, &quality, size, marks, IRIS_FLOOR_MARKS_MAX + 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_floor_fit(&floor, &quality, (iris_size){0, 9}, marks, 4), IRIS_ERR_RANGE);
    assert_int_equal(iris_floor_fit(&floor, &quality, (iris_size){9, IRIS_SIDE_MAX + 1}, marks, 4),
                     IRIS_ERR_RANGE);
    assert_int_equal(iris_floor_fit(&floor, &quality, size, NULL, 0), IRIS_ERR_DATA);
    assert_int_equal(iris_floor_fit(&floor, &quality, size, marks, 4), IRIS_OK);
    assert_int_equal(iris_floor_init(&other, size, floor.to_image_q32), IRIS_OK);
    assert_memory_equal(&other, &floor, sizeof floor);
    assert_int_equal(iris_floor_init(NULL, size, floor.to_image_q32), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_init(&other, size, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_init(&other, (iris_size){9, 0}, floor.to_image_q32), IRIS_ERR_RANGE);
    iris_q32 numbers[9] = {0};
    assert_int_equal(iris_floor_init(&other, size, numbers), IRIS_ERR_DATA);
    numbers[4] = INT64_MIN;
    assert_int_equal(iris_floor_init(&other, size, numbers), IRIS_ERR_RANGE);
    assert_int_equal(iris_floor_point(NULL, &floor, at), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_point(&at, NULL, at), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_image(NULL, &floor, at), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_image(&at, NULL, at), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_angle(NULL, &floor, at, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_angle(&angle, NULL, at, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_segment(NULL, &floor, at, at), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_segment(&line, NULL, at, at), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_foot(NULL, &floor, (iris_rect){1, 1, 1, 1}), IRIS_ERR_ARG);
    assert_int_equal(iris_floor_foot(&at, &floor, (iris_rect){1, 1, 0, 1}), IRIS_ERR_RANGE);
    assert_int_equal(iris_floor_foot(&at, &floor, (iris_rect){0, 0, IRIS_SIDE_MAX, INT32_MAX}),
                     IRIS_ERR_RANGE);
    iris_place foot, expected;
    assert_int_equal(iris_floor_foot(&foot, &floor, (iris_rect){10, c.h - 20, 9, 10}), IRIS_OK);
    assert_int_equal(iris_floor_point(&expected, &floor, place_at(14, c.h - 10.5)), IRIS_OK);
    assert_memory_equal(&foot, &expected, sizeof foot);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_those_of_double_precision),
        cmocka_unit_test(angles_are_true),
        cmocka_unit_test(exact_marks_give_the_camera),
        cmocka_unit_test(noisy_marks_give_the_least_squares),
        cmocka_unit_test(what_is_no_floor_is_refused),
        cmocka_unit_test(hostile_numbers_stay_harmless),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
