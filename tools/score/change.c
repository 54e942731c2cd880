#include "change.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "iris/copy.h"
#include "picture.h"

const change changes[] = {
    {.name = "as they are", .required = 1},
    {.name = "mirrored", .required = 1, .mirrored = 1},
    {.name = "gain 0.5", .required = 1, .gain = 0.5},
    {.name = "gain 1.5", .required = 1, .gain = 1.5},
    {.name = "noise sigma 8", .required = 1, .noise = 8},
    {.name = "light 0.3 to 1", .required = 1, .light = {0.3, 1}},
    {.name = "light 1 to 0.3", .required = 1, .light = {1, 0.3}},
    {.name = "turned by 180 degrees", .turned = 1},
    {.name = "half size", .smaller = 2},
    {.name = "quarter size", .smaller = 4},
    {.name = "double size", .larger = 2},
    {.name = "gain 0.25", .gain = 0.25},
    {.name = "gain 2", .gain = 2},
    {.name = "half the contrast, towards 128", .gain = 0.5, .lift = 64},
    {.name = "noise sigma 16", .noise = 16},
    {.name = "noise sigma 24", .noise = 24},
    {.name = "half size, noise sigma 8", .smaller = 2, .noise = 8},
    {.name = "gain 0.5, noise sigma 8", .gain = 0.5, .noise = 8},
    {.name = "light 0.3 to 1, noise sigma 8", .light = {0.3, 1}, .noise = 8},
    {.name = "light 0.1 to 1", .light = {0.1, 1}},
    {.name = "blur 7x7 twice", .blur = 3},
    {.name = "blur 15x15 twice", .blur = 7},
    {.name = "shadow 0.5 of the left half", .shadow = {0.5, 0.5, 0.5}},
    {.name = "shadow 0.5 of a slanted half", .shadow = {0.5, 0.2, 0.8}},
    {.name = "shadow 0.35 of the other slanted half", .shadow = {0.35, 0.8, 0.2}},
    {.name = "shadow 0.5 of a third of the rows", .shade = {0.5, 0.33, 0.67}},
    {.name = "a dark wall above, 0.15 of the rows", .shade = {0.05, 0, 0.15}},
    {.name = "specks, 1 % of the pixels", .specks = 0.01},
    {.name = "specks, 5 % of the pixels", .specks = 0.05},
};
const int change_count = sizeof changes / sizeof changes[0];

static double uniform(uint32_t *state) /* 0 < u < 1; xorshift, Marsaglia 2003 */
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state / 4294967296.0;
}

static double gaussian(uint32_t *state) /* Box and Muller 1958 */
{
    double radius = sqrt(-2 * log(uniform(state)));
    return radius * cos(6.283185307179586 * uniform(state));
}

static uint8_t limited(double value)
{
    return (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : floor(value + 0.5));
}

static int channels_of(const iris_image *image)
{
    return image->format == IRIS_GRAY8 ? 1 : 3;
}

/* Mean of the pixels x0..x1, y0..y1 that are inside. */
static double mean(const iris_image *image, iris_rect box, int channel)
{
    int channels = channels_of(image), count = 0;
    double sum = 0;
    for (int y = box.y; y < box.y + box.h; y++) {
        for (int x = box.x; x < box.x + box.w; x++) {
            if (x >= 0 && y >= 0 && x < image->w && y < image->h) {
                sum += ((const uint8_t *)iris_image_row(image, y))[x * channels + channel];
                count++;
            }
        }
    }
    return sum / count;
}

static iris_image resized(const change *how, const iris_image *frame)
{
    int smaller = how->smaller ? how->smaller : 1, larger = how->larger ? how->larger : 1;
    int channels = channels_of(frame);
    iris_image image = picture_make(frame->w / smaller * larger, frame->h / smaller * larger, frame->format);
    if (larger > 1) {
        iris_resize_bilinear(&image, frame);
        return image;
    }
    for (int y = 0; y < image.h; y++) {
        uint8_t *row = iris_image_row(&image, y);
        for (int x = 0; x < image.w * channels; x++) {
            const iris_rect box = {x / channels * smaller, y * smaller, smaller, smaller};
            row[x] = limited(mean(frame, box, x % channels));
        }
    }
    return image;
}

static void flip(const iris_image *image, int left_right, int up_down)
{
    int channels = channels_of(image);
    iris_image copy = picture_make(image->w, image->h, image->format);
    iris_copy(&copy, image);
    for (int y = 0; y < image->h; y++) {
        const uint8_t *from = iris_image_row(&copy, up_down ? image->h - 1 - y : y);
        uint8_t *to = iris_image_row(image, y);
        for (int x = 0; x < image->w; x++) {
            memcpy(to + x * channels, from + (left_right ? image->w - 1 - x : x) * channels,
                   (size_t)channels);
        }
    }
    free(copy.data);
}

static void blur(const iris_image *image, int radius)
{
    int channels = channels_of(image);
    iris_image copy = picture_make(image->w, image->h, image->format);
    iris_copy(&copy, image);
    for (int y = 0; y < image->h; y++) {
        uint8_t *row = iris_image_row(image, y);
        for (int x = 0; x < image->w * channels; x++) {
            const iris_rect box = {x / channels - radius, y - radius, 2 * radius + 1, 2 * radius + 1};
            row[x] = limited(mean(&copy, box, x % channels));
        }
    }
    free(copy.data);
}

/* What the light makes of white at (x, y), as shares of the width and height. */
static double light_at(const change *how, double x, double y)
{
    double gain = how->gain > 0 ? how->gain : 1;
    if (how->light[1] > 0) {
        gain *= how->light[0] + (how->light[1] - how->light[0]) * x;
    }
    if (how->shadow[0] > 0 && x < how->shadow[1] + (how->shadow[2] - how->shadow[1]) * y) {
        gain *= how->shadow[0];
    }
    if (how->shade[0] > 0 && y >= how->shade[1] && y < how->shade[2]) {
        gain *= how->shade[0];
    }
    return gain;
}

static void expose(const change *how, const iris_image *image, uint32_t seed)
{
    int channels = channels_of(image);
    uint32_t state = 2654435761u * (seed + 1) | 1;
    for (int y = 0; y < image->h; y++) {
        uint8_t *row = iris_image_row(image, y);
        for (int x = 0; x < image->w * channels; x++) {
            int column = x / channels;
            double light = light_at(how, (double)column / (image->w - 1), (double)y / image->h);
            double value = row[x] * light + how->lift;
            if (how->noise > 0) {
                value += how->noise * gaussian(&state);
            }
            if (how->specks > 0 && uniform(&state) < how->specks) {
                value = uniform(&state) < 0.5 ? 0 : 255;
            }
            row[x] = limited(value);
        }
    }
}

iris_image change_frame(const change *how, const iris_image *frame, uint32_t seed)
{
    iris_image image = resized(how, frame);
    if (!image.data) {
        return image;
    }
    flip(&image, how->mirrored || how->turned, how->turned);
    if (how->blur > 0) {
        blur(&image, how->blur);
        blur(&image, how->blur);
    }
    expose(how, &image, seed);
    return image;
}

double change_scale(const change *how)
{
    return (how->larger ? how->larger : 1.0) / (how->smaller ? how->smaller : 1.0);
}

void change_point(const change *how, iris_size size, double *x, double *y)
{
    double scale = change_scale(how);
    if (how->mirrored || how->turned) {
        *x = size.w - 1 - *x;
    }
    if (how->turned) {
        *y = size.h - 1 - *y;
    }
    *x = (*x + 0.5) * scale - 0.5;
    *y = (*y + 0.5) * scale - 0.5;
}

int change_is_random(const change *how)
{
    return how->noise > 0 || how->specks > 0;
}
