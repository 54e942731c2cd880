/* Reads any bytes as a floor's text. What is accepted is written and read again as it was, and maps points and pictures. */
#include <stdlib.h>
#include <string.h>

#include "iris/xt/birdseye.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

/* Everything that a floor is for. */
static void use(const iris_floor *floor)
{
    iris_place at = iris_place_of(floor->size.w / 2, floor->size.h), to;
    iris_angle angle;
    iris_birdseye_window window = {.size = {40, 3}, .mm_per_pixel_q16 = 400000};
    iris_birdseye birdseye;
    iris_place places[40];
    (void)iris_floor_point(&to, floor, at);
    (void)iris_floor_image(&to, floor, at);
    (void)iris_floor_angle(&angle, floor, at, 5000);
    if (iris_birdseye_init(&birdseye, floor, &window) == IRIS_OK) {
        (void)iris_birdseye_places(places, &birdseye, 2);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    iris_floor floor, again;
    int32_t line = 0;
    if (iris_floor_read_text(&floor, &line, (const char *)data, bytes) == IRIS_OK) {
        char text[IRIS_FLOOR_TEXT_BYTES];
        size_t length = 0;
        if (iris_floor_write_text(text, sizeof text, &length, &floor) != IRIS_OK ||
            iris_floor_read_text(&again, &line, text, length) != IRIS_OK ||
            memcmp(&again, &floor, sizeof floor) != 0) {
            abort();
        }
        use(&floor);
    }
    iris_q32 numbers[9];
    if (bytes >= sizeof numbers) {
        memcpy(numbers, data, sizeof numbers);
        if (iris_floor_init(&floor, (iris_size){320, 240}, numbers) == IRIS_OK) {
            use(&floor);
        }
    }
    iris_floor_mark marks[12];
    iris_floor_quality quality;
    memcpy(marks, data, bytes < sizeof marks ? bytes : sizeof marks);
    if (iris_floor_fit(&floor, &quality, (iris_size){320, 240}, marks,
                       (int32_t)(bytes < sizeof marks ? bytes / sizeof marks[0] : 12)) == IRIS_OK) {
        use(&floor);
    }
    return 0;
}
