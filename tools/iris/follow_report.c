#include "follow_report.h"

#include <stdio.h>
#include <string.h>

#include "json.h"
#include "one_line.h"

const char *follow_state_name(iris_line_state state)
{
    return state == IRIS_LINE_FOUND ? "found" : state == IRIS_LINE_STALE ? "stale" : "lost";
}

iris_span follow_row(const follow_answer *answer, int32_t y)
{
    const iris_span none = {1, 0};
    return answer->line.rows && y < answer->size.h ? answer->line.rows[y] : none;
}

static double degrees(iris_angle angle)
{
    return iris_angle_to_centidegrees(angle) / 100.0;
}

/* The rows to report: those asked for, else the look-ahead row, the middle, and the bottom. */
static int rows_of(int32_t chosen[3], const int32_t **rows, const follow_answer *answer,
                   const follow_options *options)
{
    if (options->row_count > 0) {
        *rows = options->rows;
        return options->row_count;
    }
    chosen[0] = (answer->size.h - 1) * options->line.lookahead_permil / 1000;
    chosen[1] = answer->size.h / 2;
    chosen[2] = answer->size.h - 1;
    *rows = chosen;
    return 3;
}

static void json_value(json_writer *json, const char *key, int exists, double value, int decimals)
{
    json_key(json, key);
    exists ? json_number(json, value, decimals) : json_null(json);
}

static void json_rows(json_writer *json, const follow_answer *answer, const follow_options *options)
{
    int32_t chosen[3];
    const int32_t *rows;
    int count = rows_of(chosen, &rows, answer, options);
    json_key(json, "rows");
    json_open(json, '[');
    for (int i = 0; i < count; i++) {
        iris_span span = follow_row(answer, rows[i]);
        int exists = span.left <= span.right;
        json_open(json, '{');
        json_key(json, "y");
        json_integer(json, rows[i]);
        json_value(json, "left", exists, span.left, 0);
        json_value(json, "right", exists, span.right, 0);
        json_value(json, "center", exists, (span.left + span.right) / 2.0, 1);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void json_segments(json_writer *json, const iris_follow_result *line)
{
    json_key(json, "segments");
    if (line->state == IRIS_LINE_LOST) {
        json_null(json);
        return;
    }
    json_open(json, '[');
    for (int32_t i = 0; i < line->segment_count; i++) {
        const iris_segment *segment = &line->segments[i];
        const int32_t values[] = {segment->x0, segment->y0, segment->x1, segment->y1};
        const char *const keys[] = {"x0", "y0", "x1", "y1"};
        json_open(json, '{');
        for (int k = 0; k < 4; k++) {
            json_key(json, keys[k]);
            json_integer(json, values[k]);
        }
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void print_json(const follow_answer *answer, const follow_options *options)
{
    const iris_follow_result *line = &answer->line;
    int exists = line->state != IRIS_LINE_LOST;
    json_writer json = json_to(stdout);
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, answer->file);
    json_key(&json, "frame");
    json_integer(&json, answer->frame);
    json_key(&json, "state");
    json_string(&json, follow_state_name(line->state));
    json_value(&json, "angle_deg", exists, degrees(line->angle), 2);
    json_value(&json, "offset", exists, line->offset_q16 / 65536.0, 4);
    json_value(&json, "lookahead_offset", exists, line->lookahead_offset_q16 / 65536.0, 4);
    json_value(&json, "next_angle_deg", exists && line->has_next, degrees(line->next_angle), 2);
    json_value(&json, "width_px", exists, line->width_px, 0);
    json_value(&json, "confidence", exists, line->confidence_permil / 1000.0, 3);
    json_value(&json, "steer", 1, answer->command.steer_permil / 1000.0, 3);
    json_value(&json, "steer_deg", 1, answer->wheel_centideg / 100.0, 2);
    json_value(&json, "speed", 1, answer->command.speed_permil / 1000.0, 3);
    follow_junctions_json(&json, &answer->junctions, &options->floor);
    follow_floor_json(&json, &answer->goal, line, &options->floor);
    json_rows(&json, answer, options);
    json_segments(&json, line);
    json_close(&json, '}');
}

static void print_rows(const follow_answer *answer, const follow_options *options)
{
    for (int i = 0; i < options->row_count; i++) {
        iris_span span = follow_row(answer, options->rows[i]);
        if (span.left <= span.right) {
            printf("  %d:%4d-%-4d", (int)options->rows[i], span.left, span.right);
        } else {
            printf("  %d:    -    ", (int)options->rows[i]);
        }
    }
}

static void print_text(const follow_answer *answer, const follow_options *options, int name_width)
{
    const iris_follow_result *line = &answer->line;
    int padding = name_width - (int)strlen(answer->file);
    printf("%5lld ", (long long)answer->frame);
    one_line(stdout, answer->file);
    printf("%*s  %-5s", padding > 0 ? padding : 0, "", follow_state_name(line->state));
    if (line->state == IRIS_LINE_LOST) {
        printf("  angle     -  next     -  offset     -  ahead     -  width    -  confidence    -");
    } else {
        char next[16] = "    -";
        if (line->has_next) {
            snprintf(next, sizeof next, "%+5.1f", degrees(line->next_angle));
        }
        printf("  angle %+5.1f  next %s  offset %+5.2f  ahead %+5.2f  width %4d  confidence %4.2f",
               degrees(line->angle), next, line->offset_q16 / 65536.0, line->lookahead_offset_q16 / 65536.0,
               (int)line->width_px, line->confidence_permil / 1000.0);
    }
    printf("  steer %+5.2f %+5.1f deg  speed %4.2f", answer->command.steer_permil / 1000.0,
           answer->wheel_centideg / 100.0, answer->command.speed_permil / 1000.0);
    follow_junctions_print(&answer->junctions, &options->floor);
    follow_floor_print(&answer->goal, &options->floor);
    print_rows(answer, options);
    putchar('\n');
    fflush(stdout);
}

void follow_report(const follow_answer *answer, const follow_options *options, int name_width)
{
    if (options->json) {
        print_json(answer, options);
    } else {
        print_text(answer, options, name_width);
    }
}
