/* iris cameras: devices with their formats, sizes, and rates. */
#include "../camera_tables.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../camera.h"
#include "../complain.h"
#include "../json.h"
#include "../one_line.h"
#include "iris/camera_list.h"
#include "iris/libcamera.h"

#define CAMERAS 64
#define FORMATS 64
#define SIZES   64
#define RATES   32
#define MODES   256 /* of libcamera: sizes of all formats */

static int32_t least(int32_t count, int32_t capacity)
{
    return count < capacity ? count : capacity;
}

static void json_size(json_writer *json, const char *w, const char *h, iris_size size)
{
    json_key(json, w);
    json_integer(json, size.w);
    json_key(json, h);
    json_integer(json, size.h);
}

static void json_rates(json_writer *json, const iris_camera_rates *rates, int32_t count)
{
    json_key(json, "rates");
    json_open(json, '[');
    for (int32_t i = 0; i < count; i++) {
        json_number(json, rates[i].least_millihz / 1000.0, 3);
        if (rates[i].most_millihz != rates[i].least_millihz) { /* a range: both ends, one behind the other */
            json_number(json, rates[i].most_millihz / 1000.0, 3);
        }
    }
    json_close(json, ']');
}

static int is_single(const iris_camera_sizes *sizes)
{
    return sizes->least.w == sizes->most.w && sizes->least.h == sizes->most.h;
}

static void json_one_size(json_writer *json, const iris_camera_sizes *sizes, const iris_camera_rates *rates,
                          int32_t rate_count)
{
    json_open(json, '{');
    json_size(json, "w", "h", sizes->most);
    if (!is_single(sizes)) {
        json_size(json, "least_w", "least_h", sizes->least);
        json_size(json, "step_w", "step_h", sizes->step);
    }
    json_rates(json, rates, rate_count);
    json_close(json, '}');
}

static void json_sizes(json_writer *json, const char *path, const char *fourcc)
{
    iris_camera_sizes sizes[SIZES];
    iris_camera_rates rates[RATES];
    int32_t count = 0, rate_count = 0;
    (void)iris_camera_list_sizes(sizes, &count, path, fourcc, SIZES);
    for (int32_t i = 0; i < least(count, SIZES); i++) {
        rate_count = 0;
        (void)iris_camera_list_rates(rates, &rate_count, path, fourcc, sizes[i].most, RATES);
        json_one_size(json, &sizes[i], rates, least(rate_count, RATES));
    }
}

/* The head of a format, with its list of sizes open. */
static void json_format(json_writer *json, const char *fourcc, int32_t format, const char *description)
{
    json_open(json, '{');
    json_key(json, "fourcc");
    json_string(json, fourcc);
    json_key(json, "format");
    json_string(json, format ? camera_format_name(format) : NULL);
    json_key(json, "description");
    json_string(json, description);
    json_key(json, "sizes");
    json_open(json, '[');
}

/* The head of a camera, with its list of formats open. */
static void json_head(json_writer *json, const char *device, const char *const texts[4])
{
    static const char *const keys[] = {"name", "driver", "bus", "problem"};
    json_open(json, '{');
    json_key(json, "device");
    json_string(json, device);
    for (int i = 0; i < 4; i++) {
        json_key(json, keys[i]);
        json_string(json, texts[i]);
    }
    json_key(json, "formats");
    json_open(json, '[');
}

static void json_camera(const iris_camera *camera)
{
    static iris_camera_format formats[FORMATS];
    int32_t count = 0;
    json_writer json = json_to(stdout);
    if (!camera->problem) {
        (void)iris_camera_list_formats(formats, &count, camera->path, FORMATS);
    }
    const int good = !camera->problem;
    json_head(&json, camera->path,
              (const char *const[]){good ? camera->card : NULL, good ? camera->driver : NULL,
                                    good ? camera->bus : NULL, camera->problem});
    for (int32_t i = 0; i < least(count, FORMATS); i++) {
        json_format(&json, formats[i].fourcc, formats[i].format, formats[i].description);
        json_sizes(&json, camera->path, formats[i].fourcc);
        json_close(&json, ']');
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_one_size(const iris_camera_sizes *s)
{
    printf("      %dx%d", (int)s->least.w, (int)s->least.h);
    if (!is_single(s)) {
        printf(" to %dx%d in steps of %dx%d", (int)s->most.w, (int)s->most.h, (int)s->step.w, (int)s->step.h);
    }
}

static void print_format(const char *fourcc, int32_t format, const char *description)
{
    const char *name = format ? camera_format_name(format) : "not read";
    description ? printf("  %-6s  %-12s  %s\n", fourcc, name, description)
                : printf("  %-6s  %s\n", fourcc, name);
}

static void print_sizes(const char *path, const char *fourcc)
{
    iris_camera_sizes sizes[SIZES];
    iris_camera_rates rates[RATES];
    int32_t count = 0, rate_count = 0;
    (void)iris_camera_list_sizes(sizes, &count, path, fourcc, SIZES);
    for (int32_t i = 0; i < least(count, SIZES); i++) {
        const iris_camera_sizes *s = &sizes[i];
        rate_count = 0;
        (void)iris_camera_list_rates(rates, &rate_count, path, fourcc, s->most, RATES);
        print_one_size(s);
        for (int32_t k = 0; k < least(rate_count, RATES); k++) {
            printf("%s%.4g", k == 0 ? "  at " : ", ", rates[k].least_millihz / 1000.0);
            if (rates[k].most_millihz != rates[k].least_millihz) {
                printf(" to %.4g", rates[k].most_millihz / 1000.0);
            }
        }
        putchar('\n');
    }
}

static void print_camera(const iris_camera *camera)
{
    static iris_camera_format formats[FORMATS];
    int32_t count = 0;
    printf("%s  ", camera->path);
    if (camera->problem) {
        printf("%s\n", camera->problem);
        return;
    }
    printf("%s (%s, %s)\n", camera->card, camera->driver, camera->bus);
    (void)iris_camera_list_formats(formats, &count, camera->path, FORMATS);
    for (int32_t i = 0; i < least(count, FORMATS); i++) {
        print_format(formats[i].fourcc, formats[i].format, formats[i].description);
        print_sizes(camera->path, formats[i].fourcc);
    }
}

/* Is this another format than that of the mode before? */
static int begins_format(const iris_libcamera_mode *modes, int32_t i)
{
    return i == 0 || strcmp(modes[i].name, modes[i - 1].name) != 0;
}

static void json_libcamera(const char *device, const char *model, const iris_libcamera_mode *modes,
                           int32_t count)
{
    json_writer json = json_to(stdout);
    json_head(&json, device, (const char *const[]){model, "libcamera", NULL, NULL});
    for (int32_t i = 0; i < count; i++) {
        const iris_camera_sizes sizes = {modes[i].least, modes[i].most, modes[i].step};
        if (begins_format(modes, i)) {
            json_format(&json, modes[i].name, modes[i].format, NULL);
        }
        json_one_size(&json, &sizes, NULL, 0);
        if (i + 1 == count || begins_format(modes, i + 1)) {
            json_close(&json, ']');
            json_close(&json, '}');
        }
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_libcamera(const char *device, const char *model, const iris_libcamera_mode *modes,
                            int32_t count)
{
    one_line(stdout, device);
    printf("  %s (libcamera)\n", model);
    for (int32_t i = 0; i < count; i++) {
        const iris_camera_sizes sizes = {modes[i].least, modes[i].most, modes[i].step};
        if (begins_format(modes, i)) {
            print_format(modes[i].name, modes[i].format, NULL);
        }
        print_one_size(&sizes);
        putchar('\n');
    }
}

/* Cameras behind libcamera, by which Raspberry Pis have theirs. Returns how many. */
static int32_t list_libcamera(int json)
{
    static iris_libcamera_info cameras[16];
    static iris_libcamera_mode modes[MODES];
    int32_t count = 0;
    camera_quiet_libcamera();
    (void)iris_libcamera_list(cameras, &count, 16);
    for (int32_t i = 0; i < least(count, 16); i++) {
        char device[CAMERA_LIBCAMERA_BYTES];
        snprintf(device, sizeof device, CAMERA_LIBCAMERA "%.255s", cameras[i].id);
        int32_t mode_count = 0;
        (void)iris_libcamera_list_modes(modes, &mode_count, cameras[i].id, MODES);
        (json ? json_libcamera : print_libcamera)(device, cameras[i].model, modes, least(mode_count, MODES));
    }
    return count;
}

int camera_tables_cameras(int json)
{
    static iris_camera cameras[CAMERAS];
    int32_t count = 0;
    (void)iris_camera_list(cameras, &count, CAMERAS);
    for (int32_t i = 0; i < least(count, CAMERAS); i++) {
        json ? json_camera(&cameras[i]) : print_camera(&cameras[i]);
    }
    if (count + list_libcamera(json) == 0) {
        complain(NULL, "no camera is there (neither /dev/video* nor libcamera's)");
        return EXIT_BAD_DATA;
    }
    return EXIT_DONE;
}
