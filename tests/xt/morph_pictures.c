/* Morphology on pictures: the laws of opening and closing, and shapes as gray and as masks. */
#include "../bmp_decode.h"
#include "iris/xt/morph.h"

enum { W = 70, H = 30 };

typedef iris_status (*morph_call)(const iris_image *, const iris_image *, const iris_morph_element *,
                                  iris_border, iris_scratch *);
static const morph_call calls[] = {iris_morph_open,    iris_morph_close,  iris_morph_dilate,
                                   iris_morph_erode,   iris_morph_tophat, iris_morph_blackhat,
                                   iris_morph_gradient};
enum { OPEN, CLOSE, CALLS = sizeof calls / sizeof calls[0] };

static IRIS_SCRATCH_BUFFER(memory, 1 << 20);
static uint32_t seed = 7;

static int32_t between(int32_t low, int32_t high)
{
    return low + (int32_t)(next_random(&seed) % (uint32_t)(high - low + 1));
}

static iris_scratch arena(size_t bytes)
{
    iris_scratch scratch;
    assert_true(bytes <= sizeof memory);
    assert_int_equal(iris_scratch_init(&scratch, memory.memory, bytes), IRIS_OK);
    return scratch;
}

static int none_above(const uint8_t *low, const uint8_t *high, size_t n, int mask)
{
    for (size_t i = 0; i < n; i++) {
        if (mask ? low[i] & ~high[i] : low[i] > high[i]) {
            return 0;
        }
    }
    return 1;
}

/* open <= picture <= close; the second time changes nothing; and each is the other's negative, turned by 180 degrees
 * (left out here: a turn only matters for even sides, which the definition has covered). */
static void assert_laws(const iris_image *image, const iris_morph_element *element)
{
    size_t bytes = iris_format_row_bytes(image->format, image->w) * (size_t)image->h;
    int mask = image->format == IRIS_MASK1;
    uint8_t *copies[3];
    iris_image views[3];
    for (int i = 0; i < 3; i++) {
        copies[i] = malloc(bytes);
        memcpy(copies[i], image->data, bytes); /* with the bits past w */
        views[i] = *image;
        views[i].data = copies[i];
    }
    for (int call = OPEN; call <= CLOSE; call++) {
        iris_scratch scratch =
            arena(2 * IRIS_MORPH_SCRATCH_BYTES(image->format, image->w, element->w, element->h));
        memcpy(copies[1], image->data, bytes);
        assert_int_equal(calls[call](&views[1], image, element, (iris_border){0}, &scratch), IRIS_OK);
        assert_true(call == OPEN ? none_above(copies[1], image->data, bytes, mask)
                                 : none_above(image->data, copies[1], bytes, mask));
        memcpy(copies[2], copies[1], bytes);
        assert_int_equal(calls[call](&views[2], &views[2], element, (iris_border){0}, &scratch), IRIS_OK);
        assert_memory_equal(copies[2], copies[1], bytes);
    }
    for (int i = 0; i < 3; i++) {
        free(copies[i]);
    }
}

static void laws_on_noise(void **state)
{
    (void)state;
    static const iris_format formats[] = {IRIS_GRAY8, IRIS_MASK1, IRIS_RGB888};
    static uint32_t noise[W * H];
    for (int i = 0; i < 300; i++) {
        iris_format format = formats[i % 3];
        iris_image image;
        iris_size size = {between(1, W), between(1, H)};
        iris_morph_element element = {between(1, 12), between(1, 12), (iris_morph_shape)(i / 3 % 2), 0};
        for (size_t k = 0; k < sizeof noise / sizeof noise[0]; k++) {
            noise[k] = next_random(&seed) ^ next_random(&seed) << 12;
        }
        assert_int_equal(iris_image_wrap(&image, noise, sizeof noise, size, 0, format), IRIS_OK);
        assert_laws(&image, &element);
    }
}

static void laws_on_a_photograph(void **state)
{
    (void)state;
    picture camera = load_pnm(data_path("edges/classic/camera_256.pgm"));
    if (!camera.pixels) {
        skip();
    }
    iris_image image;
    size_t bytes = (size_t)camera.w * (size_t)camera.h;
    assert_int_equal(
        iris_image_wrap(&image, camera.pixels, bytes, (iris_size){camera.w, camera.h}, 0, IRIS_GRAY8),
        IRIS_OK);
    for (int32_t side = 2; side <= 33; side += 3) {
        assert_laws(&image, &(iris_morph_element){side, side, IRIS_MORPH_SQUARE, 0});
        assert_laws(&image, &(iris_morph_element){side, side + 1, IRIS_MORPH_CROSS, 0});
    }
    free(camera.pixels);
}

/* A shape as gray and as a mask is the same shape: every operation makes the same of both. */
static void assert_alike(const picture *shape, const iris_morph_element *element)
{
    iris_size size = {shape->w, shape->h};
    size_t bytes = (size_t)shape->w * (size_t)shape->h;
    size_t mask_bytes = iris_format_row_bytes(IRIS_MASK1, shape->w) * (size_t)shape->h;
    uint8_t *levels = malloc(bytes);
    uint32_t *bits = malloc(mask_bytes);
    iris_image gray, mask, from;
    assert_int_equal(iris_image_wrap(&from, shape->pixels, bytes, size, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&gray, levels, bytes, size, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&mask, bits, mask_bytes, size, 0, IRIS_MASK1), IRIS_OK);
    for (int call = 0; call < CALLS; call++) {
        memset(bits, 0, mask_bytes);
        for (int32_t i = 0; i < size.w * size.h; i++) {
            uint32_t *row = iris_image_row(&mask, i / size.w), x = (uint32_t)(i % size.w);
            row[x / 32] |= (uint32_t)(shape->pixels[i] > 127) << x % 32;
        }
        iris_scratch scratch = arena(sizeof memory);
        assert_int_equal(calls[call](&gray, &from, element, (iris_border){0}, &scratch), IRIS_OK);
        assert_int_equal(calls[call](&mask, &mask, element, (iris_border){0}, &scratch), IRIS_OK);
        for (int32_t i = 0; i < size.w * size.h; i++) {
            int32_t x = i % size.w;
            const uint32_t *row = iris_image_row(&mask, i / size.w);
            assert_int_equal(levels[i], row[x / 32] >> x % 32 & 1 ? 255 : 0);
        }
    }
    assert_laws(&from, element);
    free(levels);
    free(bits);
}

static void shapes_as_gray_and_as_masks(void **state)
{
    (void)state;
    static const char *const names[] = {"shapes/horse.bmp", "shapes/mpeg7/bell-01.bmp",
                                        "shapes/mpeg7/bone-01.bmp"};
    static const iris_morph_element elements[] = {
        {3, 3, IRIS_MORPH_SQUARE, 0}, {6, 11, IRIS_MORPH_CROSS, 0}, {25, 40, IRIS_MORPH_SQUARE, 0}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        size_t bytes = 0;
        uint8_t *file = load_file(data_path(names[i]), &bytes);
        if (!file) {
            skip();
        }
        decoded shape = decode(file, bytes, IRIS_GRAY8);
        assert_int_equal(shape.status, IRIS_OK);
        for (size_t k = 0; k < sizeof elements / sizeof elements[0]; k++) {
            assert_alike(&shape.image, &elements[k]);
        }
        free(shape.image.pixels);
        free(file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws_on_noise),
        cmocka_unit_test(laws_on_a_photograph),
        cmocka_unit_test(shapes_as_gray_and_as_masks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
