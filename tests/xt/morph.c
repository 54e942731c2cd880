/* Morphology: the definition pixel by pixel, and pictures worked out by hand. */
#include "iris/xt/morph.h"
#include "../picture.h"

enum { W = 70, WIDEST = 289, H = 40, PARENT_W = 128, PARENT_H = 48, BYTES = 3 * PARENT_W * PARENT_H };

typedef iris_status (*morph_call)(const iris_image *, const iris_image *, const iris_morph_element *,
                                  iris_border, iris_scratch *);
static const morph_call calls[] = {iris_morph_dilate,  iris_morph_erode,  iris_morph_open,
                                   iris_morph_close,   iris_morph_tophat, iris_morph_blackhat,
                                   iris_morph_gradient};
enum { DILATE, ERODE, OPEN, CLOSE, TOPHAT, BLACKHAT, GRADIENT, CALLS };

static uint8_t source_bytes[BYTES] __attribute__((aligned(16)));
static uint8_t target_bytes[BYTES] __attribute__((aligned(16)));
static uint8_t expected_bytes[BYTES] __attribute__((aligned(16)));
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

static size_t needed(int call, const iris_image *image, const iris_morph_element *element)
{
    size_t one = IRIS_MORPH_SCRATCH_BYTES(image->format, image->w, element->w, element->h);
    return call == DILATE || call == ERODE ? one : 2 * one;
}

/* ---- the definition ---- */

typedef struct {
    int32_t w, h, channels;
    uint8_t at[WIDEST * H * 3];
} field;

static field source, between_steps, result, other;

static int32_t place(int32_t i, int32_t n, iris_border_rule rule)
{
    while (i < 0 || i >= n) {
        if (rule == IRIS_BORDER_CONSTANT) {
            return -1;
        }
        if (rule != IRIS_BORDER_REFLECT101 || n == 1) {
            return i < 0 ? 0 : n - 1;
        }
        i = i < 0 ? -i : 2 * (n - 1) - i;
    }
    return i;
}

static int value_at(const field *from, int32_t x, int32_t y, int32_t c, iris_border border)
{
    int32_t u = place(x, from->w, border.rule), v = place(y, from->h, border.rule);
    return u < 0 || v < 0 ? border.value : from->at[(v * from->w + u) * from->channels + c];
}

static int in_element(const iris_morph_element *element, int32_t dx, int32_t dy)
{
    if (dx == 0 && dy == 0) {
        return !element->exclude_center;
    }
    return element->shape == IRIS_MORPH_SQUARE || dx == 0 || dy == 0;
}

static void define_step(field *to, const field *from, const iris_morph_element *element, int erodes,
                        iris_border border)
{
    int turn = erodes ? 1 : -1;
    *to = *from;
    for (int32_t i = 0; i < from->w * from->h * from->channels; i++) {
        int32_t c = i % from->channels, x = i / from->channels % from->w, y = i / from->channels / from->w;
        int most = 0, least = 255;
        for (int32_t dy = -((element->h - 1) / 2); dy <= element->h / 2; dy++) {
            for (int32_t dx = -((element->w - 1) / 2); dx <= element->w / 2; dx++) {
                if (in_element(element, dx, dy)) {
                    int value = value_at(from, x + turn * dx, y + turn * dy, c, border);
                    most = value > most ? value : most;
                    least = value < least ? value : least;
                }
            }
        }
        to->at[i] = (uint8_t)(erodes ? least : most);
    }
}

static void subtract(field *to, const field *a, const field *b)
{
    for (int32_t i = 0; i < a->w * a->h * a->channels; i++) {
        to->at[i] = (uint8_t)(a->at[i] > b->at[i] ? a->at[i] - b->at[i] : 0);
    }
}

static void define(int call, const iris_morph_element *element, iris_border border)
{
    int erodes_first = call == ERODE || call == OPEN || call == TOPHAT || call == GRADIENT;
    define_step(&between_steps, &source, element, erodes_first, border);
    if (call == DILATE || call == ERODE) {
        result = between_steps;
    } else if (call == GRADIENT) {
        define_step(&other, &source, element, 0, border);
        result = other;
        subtract(&result, &other, &between_steps);
    } else {
        define_step(&result, &between_steps, element, !erodes_first, border);
    }
    if (call == TOPHAT) {
        subtract(&result, &source, &result);
    } else if (call == BLACKHAT) {
        subtract(&result, &result, &source);
    }
}

/* Does everything that is looked at for pixel (x, y) lie in the picture? By walking over it. */
static int is_inside(int call, const iris_morph_element *element, int32_t x, int32_t y)
{
    int32_t left = (element->w - 1) / 2, right = element->w / 2, up = (element->h - 1) / 2,
            down = element->h / 2;
    int32_t far[4] = {left, right, up, down};
    if (call == DILATE) {
        memcpy(far, (int32_t[]){right, left, down, up}, sizeof far);
    } else if (call == GRADIENT) {
        memcpy(far, (int32_t[]){right, right, down, down}, sizeof far);
    } else if (call != ERODE) {
        memcpy(far, (int32_t[]){left + right, left + right, up + down, up + down}, sizeof far);
    }
    return x - far[0] >= 0 && x + far[1] < source.w && y - far[2] >= 0 && y + far[3] < source.h;
}

/* ---- fields in views ---- */

static void set_pixel(const iris_image *view, int32_t x, int32_t y, int32_t c, int value)
{
    uint8_t *row = iris_image_row(view, y);
    if (view->format == IRIS_MASK1) {
        uint32_t *word = (uint32_t *)(void *)row + x / 32, bit = (uint32_t)1 << x % 32;
        *word = value ? *word | bit : *word & ~bit;
    } else {
        row[x * source.channels + c] = (uint8_t)value;
    }
}

/* A part of a picture, at an odd place, bottom up or not. */
static iris_image view_of(uint8_t *bytes, iris_format format, int32_t w, int32_t h)
{
    iris_image parent, view;
    int32_t parent_w = format == IRIS_MASK1 ? 320 + 7 : PARENT_W;
    ptrdiff_t stride = (ptrdiff_t)(iris_format_row_bytes(format, parent_w));
    int32_t x = format == IRIS_MASK1 ? 32 * between(0, 1) : between(0, 20);
    stride = between(0, 1) ? stride : -stride;
    assert_int_equal(iris_image_wrap(&parent, bytes, BYTES, (iris_size){parent_w, PARENT_H}, stride, format),
                     IRIS_OK);
    assert_int_equal(iris_image_crop(&view, &parent, (iris_rect){x, between(0, 7), w, h}), IRIS_OK);
    return view;
}

/* kind 0: noise; 1: black and white spots; 2: of a mask few set, else a slope; 3: most set. */
static void draw_source(iris_format format, int32_t w, int32_t h, int kind)
{
    source.w = w;
    source.h = h;
    source.channels = format == IRIS_GRAY8 || format == IRIS_MASK1 ? 1 : 3;
    for (int32_t i = 0; i < w * h * source.channels; i++) {
        uint32_t noise = next_random(&seed) >> 8;
        int bit = kind == 2 ? noise % 16 == 0 : kind == 3 ? noise % 16 != 0 : noise % 2;
        int level = kind == 0 ? (int)(noise & 255) : kind == 1 ? bit * 255 : (i * 3 + (int)(noise % 9)) & 255;
        source.at[i] = (uint8_t)(format == IRIS_MASK1 ? bit : level);
    }
}

static void put_field(const iris_image *view, const field *from)
{
    for (int32_t i = 0; i < from->w * from->h * from->channels; i++) {
        int32_t c = i % from->channels, x = i / from->channels % from->w, y = i / from->channels / from->w;
        set_pixel(view, x, y, c, from->at[i]);
    }
}

static void fill_noise(uint8_t *bytes)
{
    for (int i = 0; i < BYTES; i++) {
        bytes[i] = (uint8_t)(next_random(&seed) >> 8);
    }
}

/* One call on `source` against the definition: every byte of the target's picture, and the source's as well. */
static void check_call(int call, iris_format format, const iris_morph_element *element, iris_border border,
                       int in_place)
{
    iris_border defined = border;
    fill_noise(source_bytes);
    fill_noise(target_bytes);
    iris_image from = view_of(source_bytes, format, source.w, source.h);
    iris_image to = view_of(target_bytes, format, source.w, source.h);
    put_field(&from, &source);
    if (in_place) {
        to = from;
    }
    if (format == IRIS_MASK1 && border.value != 0) {
        defined.value = 1;
    }
    define(call, element, defined);
    uint8_t *bytes = in_place ? source_bytes : target_bytes;
    memcpy(expected_bytes, bytes, BYTES);
    iris_image expected = to;
    expected.data = expected_bytes + ((uint8_t *)to.data - bytes);
    for (int32_t i = 0; i < source.w * source.h * source.channels; i++) {
        int32_t c = i % source.channels, x = i / source.channels % source.w,
                y = i / source.channels / source.w;
        if (border.rule != IRIS_BORDER_SKIP || is_inside(call, element, x, y)) {
            set_pixel(&expected, x, y, c, result.at[i]);
        }
    }
    iris_scratch scratch = arena(needed(call, &to, element));
    assert_int_equal(calls[call](&to, &from, element, border, &scratch), IRIS_OK);
    assert_int_equal(scratch.used, 0);
    assert_int_equal(scratch.peak, scratch.bytes);
    if (memcmp(bytes, expected_bytes, BYTES) != 0) {
        print_error(
            "call %d format %d %dx%d element %dx%d shape %d exclude %d rule %d value %d in place %d\n", call,
            format, source.w, source.h, element->w, element->h, element->shape, element->exclude_center,
            border.rule, border.value, in_place);
        fail();
    }
}

static const iris_format formats[] = {IRIS_GRAY8, IRIS_MASK1, IRIS_RGB888, IRIS_BGR888};

static iris_border any_border(void)
{
    iris_border border = {(iris_border_rule)between(0, 3), (uint8_t)(between(0, 2) ? between(0, 255) : 0)};
    return border;
}

static void small_elements_in_full(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 8 * 8 * 2 * 2; i++) {
        iris_morph_element element = {1 + i % 8, 1 + i / 8 % 8, (iris_morph_shape)(i / 64 % 2), i / 128};
        if (element.exclude_center && element.w * element.h == 1) {
            continue;
        }
        for (int call = 0; call < CALLS; call++) {
            iris_format format = formats[(i + call) % 3];
            draw_source(format, between(1, 40), between(1, 12), between(0, 3));
            check_call(call, format, &element, any_border(), between(0, 1));
        }
    }
}

static void every_width(void **state)
{
    (void)state;
    for (int32_t w = 1; w <= W; w++) {
        for (int i = 0; i < 8; i++) {
            iris_morph_element element = {3, 3, (iris_morph_shape)(i / 2 % 2), i / 4};
            draw_source(formats[i % 2], w, between(1, 6), between(0, 3));
            check_call(between(0, CALLS - 1), formats[i % 2], &element, any_border(), between(0, 1));
            element.w = between(1, 40);
            element.h = between(2, 9);
            check_call(between(0, CALLS - 1), formats[i % 2], &element, any_border(), between(0, 1));
        }
    }
}

/* Squares and crosses of 3x3 have a way of their own where dst is not src. */
static void three_by_three_at_every_width(void **state)
{
    (void)state;
    for (int32_t w = 1; w <= W; w++) {
        for (int i = 0; i < 48; i++) {
            const iris_morph_element element = {3, 3, (iris_morph_shape)(i / 8 % 2), 0};
            iris_format format = formats[i / 16];
            iris_border border = {(iris_border_rule)(i / 2 % 4),
                                  (uint8_t)(between(0, 1) ? between(0, 255) : 0)};
            draw_source(format, w, between(1, 5), between(0, 3));
            check_call(i % 2 ? DILATE : ERODE, format, &element, border, 0);
        }
    }
}

/* Words of a mask are joined four at a time, and the rest one by one. */
static void wide_masks(void **state)
{
    (void)state;
    static const int32_t widths[] = {95,  96,  97,  127, 128, 129, 159, 160,
                                     161, 223, 224, 225, 256, 287, 288, 289};
    for (int i = 0; i < 16 * 12; i++) {
        iris_morph_element element = {3, 3, (iris_morph_shape)(i / 16 % 2), 0};
        draw_source(IRIS_MASK1, widths[i % 16], between(1, 5), between(0, 3));
        check_call(i / 16 % 3 ? i / 16 % 3 - 1 : between(0, CALLS - 1), IRIS_MASK1, &element, any_border(),
                   between(0, 2) == 0);
    }
}

static void large_elements(void **state)
{
    (void)state;
    static const int32_t sides[] = {1, 2, 6, 7, 9, 10, 18, 19, 20, 27, 28, 31, 33, 54, 55, 64, 65, 82, 100};
    enum { SIDES = sizeof sides / sizeof sides[0] };
    for (int i = 0; i < 4 * SIDES; i++) {
        iris_morph_element element = {sides[i % SIDES], sides[between(0, SIDES - 1)],
                                      (iris_morph_shape)(i % 3 == 0), i % 4 == 1 && i % SIDES > 0};
        for (int turn = 0; turn < 2; turn++) {
            iris_format format = formats[(i + turn) % 2];
            draw_source(format, between(1, 40), between(1, 14), between(0, 3));
            check_call(between(0, CALLS - 1), format, &element, any_border(), between(0, 1));
            element = (iris_morph_element){element.h, element.w, element.shape,
                                           element.exclude_center && element.h > 1};
        }
    }
}

static void the_largest_elements(void **state)
{
    (void)state;
    static const int32_t sides[] = {162, 163, 486, 487, IRIS_MORPH_SIDE_MAX - 1, IRIS_MORPH_SIDE_MAX};
    for (int i = 0; i < 24; i++) {
        iris_morph_element element = {i / 2 % 2 ? 3 : sides[i % 6], i / 2 % 2 ? sides[i % 6] : 2, i / 12 % 2,
                                      i % 5 == 4};
        draw_source(formats[i % 2], between(1, 9), between(1, 9), between(0, 3));
        check_call(DILATE + i % 2, formats[i % 2], &element, any_border(), 0);
    }
}

/* ---- by hand ---- */

static void draw_mask(iris_image *mask, uint32_t *words, const char *const *rows, int32_t h)
{
    int32_t w = (int32_t)strlen(rows[0]);
    memset(words, 0, 4 * (size_t)h);
    assert_int_equal(iris_image_wrap(mask, words, 4 * (size_t)h, (iris_size){w, h}, 0, IRIS_MASK1), IRIS_OK);
    for (int32_t i = 0; i < w * h; i++) {
        words[i / w] |= (uint32_t)(rows[i / w][i % w] == '1') << i % w;
    }
}

static void assert_mask(const uint32_t *words, const char *const *rows, int32_t h)
{
    for (int32_t y = 0; y < h; y++) {
        for (int32_t x = 0; rows[y][x]; x++) {
            assert_int_equal(words[y] >> x & 1, rows[y][x] == '1');
        }
    }
}

static void masks_by_hand(void **state)
{
    (void)state;
    static const char *const start[] = {"0000000", "0010000", "0000000", "0000011", "0000000"};
    static const struct {
        iris_morph_element element;
        const char *rows[5];
    } cases[] = {
        {{3, 3, IRIS_MORPH_SQUARE, 0}, {"0111000", "0111000", "0111111", "0000111", "0000111"}},
        {{3, 3, IRIS_MORPH_CROSS, 0}, {"0010000", "0111000", "0010011", "0000111", "0000011"}},
        {{3, 3, IRIS_MORPH_SQUARE, 1}, {"0111000", "0101000", "0111111", "0000111", "0000111"}},
        {{2, 1, IRIS_MORPH_SQUARE, 0}, {"0000000", "0011000", "0000000", "0000011", "0000000"}},
        {{1, 2, IRIS_MORPH_SQUARE, 0}, {"0000000", "0010000", "0010000", "0000011", "0000011"}},
        {{5, 3, IRIS_MORPH_CROSS, 0}, {"0010000", "1111100", "0010011", "0001111", "0000011"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint32_t words[5];
        iris_image mask;
        iris_scratch scratch = arena(sizeof memory);
        draw_mask(&mask, words, start, 5);
        assert_int_equal(iris_morph_dilate(&mask, &mask, &cases[i].element, (iris_border){0}, &scratch),
                         IRIS_OK);
        assert_mask(words, cases[i].rows, 5);
    }
}

/* A block of 3x3 and crumbs: open removes the crumbs, close fills the hole, top-hat shows crumbs, black-hat the hole. */
static void compositions_by_hand(void **state)
{
    (void)state;
    static const char *const start[] = {"00000000", "11101000", "11100000",
                                        "11100110", "00000110", "10000000"};
    static const char *const opened[] = {"00000000", "11100000", "11100000",
                                         "11100000", "00000000", "00000000"};
    static const char *const crumbs[] = {"00000000", "00001000", "00000000",
                                         "00000110", "00000110", "10000000"};
    static const char *const ring[] = {"111111", "111111", "110111", "111111", "111111"};
    static const char *const full[] = {"111111", "111111", "111111", "111111", "111111"};
    static const char *const hole[] = {"000000", "000000", "001000", "000000", "000000"};
    static const char *const around[] = {"000000", "011100", "011100", "011100", "000000"};
    static const struct {
        int call, h;
        const char *const *before, *const *after;
    } cases[] = {{OPEN, 6, start, opened},  {TOPHAT, 6, start, crumbs},  {CLOSE, 5, ring, full},
                 {BLACKHAT, 5, ring, hole}, {GRADIENT, 5, ring, around}, {OPEN, 5, full, full}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint32_t words[6];
        iris_image mask;
        iris_scratch scratch = arena(sizeof memory);
        draw_mask(&mask, words, cases[i].before, cases[i].h);
        assert_int_equal(calls[cases[i].call](&mask, &mask, NULL, (iris_border){0}, &scratch), IRIS_OK);
        assert_mask(words, cases[i].after, cases[i].h);
    }
}

static void gray_by_hand(void **state)
{
    (void)state;
    uint8_t pixels[9] = {10, 20, 30, 40, 50, 60, 70, 80, 90}, out[9];
    iris_image from, to;
    iris_morph_element element;
    iris_morph_element_defaults(NULL);
    iris_morph_element_defaults(&element);
    assert_int_equal(element.w * 10 + element.h, 33);
    assert_int_equal(element.shape, IRIS_MORPH_SQUARE);
    iris_scratch scratch = arena(sizeof memory);
    assert_int_equal(iris_image_wrap(&from, pixels, 9, (iris_size){3, 3}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_image_wrap(&to, out, 9, (iris_size){3, 3}, 0, IRIS_GRAY8), IRIS_OK);
    assert_int_equal(iris_morph_dilate(&to, &from, NULL, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){50, 60, 60, 80, 90, 90, 80, 90, 90}), 9);
    assert_int_equal(iris_morph_erode(&to, &from, NULL, (iris_border){IRIS_BORDER_CONSTANT, 5}, &scratch),
                     IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){5, 5, 5, 5, 10, 5, 5, 5, 5}), 9);
    element.exclude_center =
        1; /* the report's: 90 is not its own neighbor, but at the edge stands for what is beyond */
    memset(out, 1, 9);
    assert_int_equal(iris_morph_dilate(&to, &from, &element, (iris_border){IRIS_BORDER_SKIP, 0}, &scratch),
                     IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){1, 1, 1, 1, 90, 1, 1, 1, 1}), 9);
    pixels[4] = 200;
    assert_int_equal(iris_morph_dilate(&to, &from, &element, (iris_border){IRIS_BORDER_SKIP, 0}, &scratch),
                     IRIS_OK);
    assert_int_equal(out[4], 90);
    assert_int_equal(iris_morph_dilate(&to, &from, &element, (iris_border){0}, &scratch), IRIS_OK);
    assert_memory_equal(out, ((uint8_t[]){200, 200, 200, 200, 90, 200, 200, 200, 200}), 9);
}

/* ---- calls ---- */

static void scratch_is_exact(void **state)
{
    (void)state;
    static const uint8_t constant[IRIS_MORPH_SCRATCH_BYTES(IRIS_GRAY8, 160, 3, 3)];
    assert_int_equal(sizeof constant, 4 * (16 + 160 + 16) + 3 * 160 + 176);
    assert_int_equal(IRIS_MORPH_SCRATCH_BYTES(IRIS_MASK1, 160, 3, 3), 4 * (16 + 32) + 3 * 32 + 32);
    for (int i = 0; i < 40; i++) {
        iris_format format = formats[i % 4];
        iris_morph_element element = {between(1, 70), between(1, 70), IRIS_MORPH_SQUARE, 0};
        int call = i % CALLS;
        fill_noise(target_bytes);
        memcpy(expected_bytes, target_bytes, BYTES);
        iris_image from = view_of(source_bytes, format, 37, 9), to = view_of(target_bytes, format, 37, 9);
        iris_scratch scratch = arena(needed(call, &to, &element) - 1);
        assert_int_equal(calls[call](&to, &from, &element, (iris_border){0}, &scratch), IRIS_ERR_SCRATCH);
        assert_int_equal(scratch.used, 0);
        assert_memory_equal(target_bytes, expected_bytes, BYTES);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_scratch scratch = arena(sizeof memory);
    iris_border border = {IRIS_BORDER_REPLICATE, 0};
    memset(target_bytes, 9, BYTES);
    memcpy(expected_bytes, target_bytes, BYTES);
    for (int call = 0; call < CALLS; call++) {
        iris_image from = view_of(source_bytes, IRIS_GRAY8, 20, 9),
                   to = view_of(target_bytes, IRIS_GRAY8, 20, 9);
        iris_image bad = to;
        assert_int_equal(calls[call](NULL, &from, NULL, border, &scratch), IRIS_ERR_ARG);
        assert_int_equal(calls[call](&to, NULL, NULL, border, &scratch), IRIS_ERR_ARG);
        assert_int_equal(calls[call](&to, &from, NULL, border, NULL), IRIS_ERR_ARG);
        assert_int_equal(calls[call](&to, &from, NULL, (iris_border){(iris_border_rule)4, 0}, &scratch),
                         IRIS_ERR_ARG);
        bad.w = 19;
        assert_int_equal(calls[call](&bad, &from, NULL, border, &scratch), IRIS_ERR_RANGE);
        bad.w = 0;
        assert_int_equal(calls[call](&bad, &from, NULL, border, &scratch), IRIS_ERR_RANGE);
        assert_int_equal(calls[call](&to, &bad, NULL, border, &scratch), IRIS_ERR_RANGE);
        bad = to;
        bad.format = IRIS_HSL24;
        assert_int_equal(calls[call](&bad, &bad, NULL, border, &scratch), IRIS_ERR_FORMAT);
        assert_int_equal(calls[call](&to, &bad, NULL, border, &scratch), IRIS_ERR_FORMAT);
        bad = to;
        bad.data = (uint8_t *)bad.data + 1;
        assert_int_equal(calls[call](&to, &bad, NULL, border, &scratch), IRIS_ERR_ALIAS);
        static const struct {
            iris_morph_element element;
            iris_status status;
        } elements[] = {{{0, 3, IRIS_MORPH_SQUARE, 0}, IRIS_ERR_RANGE},
                        {{3, 0, IRIS_MORPH_SQUARE, 0}, IRIS_ERR_RANGE},
                        {{IRIS_MORPH_SIDE_MAX + 1, 3, IRIS_MORPH_SQUARE, 0}, IRIS_ERR_RANGE},
                        {{3, INT32_MAX, IRIS_MORPH_SQUARE, 0}, IRIS_ERR_RANGE},
                        {{3, INT32_MIN, IRIS_MORPH_SQUARE, 0}, IRIS_ERR_RANGE},
                        {{1, 1, IRIS_MORPH_SQUARE, 1}, IRIS_ERR_RANGE},
                        {{3, 3, (iris_morph_shape)2, 0}, IRIS_ERR_ARG}};
        for (size_t i = 0; i < sizeof elements / sizeof elements[0]; i++) {
            assert_int_equal(calls[call](&to, &from, &elements[i].element, border, &scratch),
                             elements[i].status);
        }
    }
    assert_memory_equal(target_bytes, expected_bytes, BYTES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_elements_in_full),
        cmocka_unit_test(every_width),
        cmocka_unit_test(three_by_three_at_every_width),
        cmocka_unit_test(wide_masks),
        cmocka_unit_test(large_elements),
        cmocka_unit_test(the_largest_elements),
        cmocka_unit_test(masks_by_hand),
        cmocka_unit_test(compositions_by_hand),
        cmocka_unit_test(gray_by_hand),
        cmocka_unit_test(scratch_is_exact),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
