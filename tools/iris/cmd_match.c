#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "canvas.h"
#include "commands.h"
#include "file_name.h"
#include "frame_reader.h"
#include "inputs.h"
#include "iris/xt/shape.h"
#include "iris/xt/threshold.h"
#include "operation.h"
#include "system.h"

static const char help[] =
    "usage: iris match --models DIR [--method height|radial|moments] [--least SCORE] [--no-mirror]\n"
    "                  [--self] [--roi x,y,w,h] [--json] IN... [-o OUT]\n\n"
    "What a silhouette is: the model in DIR that is most like it, however it is moved, turned, scaled, or\n"
    "mirrored. A model is a picture of a silhouette; its class is the file's name up to the first dash.\n"
    "The silhouette is the white part that encloses most; gray and color pictures count as white above\n"
    "127.\n\n"
    "  --models DIR      a folder of BMP, PGM, and PPM files (or one such file)\n"
    "  --method height   how high all other points of the outline are over each tangent (the default)\n"
    "  --method radial   how far the edge is, all around (iris signature)\n"
    "  --method moments  Hu's moments; no angle\n"
    "  --least SCORE     0 to 1: below this score the class is unknown, null in JSON (default 0.333 for\n"
    "                    height, 0.7 for radial, 0.75 for moments)\n"
    "  --no-mirror       mirror images are something else\n"
    "  --self            a picture that is itself one of the files of models is matched with this one,\n"
    "                    too; without it, only with all others\n" OPERATION_OPTIONS "\n"
    "JSON has class, model (the file most like it), score (0 to 1; do not compare methods), angle_deg\n"
    "(by which the model must be turned clockwise to lie like the silhouette), and mirrored (1: after its\n"
    "left and right have been swapped). With -o a picture with the outline and the class.\n\n"
    "example: iris match --models shapes --json part.bmp\n";

#define CLASS_MAX 64

typedef struct {
    iris_shape_matching matching;
    int self;
} settings;

/* The models of --models, for as long as the program runs. */
static struct {
    input_list files;
    iris_shape *shapes;
    int32_t *file_of; /* index in files */
    iris_shape_library library;
} known;

typedef struct {
    int has_shape;
    iris_shape shape;
    iris_shape_found found;
    iris_contour outline;
    int32_t x, y; /* of the part worked on */
} finding;

/* Describes the white part that encloses most. *outline and *shape: 1; none: 0; after an error, told in *status: -1. */
static int describe(iris_shape *shape, iris_contour *outline, iris_status *status, const iris_image *mask,
                    iris_scratch *scratch)
{
    int32_t count = 0;
    *status = iris_contour_find(outline, 1, &count, mask, scratch);
    if (*status != IRIS_OK && *status != IRIS_ERR_FULL) {
        return -1;
    }
    if (count == 0 || outline->points < 2) {
        return 0;
    }
    *status = iris_shape_describe(shape, outline, mask, scratch);
    return *status == IRIS_OK ? 1 : -1;
}

/* The class of a file: its name up to the first dash, or without its ending. */
static void class_of(char name[CLASS_MAX], const char *path)
{
    const char *base = file_name(path);
    size_t length = strcspn(base, "-");
    if (base[length] == 0) {
        const char *dot = strrchr(base, '.');
        length = dot ? (size_t)(dot - base) : length;
    }
    snprintf(name, CLASS_MAX, "%.*s", (int)(length < CLASS_MAX ? length : CLASS_MAX - 1), base);
}

/* The gray picture as a model: 1, or 0 after complaining. */
static int make_model(iris_shape *shape, const char *file, const iris_image *gray)
{
    picture_buffer mask = {0};
    iris_size size = {gray->w, gray->h};
    iris_scratch scratch;
    iris_contour outline;
    size_t bytes = IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(gray->w, gray->h);
    void *memory = system_scratch(bytes);
    iris_status status = memory ? picture_reserve(&mask, size, IRIS_MASK1) : IRIS_ERR_SCRATCH;
    int made = -1;
    if (status == IRIS_OK) {
        iris_threshold(&mask.image, gray, 127, IRIS_SELECT_BRIGHT);
        iris_scratch_init(&scratch, memory, bytes);
        made = describe(shape, &outline, &status, &mask.image, &scratch);
    }
    free(memory);
    picture_free(&mask);
    if (made < 1) {
        complain(file, "%s", made == 0 ? "nothing is white: no model" : iris_status_text(status));
    }
    return made == 1;
}

static int read_model(iris_shape *shape, const char *file)
{
    static frame_reader reader;
    picture_buffer gray = {0};
    iris_status status = frame_reader_open(&reader, file);
    status = status == IRIS_OK ? frame_reader_next(&reader, &gray, IRIS_GRAY8) : status;
    int good = status == IRIS_OK;
    frame_reader_close(&reader);
    if (!good) {
        complain(file, "%s", frame_reader_problem(&reader));
    }
    good = good && make_model(shape, file, &gray.image);
    picture_free(&gray);
    return good;
}

/* All of --models. Returns 0 after complaining. */
static int read_models(const char *folder)
{
    char *operand[] = {(char *)folder};
    if (inputs_expand(&known.files, 1, operand) != EXIT_DONE) {
        return 0;
    }
    int32_t count = known.files.count, used = 0;
    known.shapes = calloc((size_t)count + 1, sizeof *known.shapes);
    known.file_of = calloc((size_t)count + 1, sizeof *known.file_of);
    for (int32_t i = 0; known.shapes && known.file_of && i < count; i++) {
        if (!read_model(&known.shapes[used], known.files.paths[i])) {
            return 0;
        }
        known.file_of[used++] = i;
    }
    known.library = (iris_shape_library){known.shapes, used};
    if (used == 0) {
        complain("--models", "no models in '%s'", folder);
    }
    return used > 0;
}

/* The model that is this very file; -1: none. */
static int32_t model_of_file(const char *file)
{
    for (int32_t i = 0; strcmp(file, "-") != 0 && i < known.library.count; i++) {
        if (system_is_same_file(file, known.files.paths[known.file_of[i]])) {
            return i;
        }
    }
    return -1;
}

static const char *model_name(const finding *found)
{
    return found->found.index < 0 ? NULL : known.files.paths[known.file_of[found->found.index]];
}

/* Outline, class, and the direction in which the model's right lies. */
static int draw(const iris_image *overlay, const iris_image *mask, const finding *found)
{
    canvas c = canvas_plain(overlay);
    int32_t count = found->outline.points;
    iris_contour_point *points = malloc((size_t)count * sizeof *points);
    canvas_point *places = malloc((size_t)count * sizeof *places);
    if (points && places && iris_contour_points(points, count, &count, &found->outline, mask) == IRIS_OK) {
        for (int32_t i = 0; i < count; i++) {
            places[i] = (canvas_point){points[i].x, points[i].y};
        }
        canvas_polygon(&c, places, (int)count, 1, canvas_color(0));
    }
    free(points);
    free(places);
    char text[CLASS_MAX + 16], name[CLASS_MAX] = "unknown";
    canvas_point center = {found->shape.x_q16 / 65536.0, found->shape.y_q16 / 65536.0};
    if (found->found.class_index >= 0) {
        double turn = found->found.angle * (3.14159265358979 / 32768);
        double reach = found->shape.diameter_q16 / 65536.0 / 3;
        class_of(name, model_name(found));
        canvas_line(&c, center, (canvas_point){center.x + reach * cos(turn), center.y + reach * sin(turn)},
                    canvas_color(1));
        canvas_cross(&c, center, 3, canvas_color(1));
    }
    snprintf(text, sizeof text, "%s %.2f", name, found->found.score_q16 / 65536.0);
    canvas_text(&c, (canvas_point){4, 4}, canvas_color(2), text);
    return EXIT_DONE;
}

static int match(finding *found, const iris_image *mask, operation_stage *stage)
{
    const settings *by = stage->settings;
    iris_status status;
    iris_scratch *scratch = stage_scratch(stage, IRIS_SHAPE_DESCRIBE_SCRATCH_BYTES(mask->w, mask->h) +
                                                     IRIS_SHAPE_MATCH_SCRATCH_BYTES);
    if (!scratch) {
        return EXIT_BAD_DATA;
    }
    found->found = (iris_shape_found){IRIS_SHAPE_UNKNOWN, -1, 0, 0, 0};
    found->has_shape = describe(&found->shape, &found->outline, &status, mask, scratch);
    if (found->has_shape < 0) {
        return stage_exit(stage, status);
    }
    if (found->has_shape) {
        iris_shape_matching matching = by->matching;
        matching.except = by->self ? -1 : model_of_file(stage->file);
        status = iris_shape_match(&found->found, &found->shape, &known.library, &matching, scratch);
        return stage_exit(stage, status);
    }
    return EXIT_DONE;
}

static int apply(iris_image *result, const iris_image *input, operation_stage *stage)
{
    const iris_image *mask = stage_mask(stage, input);
    const iris_image *color = mask ? stage_color(stage, input) : NULL;
    const iris_image *overlay = color ? stage_copy(stage, color) : NULL;
    finding *found = overlay ? stage_room(stage, sizeof *found) : NULL;
    if (!found) {
        return EXIT_BAD_DATA;
    }
    int exit_code = match(found, mask, stage);
    if (exit_code == EXIT_DONE && found->has_shape) {
        exit_code = draw(overlay, mask, found);
    }
    stage->finding = found;
    *result = *overlay;
    return exit_code;
}

static void report(json_writer *json, const operation_stage *stage)
{
    const settings *by = stage->settings;
    const finding *found = stage->finding;
    char name[CLASS_MAX];
    json_key(json, "class");
    if (found->found.class_index < 0) {
        json_null(json);
    } else {
        class_of(name, model_name(found));
        json_string(json, name);
    }
    json_key(json, "model");
    json_string(json, model_name(found));
    json_key(json, "score");
    json_number(json, found->found.score_q16 / 65536.0, 4);
    json_key(json, "angle_deg");
    if (found->found.index < 0 || by->matching.method == IRIS_SHAPE_MOMENTS) {
        json_null(json);
    } else {
        json_number(json, found->found.angle * (360 / 65536.0), 2);
    }
    json_key(json, "mirrored");
    json_integer(json, found->found.mirrored);
}

static void print(FILE *out, const operation_stage *stage)
{
    const settings *by = stage->settings;
    const finding *found = stage->finding;
    char name[CLASS_MAX];
    if (!found->has_shape) {
        fprintf(out, "%s: nothing\n", stage->file);
    } else if (found->found.index < 0) {
        fprintf(out, "%s: unknown, there is no other model\n", stage->file);
    } else {
        class_of(name, model_name(found));
        fprintf(out, "%s: %s, score %.3f, most like %s", stage->file,
                found->found.class_index < 0 ? "unknown" : name, found->found.score_q16 / 65536.0,
                model_name(found));
        if (by->matching.method != IRIS_SHAPE_MOMENTS) {
            fprintf(out, "%s turned by %.1f degrees", found->found.mirrored ? " mirrored," : "",
                    found->found.angle * (360 / 65536.0));
        }
        fputc('\n', out);
    }
}

static int parse(void *memory, operation_words *words)
{
    static const char *const names[] = {"height", "radial", "moments"};
    settings *by = memory;
    const char *models = NULL, *method = "height", *least = NULL;
    int no_mirror = 0;
    const args_option options[] = {{"models", 0, NULL, &models},
                                   {"method", 0, NULL, &method},
                                   {"least", 0, NULL, &least},
                                   {"no-mirror", 0, &no_mirror, NULL},
                                   {"self", 0, &by->self, NULL}};
    if (!operation_options(words, options, sizeof options / sizeof options[0])) {
        return 0;
    }
    int chosen = 0;
    while (chosen < 3 && strcmp(method, names[chosen]) != 0) {
        chosen++;
    }
    if (chosen == 3) {
        complain("--method", "height, radial, or moments, not '%s'", method);
        return 0;
    }
    iris_shape_matching_defaults(&by->matching, (iris_shape_method)chosen);
    by->matching.mirrored = !no_mirror;
    if (least && !args_q16(&by->matching.least_q16, 0, IRIS_Q16_ONE, least)) {
        complain("--least", "a score from 0 to 1, such as 0.5, not '%s'", least);
        return 0;
    }
    if (!models) {
        complain("--models", "is needed: a folder of silhouettes, such as shapes/apple-1.bmp");
        return 0;
    }
    if (!read_models(models)) {
        words->exit_code = EXIT_BAD_DATA;
        return 0;
    }
    return 1;
}

const operation operation_match = {.name = "match",
                                   .summary = "what a silhouette is, by a folder of models",
                                   .help = help,
                                   .parse = parse,
                                   .apply = apply,
                                   .report = report,
                                   .print = print,
                                   .reports_alone = 1};
