/* The frame that all cases work on. */
#include <string.h>

#include "bench.h"
#include "iris/xt/threshold.h"

bench_pictures bench_frame;

iris_image bench_canvas_of(iris_format format, int32_t w, int32_t h)
{
    iris_image image = {0};
    size_t bytes = iris_format_row_bytes(format, w) * (size_t)h;
    void *pixels = iris_scratch_take(&bench_frame.scratch, bytes);
    if (pixels) {
        memset(pixels, 0, bytes);
        (void)iris_image_wrap(&image, pixels, bytes, (iris_size){w, h}, 0, format);
    }
    return image;
}

iris_image bench_canvas(iris_format format)
{
    return bench_canvas_of(format, bench_frame.gray.w, bench_frame.gray.h);
}

static void draw_floor(const iris_image *gray, const iris_image *rgb)
{
    uint32_t random = 1;
    for (int32_t y = 0; y < gray->h; y++) {
        uint8_t *row = iris_image_row(gray, y);
        uint8_t *pixel = iris_image_row(rgb, y);
        int32_t line = gray->w * 5 / 16 + (gray->h - y) / 3;
        for (int32_t x = 0; x < gray->w; x++, pixel += 3) {
            random = random * 1664525u + 1013904223u;
            int32_t level = 200 - x * 80 / gray->w + (int32_t)(random >> 28) - 8;
            level = x >= line && x < line + gray->w * 7 / 80 ? level / 4 : level;
            row[x] = (uint8_t)level;
            pixel[0] = (uint8_t)level;
            pixel[1] = (uint8_t)(level - (int32_t)(random >> 20 & 31u));
            pixel[2] = (uint8_t)(level / 2);
        }
    }
}

void bench_frame_begin(iris_size size, void *memory, size_t bytes)
{
    (void)iris_scratch_init(&bench_frame.scratch, memory, bytes);
    bench_frame.gray = bench_canvas_of(IRIS_GRAY8, size.w, size.h);
    bench_frame.rgb = bench_canvas(IRIS_RGB888);
    bench_frame.mask = bench_canvas(IRIS_MASK1);
    bench_frame.gray_to = bench_canvas(IRIS_GRAY8);
    bench_frame.rgb_to = bench_canvas(IRIS_RGB888);
    bench_frame.mask_to = bench_canvas(IRIS_MASK1);
    draw_floor(&bench_frame.gray, &bench_frame.rgb);
    (void)iris_threshold(&bench_frame.mask, &bench_frame.gray, 60, IRIS_SELECT_DARK);
}
