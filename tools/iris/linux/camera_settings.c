/* iris controls: what a camera lets be set. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../camera_tables.h"
#include "../complain.h"
#include "../json.h"
#include "iris/camera_control.h"

#define CONTROLS 128
#define CHOICES  64

static iris_camera_controls controls;
static iris_camera_choice choices[CHOICES];

static const char *const kinds[] = {"?", "number", "switch", "menu", "button", "bits"};

static const struct {
    uint32_t flag;
    const char *name;
} flags[] = {{IRIS_CONTROL_READ_ONLY, "read-only"},
             {IRIS_CONTROL_WRITE_ONLY, "write-only"},
             {IRIS_CONTROL_INACTIVE, "inactive"},
             {IRIS_CONTROL_BUSY, "busy"}};

static int open_controls(const char *device)
{
    if (iris_camera_controls_open(&controls, device) != IRIS_OK) {
        complain(device, "%s", iris_camera_controls_problem(&controls));
        return EXIT_BAD_DATA;
    }
    return EXIT_DONE;
}

/* The choices of a menu are in `choices` then. Returns how many. */
static int32_t choices_of(const iris_camera_control *control)
{
    int32_t count = 0;
    if (control->kind == IRIS_CONTROL_MENU) {
        (void)iris_camera_control_choices(choices, &count, &controls, control->name, CHOICES);
    }
    return count < CHOICES ? count : CHOICES;
}

static const char *choice_name(int32_t count, int64_t value)
{
    for (int32_t i = 0; i < count; i++) {
        if (choices[i].value == value) {
            return choices[i].name;
        }
    }
    return NULL;
}

static int has_value(const iris_camera_control *control)
{
    return control->kind != IRIS_CONTROL_BUTTON && !(control->flags & IRIS_CONTROL_WRITE_ONLY);
}

static void json_control(const iris_camera_control *control)
{
    const struct {
        const char *key;
        int64_t number;
    } numbers[] = {{"value", control->value},
                   {"minimum", control->minimum},
                   {"maximum", control->maximum},
                   {"step", control->step},
                   {"default", control->default_value}};
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "name");
    json_string(&json, control->name);
    json_key(&json, "label");
    json_string(&json, control->label);
    json_key(&json, "kind");
    json_string(&json, kinds[control->kind]);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        json_key(&json, numbers[i].key);
        i > 0 || has_value(control) ? json_integer(&json, numbers[i].number) : json_null(&json);
    }
    json_key(&json, "flags");
    json_open(&json, '[');
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        if (control->flags & flags[i].flag) {
            json_string(&json, flags[i].name);
        }
    }
    json_close(&json, ']');
    json_key(&json, "choices");
    json_open(&json, '[');
    int32_t count = choices_of(control);
    for (int32_t i = 0; i < count; i++) {
        json_open(&json, '{');
        json_key(&json, "value");
        json_integer(&json, choices[i].value);
        json_key(&json, "name");
        json_string(&json, choices[i].name);
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_value(const iris_camera_control *control, int32_t choice_count, int64_t value)
{
    const char *name = choice_name(choice_count, value);
    if (name) {
        printf("%s", name);
    } else if (control->kind == IRIS_CONTROL_SWITCH) {
        printf("%s", value ? "on" : "off");
    } else if (control->kind == IRIS_CONTROL_BITS) {
        printf("0x%" PRIx64, (uint64_t)value);
    } else {
        printf("%" PRId64, value);
    }
}

static void print_control(const iris_camera_control *control)
{
    int32_t count = choices_of(control);
    printf("%-28s ", control->name);
    if (control->kind == IRIS_CONTROL_BUTTON) {
        printf("button");
    } else {
        has_value(control) ? print_value(control, count, control->value) : (void)putchar('-');
        printf("  (default ");
        print_value(control, count, control->default_value);
        if (control->kind == IRIS_CONTROL_NUMBER) {
            printf(", %" PRId64 " to %" PRId64, control->minimum, control->maximum);
            if (control->step != 1) {
                printf(" in steps of %" PRId64, control->step);
            }
        }
        for (int32_t i = 0; i < count; i++) {
            printf("%s%s", i == 0 ? "; " : ", ", choices[i].name);
        }
        putchar(')');
    }
    for (size_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        if (control->flags & flags[i].flag) {
            printf("  %s", flags[i].name);
        }
    }
    putchar('\n');
}

int camera_tables_controls(const char *device, int json)
{
    static iris_camera_control list[CONTROLS];
    int32_t count = 0;
    int exit_code = open_controls(device);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    iris_status status = iris_camera_controls_list(list, &count, &controls, CONTROLS);
    if (status != IRIS_OK && status != IRIS_ERR_FULL) {
        complain(device, "%s", iris_camera_controls_problem(&controls));
        exit_code = EXIT_BAD_DATA;
    } else if (count == 0) {
        complain(device, "this camera has no controls");
    }
    for (int32_t i = 0; exit_code == EXIT_DONE && i < count && i < CONTROLS; i++) {
        json ? json_control(&list[i]) : print_control(&list[i]);
    }
    iris_camera_controls_close(&controls);
    return exit_code;
}

/* A decimal number, or a hexadecimal one that begins with 0x. */
static int read_whole(int64_t *value, const char *text)
{
    char *end;
    int is_hex = text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
    errno = 0;
    *value = strtoll(text, &end, is_hex ? 16 : 10);
    return end != text && *end == '\0' && errno == 0;
}

/* Reads a value as its kind wants it. Returns 0 after complaining. */
static int read_value(int64_t *value, const iris_camera_control *control, const char *text)
{
    int is_switch = control->kind == IRIS_CONTROL_SWITCH;
    if (is_switch && (strcmp(text, "on") == 0 || strcmp(text, "off") == 0)) {
        *value = text[1] == 'n';
        return 1;
    }
    if (read_whole(value, text)) {
        return 1;
    }
    complain(control->name, is_switch ? "on or off, not '%s'" : "a whole number, not '%s'", text);
    return 0;
}

/* May a number be the value of a choice? Not where choices are called by numbers. */
static int is_value(int64_t *value, const iris_camera_control *menu, const char *text)
{
    int32_t count = choices_of(menu);
    int named_by_words = 1;
    for (int32_t i = 0; i < count; i++) {
        named_by_words &= !read_whole(value, choices[i].name);
    }
    return named_by_words && read_whole(value, text);
}

/* Complains where the text is no value; the status is IRIS_ERR_RANGE then, and *said is 1. */
static iris_status set_value(int *said, const iris_camera_control *control, const char *text)
{
    int64_t value;
    *said = 0;
    if (control->kind == IRIS_CONTROL_MENU) {
        iris_status status = iris_camera_control_choose(&controls, control->name, text);
        if (status != IRIS_ERR_RANGE || !is_value(&value, control, text)) {
            return status;
        }
    } else if (!read_value(&value, control, text)) {
        *said = 1;
        return IRIS_ERR_RANGE;
    }
    return iris_camera_control_set(&controls, control->name, value);
}

/* Returns an exit code after complaining. */
static int set(const char *name, const char *text, int json)
{
    iris_camera_control control;
    int said = 0;
    iris_status status = iris_camera_control_get(&control, &controls, name);
    if (status == IRIS_OK) {
        status = set_value(&said, &control, text);
    }
    if (status == IRIS_OK) {
        status = iris_camera_control_get(&control, &controls, name);
    }
    if (status != IRIS_OK) {
        if (!said) {
            complain(name, "%s", iris_camera_controls_problem(&controls));
        }
        return status == IRIS_ERR_RANGE ? EXIT_BAD_CALL : EXIT_BAD_DATA;
    }
    json ? json_control(&control) : print_control(&control);
    return EXIT_DONE;
}

int camera_tables_set(const char *device, int count, char **words, int json)
{
    int exit_code = open_controls(device);
    if (exit_code != EXIT_DONE) {
        return exit_code;
    }
    for (int i = 0; i < count && exit_code == EXIT_DONE; i++) {
        char *equals = strchr(words[i], '=');
        *equals = '\0';
        exit_code = set(words[i], equals + 1, json);
    }
    iris_camera_controls_close(&controls);
    return exit_code;
}
