#include "capture_output.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "camera.h"
#include "complain.h"
#include "file_write.h"
#include "frame_picture.h"
#include "iris/pnm.h"
#include "json.h"
#include "one_line.h"
#include "picture_write.h"

/* A frame's colors, where a file does not hold it as it is. */
static picture_buffer colors;

/* Frames that were written. */
static uint64_t frames_written;

static int write_rows(FILE *file, const iris_image *image)
{
    size_t bytes = iris_format_row_bytes(image->format, image->w);
    int done = 1;
    for (int32_t y = 0; y < image->h && done; y++) {
        done = fwrite(iris_image_row(image, y), 1, bytes, file) == bytes;
    }
    return done;
}

/* Of file_writer. */
static int write_raw(FILE *file, const void *user)
{
    const iris_frame *frame = user;
    return write_rows(file, &frame->image) && (!frame->chroma.data || write_rows(file, &frame->chroma)) &&
           fflush(file) == 0;
}

static int write_pnm(FILE *file, const void *user)
{
    return iris_pnm_write((iris_sink){file_write_bytes, file}, user) == IRIS_OK && fflush(file) == 0;
}

static void report(const iris_frame *frame, const char *path)
{
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "frame");
    json_integer(&json, (int64_t)frame->sequence + 1);
    json_key(&json, "time_us");
    json_integer(&json, frame->time_us);
    json_key(&json, "file");
    json_string(&json, path);
    json_close(&json, '}');
}

int capture_output_write(const capture_output *output, const iris_frame *frame)
{
    int to_stdout = strcmp(output->folder, "-") == 0, done;
    char path[PATH_MAX] = "-";
    iris_image view;
    if (!to_stdout &&
        snprintf(path, sizeof path, "%s/frame_%06llu.%s", output->folder,
                 (unsigned long long)frame->sequence + 1, output->raw ? "raw" : "bmp") >= (int)sizeof path) {
        complain(output->folder, "the name is too long");
        return EXIT_BAD_DATA;
    }
    if (output->raw) {
        done = file_write(path, write_raw, frame);
    } else {
        iris_status status = frame_picture(&view, &colors, frame);
        if (status != IRIS_OK) {
            complain(path, "%s", picture_problem(status, (iris_size){frame->image.w, frame->image.h}));
            return EXIT_BAD_DATA;
        }
        done = to_stdout ? file_write(path, write_pnm, &view) : picture_write(path, &view);
    }
    frames_written += (uint64_t)done;
    if (done && output->json) {
        report(frame, path);
    }
    return done ? EXIT_DONE : EXIT_BAD_DATA;
}

static const char *matrix_name(iris_color_matrix matrix)
{
    static const char *const names[] = {NULL, "bt601", "bt709", "bt2020"};
    return names[matrix];
}

static void json_granted(json_writer *json, const iris_capture_grant *granted)
{
    static const char *const ranges[] = {NULL, "limited", "full"};
    json_key(json, "granted");
    json_open(json, '{');
    json_key(json, "w");
    json_integer(json, granted->size.w);
    json_key(json, "h");
    json_integer(json, granted->size.h);
    json_key(json, "format");
    json_string(json, camera_format_name(granted->format));
    json_key(json, "stride");
    json_integer(json, granted->stride);
    json_key(json, "rate");
    granted->rate_millihz > 0 ? json_number(json, granted->rate_millihz / 1000.0, 3) : json_null(json);
    json_key(json, "matrix");
    json_string(json, matrix_name(granted->matrix));
    json_key(json, "range");
    json_string(json, ranges[granted->range]);
    json_close(json, '}');
}

void capture_output_end(const capture_output *output, const char *device, const iris_capture *capture)
{
    const iris_capture_grant *granted = &capture->granted;
    const struct {
        const char *name;
        uint64_t count;
    } counters[] = {{"frames", frames_written},      {"dropped", capture->dropped},
                    {"skipped", capture->skipped},   {"damaged", capture->damaged},
                    {"restarts", capture->restarts}, {"returns", capture->returns}};
    const size_t counter_count = sizeof counters / sizeof counters[0];
    if (output->json) {
        json_writer json = json_to(stdout);
        json_open(&json, '{');
        json_granted(&json, granted);
        for (size_t i = 0; i < counter_count; i++) {
            json_key(&json, counters[i].name);
            json_integer(&json, (int64_t)counters[i].count);
        }
        json_close(&json, '}');
        return;
    }
    if (frames_written == 0) {
        return;
    }
    one_line(stdout, device);
    printf("  %dx%d %s", (int)granted->size.w, (int)granted->size.h, camera_format_name(granted->format));
    if (granted->rate_millihz > 0) {
        printf(" at %g", granted->rate_millihz / 1000.0);
    }
    for (size_t i = 0; i < counter_count; i++) {
        printf("%s%llu %s", i == 0 ? "  " : ", ", (unsigned long long)counters[i].count, counters[i].name);
    }
    putchar('\n');
}

void capture_output_free(void)
{
    picture_free(&colors);
}
