#include "iris/runtime/order.h"

#include "../foundation/text_lines.h"
#include "iris/fixed.h"

/* What stands behind a verb: whole numbers, or an angle in degrees. */
enum { NOTHING = 0, WHOLE, DEGREES };

typedef struct {
    const char *name;
    uint8_t form[2]; /* of a and b */
    uint8_t needed;  /* numbers that must stand there; those behind them are 0 when they do not */
    int32_t least[2], most[2];
} verb_form;

static const verb_form forms[IRIS_ORDER_VERBS] = {
    [IRIS_ORDER_NONE] = {"", {NOTHING, NOTHING}, 0, {0, 0}, {0, 0}},
    [IRIS_ORDER_STOP] = {"stop", {NOTHING, NOTHING}, 0, {0, 0}, {0, 0}},
    [IRIS_ORDER_GO] = {"go",
                       {WHOLE, WHOLE},
                       1,
                       {-IRIS_ORDER_PLACE_MAX_MM, 0},
                       {IRIS_ORDER_PLACE_MAX_MM, IRIS_ORDER_SPEED_MAX_MMS}},
    [IRIS_ORDER_TURN] =
        {"turn", {DEGREES, NOTHING}, 1, {-IRIS_ORDER_ANGLE_MAX, 0}, {IRIS_ORDER_ANGLE_MAX, 0}},
    [IRIS_ORDER_DRIVE] = {"drive",
                          {WHOLE, DEGREES},
                          2,
                          {-IRIS_ORDER_SPEED_MAX_MMS, -IRIS_ORDER_TURN_RATE_MAX},
                          {IRIS_ORDER_SPEED_MAX_MMS, IRIS_ORDER_TURN_RATE_MAX}},
    [IRIS_ORDER_FOLLOW_LINE] = {"follow", {WHOLE, NOTHING}, 0, {0, 0}, {IRIS_ORDER_SPEED_MAX_MMS, 0}},
    [IRIS_ORDER_LOCK_ON] = {"lock", {WHOLE, NOTHING}, 0, {0, 0}, {IRIS_ORDER_SPEED_MAX_MMS, 0}},
    [IRIS_ORDER_GO_TO] = {"goto",
                          {WHOLE, WHOLE},
                          2,
                          {-IRIS_ORDER_PLACE_MAX_MM, -IRIS_ORDER_PLACE_MAX_MM},
                          {IRIS_ORDER_PLACE_MAX_MM, IRIS_ORDER_PLACE_MAX_MM}},
    [IRIS_ORDER_EXPLORE] = {"explore", {WHOLE, NOTHING}, 0, {0, 0}, {IRIS_ORDER_SPEED_MAX_MMS, 0}},
    [IRIS_ORDER_MAP] = {"map", {NOTHING, NOTHING}, 0, {0, 0}, {0, 0}},
    [IRIS_ORDER_DETECT] = {"detect", {NOTHING, NOTHING}, 0, {0, 0}, {0, 0}},
    [IRIS_ORDER_RESET_TIME] = {"reset", {NOTHING, NOTHING}, 0, {0, 0}, {0, 0}},
};

/* Thousandths of a degree, and back: 360000 to 65536. */
static int32_t units_of(int32_t milli)
{
    const int64_t scaled = (int64_t)milli * 1024;
    return (int32_t)((scaled * 2 + 5625 >= 0 ? scaled * 2 + 5625 : scaled * 2 + 5625 - 11249) / 11250);
}

static int32_t milli_of(int32_t units)
{
    return (int32_t)iris_round_shift((int64_t)units * 5625, 10);
}

iris_status iris_order_check(const iris_order *order)
{
    if (!order || (int)order->verb <= IRIS_ORDER_NONE || (int)order->verb >= IRIS_ORDER_VERBS) {
        return IRIS_ERR_ARG;
    }
    const verb_form *form = &forms[order->verb];
    return order->a < form->least[0] || order->a > form->most[0] || order->b < form->least[1] ||
                   order->b > form->most[1]
               ? IRIS_ERR_RANGE
               : IRIS_OK;
}

const char *iris_order_name(int32_t verb)
{
    return verb > IRIS_ORDER_NONE && verb < IRIS_ORDER_VERBS ? forms[verb].name : NULL;
}

static char *put_degrees(char *at, int32_t units)
{
    const int32_t milli = milli_of(units);
    const int32_t size = milli < 0 ? -milli : milli;
    int32_t rest = size % 1000;
    if (milli < 0) {
        *at++ = '-';
    }
    at = iris_text_put_number(at, size / 1000, '.');
    if (rest == 0) {
        return at - 1;
    }
    for (int32_t place = 100; rest > 0; rest %= place, place /= 10) {
        *at++ = (char)('0' + rest / place);
    }
    return at;
}

iris_status iris_order_write(char *text, size_t capacity, size_t *length, const iris_order *order)
{
    if (!text || !length) {
        return IRIS_ERR_ARG;
    }
    const iris_status status = iris_order_check(order);
    if (status != IRIS_OK) {
        return status;
    }
    const verb_form *form = &forms[order->verb];
    const int32_t values[2] = {order->a, order->b};
    char made[IRIS_ORDER_TEXT_BYTES];
    char *at = iris_text_put_word(made, form->name);
    for (int i = 0; i < 2 && form->form[i] != NOTHING; i++) {
        if (i >= form->needed && values[i] == 0) {
            break;
        }
        *at++ = ' ';
        at = form->form[i] == DEGREES ? put_degrees(at, values[i])
                                      : iris_text_put_number(at, values[i], 0) - 1;
    }
    *at++ = 0;
    const size_t bytes = (size_t)(at - made);
    if (bytes > capacity) {
        return IRIS_ERR_RANGE;
    }
    for (size_t i = 0; i < bytes; i++) {
        text[i] = made[i];
    }
    *length = bytes - 1;
    return IRIS_OK;
}

/* What is left of a line. */
typedef struct {
    const char *at, *end;
} rest_of_line;

static int is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static void skip_spaces(rest_of_line *r)
{
    while (r->at < r->end && is_space(*r->at)) {
        r->at++;
    }
    if (r->at < r->end && *r->at == '#') {
        r->end = r->at;
    }
}

static int take_name(rest_of_line *r, const char *name)
{
    const char *at = r->at;
    for (; *name && at < r->end; at++, name++) {
        const char small = *at >= 'A' && *at <= 'Z' ? (char)(*at - 'A' + 'a') : *at;
        if (small != *name) {
            return 0;
        }
    }
    if (*name || (at < r->end && !is_space(*at) && *at != '#')) {
        return 0;
    }
    r->at = at;
    return 1;
}

static iris_order_verb take_verb(rest_of_line *r)
{
    for (int verb = IRIS_ORDER_STOP; verb < IRIS_ORDER_VERBS; verb++) {
        if (take_name(r, forms[verb].name)) {
            return (iris_order_verb)verb;
        }
    }
    return IRIS_ORDER_NONE;
}

/* A number in thousandths, with up to `places` places behind its point; it saturates far beyond all ranges. */
static iris_status take_thousandths(int64_t *number, rest_of_line *r, int places)
{
    const char *at = r->at;
    const int negative = at < r->end && *at == '-';
    int64_t value = 0;
    int digits = 0, behind = 0;
    at += negative;
    for (; at < r->end && *at >= '0' && *at <= '9'; at++, digits++) {
        value = value < 1000000000000 ? value * 10 + (*at - '0') : value;
    }
    if (places > 0 && at < r->end && *at == '.') {
        for (at++; at < r->end && *at >= '0' && *at <= '9' && behind < places; at++, digits++, behind++) {
            value = value * 10 + (*at - '0');
        }
    }
    if (digits == 0 || (at < r->end && !is_space(*at) && *at != '#')) {
        return IRIS_ERR_DATA;
    }
    for (; behind < 3; behind++) {
        value *= 10;
    }
    *number = negative ? -value : value;
    r->at = at;
    return IRIS_OK;
}

/* A value of this form, in its unit. */
static iris_status take_value(int32_t *value, rest_of_line *r, int form)
{
    int64_t number = 0;
    const iris_status status = take_thousandths(&number, r, form == DEGREES ? 3 : 0);
    if (status != IRIS_OK) {
        return status;
    }
    if (form == WHOLE) {
        *value = iris_sat_s32(number / 1000);
        return IRIS_OK;
    }
    const int64_t most = 40000 * 1000; /* degrees: more than any range */
    *value = units_of((int32_t)(number > most ? most : number < -most ? -most : number));
    return IRIS_OK;
}

static iris_status take_values(iris_order *order, rest_of_line *r, const char **wrong)
{
    const verb_form *form = &forms[order->verb];
    int32_t values[2] = {0, 0};
    for (int i = 0; i < 2 && form->form[i] != NOTHING; i++) {
        skip_spaces(r);
        *wrong = r->at;
        if (i >= form->needed && r->at >= r->end) {
            break;
        }
        const iris_status status = take_value(&values[i], r, form->form[i]);
        if (status != IRIS_OK) {
            return status;
        }
        if (values[i] < form->least[i] || values[i] > form->most[i]) {
            return IRIS_ERR_RANGE;
        }
    }
    order->a = values[0];
    order->b = values[1];
    skip_spaces(r);
    *wrong = r->at;
    return r->at < r->end ? IRIS_ERR_DATA : IRIS_OK;
}

iris_status iris_order_read(iris_order *order, int32_t *column, const char *text, size_t length)
{
    if (!order || !column || !text) {
        return IRIS_ERR_ARG;
    }
    rest_of_line r = {text, text + length};
    skip_spaces(&r);
    const char *wrong = r.at;
    iris_order found = {IRIS_ORDER_NONE, 0, 0};
    iris_status status = r.at < r.end ? IRIS_ERR_DATA : IRIS_ERR_END;
    if (status == IRIS_ERR_DATA) {
        found.verb = take_verb(&r);
        status = found.verb == IRIS_ORDER_NONE ? IRIS_ERR_DATA : take_values(&found, &r, &wrong);
    }
    *column = status == IRIS_ERR_DATA || status == IRIS_ERR_RANGE ? iris_sat_s32(wrong - text + 1) : 0;
    if (status == IRIS_OK) {
        *order = found;
    }
    return status;
}

iris_status iris_order_of_command(iris_order *order, const iris_command *command, int32_t speed_max_mms,
                                  int32_t turn_rate_max)
{
    if (!order || !command || command->steer_permil < -1000 || command->steer_permil > 1000 ||
        command->speed_permil < 0 || command->speed_permil > 1000) {
        return IRIS_ERR_ARG;
    }
    if (speed_max_mms < 1 || speed_max_mms > IRIS_ORDER_SPEED_MAX_MMS || turn_rate_max < 0 ||
        turn_rate_max > IRIS_ORDER_TURN_RATE_MAX) {
        return IRIS_ERR_RANGE;
    }
    const int32_t share = command->steer_permil * command->speed_permil; /* millionths */
    order->verb = IRIS_ORDER_DRIVE;
    order->a = speed_max_mms * command->speed_permil / 1000;
    order->b = (int32_t)((int64_t)turn_rate_max * share / 1000000);
    return IRIS_OK;
}
