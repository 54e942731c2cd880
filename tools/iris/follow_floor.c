#include "follow_floor.h"

#include <stdio.h>

#include "args.h"
#include "complain.h"
#include "floor_file.h"
#include "floor_option.h"

static int read_mm(int32_t *mm, const char *option, const char *text, int32_t low, int32_t high)
{
    if (text && (!args_numbers(mm, 1, ',', text) || *mm < low || *mm > high)) {
        complain(option, "%d to %d millimeters, not '%s'", (int)low, (int)high, text);
        return 0;
    }
    return 1;
}

int follow_floor_read(follow_floor *by, const follow_floor_texts *texts)
{
    iris_pursuit_defaults(&by->config);
    by->used = texts->floor != NULL;
    if (!by->used) {
        const char *given = texts->lookahead ? "--lookahead"
                            : texts->radius  ? "--radius"
                            : texts->axle    ? "--axle"
                                             : NULL;
        if (given) {
            complain(given, "only together with --floor");
        }
        return given ? EXIT_BAD_CALL : EXIT_DONE;
    }
    if (!read_mm(&by->config.lookahead_mm, "--lookahead", texts->lookahead, 10, 10000) ||
        !read_mm(&by->config.radius_mm, "--radius", texts->radius, 1, 100000) ||
        !read_mm(&by->config.axle_mm, "--axle", texts->axle, -10000, 10000)) {
        return EXIT_BAD_CALL;
    }
    return floor_file_read(&by->floor, texts->floor) ? EXIT_DONE : EXIT_BAD_DATA;
}

void follow_floor_steer(iris_command *command, iris_pursuit_goal *goal, iris_steer *steer,
                        const iris_follow_result *line, const follow_floor *by, int32_t elapsed_ms)
{
    const iris_pursuit pursuit = {&by->floor, &by->config};
    *goal = (iris_pursuit_goal){0};
    if (by->used) {
        iris_pursuit_update(command, goal, steer, line, &pursuit, elapsed_ms);
    } else {
        iris_steer_update(command, steer, line, elapsed_ms);
    }
}

static double mm_of(iris_q16 value)
{
    return value / 65536.0;
}

static double degrees(iris_angle angle)
{
    return iris_angle_to_centidegrees(angle) / 100.0;
}

static void json_piece(json_writer *json, const iris_segment *segment, const iris_floor *floor)
{
    iris_floor_line piece;
    if (iris_floor_segment(&piece, floor, iris_place_of(segment->x0, segment->y0),
                           iris_place_of(segment->x1, segment->y1)) != IRIS_OK) {
        json_null(json);
        return;
    }
    json_open(json, '{');
    floor_json_mm(json, "x0", 1, piece.a.x_q16);
    floor_json_mm(json, "y0", 1, piece.a.y_q16);
    floor_json_mm(json, "x1", 1, piece.b.x_q16);
    floor_json_mm(json, "y1", 1, piece.b.y_q16);
    json_key(json, "angle_deg");
    json_number(json, degrees(piece.angle), 2);
    json_close(json, '}');
}

void follow_floor_json(json_writer *json, const iris_pursuit_goal *goal, const iris_follow_result *line,
                       const follow_floor *by)
{
    if (!by->used) {
        return;
    }
    floor_json_mm(json, "offset_mm", goal->found, goal->offset_q16);
    floor_json_mm(json, "distance_mm", goal->found, goal->distance_q16);
    json_key(json, "heading_deg");
    goal->found ? json_number(json, degrees(goal->heading), 2) : json_null(json);
    json_key(json, "segments_mm");
    if (line->state == IRIS_LINE_LOST) {
        json_null(json);
        return;
    }
    json_open(json, '[');
    for (int32_t i = 0; i < line->segment_count; i++) {
        json_piece(json, &line->segments[i], &by->floor);
    }
    json_close(json, ']');
}

void follow_floor_json_junction(json_writer *json, const iris_junction *junction, const follow_floor *by)
{
    iris_place mm = {0, 0}, at = {junction->x_q4 * 4096, junction->y_q4 * 4096};
    if (!by->used) {
        return;
    }
    int exists = iris_floor_point(&mm, &by->floor, at) == IRIS_OK;
    floor_json_mm(json, "x_mm", exists, mm.x_q16);
    floor_json_mm(json, "y_mm", exists, mm.y_q16);
    json_key(json, "branches_true_deg");
    if (!exists) {
        json_null(json);
        return;
    }
    json_open(json, '[');
    for (int32_t i = 0; i < junction->branch_count; i++) {
        iris_angle angle = 0;
        (void)iris_floor_angle(&angle, &by->floor, at, junction->branches[i]);
        json_number(json, degrees(angle), 1);
    }
    json_close(json, ']');
}

void follow_floor_print_junction(const iris_junction *junction, const follow_floor *by)
{
    iris_place mm, at = {junction->x_q4 * 4096, junction->y_q4 * 4096};
    if (!by->used || iris_floor_point(&mm, &by->floor, at) != IRIS_OK) {
        return;
    }
    printf(" (%.0f,%.0f mm", mm_of(mm.x_q16), mm_of(mm.y_q16));
    for (int32_t i = 0; i < junction->branch_count; i++) {
        iris_angle angle = 0;
        (void)iris_floor_angle(&angle, &by->floor, at, junction->branches[i]);
        printf("%s%+.0f", i == 0 ? " " : "/", degrees(angle));
    }
    putchar(')');
}

void follow_floor_print(const iris_pursuit_goal *goal, const follow_floor *by)
{
    if (by->used && goal->found) {
        printf("  at %4.0f mm %+5.0f mm  heading %+6.1f", mm_of(goal->distance_q16), mm_of(goal->offset_q16),
               degrees(goal->heading));
    } else if (by->used) {
        printf("  at    - mm     - mm  heading      -");
    }
}
