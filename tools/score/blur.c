/* The Gaussian blur against double precision, at sigmas from its least to its largest. */
#include <math.h>
#include <stdlib.h>

#include "iris/xt/blur.h"
#include "picture.h"
#include "score.h"

#define SIGMAS 40
#define WIDTH  256
#define REACH  200 /* five of the largest sigma, where nothing is left */

typedef struct {
    double weight[REACH + 1];
    int32_t reach;
} gaussian;

static int32_t clamped(int32_t i, int32_t n)
{
    return i < 0 ? 0 : i < n ? i : n - 1;
}

/* `to` is `from` summed along one axis; pixels of a line are `step` apart, lines `next`. */
static void sum_lines(double *to, const double *from, iris_size size, int down, const gaussian *by)
{
    int32_t n = down ? size.h : size.w, lines = down ? size.w : size.h;
    int32_t step = down ? size.w : 1, next = down ? 1 : size.w;
    for (int32_t line = 0; line < lines; line++) {
        for (int32_t i = 0; i < n; i++) {
            double sum = 0;
            for (int32_t k = -by->reach; k <= by->reach; k++) {
                sum += by->weight[abs(k)] * from[line * next + clamped(i + k, n) * step];
            }
            to[line * next + i * step] = sum;
        }
    }
}

static gaussian gaussian_of(double sigma)
{
    gaussian g = {.reach = (int32_t)ceil(5 * sigma)};
    double sum = 0;
    for (int k = g.reach; k >= 0; k--) {
        g.weight[k] = exp(-k * k / (2 * sigma * sigma));
        sum += k > 0 ? 2 * g.weight[k] : g.weight[k];
    }
    for (int k = 0; k <= g.reach; k++) {
        g.weight[k] /= sum;
    }
    return g;
}

/* The farthest that a blurred pixel is from the rounded exact one. */
static int worst_at(const iris_image *image, iris_q16 sigma_q16, double *exact, double *between)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_BLUR_GAUSSIAN_SCRATCH_BYTES(WIDTH, 1, IRIS_BLUR_SIGMA_MAX));
    iris_size size = {image->w, image->h};
    iris_image blurred = picture_make(size.w, size.h, IRIS_GRAY8);
    gaussian by = gaussian_of(sigma_q16 / 65536.0);
    iris_scratch scratch;
    int worst = 255;
    for (int32_t i = 0; i < size.w * size.h; i++) {
        exact[i] = ((const uint8_t *)iris_image_row(image, i / size.w))[i % size.w];
    }
    sum_lines(between, exact, size, 1, &by);
    sum_lines(exact, between, size, 0, &by);
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (blurred.data && iris_blur_gaussian(&blurred, image, sigma_q16,
                                           (iris_border){IRIS_BORDER_REPLICATE, 0}, &scratch) == IRIS_OK) {
        worst = 0;
        for (int32_t i = 0; i < size.w * size.h; i++) {
            int is = ((const uint8_t *)iris_image_row(&blurred, i / size.w))[i % size.w];
            int off = abs(is - (int)floor(exact[i] + 0.5));
            worst = off > worst ? off : worst;
        }
    }
    free(blurred.data);
    return worst;
}

void score_blur(score *s)
{
    static const char what[] = "Gaussian blur, sigma 0.1 to 40, off the real one's rounded pixels";
    iris_image image;
    if (picture_load(&image, "edges/classic/camera_256.pgm", IRIS_GRAY8) != IRIS_OK) {
        score_row(s, what, "at most 1", SCORE_SKIPPED, "no data (IRIS_DATA)");
        free(image.data);
        return;
    }
    size_t pixels = (size_t)image.w * (size_t)image.h;
    double *exact = calloc(2 * pixels, sizeof *exact);
    int worst = exact ? 0 : 255;
    for (int i = 0; exact && i < SIGMAS; i++) {
        double sigma = 0.1 * pow(400, (double)i / (SIGMAS - 1));
        iris_q16 sigma_q16 = (iris_q16)ceil(sigma * 65536);
        sigma_q16 = sigma_q16 > IRIS_BLUR_SIGMA_MAX ? IRIS_BLUR_SIGMA_MAX : sigma_q16;
        int off = worst_at(&image, sigma_q16, exact, exact + pixels);
        worst = off > worst ? off : worst;
    }
    free(exact);
    free(image.data);
    score_row(s, what, "at most 1", score_if(worst <= 1), "%d, at %d sigmas on a photograph", worst, SIGMAS);
}
