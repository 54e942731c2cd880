#include "iris/draw.h"

#include "draw_font.h"

/* A color as the bytes of a format; for IRIS_MASK1 bytes[0] is 0 or 1. */
typedef struct {
    uint8_t bytes[3];
    int32_t size; /* bytes per pixel; 0 for IRIS_MASK1 */
} draw_pen;

static iris_status pen_make(draw_pen *result, const iris_image *image, iris_color color)
{
    if (!image) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(image);
    if (status != IRIS_OK) {
        return status;
    }
    uint8_t luma = (uint8_t)((77u * color.r + 150u * color.g + 29u * color.b + 128u) >> 8);
    switch (image->format) {
    case IRIS_GRAY8:
        *result = (draw_pen){{luma, 0, 0}, 1};
        return IRIS_OK;
    case IRIS_MASK1:
        *result = (draw_pen){{luma >> 7, 0, 0}, 0};
        return IRIS_OK;
    case IRIS_RGB888:
        *result = (draw_pen){{color.r, color.g, color.b}, 3};
        return IRIS_OK;
    case IRIS_BGR888:
        *result = (draw_pen){{color.b, color.g, color.r}, 3};
        return IRIS_OK;
    default:
        return IRIS_ERR_FORMAT;
    }
}

/* Draws columns x0 to x1 (inclusive) of row y, clipped. */
static void span(const iris_image *image, draw_pen pen, int64_t x0, int64_t x1, int64_t y)
{
    if (y < 0 || y >= image->h) {
        return;
    }
    int32_t first = x0 < 0 ? 0 : x0 < image->w ? (int32_t)x0 : image->w;
    int32_t last = x1 < image->w ? (x1 < 0 ? -1 : (int32_t)x1) : image->w - 1;
    uint8_t *row = (uint8_t *)iris_image_row(image, (int32_t)y);
    for (int32_t x = first; x <= last; x++) {
        if (pen.size == 0) {
            uint32_t *word = (uint32_t *)(void *)row + x / 32;
            uint32_t bit = (uint32_t)1 << x % 32;
            *word = pen.bytes[0] ? *word | bit : *word & ~bit;
        } else {
            for (int32_t i = 0; i < pen.size; i++) {
                row[(ptrdiff_t)x * pen.size + i] = pen.bytes[i];
            }
        }
    }
}

static void dot(const iris_image *image, draw_pen pen, int64_t x, int64_t y)
{
    span(image, pen, x, x, y);
}

/* Draws columns x0 to x1 of rows y0 to y1, clipped. */
static void block(const iris_image *image, draw_pen pen, const int64_t x[2], const int64_t y[2])
{
    int64_t first = y[0] < 0 ? 0 : y[0];
    int64_t last = y[1] < image->h ? y[1] : image->h - 1;
    for (int64_t row = first; row <= last; row++) {
        span(image, pen, x[0], x[1], row);
    }
}

/* A line seen along its longer direction: u runs from u0 up by one pixel per step, v follows. */
typedef struct {
    int64_t u0, v0;
    uint64_t du, dv; /* 0 <= dv <= du < 2^32 */
    int64_t v_step;  /* 1 or -1 */
} slope;

static slope slope_make(const int64_t left[2], const int64_t right[2])
{
    int64_t rise = right[1] - left[1];
    return (slope){left[0], left[1], (uint64_t)(right[0] - left[0]), (uint64_t)(rise < 0 ? -rise : rise),
                   rise < 0 ? -1 : 1};
}

/* Step i is at v0 + v_step * round(i dv / du), half up; quotient and remainder are carried from step to step
 * and started by a division where the line enters the image. Products stay below 2^64. */
static void slope_draw(const iris_image *image, draw_pen pen, slope line, int steep)
{
    int64_t side = steep ? image->h : image->w;
    int64_t end = line.u0 + (int64_t)line.du;
    int64_t u = line.u0 < 0 ? 0 : line.u0;
    uint64_t divisor = line.du > 0 ? line.du : 1;
    if (end < 0 || line.u0 >= side) {
        return;
    }
    uint64_t product = (uint64_t)(u - line.u0) * line.dv;
    uint64_t whole = product / divisor;
    uint64_t rest = product % divisor;
    for (; u <= end && u < side; u++) {
        int64_t v = line.v0 + line.v_step * (int64_t)(whole + (2 * rest >= divisor));
        dot(image, pen, steep ? v : u, steep ? u : v);
        rest += line.dv;
        if (rest >= divisor) {
            rest -= divisor;
            whole++;
        }
    }
}

iris_status iris_draw_line(const iris_image *image, int32_t x0, int32_t y0, int32_t x1, int32_t y1,
                           iris_color color)
{
    draw_pen pen;
    iris_status status = pen_make(&pen, image, color);
    if (status != IRIS_OK) {
        return status;
    }
    int64_t width = x0 > x1 ? (int64_t)x0 - x1 : (int64_t)x1 - x0;
    int64_t height = y0 > y1 ? (int64_t)y0 - y1 : (int64_t)y1 - y0;
    int steep = height > width;
    int64_t a[2] = {steep ? y0 : x0, steep ? x0 : y0};
    int64_t b[2] = {steep ? y1 : x1, steep ? x1 : y1};
    slope_draw(image, pen, a[0] <= b[0] ? slope_make(a, b) : slope_make(b, a), steep);
    return IRIS_OK;
}

static iris_status draw_rect(const iris_image *image, iris_rect rect, iris_color color, int filled)
{
    draw_pen pen;
    iris_status status = pen_make(&pen, image, color);
    if (status != IRIS_OK || rect.w < 1 || rect.h < 1) {
        return status;
    }
    const int64_t x[2] = {rect.x, (int64_t)rect.x + rect.w - 1};
    const int64_t y[2] = {rect.y, (int64_t)rect.y + rect.h - 1};
    if (filled) {
        block(image, pen, x, y);
        return IRIS_OK;
    }
    for (int side = 0; side < 2; side++) {
        const int64_t column[2] = {x[side], x[side]};
        span(image, pen, x[0], x[1], y[side]);
        block(image, pen, column, y);
    }
    return IRIS_OK;
}

iris_status iris_draw_rect(const iris_image *image, iris_rect rect, iris_color color)
{
    return draw_rect(image, rect, color, 0);
}

iris_status iris_draw_rect_filled(const iris_image *image, iris_rect rect, iris_color color)
{
    return draw_rect(image, rect, color, 1);
}

iris_status iris_draw_circle(const iris_image *image, int32_t x, int32_t y, int32_t radius, iris_color color)
{
    draw_pen pen;
    iris_status status = pen_make(&pen, image, color);
    if (status != IRIS_OK) {
        return status;
    }
    if (radius < 0 || radius > IRIS_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    /* One eighth from the top to the diagonal: error is a^2 + (b - 1/2)^2 - r^2, less 1/4, at the next column
     * a. */
    int64_t a = 0;
    int64_t b = radius;
    int64_t error = 1 - (int64_t)radius;
    while (a <= b) {
        for (int half = -1; half <= 1; half += 2) {
            dot(image, pen, x - a, y + half * b);
            dot(image, pen, x + a, y + half * b);
            dot(image, pen, x - b, y + half * a);
            dot(image, pen, x + b, y + half * a);
        }
        a++;
        if (error >= 0) {
            b--;
            error += 2 * (a - b) + 1;
        } else {
            error += 2 * a + 1;
        }
    }
    return IRIS_OK;
}

iris_status iris_draw_cross(const iris_image *image, int32_t x, int32_t y, int32_t arm, iris_color color)
{
    draw_pen pen;
    iris_status status = pen_make(&pen, image, color);
    if (status != IRIS_OK) {
        return status;
    }
    if (arm < 0) {
        return IRIS_ERR_RANGE;
    }
    const int64_t column[2] = {x, x};
    const int64_t rows[2] = {(int64_t)y - arm, (int64_t)y + arm};
    span(image, pen, (int64_t)x - arm, (int64_t)x + arm, y);
    block(image, pen, column, rows);
    return IRIS_OK;
}

static void glyph_draw(const iris_image *image, draw_pen pen, const int64_t at[2], char letter, int32_t scale)
{
    if (at[0] >= image->w || at[0] + 5 * scale <= 0 || at[1] >= image->h || at[1] + 7 * scale <= 0) {
        return;
    }
    const uint8_t *rows =
        iris_draw_font[letter >= ' ' && letter <= '~' ? letter - ' ' : IRIS_DRAW_GLYPHS - 1];
    for (int32_t row = 0; row < IRIS_DRAW_GLYPH_ROWS; row++) {
        const int64_t y[2] = {at[1] + row * scale, at[1] + (row + 1) * scale - 1};
        for (int32_t column = 0; column < 5; column++) {
            const int64_t x[2] = {at[0] + column * scale, at[0] + (column + 1) * scale - 1};
            if (rows[row] >> (4 - column) & 1) {
                block(image, pen, x, y);
            }
        }
    }
}

iris_status iris_draw_text(const iris_image *image, int32_t x, int32_t y, const char *text, int32_t scale,
                           iris_color color)
{
    draw_pen pen;
    iris_status status = pen_make(&pen, image, color);
    if (status != IRIS_OK) {
        return status;
    }
    if (!text) {
        return IRIS_ERR_ARG;
    }
    if (scale < 1 || scale > IRIS_TEXT_SCALE_MAX) {
        return IRIS_ERR_RANGE;
    }
    int64_t at[2] = {x, y};
    for (; *text != '\0'; text++) {
        if (*text == '\n') {
            at[0] = x;
            at[1] += IRIS_TEXT_CELL_H * scale;
        } else {
            glyph_draw(image, pen, at, *text, scale);
            at[0] += IRIS_TEXT_CELL_W * scale;
        }
    }
    return IRIS_OK;
}

iris_size iris_draw_text_size(const char *text, int32_t scale)
{
    const iris_size none = {0, 0};
    if (!text || *text == '\0' || scale < 1 || scale > IRIS_TEXT_SCALE_MAX) {
        return none;
    }
    int64_t lines = 1;
    int64_t longest = 0;
    int64_t length = 0;
    for (; *text != '\0'; text++) {
        length = *text == '\n' ? 0 : length + 1;
        lines += *text == '\n';
        longest = length > longest ? length : longest;
    }
    int64_t w = longest > 0 ? (longest * IRIS_TEXT_CELL_W - 1) * scale : 0;
    int64_t h = (lines * IRIS_TEXT_CELL_H - 1) * scale;
    if (w > INT32_MAX || h > INT32_MAX) {
        return none;
    }
    return (iris_size){(int32_t)w, (int32_t)h};
}
