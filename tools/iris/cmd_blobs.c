#include <math.h>
#include <string.h>

#include "canvas.h"
#include "commands.h"
#include "floor_option.h"
#include "iris/xt/blob.h"
#include "operation.h"

static const char help[] =
    "usage: iris blobs [--connectivity 4|8] [--min-area N] [--max-area N] [--count N] [FILTER...]\n"
    "                  [--floor FLOOR] [--roi x,y,w,h] [--json] IN... [-o OUT]\n\n"
    "The connected white parts of a mask, the largest first: place, size, direction, shape, and mean color.\n"
    "Gray and color pictures count as white above 127.\n\n"
    "  --connectivity N  8: pixels that touch by a corner belong together (the default), 4: by a side only\n"
    "  --min-area N      no blobs of fewer pixels (without it, every pixel counts)\n"
    "  --max-area N      no blobs of more pixels\n"
    "  --count N         the N largest only; count in the JSON stays that of all\n"
    "  --width A-B       only blobs whose box is A to B pixels wide; --height the same; one number: exactly "
    "so\n"
    "  --fill A-B        only blobs that cover A to B permil of their box\n"
    "  --elongation A-B  only blobs A to B times as long as they are broad, such as 2.5-100\n"
    "  --holes A-B       only blobs with A to B holes\n"
    "  --inside          only blobs that do not touch the picture's edge\n"
    "  --center x,y,w,h  only blobs whose center is in this part\n" FLOOR_OPTION_HELP OPERATION_OPTIONS "\n"
    "JSON has count and blobs: id (from 1), x, y, w, h (the box), cx, cy (the center of gravity), area,\n"
    "angle_deg (of the long axis: 0 straight up, positive when it leans right), elongation, length,\n"
    "breadth (of the rectangle with the same moments), perimeter, edges (pixel sides around it), holes,\n"
    "and mean (a number for gray, [r,g,b] for color). With --floor also x_mm, y_mm: where it stands, the\n"
    "middle of its box's lower edge; null beyond the horizon. With -o a picture with boxes, centers, and "
    "axes.\n\n"
    "example: iris blobs --min-area 50 parts.bmp -o found.bmp\n";

typedef struct {
    iris_blob_config config;
    int32_t most; /* of --count */
    floor_option floor;
} settings;

/* What apply leaves for report; the blobs lie behind it. */
typedef struct {
    iris_blob_table table;
    iris_format format; /* of the means; IRIS_MASK1: there are none */
} finding;

static int32_t shown(const finding *found)
{
    return found->table.count < found->table.capacity ? found->table.count : found->table.capacity;
}

/* As the settings say, but places count from the part worked on. */
static iris_blob_config config_of(const operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_blob_config config = by->config;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    config.filter.center_in.x -= x;
    config.filter.center_in.y -= y;
    return config;
}

/* How many blobs there are, at most those of --count; negative after complaining. */
static int32_t room_for(const iris_image *mask, operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_blob_config config = config_of(stage);
    iris_blob_table none = {NULL, 0, 0};
    iris_scratch *scratch = stage_scratch(stage, IRIS_BLOB_SCRATCH_BYTES(mask->w, 0));
    if (!scratch) {
        return -1;
    }
    iris_status status = iris_blobs(&none, mask, NULL, &config, scratch);
    if (status != IRIS_ERR_FULL && stage_exit(stage, status) != EXIT_DONE) {
        return -1;
    }
    return none.count < by->most ? none.count : by->most;
}

/* picture: for the means, null: none. */
static finding *find(const iris_image *mask, const iris_image *picture, operation_stage *stage)
{
    iris_blob_config config = config_of(stage);
    int32_t room = room_for(mask, stage);
    finding *found =
        room < 0 ? NULL : stage_room(stage, sizeof *found + (size_t)room * sizeof *found->table.blobs);
    iris_scratch *scratch = found ? stage_scratch(stage, IRIS_BLOB_SCRATCH_BYTES(mask->w, room) +
                                                             IRIS_BLOB_COLOR_SCRATCH_BYTES(mask->w))
                                  : NULL;
    if (!scratch) {
        return NULL;
    }
    found->table = (iris_blob_table){(iris_blob *)(found + 1), room, 0};
    found->format = picture ? picture->format : IRIS_MASK1;
    iris_status status = iris_blobs(&found->table, mask, picture, &config, scratch);
    if (status != IRIS_ERR_FULL && stage_exit(stage, status) != EXIT_DONE) {
        return NULL;
    }
    stage->finding = found;
    return found;
}

static iris_blob_shape shape_of(const iris_blob *blob)
{
    iris_blob_shape shape = {0, 0, 0, 0, 0};
    (void)iris_blob_shape_of(&shape, blob);
    return shape;
}

static void draw(const iris_image *color, const finding *found)
{
    canvas c = canvas_plain(color);
    for (int32_t i = shown(found) - 1; i >= 0; i--) {
        const iris_blob *blob = &found->table.blobs[i];
        iris_blob_shape shape = shape_of(blob);
        double x = blob->x_q16 / 65536.0, y = blob->y_q16 / 65536.0, half = shape.length_q16 / 131072.0;
        double turn = shape.angle * (3.14159265358979 / 32768);
        double dx = half * sin(turn), dy = -half * cos(turn);
        canvas_rect(&c, blob->box, canvas_color(i));
        if (blob->area > 1) {
            canvas_line(&c, (canvas_point){x - dx, y - dy}, (canvas_point){x + dx, y + dy}, canvas_color(i));
            canvas_cross(&c, (canvas_point){x, y}, 3, canvas_color(i));
        }
    }
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const settings *by = stage->settings;
    if (!floor_option_fits(&by->floor, stage)) {
        return EXIT_BAD_DATA;
    }
    const iris_image *mask = stage_mask(stage, input);
    const iris_image *picture = mask && input->format != IRIS_MASK1 ? stage_levels(stage, input) : NULL;
    const iris_image *color = mask ? stage_color(stage, input) : NULL;
    const iris_image *overlay = color ? stage_copy(stage, color) : NULL;
    finding *found = overlay ? find(mask, picture, stage) : NULL;
    if (!found) {
        return EXIT_BAD_DATA;
    }
    draw(overlay, found);
    *result = *overlay;
    return EXIT_DONE;
}

static void report_integer(json_writer *json, const char *key, int64_t number)
{
    json_key(json, key);
    json_integer(json, number);
}

static void report_number(json_writer *json, const char *key, double number)
{
    json_key(json, key);
    json_number(json, number, 2);
}

static void report_mean(json_writer *json, iris_color mean, iris_format format)
{
    if (format == IRIS_MASK1) {
        return;
    }
    json_key(json, "mean");
    if (format == IRIS_GRAY8) {
        json_integer(json, mean.g);
        return;
    }
    json_open(json, '[');
    json_integer(json, mean.r);
    json_integer(json, mean.g);
    json_integer(json, mean.b);
    json_close(json, ']');
}

/* Where the blob stands on the floor; 0: there is no floor, or not there. */
static int foot_of(iris_place *mm, const iris_blob *blob, const operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_rect box = blob->box;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    box.x += x;
    box.y += y;
    *mm = (iris_place){0, 0};
    return by->floor.used && iris_floor_foot(mm, &by->floor.floor, box) == IRIS_OK;
}

static void report_foot(json_writer *json, const iris_blob *blob, const operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_place mm;
    int stands = foot_of(&mm, blob, stage);
    if (by->floor.used) {
        floor_json_mm(json, "x_mm", stands, mm.x_q16);
        floor_json_mm(json, "y_mm", stands, mm.y_q16);
    }
}

static void report(json_writer *json, const operation_stage *stage)
{
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    report_integer(json, "count", found->table.count);
    json_key(json, "blobs");
    json_open(json, '[');
    for (int32_t i = 0; i < shown(found); i++) {
        const iris_blob *blob = &found->table.blobs[i];
        iris_blob_shape shape = shape_of(blob);
        json_open(json, '{');
        report_integer(json, "id", i + 1);
        report_integer(json, "x", x + blob->box.x);
        report_integer(json, "y", y + blob->box.y);
        report_integer(json, "w", blob->box.w);
        report_integer(json, "h", blob->box.h);
        report_number(json, "cx", x + blob->x_q16 / 65536.0);
        report_number(json, "cy", y + blob->y_q16 / 65536.0);
        report_integer(json, "area", blob->area);
        report_number(json, "angle_deg", shape.angle * (360 / 65536.0));
        report_number(json, "elongation", shape.elongation_q16 / 65536.0);
        report_number(json, "length", shape.length_q16 / 65536.0);
        report_number(json, "breadth", shape.breadth_q16 / 65536.0);
        report_number(json, "perimeter", shape.perimeter_q16 / 65536.0);
        report_integer(json, "edges", blob->edges);
        report_integer(json, "holes", blob->holes);
        report_mean(json, blob->mean, found->format);
        report_foot(json, blob, stage);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void print(FILE *out, const operation_stage *stage)
{
    const finding *found = stage->finding;
    int32_t x, y;
    stage_origin(&x, &y, stage);
    fprintf(out, "%s: %d blob%s\n", stage->file, (int)found->table.count, found->table.count == 1 ? "" : "s");
    for (int32_t i = 0; i < shown(found); i++) {
        const iris_blob *blob = &found->table.blobs[i];
        iris_blob_shape shape = shape_of(blob);
        fprintf(out,
                "  %d: area %d, center %.1f,%.1f, box %d,%d,%d,%d, angle %.1f, elongation %.2f, holes %d",
                (int)i + 1, (int)blob->area, x + blob->x_q16 / 65536.0, y + blob->y_q16 / 65536.0,
                (int)(x + blob->box.x), (int)(y + blob->box.y), (int)blob->box.w, (int)blob->box.h,
                shape.angle * (360 / 65536.0), shape.elongation_q16 / 65536.0, (int)blob->holes);
        iris_place mm;
        if (foot_of(&mm, blob, stage)) {
            fprintf(out, ", stands at %.0f,%.0f mm", mm.x_q16 / 65536.0, mm.y_q16 / 65536.0);
        }
        fputc('\n', out);
    }
}

/* "A-B", or "A" for A-A, of numbers that are not negative; text null: they stay. Returns 0 after complaining. */
static int read_range(int32_t *low, int32_t *high, const char *option, const char *text)
{
    int32_t read[2];
    if (!text) {
        return 1;
    }
    if (args_numbers(read, 1, '-', text)) {
        read[1] = read[0];
    } else if (!args_numbers(read, 2, '-', text)) {
        read[0] = -1;
    }
    if (read[0] < 0 || read[1] < read[0]) {
        complain(option, "a number or A-B, such as 10-50, not '%s'", text);
        return 0;
    }
    *low = read[0];
    *high = read[1];
    return 1;
}

/* The same with 16 fraction bits. */
static int read_range_q16(iris_q16 *low, iris_q16 *high, const char *option, const char *text)
{
    char first[32];
    const char *dash = text ? strchr(text, '-') : NULL;
    size_t length = dash ? (size_t)(dash - text) : 0;
    if (!text) {
        return 1;
    }
    if (!dash || length >= sizeof first) {
        complain(option, "A-B, such as 2.5-100, not '%s'", text);
        return 0;
    }
    memcpy(first, text, length);
    first[length] = 0;
    if (!args_q16(low, 0, INT32_MAX, first) || !args_q16(high, *low, INT32_MAX, dash + 1)) {
        complain(option, "A-B, such as 2.5-100, not '%s'", text);
        return 0;
    }
    return 1;
}

/* A number from `least` on; text null: it stays. Returns 0 after complaining. */
static int read_number(int32_t *number, int32_t least, const char *option, const char *text)
{
    int32_t read;
    if (!text) {
        return 1;
    }
    if (!args_numbers(&read, 1, ',', text) || read < least) {
        complain(option, "a number from %d on, not '%s'", (int)least, text);
        return 0;
    }
    *number = read;
    return 1;
}

/* What the options say, as text; null: not given. */
typedef struct {
    const char *connectivity, *min_area, *max_area, *count, *width, *height, *fill, *elongation, *holes,
        *center;
} texts;

static int read_texts(settings *by, const texts *given)
{
    iris_blob_filter *filter = &by->config.filter;
    if (given->connectivity && strcmp(given->connectivity, "4") != 0 &&
        strcmp(given->connectivity, "8") != 0) {
        complain("--connectivity", "4 or 8, not '%s'", given->connectivity);
        return 0;
    }
    by->config.connectivity = given->connectivity && given->connectivity[0] == '4' ? 4 : 8;
    return read_number(&filter->min_area, 0, "--min-area", given->min_area) &&
           read_number(&filter->max_area, 0, "--max-area", given->max_area) &&
           read_number(&by->most, 1, "--count", given->count) &&
           read_range(&filter->min_w, &filter->max_w, "--width", given->width) &&
           read_range(&filter->min_h, &filter->max_h, "--height", given->height) &&
           read_range(&filter->min_fill_permil, &filter->max_fill_permil, "--fill", given->fill) &&
           read_range(&filter->min_holes, &filter->max_holes, "--holes", given->holes) &&
           read_range_q16(&filter->min_elongation_q16, &filter->max_elongation_q16, "--elongation",
                          given->elongation) &&
           (!given->center || args_rect(&filter->center_in, "--center", given->center));
}

static int parse(void *memory, operation_words *words)
{
    settings *by = memory;
    texts given = {0};
    const char *floor = NULL;
    int inside = 0;
    const args_option options[] = {{"connectivity", 0, NULL, &given.connectivity},
                                   {"min-area", 0, NULL, &given.min_area},
                                   {"max-area", 0, NULL, &given.max_area},
                                   {"count", 0, NULL, &given.count},
                                   {"width", 0, NULL, &given.width},
                                   {"height", 0, NULL, &given.height},
                                   {"fill", 0, NULL, &given.fill},
                                   {"elongation", 0, NULL, &given.elongation},
                                   {"holes", 0, NULL, &given.holes},
                                   {"center", 0, NULL, &given.center},
                                   {"inside", 0, &inside, NULL},
                                   {"floor", 0, NULL, &floor}};
    iris_blob_defaults(&by->config);
    by->most = INT32_MAX;
    if (!operation_options(words, options, sizeof options / sizeof options[0]) || !read_texts(by, &given)) {
        return 0;
    }
    by->config.filter.inside = inside;
    return floor_option_read(&by->floor, floor, words);
}

const operation operation_blobs = {.name = "blobs",
                                   .summary = "the connected white parts of a mask, measured",
                                   .help = help,
                                   .parse = parse,
                                   .apply = apply,
                                   .report = report,
                                   .print = print,
                                   .reports_alone = 1};
