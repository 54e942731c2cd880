#include "iris/3d/pair_text.h"

#include "camera_lines.h"

#define HALF  (1 + IRIS_CAMERA_LINES) /* lines of a camera, with its side */
#define LINES (2 * HALF + 2)

typedef struct {
    iris_camera_content cameras[2];
    iris_q32 numbers[6];
} content;

static const char *const SIDES[2] = {"left", "right"}, *const WORDS[2] = {"turn", "place"};

static uint32_t check_of(const content *c)
{
    const uint32_t left = iris_camera_content_check(IRIS_TEXT_CHECK, &c->cameras[0]);
    return iris_text_check(iris_camera_content_check(left, &c->cameras[1]), c->numbers, 6);
}

void iris_pair_sensors(iris_sensor sensors[2], const iris_pair *pair)
{
    for (int k = 0; k < 2; k++) {
        sensors[k] = (iris_sensor){.intrinsics = pair->cameras[k].intrinsics, .lens = pair->cameras[k].lens};
    }
    iris_mat3_identity(&sensors[0].pose.turn);
    iris_rotation_from_vector(&sensors[1].pose.turn, pair->turn);
    sensors[1].pose.place = pair->place;
}

iris_status iris_pair_write_text(char *text, size_t capacity, size_t *length, const iris_pair *pair)
{
    content c;
    if (!text || !length || !pair) {
        return IRIS_ERR_ARG;
    }
    const iris_q32 numbers[6] = {pair->turn.x,  pair->turn.y,  pair->turn.z,
                                 pair->place.x, pair->place.y, pair->place.z};
    int sound = iris_camera_content_of(&c.cameras[0], &pair->cameras[0]) &&
                iris_camera_content_of(&c.cameras[1], &pair->cameras[1]);
    for (int i = 0; i < 6; i++) {
        c.numbers[i] = numbers[i];
        sound = sound && numbers[i] < IRIS_CAMERA_LIMIT && numbers[i] > -IRIS_CAMERA_LIMIT;
    }
    if (!sound || capacity < IRIS_PAIR_TEXT_BYTES) {
        return IRIS_ERR_RANGE;
    }
    char *at = iris_text_put_word(text, "iris pair 1\n");
    for (int k = 0; k < 2; k++) {
        at = iris_text_put_word(at, SIDES[k]);
        *at++ = '\n';
        at = iris_camera_put_lines(at, &c.cameras[k]);
    }
    for (int i = 0; i < 6; i++) {
        at = i % 3 == 0 ? iris_text_put_word(at, WORDS[i / 3]) : at;
        at = i % 3 == 0 ? iris_text_put_word(at, " ") : at;
        at = iris_text_put_q32(at, c.numbers[i], i % 3 == 2 ? '\n' : ' ');
    }
    at = iris_text_put_check(at, check_of(&c));
    *at = 0;
    *length = (size_t)(at - text);
    return IRIS_OK;
}

static int take_line(void *user, iris_text_lines *r, int i)
{
    content *c = user;
    if (i < 2 * HALF) {
        return i % HALF == 0 ? iris_text_take_word(r, SIDES[i / HALF])
                             : iris_camera_take_line(&c->cameras[i / HALF], r, i % HALF - 1);
    }
    int row = i - 2 * HALF, good = iris_text_take_word(r, WORDS[row]);
    for (int k = 0; k < 3 && good; k++) {
        good = iris_text_take_q32(&c->numbers[3 * row + k], r);
    }
    return good;
}

iris_status iris_pair_read_text(iris_pair *pair, int32_t *line, const char *text, size_t bytes)
{
    static const iris_text_form form = {"pair", LINES, take_line};
    iris_camera_model left, right;
    if (!pair || !line || (!text && bytes > 0)) {
        return IRIS_ERR_ARG;
    }
    content c = {.numbers = {0}};
    iris_text_source source = {.text = text, .bytes = bytes};
    iris_status status = iris_text_read(&c, &source, &form);
    if (status == IRIS_OK && ((source.has_check && source.check != check_of(&c)) ||
                              !iris_camera_content_model(&left, &c.cameras[0]) ||
                              !iris_camera_content_model(&right, &c.cameras[1]))) {
        status = IRIS_ERR_DATA;
    }
    if (status == IRIS_OK) {
        const iris_q32 *n = c.numbers;
        *pair = (iris_pair){{left, right}, {n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    } else {
        *line = source.line;
    }
    return status;
}
