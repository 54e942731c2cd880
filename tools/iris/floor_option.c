#include "floor_option.h"

#include "floor_file.h"

int floor_option_read(floor_option *by, const char *path, operation_words *words)
{
    by->used = path != NULL;
    if (by->used && !floor_file_read(&by->floor, path)) {
        words->exit_code = EXIT_BAD_DATA;
        return 0;
    }
    return 1;
}

int floor_option_fits(const floor_option *by, const operation_stage *stage)
{
    return !by->used || floor_fits(&by->floor, stage->file, stage_size(stage));
}

void floor_json_mm(json_writer *json, const char *key, int exists, iris_q16 mm)
{
    json_key(json, key);
    exists ? json_number(json, mm / 65536.0, 1) : json_null(json);
}

static double degrees(iris_angle angle)
{
    return iris_angle_to_centidegrees(angle) / 100.0;
}

void floor_option_json_line(json_writer *json, const floor_option *by, iris_place a, iris_place b)
{
    iris_place near = {0, 0}, far = {0, 0};
    iris_floor_line line = {{0, 0}, {0, 0}, 0, 0};
    if (!by->used) {
        return;
    }
    int has_near = iris_floor_point(&near, &by->floor, a) == IRIS_OK;
    int has_far = iris_floor_point(&far, &by->floor, b) == IRIS_OK;
    int whole = iris_floor_segment(&line, &by->floor, a, b) == IRIS_OK;
    floor_json_mm(json, "x0_mm", has_near, near.x_q16);
    floor_json_mm(json, "y0_mm", has_near, near.y_q16);
    floor_json_mm(json, "x1_mm", has_far, far.x_q16);
    floor_json_mm(json, "y1_mm", has_far, far.y_q16);
    floor_json_mm(json, "length_mm", whole, line.length_q16);
    json_key(json, "true_deg");
    whole ? json_number(json, degrees(line.angle), 2) : json_null(json);
}

void floor_option_print_line(FILE *out, const floor_option *by, iris_place a, iris_place b)
{
    iris_floor_line line;
    if (!by->used) {
        return;
    }
    if (iris_floor_segment(&line, &by->floor, a, b) != IRIS_OK) {
        fputs(", on the floor not wholly in sight", out);
        return;
    }
    fprintf(out, ", on the floor %.0f,%.0f to %.0f,%.0f mm, length %.0f mm, angle %+.1f",
            line.a.x_q16 / 65536.0, line.a.y_q16 / 65536.0, line.b.x_q16 / 65536.0, line.b.y_q16 / 65536.0,
            line.length_q16 / 65536.0, degrees(line.angle));
}
