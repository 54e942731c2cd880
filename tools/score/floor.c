/* The floor: how true its millimeters are, what is refused, and what a robot gains by them. */
#include "iris/xt/floor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "figures.h"
#include "iris/xt/birdseye.h"
#include "iris/xt/pursuit.h"

#define W     320
#define H     240
#define SPOTS 12
#define NOISE 0.3 /* pixels, of what is read off a picture */

/* A camera above a floor, mm and radians. */
typedef struct {
    double focal, height, tilt, roll;
} floor_camera;

static uint64_t random_state;

static double uniform(double low, double high)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return low + (high - low) * (double)(random_state >> 11) / 9007199254740992.0;
}

static double normal(double sigma)
{
    double u = uniform(1e-12, 1), v = uniform(0, 6.283185307179586);
    return sigma * sqrt(-2 * log(u)) * cos(v);
}

/* 100 to 400 mm high, 20 to 70 degrees down. */
static floor_camera any_camera(void)
{
    const double degree = 3.14159265358979323846 / 180;
    double focal = W / 2.0 / tan(uniform(25, 38) * degree), height = uniform(100, 400);
    double tilt = uniform(20, 70) * degree;
    return (floor_camera){focal, height, tilt, uniform(-4, 4) * degree};
}

/* The floor to the picture; returns the depth. */
static double see(double *u, double *v, const floor_camera *c, double x, double y)
{
    double down = c->height * cos(c->tilt) - y * sin(c->tilt),
           depth = c->height * sin(c->tilt) + y * cos(c->tilt);
    *u = (W - 1) / 2.0 + c->focal * (x * cos(c->roll) - down * sin(c->roll)) / depth;
    *v = (H - 1) / 2.0 + c->focal * (x * sin(c->roll) + down * cos(c->roll)) / depth;
    return depth;
}

/* The picture to the floor; 0 when it is not within 3 m. */
static int meet(double *x, double *y, const floor_camera *c, double u, double v)
{
    double a = (u - (W - 1) / 2.0) / c->focal, b = (v - (H - 1) / 2.0) / c->focal;
    double right = a * cos(c->roll) + b * sin(c->roll), down = b * cos(c->roll) - a * sin(c->roll);
    double drop = sin(c->tilt) + down * cos(c->tilt);
    *x = right * c->height / drop;
    *y = (cos(c->tilt) - down * sin(c->tilt)) * c->height / drop;
    return drop > 0 && hypot(*x, *y) < 3000;
}

static iris_place place(double x, double y)
{
    return (iris_place){(iris_q16)lround(x * 65536), (iris_q16)lround(y * 65536)};
}

/* Marks all over the lower part of the picture, the first four near its corners. */
static void draw_marks(iris_floor_mark *marks, int count, const floor_camera *c, double noise)
{
    for (int i = 0; i < count; i++) {
        double x, y, u, v;
        do {
            double a = i < 4 ? 0.1 + 0.8 * (i & 1) + uniform(-0.05, 0.05) : uniform(0.05, 0.95);
            double b = i < 4 ? 0.4 + 0.5 * (i >> 1) + uniform(-0.03, 0.03) : uniform(0.35, 0.95);
            u = a * W;
            v = b * H;
        } while (!meet(&x, &y, c, u, v));
        x = floor(x + 0.5);
        y = floor(y + 0.5);
        (void)see(&u, &v, c, x, y);
        marks[i] = (iris_floor_mark){place(u + normal(noise), v + normal(noise)), place(x, y)};
    }
}

static int fit(iris_floor *found, const iris_floor_mark *marks, int count, iris_floor_flaw *flaw)
{
    iris_floor_quality quality;
    iris_status status = iris_floor_fit(found, &quality, (iris_size){W, H}, marks, count);
    *flaw = quality.flaw;
    return status == IRIS_OK;
}

/* Distances of what the floor says from what is true, all over the floor in sight: in the picture, and within 1 m on the floor. */
static void add_errors(double *square_px, double *square_mm, long *n, const iris_floor *found,
                       const floor_camera *c)
{
    for (int i = 0; i < 80; i++) {
        double u = uniform(0, W - 1), v = uniform(H / 3.0, H - 1), x, y, to_u, to_v;
        iris_place mm, px;
        if (meet(&x, &y, c, u, v) && hypot(x, y) < 1000 &&
            iris_floor_point(&mm, found, place(u, v)) == IRIS_OK &&
            iris_floor_image(&px, found, place(x, y)) == IRIS_OK) {
            (void)see(&to_u, &to_v, c, x, y);
            *square_mm += pow(mm.x_q16 / 65536.0 - x, 2) + pow(mm.y_q16 / 65536.0 - y, 2);
            *square_px += pow(px.x_q16 / 65536.0 - to_u, 2) + pow(px.y_q16 / 65536.0 - to_v, 2);
            ++*n;
        }
    }
}

static void score_fits(score *s)
{
    static const int counts[] = {4, 8, 16, 64};
    for (int k = 0; k < 4; k++) {
        iris_floor_mark marks[64];
        double px = 0, mm = 0;
        long n = 0, refused = 0;
        random_state = 88172645463325252u;
        for (int i = 0; i < 300; i++) {
            floor_camera c = any_camera();
            iris_floor found;
            iris_floor_flaw flaw;
            draw_marks(marks, counts[k], &c, NOISE);
            if (fit(&found, marks, counts[k], &flaw)) {
                add_errors(&px, &mm, &n, &found, &c);
            } else {
                refused++;
            }
        }
        char what[96];
        snprintf(what, sizeof what, "floor from %d marks read to 0.3 px, 300 cameras", counts[k]);
        score_row(s, what, k == 1 ? "at most 0.5 px" : NULL,
                  k == 1 ? score_if(refused == 0 && sqrt(px / (double)n) <= 0.5) : SCORE_INFORMATION,
                  "rms %.2f px, %.1f mm within 1 m; %ld refused", sqrt(px / (double)n), sqrt(mm / (double)n),
                  refused);
    }
}

/* Exact marks: what the integers lose. */
static void score_exact(score *s)
{
    double most = 0;
    random_state = 1234567;
    for (int i = 0; i < 500; i++) {
        iris_floor_mark marks[12];
        iris_floor found;
        iris_floor_flaw flaw;
        floor_camera c = any_camera();
        draw_marks(marks, 12, &c, 0);
        double px = 0, mm = 0;
        long n = 0;
        if (fit(&found, marks, 12, &flaw)) {
            add_errors(&px, &mm, &n, &found, &c);
        }
        most = fmax(most, n > 0 ? sqrt(px / (double)n) : 1000);
    }
    score_row(s, "floor from exact marks against double precision", "at most 0.01 px", score_if(most <= 0.01),
              "%.6f px", most);
}

/* A picture of dark spots of 12 mm on the floor, four samples a side in each pixel, with noise and uneven light. */
static void render(uint8_t *gray, const floor_camera *c, const double (*spots)[2])
{
    for (int y = 0; y < H; y++) {
        for (int x = 0; x < W; x++) {
            double sum = 0, light = 0.8 + 0.4 * x / W;
            for (int k = 0; k < 16; k++) {
                double right, ahead, level = 170;
                int on = meet(&right, &ahead, c, x - 0.375 + 0.25 * (k % 4), y - 0.375 + 0.25 * (k / 4));
                for (int i = 0; on && i < SPOTS; i++) {
                    level = hypot(right - spots[i][0], ahead - spots[i][1]) < 12 ? 30 : level;
                }
                sum += level / 16;
            }
            sum = sum * light + normal(5);
            gray[y * W + x] = (uint8_t)(sum < 0 ? 0 : sum > 255 ? 255 : sum + 0.5);
        }
    }
}

/* Where the picture shows the spot that should be about at (u, v): its center of darkness. 0 when it is not all there. */
static int spot_center(double *u, double *v, const uint8_t *gray, double reach)
{
    double sum = 0, at_u = 0, at_v = 0;
    int left = (int)(*u - reach), top = (int)(*v - reach), side = (int)(2 * reach) + 1;
    if (left < 0 || top < 0 || left + side >= W || top + side >= H) {
        return 0;
    }
    for (int y = top; y <= top + side; y++) {
        for (int x = left; x <= left + side; x++) {
            double dark = 110 - gray[y * W + x];
            if (dark > 0) {
                sum += dark;
                at_u += dark * x;
                at_v += dark * y;
            }
        }
    }
    *u = at_u / sum;
    *v = at_v / sum;
    return sum > 0;
}

static void score_rendered(score *s)
{
    static uint8_t gray[W * H];
    double sum = 0, most = 0;
    long n = 0;
    random_state = 424242;
    for (int k = 0; k < 20; k++) {
        floor_camera c = any_camera();
        iris_floor_mark marks[8];
        iris_floor found;
        iris_floor_flaw flaw;
        double spots[SPOTS][2];
        for (int i = 0; i < SPOTS; i++) { /* one of them in each of 4x3 fields of the picture's lower part */
            double u = W * (0.13 + 0.25 * (i % 4) + uniform(-0.04, 0.04)), v = H * (0.45 + 0.2 * (i / 4));
            if (!meet(&spots[i][0], &spots[i][1], &c, u, v)) {
                spots[i][1] = 100000;
            }
        }
        draw_marks(marks, 8, &c, NOISE);
        render(gray, &c, (const double(*)[2])spots);
        for (int i = 0; i < SPOTS && fit(&found, marks, 8, &flaw); i++) {
            double u, v, depth = see(&u, &v, &c, spots[i][0], spots[i][1]);
            double reach = 14 * c.focal / depth + 2;
            iris_place mm;
            if (hypot(spots[i][0], spots[i][1]) < 600 && reach < 20 && reach > 4 &&
                spot_center(&u, &v, gray, reach) && iris_floor_point(&mm, &found, place(u, v)) == IRIS_OK) {
                double off = hypot(mm.x_q16 / 65536.0 - spots[i][0], mm.y_q16 / 65536.0 - spots[i][1]);
                sum += off;
                most = fmax(most, off);
                n++;
            }
        }
    }
    score_row(s, "spots of 24 mm in rendered pictures, within 0.6 m", "at most 2 mm",
              score_if(n > 50 && sum / (double)n <= 2), "mean %.2f mm, largest %.1f (%ld spots, 8 marks)",
              sum / (double)n, most, n);
}

/* Marks that are no floor, with and without noise; returns what is expected. */
static iris_floor_flaw spoil(iris_floor_mark *marks, int count, const floor_camera *c, int how, double noise)
{
    for (int i = 0; i < count; i++) {
        double t = uniform(-0.3, 1.3), x = marks[0].floor.x_q16 / 65536.0, y = marks[0].floor.y_q16 / 65536.0,
               u, v;
        x += t * (marks[1].floor.x_q16 / 65536.0 - x);
        y += t * (marks[1].floor.y_q16 / 65536.0 - y);
        if (how == 0 && i > 2) { /* three places, again and again */
            marks[i] = marks[i % 3];
        } else if (how == 1 && i > 1 && i < count - 1) { /* all but one in line */
            (void)see(&u, &v, c, x, y);
            marks[i] = (iris_floor_mark){place(u + normal(noise), v + normal(noise)), place(x, y)};
        } else if (how == 2) {
            marks[i].floor.x_q16 = -marks[i].floor.x_q16;
        }
    }
    if (how == 3) { /* a bow tie */
        iris_place kept = marks[0].floor;
        marks[0].floor = marks[1].floor;
        marks[1].floor = kept;
    }
    static const iris_floor_flaw expected[] = {IRIS_FLOOR_TOO_FEW, IRIS_FLOOR_IN_LINE, IRIS_FLOOR_MIRRORED,
                                               IRIS_FLOOR_HORIZON};
    return expected[how];
}

static void score_refused(score *s)
{
    long wrong_reason = 0, accepted = 0, good_refused = 0, n = 0;
    random_state = 987654321;
    for (int i = 0; i < 2000; i++) {
        floor_camera c = any_camera();
        iris_floor_mark marks[12];
        iris_floor found;
        iris_floor_flaw flaw;
        int how = i % 4, count = how == 3 ? 4 : 4 + i / 4 % 9;
        double noise = i % 8 < 4 ? 0 : NOISE;
        draw_marks(marks, count, &c, noise);
        good_refused += !fit(&found, marks, count, &flaw);
        iris_floor_flaw expected = spoil(marks, count, &c, how, noise);
        accepted += fit(&found, marks, count, &flaw);
        wrong_reason += flaw != IRIS_FLOOR_FINE && flaw != expected;
        n++;
    }
    score_row(s, "marks that determine no floor refused", "all", score_if(accepted == 0 && good_refused == 0),
              "%ld of %ld; %ld for another reason; good ones refused: %ld", n - accepted, n, wrong_reason,
              good_refused);
}

/* The picture's positions in a bird's-eye view, against the floor's numbers in double precision. */
static void score_birdseye(score *s)
{
    static iris_place places[W];
    double most = 0;
    long n = 0;
    random_state = 31415926;
    for (int k = 0; k < 200; k++) {
        floor_camera c = any_camera();
        iris_floor_mark marks[8];
        iris_floor found;
        iris_floor_flaw flaw;
        iris_birdseye view;
        iris_birdseye_window window = {.size = {W, H},
                                       .corner = place(uniform(-900, -100), uniform(300, 2500))};
        window.mm_per_pixel_q16 = (iris_q16)(65536 * uniform(1, 10));
        draw_marks(marks, 8, &c, NOISE);
        if (!fit(&found, marks, 8, &flaw) || iris_birdseye_init(&view, &found, &window) != IRIS_OK) {
            continue;
        }
        double m[9];
        for (int i = 0; i < 9; i++) {
            m[i] = (double)found.to_image_q32[i];
        }
        for (int y = 0; y < H; y += 5) {
            (void)iris_birdseye_places(places, &view, y);
            for (int x = 0; x < W; x++) {
                double right = (window.corner.x_q16 + (double)window.mm_per_pixel_q16 * x) / 65536;
                double ahead = (window.corner.y_q16 - (double)window.mm_per_pixel_q16 * y) / 65536;
                double w = m[6] * right + m[7] * ahead + m[8];
                if (places[x].x_q16 != INT32_MIN) {
                    most = fmax(most,
                                hypot(places[x].x_q16 / 65536.0 - (m[0] * right + m[1] * ahead + m[2]) / w,
                                      places[x].y_q16 / 65536.0 - (m[3] * right + m[4] * ahead + m[5]) / w));
                    n++;
                }
            }
        }
    }
    score_row(s, "bird's-eye view: source positions, largest error", "below 1/16 px",
              score_if(n > 100000 && most < 1.0 / 16), "%.4f px (%ld pixels of 200 views)", most, n);
}

/* Mean and largest lateral distance of a drive, mm. 0 when there was none. */
static int read_drive(double *mean, double *most, char *why, size_t bytes, const score *s, const char *name)
{
    char line[256];
    int passed = 0;
    FILE *file = figures_open(why, bytes, s, name);
    *mean = *most = 0;
    while (file && fgets(line, sizeof line, file)) {
        sscanf(line, "error rms %*f cm, largest %lf cm", most);
        sscanf(line, " mean %lf cm", mean);
        passed |= strncmp(line, "PASSED", 6) == 0;
    }
    if (file) {
        fclose(file);
        snprintf(why, bytes, "the drive failed");
    }
    *mean *= 10;
    *most *= 10;
    return passed;
}

static void score_driven(score *s)
{
    char why[128];
    double plain_mean, plain_most, mean, most;
    if (!read_drive(&plain_mean, &plain_most, why, sizeof why, s, "drive") ||
        !read_drive(&mean, &most, why, sizeof why, s, "drive-floor")) {
        score_row(s, "drive by millimeters", "at most plain",
                  strcmp(why, "the drive failed") == 0 ? SCORE_MISSED : SCORE_SKIPPED, "%s", why);
        return;
    }
    score_row(s, "drive by millimeters: lateral distance", "at most plain",
              score_if(mean <= plain_mean && most <= plain_most),
              "mean %.1f mm, largest %.0f; plain: mean %.1f, largest %.0f", mean, most, plain_mean,
              plain_most);
}

void score_floor(score *s)
{
    score_fits(s);
    score_exact(s);
    score_rendered(s);
    score_refused(s);
    score_birdseye(s);
    score_driven(s);
    score_cost_row(s, "192 floor points to millimeters", "floor: 192 points", sizeof(iris_floor));
    score_cost_row(s, "goal of a pursuit", "floor: goal of a pursuit",
                   sizeof(iris_floor) + sizeof(iris_pursuit_goal));
    score_cost_row(s, "bird's-eye view of gray", "bird's-eye view of gray", sizeof(iris_birdseye));
    score_cost_row(s, "bird's-eye view of color", "bird's-eye view of color", sizeof(iris_birdseye));
}
