/* A camera's calibration as text: see camera_text.h for the format. */
#include <string.h>

#include "camera_lines.h"

#define NUMBERS   IRIS_CAMERA_NUMBERS
#define LENS_LINE 4 /* of the lines, from 0 */

/* The lines of numbers behind the size, and how many each has. */
static const struct {
    const char *word;
    int count;
} rows[] = {{"focal", 2}, {"skew", 1}, {"center", 2}, {"radial", 3}, {"tangential", 2}, {"decentering", 2}};

static int is_sound(const iris_camera_content *c)
{
    int sound = c->w >= 1 && c->w <= IRIS_SIDE_MAX && c->h >= 1 && c->h <= IRIS_SIDE_MAX;
    for (int i = 0; i < NUMBERS; i++) {
        sound &= c->numbers[i] < IRIS_CAMERA_LIMIT && c->numbers[i] > -IRIS_CAMERA_LIMIT;
    }
    return sound && c->numbers[0] > 0 && c->numbers[1] > 0;
}

int iris_camera_content_of(iris_camera_content *content, const iris_camera_model *model)
{
    const iris_intrinsics *k = &model->intrinsics;
    const iris_lens *l = &model->lens;
    *content = (iris_camera_content){model->size.w,
                                     model->size.h,
                                     l->direction == IRIS_LENS_CORRECTS,
                                     {k->alpha_u, k->alpha_v, k->shear, k->u0, k->v0, l->k1, l->k2, l->k3,
                                      l->p1, l->p2, l->center.x, l->center.y},
                                     NUMBERS};
    return is_sound(content) && (l->direction == IRIS_LENS_CORRECTS || l->direction == IRIS_LENS_BENDS);
}

int iris_camera_content_model(iris_camera_model *model, const iris_camera_content *content)
{
    const iris_q32 *n = content->numbers;
    *model = (iris_camera_model){{(int32_t)content->w, (int32_t)content->h},
                                 {n[0], n[1], n[2], n[3], n[4]},
                                 {n[5],
                                  n[6],
                                  n[7],
                                  n[8],
                                  n[9],
                                  {n[10], n[11]},
                                  content->corrects ? IRIS_LENS_CORRECTS : IRIS_LENS_BENDS}};
    return is_sound(content);
}

uint32_t iris_camera_content_check(uint32_t check, const iris_camera_content *content)
{
    const int64_t others[3] = {content->w, content->h,
                               content->corrects ? IRIS_LENS_CORRECTS : IRIS_LENS_BENDS};
    return iris_text_check(iris_text_check(check, others, 3), content->numbers, NUMBERS);
}

char *iris_camera_put_lines(char *at, const iris_camera_content *content)
{
    int next = 0;
    at = iris_text_put_word(at, "size ");
    at = iris_text_put_number(at, content->w, ' ');
    at = iris_text_put_number(at, content->h, '\n');
    for (int i = 0; i < 6; i++) {
        if (i == LENS_LINE - 1) {
            at = iris_text_put_word(at, content->corrects ? "lens corrects\n" : "lens bends\n");
        }
        at = iris_text_put_word(at, rows[i].word);
        *at++ = ' ';
        for (int k = 0; k < rows[i].count; k++) {
            at = iris_text_put_q32(at, content->numbers[next++], k == rows[i].count - 1 ? '\n' : ' ');
        }
    }
    return at;
}

int iris_camera_take_line(iris_camera_content *c, iris_text_lines *r, int i)
{
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

iris_status iris_camera_write_text(char *text, size_t capacity, size_t *length,
                                   const iris_camera_model *model)
{
    char made[IRIS_CAMERA_TEXT_BYTES];
    iris_camera_content c;
    if (!text || !length || !model) {
        return IRIS_ERR_ARG;
    }
    if (!iris_camera_content_of(&c, model)) {
        return IRIS_ERR_RANGE;
    }
    char *at = iris_camera_put_lines(iris_text_put_word(made, "iris camera 1\n"), &c);
    const iris_text_made whole = {made, at, iris_camera_content_check(IRIS_TEXT_CHECK, &c)};
    return iris_text_finish(text, capacity, length, &whole);
}

static int take_line(void *user, iris_text_lines *r, int i)
{
    return iris_camera_take_line(user, r, i);
}

iris_status iris_camera_read_text(iris_camera_model *model, int32_t *line, const char *text, size_t bytes)
{
    static const iris_text_form form = {"camera", IRIS_CAMERA_LINES, take_line};
    iris_camera_model made;
    if (!model || !line || (!text && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    iris_camera_content c = {.w = 0};
    iris_text_source source = {.text = text, .bytes = bytes};
    iris_status status = iris_text_read(&c, &source, &form);
    if (status == IRIS_OK &&
        ((source.has_check && source.check != iris_camera_content_check(IRIS_TEXT_CHECK, &c)) ||
         !iris_camera_content_model(&made, &c))) {
        status = IRIS_ERR_DATA;
    }
    if (status == IRIS_OK) {
        *model = made;
    } else {
        *line = source.line;
    }
    return status;
}
