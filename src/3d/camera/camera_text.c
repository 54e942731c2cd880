/* A camera's calibration as text: see camera_text.h for the format. */
#include "iris/3d/camera_text.h"

#include <string.h>

#include "../../foundation/text_lines.h"

#define NUMBERS   12
#define LINES     8 /* between the first one and the check */
#define LENS_LINE 4 /* of these, from 0 */
#define LIMIT     (1000000000 * IRIS_Q32_ONE)

/* The lines of numbers behind the size, and how many each has. */
static const struct {
    const char *word;
    int count;
} rows[] = {{"focal", 2}, {"skew", 1}, {"center", 2}, {"radial", 3}, {"tangential", 2}, {"decentering", 2}};

static void numbers_of(iris_q32 numbers[NUMBERS], const iris_camera_model *model)
{
    const iris_intrinsics *k = &model->intrinsics;
    const iris_lens *l = &model->lens;
    const iris_q32 all[NUMBERS] = {k->alpha_u, k->alpha_v, k->shear, k->u0, k->v0,       l->k1,
                                   l->k2,      l->k3,      l->p1,    l->p2, l->center.x, l->center.y};
    memcpy(numbers, all, sizeof all);
}

static iris_camera_model model_of(const iris_q32 n[NUMBERS], iris_size size, int direction)
{
    iris_camera_model made = {
        size,
        {n[0], n[1], n[2], n[3], n[4]},
        {n[5], n[6], n[7], n[8], n[9], {n[10], n[11]}, direction ? IRIS_LENS_CORRECTS : IRIS_LENS_BENDS}};
    return made;
}

static int is_sound(const iris_camera_model *model, const iris_q32 numbers[NUMBERS])
{
    const iris_size size = model->size;
    int sound = size.w >= 1 && size.w <= IRIS_SIDE_MAX && size.h >= 1 && size.h <= IRIS_SIDE_MAX;
    for (int i = 0; i < NUMBERS; i++) {
        sound &= numbers[i] < LIMIT && numbers[i] > -LIMIT;
    }
    return sound && numbers[0] > 0 && numbers[1] > 0 &&
           (model->lens.direction == IRIS_LENS_BENDS || model->lens.direction == IRIS_LENS_CORRECTS);
}

static uint32_t check_of(const iris_camera_model *model, const iris_q32 numbers[NUMBERS])
{
    const int64_t others[3] = {model->size.w, model->size.h, model->lens.direction};
    return iris_text_check(iris_text_check(IRIS_TEXT_CHECK, others, 3), numbers, NUMBERS);
}

iris_status iris_camera_write_text(char *text, size_t capacity, size_t *length,
                                   const iris_camera_model *model)
{
    char made[IRIS_CAMERA_TEXT_BYTES], *at = made;
    iris_q32 numbers[NUMBERS];
    int next = 0;
    if (!text || !length || !model) {
        return IRIS_ERR_ARG;
    }
    numbers_of(numbers, model);
    if (!is_sound(model, numbers)) {
        return IRIS_ERR_RANGE;
    }
    at = iris_text_put_word(at, "iris camera 1\nsize ");
    at = iris_text_put_number(at, model->size.w, ' ');
    at = iris_text_put_number(at, model->size.h, '\n');
    for (int i = 0; i < 6; i++) {
        if (i == LENS_LINE - 1) {
            at = iris_text_put_word(at, model->lens.direction == IRIS_LENS_BENDS ? "lens bends\n"
                                                                                 : "lens corrects\n");
        }
        at = iris_text_put_word(at, rows[i].word);
        *at++ = ' ';
        for (int k = 0; k < rows[i].count; k++) {
            at = iris_text_put_q32(at, numbers[next++], k == rows[i].count - 1 ? '\n' : ' ');
        }
    }
    const iris_text_made whole = {made, at, check_of(model, numbers)};
    return iris_text_finish(text, capacity, length, &whole);
}

typedef struct {
    int64_t w, h;
    int corrects;
    iris_q32 numbers[NUMBERS];
    int count;
} content;

static int take_line(void *user, iris_text_lines *r, int i)
{
    content *c = user;
    if (i == 0) {
        return iris_text_take_word(r, "size") && iris_text_take_number(&c->w, r) &&
               iris_text_take_number(&c->h, r) && c->w > 0 && c->w <= IRIS_SIDE_MAX && c->h > 0 &&
               c->h <= IRIS_SIDE_MAX;
    }
    if (i == LENS_LINE) {
        if (!iris_text_take_word(r, "lens")) {
            return 0;
        }
        c->corrects = iris_text_take_word(r, "corrects");
        return c->corrects || iris_text_take_word(r, "bends");
    }
    int row = i < LENS_LINE ? i - 1 : i - 2, good = iris_text_take_word(r, rows[row].word);
    for (int k = 0; k < rows[row].count && good; k++) {
        good = iris_text_take_q32(&c->numbers[c->count++], r);
    }
    return good;
}

iris_status iris_camera_read_text(iris_camera_model *model, int32_t *line, const char *text, size_t bytes)
{
    static const iris_text_form form = {"camera", LINES, take_line};
    if (!model || !line || (!text && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    content c = {.w = 0};
    iris_text_source source = {.text = text, .bytes = bytes};
    iris_status status = iris_text_read(&c, &source, &form);
    const iris_camera_model made = model_of(c.numbers, (iris_size){(int32_t)c.w, (int32_t)c.h}, c.corrects);
    if (status == IRIS_OK && (source.check != check_of(&made, c.numbers) || !is_sound(&made, c.numbers))) {
        status = IRIS_ERR_DATA;
    }
    if (status == IRIS_OK) {
        *model = made;
    } else {
        *line = source.line;
    }
    return status;
}
