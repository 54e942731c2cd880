#include "histogram_chart.h"

#include <math.h>
#include <stdio.h>

#include "iris/copy.h"
#include "iris/draw.h"

/* Pixels. The plot is PLOT_W wide, so many for each level. */
enum {
    LEFT = 96,
    RIGHT = 28,
    TOP = 12,
    BOTTOM = 34,
    LINE_H = 22,
    GAP = 16,
    PLOT_W = 512,
    PLOT_H = 256,
    TICK = 6,
    SCALE = 2
};

static const iris_color ink = {40, 40, 40}, pale = {222, 222, 222}, cut = {190, 0, 0};

typedef struct {
    const iris_image *image;
    const chart *of;
    int32_t top;   /* y of the plot's upper edge */
    uint64_t most; /* the count there */
    uint64_t step; /* from one line of the grid to the next */
} drawing;

iris_size chart_size(const chart *of)
{
    return (iris_size){LEFT + PLOT_W + RIGHT, TOP + LINE_H * of->channels + GAP + PLOT_H + BOTTOM};
}

static int32_t x_of(const drawing *d, int level)
{
    return LEFT + level * PLOT_W / d->of->levels;
}

/* y of a count, cut off at the plot's edge. */
static int32_t y_of(const drawing *d, uint64_t count)
{
    count = count < d->most ? count : d->most;
    return d->top + PLOT_H - (int32_t)(count * PLOT_H / d->most);
}

/* The scale ends at 1, 2, or 5 times a power of ten. Black and white, which gather what is out of range, do not set it when
 * they are far above the rest. */
static void choose_scale(drawing *d)
{
    uint64_t inner = 0, outer = 1, power = 1;
    for (int c = 0; c < d->of->channels; c++) {
        for (int p = 0; p < d->of->levels; p++) {
            uint64_t count = d->of->channel[c].count[p];
            outer = count > outer ? count : outer;
            inner = count > inner && p > 0 && p < d->of->levels - 1 ? count : inner;
        }
    }
    uint64_t peak = outer > 2 * inner && inner > 0 ? inner : outer;
    while (10 * power < peak) {
        power *= 10;
    }
    uint64_t times = peak <= power ? 1 : peak <= 2 * power ? 2 : peak <= 5 * power ? 5 : 10;
    uint64_t parts = times == 2 ? 4 : 5;
    d->most = times * power;
    d->step = d->most % parts == 0 ? d->most / parts : 1;
}

/* What lies under a curve is tinted with its color; where curves overlap the tints darken each other. */
static void tint(const drawing *d)
{
    for (int c = 0; c < d->of->channels; c++) {
        const chart_channel *channel = &d->of->channel[c];
        const uint8_t shade[3] = {(uint8_t)(195 + channel->line.r / 5), (uint8_t)(195 + channel->line.g / 5),
                                  (uint8_t)(195 + channel->line.b / 5)};
        for (int32_t x = 0; x < PLOT_W; x++) {
            for (int32_t y = y_of(d, channel->count[x * d->of->levels / PLOT_W]); y < d->top + PLOT_H; y++) {
                uint8_t *pixel = (uint8_t *)iris_image_row(d->image, y) + 3 * (LEFT + x);
                for (int k = 0; k < 3; k++) {
                    pixel[k] = (uint8_t)(pixel[k] * shade[k] / 255);
                }
            }
        }
    }
}

/* Text whose right end, or with `centered` its middle, is at x. */
static void put_text(const drawing *d, int32_t x, int32_t y, const char *text, int centered)
{
    iris_size size = iris_draw_text_size(text, SCALE);
    iris_draw_text(d->image, x - (centered ? size.w / 2 : size.w), y, text, SCALE, ink);
}

static void draw_axes(const drawing *d)
{
    const int32_t bottom = d->top + PLOT_H, right = LEFT + PLOT_W;
    const uint64_t unit = d->step % 1000000 == 0                     ? 1000000
                          : d->most >= 100000 && d->step % 1000 == 0 ? 1000
                                                                     : 1;
    char text[32];
    for (uint64_t count = 0; count <= d->most; count += d->step) {
        int32_t y = y_of(d, count);
        iris_draw_line(d->image, LEFT, y, right, y, pale);
        iris_draw_line(d->image, LEFT - TICK, y, LEFT, y, ink);
        snprintf(text, sizeof text, "%llu%s", (unsigned long long)(count / unit),
                 count == 0 || unit == 1 ? ""
                 : unit == 1000          ? "k"
                                         : "M");
        put_text(d, LEFT - TICK - 4, y - 7, text, 0);
    }
    for (int level = 0; level<d->of->levels; level += d->of->levels> 2 ? 32 : 1) {
        int32_t x = x_of(d, level) + PLOT_W / d->of->levels / 2;
        iris_draw_line(d->image, x, bottom, x, bottom + TICK, ink);
        if (d->of->levels == 2 || level % 64 == 0) {
            iris_draw_line(d->image, x, d->top, x, bottom, pale);
            snprintf(text, sizeof text, "%d", level);
            put_text(d, x, bottom + TICK + 6, text, 1);
        }
    }
    if (d->of->levels > 2) {
        iris_draw_line(d->image, right - 1, bottom, right - 1, bottom + TICK, ink);
        put_text(d, right - 1, bottom + TICK + 6, "255", 1);
    }
    iris_draw_line(d->image, LEFT - 1, d->top, LEFT - 1, bottom, ink);
    iris_draw_line(d->image, LEFT - 1, bottom, right, bottom, ink);
}

/* Steps, two pixels strong; a red arrow where a count is cut off. */
static void draw_curve(const drawing *d, const chart_channel *channel)
{
    int32_t before = d->top + PLOT_H;
    for (int p = 0; p <= d->of->levels; p++) {
        int32_t x = x_of(d, p), y = p < d->of->levels ? y_of(d, channel->count[p]) : d->top + PLOT_H;
        iris_draw_line(d->image, x, before, x, y, channel->line);
        if (p < d->of->levels) {
            iris_draw_line(d->image, x, y, x_of(d, p + 1), y, channel->line);
        }
        if (p < d->of->levels && channel->count[p] > d->most) {
            for (int32_t k = 0; k < 5; k++) {
                iris_draw_line(d->image, x - k, d->top - 8 + k, x + 1 + k, d->top - 8 + k, cut);
            }
        }
        before = y;
    }
}

static void draw_words(const drawing *d, int c)
{
    const chart_channel *channel = &d->of->channel[c];
    char text[160];
    double mean = channel->is.mean_q16 / 65536.0, deviation = sqrt(channel->is.variance_q16 / 65536.0);
    if (d->of->levels == 2) {
        snprintf(text, sizeof text, "%-6s %.2f %% of %lu pixels", channel->name, 100 * mean,
                 (unsigned long)channel->is.count);
    } else {
        snprintf(text, sizeof text, "%-6s mean %.1f  sd %.1f  median %d  %d to %d", channel->name, mean,
                 deviation, channel->is.median, channel->is.min, channel->is.max);
    }
    iris_draw_text(d->image, 12, TOP + c * LINE_H, text, SCALE, channel->line);
}

void chart_draw(const iris_image *image, const chart *of)
{
    drawing d = {image, of, TOP + LINE_H * of->channels + GAP, 1, 1};
    choose_scale(&d);
    iris_fill(image, 0xFFFFFF);
    tint(&d);
    draw_axes(&d);
    for (int c = 0; c < of->channels; c++) {
        draw_curve(&d, &of->channel[c]);
        draw_words(&d, c);
    }
}
