/* Controls of the kernel's cameras, by names that stay the same from driver to driver. */
#include "iris/camera_control.h"
#include "video_device.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

enum {
    CONTROLS_MAX = 1024, /* the longest lists that are read from a driver */
    CHOICES_MAX = 1024
};

static const struct {
    uint32_t id;
    const char *name;
} usual[] = {
    {V4L2_CID_EXPOSURE_ABSOLUTE, "exposure"},
    {V4L2_CID_EXPOSURE, "exposure"},
    {V4L2_CID_EXPOSURE_AUTO, "exposure-auto"},
    {V4L2_CID_EXPOSURE_AUTO_PRIORITY, "exposure-auto-priority"},
    {V4L2_CID_AUTO_EXPOSURE_BIAS, "exposure-bias"},
    {V4L2_CID_GAIN, "gain"},
    {V4L2_CID_AUTOGAIN, "gain-auto"},
    {V4L2_CID_ANALOGUE_GAIN, "analog-gain"},
    {V4L2_CID_DIGITAL_GAIN, "digital-gain"},
    {V4L2_CID_ISO_SENSITIVITY, "iso"},
    {V4L2_CID_ISO_SENSITIVITY_AUTO, "iso-auto"},
    {V4L2_CID_WHITE_BALANCE_TEMPERATURE, "white-balance"},
    {V4L2_CID_AUTO_WHITE_BALANCE, "white-balance-auto"},
    {V4L2_CID_DO_WHITE_BALANCE, "white-balance-once"},
    {V4L2_CID_RED_BALANCE, "red-balance"},
    {V4L2_CID_BLUE_BALANCE, "blue-balance"},
    {V4L2_CID_FOCUS_ABSOLUTE, "focus"},
    {V4L2_CID_FOCUS_AUTO, "focus-auto"},
    {V4L2_CID_BRIGHTNESS, "brightness"},
    {V4L2_CID_AUTOBRIGHTNESS, "brightness-auto"},
    {V4L2_CID_CONTRAST, "contrast"},
    {V4L2_CID_SATURATION, "saturation"},
    {V4L2_CID_HUE, "hue"},
    {V4L2_CID_HUE_AUTO, "hue-auto"},
    {V4L2_CID_SHARPNESS, "sharpness"},
    {V4L2_CID_GAMMA, "gamma"},
    {V4L2_CID_BACKLIGHT_COMPENSATION, "backlight-compensation"},
    {V4L2_CID_POWER_LINE_FREQUENCY, "power-line-frequency"},
    {V4L2_CID_HFLIP, "flip-horizontal"},
    {V4L2_CID_VFLIP, "flip-vertical"},
    {V4L2_CID_ROTATE, "rotate"},
    {V4L2_CID_ZOOM_ABSOLUTE, "zoom"},
    {V4L2_CID_PAN_ABSOLUTE, "pan"},
    {V4L2_CID_TILT_ABSOLUTE, "tilt"},
    {V4L2_CID_TEST_PATTERN, "test-pattern"},
};

/* The driver's words in small letters and digits, with one dash for what is between them. */
static void put_dashes(char name[IRIS_CAMERA_CONTROL_NAME_BYTES], const char *words)
{
    size_t length = 0;
    for (; *words && length + 1 < IRIS_CAMERA_CONTROL_NAME_BYTES; words++) {
        char letter = *words >= 'A' && *words <= 'Z' ? (char)(*words - 'A' + 'a') : *words;
        if ((letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9')) {
            name[length++] = letter;
        } else if (length > 0 && name[length - 1] != '-') {
            name[length++] = '-';
        }
    }
    while (length > 0 && name[length - 1] == '-') {
        length--;
    }
    name[length] = 0;
}

/* Without regard to others of that name. */
static void name_of(char name[IRIS_CAMERA_CONTROL_NAME_BYTES], uint32_t id, const char *label)
{
    for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++) {
        if (usual[i].id == id) {
            problem_text text = problem_text_in(name, IRIS_CAMERA_CONTROL_NAME_BYTES);
            problem_text_add(&text, usual[i].name);
            return;
        }
    }
    put_dashes(name, label);
    if (name[0] == 0) {
        put_dashes(name, "unnamed");
    }
}

static iris_status fail(iris_camera_controls *controls, iris_status status, const char *what, int error)
{
    problem_text text = problem_text_in(controls->problem, sizeof controls->problem);
    problem_text_add(&text, what);
    if (error != 0) {
        problem_text_add(&text, ": ");
        problem_text_add(&text, video_error_text(error));
    }
    return status;
}

iris_status iris_camera_controls_open(iris_camera_controls *controls, const char *path)
{
    if (!controls || !path) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_capability capability;
    uint32_t type;
    memset(controls, 0, sizeof *controls);
    controls->handle = -1;
    int error = video_open(&controls->handle, &type, &capability, path);
    return error ? fail(controls, video_open_status(error), video_open_text(error), 0) : IRIS_OK;
}

void iris_camera_controls_close(iris_camera_controls *controls)
{
    if (controls && controls->handle >= 0) {
        (void)close(controls->handle);
        controls->handle = -1;
    }
}

const char *iris_camera_controls_problem(const iris_camera_controls *controls)
{
    return controls ? controls->problem : "not opened";
}

static iris_camera_control_kind kind_of(uint32_t type)
{
    switch (type) {
    case V4L2_CTRL_TYPE_INTEGER:
    case V4L2_CTRL_TYPE_INTEGER64:
        return IRIS_CONTROL_NUMBER;
    case V4L2_CTRL_TYPE_BOOLEAN:
        return IRIS_CONTROL_SWITCH;
    case V4L2_CTRL_TYPE_MENU:
    case V4L2_CTRL_TYPE_INTEGER_MENU:
        return IRIS_CONTROL_MENU;
    case V4L2_CTRL_TYPE_BUTTON:
        return IRIS_CONTROL_BUTTON;
    case V4L2_CTRL_TYPE_BITMASK:
        return IRIS_CONTROL_BITS;
    default:
        return (iris_camera_control_kind)0;
    }
}

/* The next control after *id that is listed: 0, or errno, EINVAL at the end. */
static int next_control(struct v4l2_query_ext_ctrl *query, int handle, uint32_t *id)
{
    for (int i = 0; i < CONTROLS_MAX; i++) {
        memset(query, 0, sizeof *query);
        query->id = *id | V4L2_CTRL_FLAG_NEXT_CTRL;
        int error = video_ask(handle, VIDIOC_QUERY_EXT_CTRL, query);
        if (error != 0) {
            return error == ENOTTY ? EINVAL : error;
        }
        if (query->id <= *id) {
            return EINVAL; /* a driver that goes back would never end */
        }
        *id = query->id;
        if (kind_of(query->type) != 0 &&
            !(query->flags & (V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_HAS_PAYLOAD))) {
            return 0;
        }
    }
    return EINVAL;
}

/* One value is read or written. 0, or errno. */
static int exchange(int64_t *value, int handle, unsigned long request, uint32_t id, uint32_t type)
{
    struct v4l2_ext_control control;
    struct v4l2_ext_controls list;
    memset(&control, 0, sizeof control);
    memset(&list, 0, sizeof list);
    control.id = id;
    if (type == V4L2_CTRL_TYPE_INTEGER64) {
        control.value64 = *value;
    } else {
        control.value = (int32_t)*value;
    }
    list.which = V4L2_CTRL_WHICH_CUR_VAL;
    list.count = 1;
    list.controls = &control;
    int error = video_ask(handle, request, &list);
    if (error == 0) {
        *value = type == V4L2_CTRL_TYPE_INTEGER64 ? control.value64
                 : type == V4L2_CTRL_TYPE_BITMASK ? (int64_t)(uint32_t)control.value
                                                  : control.value;
    }
    return error;
}

/* All but the name. */
static int describe(iris_camera_control *control, int handle, const struct v4l2_query_ext_ctrl *query)
{
    memset(control, 0, sizeof *control);
    problem_text_copy(control->label, sizeof control->label, query->name, sizeof query->name);
    control->kind = kind_of(query->type);
    control->id = query->id;
    control->minimum = query->minimum;
    control->maximum = query->maximum;
    control->step = query->step >= 1 && query->step <= INT64_MAX ? (int64_t)query->step : 1;
    control->default_value = query->default_value;
    if (query->type == V4L2_CTRL_TYPE_BITMASK) {
        control->maximum = (int64_t)(uint32_t)query->maximum;
        control->default_value = (int64_t)(uint32_t)query->default_value;
    }
    control->flags = (query->flags & V4L2_CTRL_FLAG_READ_ONLY ? IRIS_CONTROL_READ_ONLY : 0) |
                     (query->flags & V4L2_CTRL_FLAG_WRITE_ONLY ? IRIS_CONTROL_WRITE_ONLY : 0) |
                     (query->flags & V4L2_CTRL_FLAG_INACTIVE ? IRIS_CONTROL_INACTIVE : 0) |
                     (query->flags & V4L2_CTRL_FLAG_GRABBED ? IRIS_CONTROL_BUSY : 0);
    if (control->kind == IRIS_CONTROL_BUTTON || control->flags & IRIS_CONTROL_WRITE_ONLY) {
        return 0;
    }
    int error = exchange(&control->value, handle, VIDIOC_G_EXT_CTRLS, query->id, query->type);
    return error == ENODEV ? error : 0;
}

static void add_ordinal(char name[IRIS_CAMERA_CONTROL_NAME_BYTES], int ordinal)
{
    char number[16];
    problem_text text = problem_text_in(number, sizeof number);
    problem_text_add(&text, "-");
    problem_text_add_number(&text, ordinal);
    size_t length = strlen(name), room = IRIS_CAMERA_CONTROL_NAME_BYTES - 1 - text.length;
    memcpy(name + (length < room ? length : room), number, text.length + 1);
}

iris_status iris_camera_controls_list(iris_camera_control *list, int32_t *count,
                                      iris_camera_controls *controls, int32_t capacity)
{
    if (!count || !controls || controls->handle < 0 || capacity < 0 || (capacity > 0 && !list)) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_query_ext_ctrl query;
    uint32_t id = 0;
    int error;
    *count = 0;
    while ((error = next_control(&query, controls->handle, &id)) == 0 && *count < CONTROLS_MAX) {
        if (*count < capacity) {
            iris_camera_control *control = &list[*count];
            int ordinal = 1;
            error = describe(control, controls->handle, &query);
            if (error != 0) {
                break;
            }
            name_of(control->name, control->id, control->label);
            for (int32_t i = 0; i < *count; i++) {
                char other[IRIS_CAMERA_CONTROL_NAME_BYTES];
                name_of(other, list[i].id, list[i].label);
                ordinal += strcmp(other, control->name) == 0;
            }
            if (ordinal > 1) {
                add_ordinal(control->name, ordinal);
            }
        }
        ++*count;
    }
    if (error != 0 && error != EINVAL) {
        return fail(controls, IRIS_ERR_IO, "the camera does not list its controls", error);
    }
    return *count > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

/* Of name-2 the name and the 2; 1 for a name without a number. */
static int split_ordinal(char base[IRIS_CAMERA_CONTROL_NAME_BYTES], const char *name)
{
    size_t length = strlen(name), digits = 0;
    while (digits < 3 && digits < length && name[length - 1 - digits] >= '0' &&
           name[length - 1 - digits] <= '9') {
        digits++;
    }
    problem_text_copy(base, IRIS_CAMERA_CONTROL_NAME_BYTES, name, length);
    if (digits == 0 || digits + 1 >= length || name[length - 1 - digits] != '-') {
        return 1;
    }
    int ordinal = 0;
    for (size_t i = length - digits; i < length; i++) {
        ordinal = ordinal * 10 + (name[i] - '0');
    }
    base[length - digits - 1 < IRIS_CAMERA_CONTROL_NAME_BYTES ? length - digits - 1 : 0] = 0;
    return ordinal;
}

/* The control of that name, and its kernel's type. */
static iris_status find(struct v4l2_query_ext_ctrl *found, iris_camera_controls *controls, const char *name)
{
    struct v4l2_query_ext_ctrl query;
    char base[IRIS_CAMERA_CONTROL_NAME_BYTES];
    int ordinal = split_ordinal(base, name), seen = 0, error = 0, have = 0;
    uint32_t id = 0;
    for (int i = 0; i < CONTROLS_MAX; i++) {
        char own[IRIS_CAMERA_CONTROL_NAME_BYTES], label[33];
        error = next_control(&query, controls->handle, &id);
        if (error != 0) {
            break;
        }
        problem_text_copy(label, sizeof label, query.name, sizeof query.name);
        name_of(own, query.id, label);
        if (strcmp(own, name) == 0) {
            *found = query;
            return IRIS_OK;
        }
        if (strcmp(own, base) == 0 && ++seen == ordinal) {
            *found = query;
            have = 1;
        }
    }
    if (error != 0 && error != EINVAL) {
        return fail(controls, IRIS_ERR_IO, "the camera does not list its controls", error);
    }
    return have ? IRIS_OK : fail(controls, IRIS_ERR_UNSUPPORTED, "the camera has no such control", 0);
}

iris_status iris_camera_control_get(iris_camera_control *control, iris_camera_controls *controls,
                                    const char *name)
{
    if (!control || !controls || controls->handle < 0 || !name) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_query_ext_ctrl query;
    iris_camera_control read;
    iris_status status = find(&query, controls, name);
    if (status != IRIS_OK) {
        return status;
    }
    int error = describe(&read, controls->handle, &query);
    if (error != 0) {
        return fail(controls, IRIS_ERR_IO, "the control cannot be read", error);
    }
    problem_text_copy(read.name, sizeof read.name, name, strlen(name));
    *control = read;
    return IRIS_OK;
}

static iris_status refuse_value(iris_camera_controls *controls, const char *name,
                                const iris_camera_control *control)
{
    problem_text text = problem_text_in(controls->problem, sizeof controls->problem);
    problem_text_add(&text, name);
    if (control->kind == IRIS_CONTROL_BITS) {
        problem_text_add(&text, " takes the bits of ");
    } else {
        problem_text_add(&text, control->kind == IRIS_CONTROL_MENU ? " takes a choice from " : " takes ");
        problem_text_add_number(&text, control->minimum);
        problem_text_add(&text, " to ");
    }
    problem_text_add_number(&text, control->maximum);
    if (control->step > 1 && control->kind == IRIS_CONTROL_NUMBER) {
        problem_text_add(&text, " in steps of ");
        problem_text_add_number(&text, control->step);
    }
    return IRIS_ERR_RANGE;
}

static int query_choice(struct v4l2_querymenu *item, int handle, uint32_t id, int64_t value)
{
    memset(item, 0, sizeof *item);
    item->id = id;
    item->index = (uint32_t)value;
    return video_ask(handle, VIDIOC_QUERYMENU, item);
}

iris_status iris_camera_control_set(iris_camera_controls *controls, const char *name, int64_t value)
{
    if (!controls || controls->handle < 0 || !name) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_query_ext_ctrl query;
    struct v4l2_querymenu item;
    iris_camera_control control;
    iris_status status = find(&query, controls, name);
    if (status != IRIS_OK) {
        return status;
    }
    query.flags |= V4L2_CTRL_FLAG_WRITE_ONLY; /* its value is of no interest */
    (void)describe(&control, controls->handle, &query);
    if (control.flags & IRIS_CONTROL_READ_ONLY) {
        return fail(controls, IRIS_ERR_UNSUPPORTED, "the control can only be read", 0);
    }
    int outside = value < control.minimum || value > control.maximum;
    outside |= control.kind == IRIS_CONTROL_BITS && (value & ~control.maximum) != 0;
    if (control.kind == IRIS_CONTROL_BUTTON) {
        value = 0;
    } else if (outside) {
        return refuse_value(controls, name, &control);
    }
    if (control.kind == IRIS_CONTROL_MENU &&
        query_choice(&item, controls->handle, query.id, value) == EINVAL) {
        return refuse_value(controls, name, &control);
    }
    int error = exchange(&value, controls->handle, VIDIOC_S_EXT_CTRLS, query.id, query.type);
    if (error == ERANGE) {
        return refuse_value(controls, name, &control);
    }
    if (error == EBUSY) {
        return fail(controls, IRIS_ERR_IO,
                    "the control cannot be set while frames flow, or another one holds it", 0);
    }
    return error ? fail(controls, IRIS_ERR_IO, "the control cannot be set", error) : IRIS_OK;
}

static void read_choice(iris_camera_choice *choice, const struct v4l2_query_ext_ctrl *query,
                        const struct v4l2_querymenu *item, int64_t value)
{
    memset(choice, 0, sizeof *choice);
    choice->value = value;
    if (query->type == V4L2_CTRL_TYPE_INTEGER_MENU) {
        problem_text text = problem_text_in(choice->name, sizeof choice->name);
        problem_text_add_number(&text, item->value);
    } else {
        char label[33];
        problem_text_copy(label, sizeof label, item->name, sizeof item->name);
        put_dashes(choice->name, label);
    }
}

/* The choice of this value, or of the next one that the camera has; *value is the one after it then. 0, or errno, EINVAL
 * behind the last. */
static int next_choice(iris_camera_choice *choice, int handle, const struct v4l2_query_ext_ctrl *query,
                       int64_t *value)
{
    while (*value <= query->maximum && *value - query->minimum < CHOICES_MAX) {
        struct v4l2_querymenu item;
        int error = query_choice(&item, handle, query->id, *value);
        if (error == 0) {
            read_choice(choice, query, &item, *value);
        }
        ++*value;
        if (error != EINVAL) {
            return error;
        }
    }
    return EINVAL;
}

iris_status iris_camera_control_choices(iris_camera_choice *choices, int32_t *count,
                                        iris_camera_controls *controls, const char *name, int32_t capacity)
{
    if (!count || !controls || controls->handle < 0 || !name || capacity < 0 || (capacity > 0 && !choices)) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_query_ext_ctrl query;
    iris_camera_choice choice;
    int error;
    *count = 0;
    iris_status status = find(&query, controls, name);
    if (status != IRIS_OK || kind_of(query.type) != IRIS_CONTROL_MENU) {
        return status;
    }
    int64_t value = query.minimum;
    while ((error = next_choice(&choice, controls->handle, &query, &value)) == 0) {
        if (*count < capacity) {
            choices[*count] = choice;
        }
        ++*count;
    }
    if (error != EINVAL) {
        return fail(controls, IRIS_ERR_IO, "the camera does not list its choices", error);
    }
    return *count > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

/* Is word how this name begins, up to a dash? *whole: it is all of it. */
static int begins_with(int *whole, const char *name, const char *word)
{
    size_t length = strlen(word);
    *whole = strcmp(name, word) == 0;
    return length > 0 && strncmp(name, word, length) == 0 && (name[length] == '-' || *whole);
}

iris_status iris_camera_control_choose(iris_camera_controls *controls, const char *name, const char *word)
{
    if (!controls || controls->handle < 0 || !name || !word) {
        return IRIS_ERR_ARG;
    }
    struct v4l2_query_ext_ctrl query;
    iris_camera_choice choice;
    iris_status status = find(&query, controls, name);
    if (status != IRIS_OK) {
        return status;
    }
    if (kind_of(query.type) != IRIS_CONTROL_MENU) {
        return fail(controls, IRIS_ERR_RANGE, "the control is not a menu", 0);
    }
    problem_text text = problem_text_in(controls->problem, sizeof controls->problem);
    problem_text_add(&text, "no single choice is called that; there are");
    int64_t value = query.minimum, found = 0;
    int found_count = 0, whole = 0, error;
    while (!whole && (error = next_choice(&choice, controls->handle, &query, &value)) == 0) {
        problem_text_add(&text, " ");
        problem_text_add(&text, choice.name);
        if (begins_with(&whole, choice.name, word)) {
            found = choice.value;
            found_count = whole ? 1 : found_count + 1;
        }
    }
    if (!whole && error != EINVAL) {
        return fail(controls, IRIS_ERR_IO, "the camera does not list its choices", error);
    }
    return found_count == 1 ? iris_camera_control_set(controls, name, found) : IRIS_ERR_RANGE;
}
