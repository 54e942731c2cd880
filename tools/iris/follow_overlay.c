#include "follow_overlay.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "complain.h"
#include "iris/copy.h"
#include "iris/draw.h"
#include "picture.h"
#include "picture_write.h"

#define READABLE_W  320 /* pixels that the text needs */
#define ENLARGE_MAX 8

static const iris_color EDGE = {0, 255, 90};
static const iris_color SEGMENT = {255, 0, 200};
static const iris_color ARROW = {0, 220, 255};
static const iris_color OUTLINE = {0, 0, 0};
static const iris_color TEXT = {255, 255, 255};

/* The enlarged frame, kept for the next one. */
static picture_buffer enlarged;

/* A picture of the frame in which each of its pixels is a square. */
typedef struct {
    iris_image image;
    int32_t scale;
} canvas;

/* --- where to --- */

/* Returns 0 when the path would be too long. */
static int path_of(char path[PATH_MAX], const char *folder, const char *file, int64_t frame)
{
    const char *slash = strrchr(file, '/');
    const char *name = slash ? slash + 1 : file;
    const char *dot = strrchr(name, '.');
    int length = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
    int written = strcmp(file, "-") == 0
                      ? snprintf(path, PATH_MAX, "%s/frame_%05lld.bmp", folder, (long long)frame)
                      : snprintf(path, PATH_MAX, "%s/%.*s.bmp", folder, length, name);
    return written < PATH_MAX;
}

/* Makes the folder and the folders that lead to it. Returns 0 with errno set. */
static int make_folder(const char *folder)
{
    char path[PATH_MAX];
    struct stat status;
    if (snprintf(path, sizeof path, "%s", folder) >= (int)sizeof path) {
        errno = ENAMETOOLONG;
        return 0;
    }
    for (char *at = path + 1; *folder != '\0' && *at != '\0'; at++) {
        if (*at == '/') {
            *at = '\0';
            (void)mkdir(path, 0777); /* what went wrong shows at the end */
            *at = '/';
        }
    }
    if (mkdir(path, 0777) != 0 && errno != EEXIST) {
        return 0;
    }
    errno = ENOTDIR;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static int by_text(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Is `path` there, and the same file as `input`? */
static int is_input(const char *path, const char *input)
{
    struct stat a, b;
    return strcmp(input, "-") != 0 && stat(path, &a) == 0 && stat(input, &b) == 0 && a.st_dev == b.st_dev &&
           a.st_ino == b.st_ino;
}

/* Fills paths with where each input's picture goes. Returns an exit code after complaining. */
static int collect_paths(char **paths, const char *folder, const input_list *inputs)
{
    for (int i = 0; i < inputs->count; i++) {
        char path[PATH_MAX];
        if (!path_of(path, folder, inputs->paths[i], 1)) {
            complain(inputs->paths[i], "%s", strerror(ENAMETOOLONG));
            return EXIT_BAD_DATA;
        }
        if (is_input(path, inputs->paths[i])) {
            complain(path, "the overlay would replace the input");
            return EXIT_BAD_CALL;
        }
        paths[i] = strdup(path);
        if (!paths[i]) {
            complain(NULL, "not enough memory");
            return EXIT_BAD_DATA;
        }
    }
    return EXIT_DONE;
}

int follow_overlay_begin(const char *folder, const input_list *inputs)
{
    if (!make_folder(folder)) {
        complain(folder, "%s", strerror(errno));
        return EXIT_BAD_DATA;
    }
    char **paths = calloc((size_t)inputs->count + 1, sizeof *paths);
    if (!paths) {
        complain(NULL, "not enough memory");
        return EXIT_BAD_DATA;
    }
    int exit_code = collect_paths(paths, folder, inputs);
    if (exit_code == EXIT_DONE) {
        qsort(paths, (size_t)inputs->count, sizeof *paths, by_text);
    }
    for (int i = 1; i < inputs->count && exit_code == EXIT_DONE; i++) {
        if (strcmp(paths[i - 1], paths[i]) == 0) {
            complain(paths[i], "more than one overlay would be written there");
            exit_code = EXIT_BAD_CALL;
        }
    }
    for (int i = 0; i < inputs->count; i++) {
        free(paths[i]);
    }
    free(paths);
    return exit_code;
}

/* --- what is drawn --- */

/* The canvas pixel in the middle of a frame pixel. */
static int32_t middle(const canvas *c, int32_t at)
{
    return at * c->scale + c->scale / 2;
}

/* A line `reach` pixels thick to every side. */
static void draw_thick(const iris_image *image, const iris_segment *s, int32_t reach, iris_color color)
{
    for (int32_t dy = -reach; dy <= reach; dy++) {
        for (int32_t dx = -reach; dx <= reach; dx++) {
            iris_draw_line(image, s->x0 + dx, s->y0 + dy, s->x1 + dx, s->y1 + dy, color);
        }
    }
}

static int32_t stroke_reach(const canvas *c)
{
    return c->image.w >= 2 * READABLE_W ? c->image.w / (2 * READABLE_W) : 1;
}

/* The edges row by row, joined where the next row has the line too. */
static void draw_edges(const canvas *c, const follow_answer *answer)
{
    int32_t reach = stroke_reach(c) / 2;
    iris_span above = {1, 0};
    for (int32_t y = 0; y < answer->size.h; y++) {
        iris_span span = follow_row(answer, y);
        iris_span from = above.left <= above.right ? above : span;
        if (span.left <= span.right) {
            int32_t y0 = middle(c, above.left <= above.right ? y - 1 : y), y1 = middle(c, y);
            iris_segment left = {middle(c, from.left), y0, middle(c, span.left), y1};
            iris_segment right = {middle(c, from.right), y0, middle(c, span.right), y1};
            draw_thick(&c->image, &left, reach, EDGE);
            draw_thick(&c->image, &right, reach, EDGE);
        }
        above = span;
    }
}

static void draw_segments(const canvas *c, const iris_follow_result *line)
{
    int32_t reach = stroke_reach(c);
    for (int32_t i = 0; i < line->segment_count; i++) {
        const iris_segment *s = &line->segments[i];
        iris_segment drawn = {middle(c, s->x0), middle(c, s->y0), middle(c, s->x1), middle(c, s->y1)};
        draw_thick(&c->image, &drawn, reach, SEGMENT);
    }
    for (int32_t i = 0; i < line->segment_count; i++) {
        int32_t x = middle(c, line->segments[i].x0), y = middle(c, line->segments[i].y0),
                side = 2 * reach + 1;
        iris_draw_rect_filled(&c->image, (iris_rect){x - side, y - side, 2 * side + 1, 2 * side + 1},
                              OUTLINE);
        iris_draw_rect_filled(&c->image, (iris_rect){x - side + 1, y - side + 1, 2 * side - 1, 2 * side - 1},
                              SEGMENT);
    }
}

/* From where the line meets the bottom row (or a little above, to be seen as a whole), along its direction there. */
static void draw_arrow(const canvas *c, const follow_answer *answer)
{
    const iris_follow_result *line = &answer->line;
    const double turn = 6.283185307179586;
    double angle = line->angle / 65536.0 * turn;
    double length = c->image.h / 4.0;
    double column = (answer->size.w - 1) / 2.0 + line->offset_q16 / 65536.0 * answer->size.w / 2.0;
    int lies_across = cos(angle) < 0.35;
    column = column < 0 ? 0 : column > answer->size.w - 1 ? answer->size.w - 1 : column;
    int32_t x = middle(c, (int32_t)lround(column)),
            y = c->image.h - 1 - (lies_across ? (int32_t)length / 4 : 0);
    int32_t tip_x = x + (int32_t)lround(length * sin(angle)),
            tip_y = y - (int32_t)lround(length * cos(angle));
    for (int32_t k = 0; k < 2; k++) { /* the outline, then the arrow */
        int32_t reach = stroke_reach(c) + 1 - k;
        iris_color color = k == 0 ? OUTLINE : ARROW;
        draw_thick(&c->image, &(iris_segment){x, y, tip_x, tip_y}, reach, color);
        for (int side = -1; side <= 1; side += 2) {
            double back = angle + side * turn * 0.42;
            iris_segment barb = {tip_x, tip_y, tip_x + (int32_t)lround(length / 3 * sin(back)),
                                 tip_y - (int32_t)lround(length / 3 * cos(back))};
            draw_thick(&c->image, &barb, reach, color);
        }
    }
}

/* A quarter of the light stays: what is below the text can still be seen. */
static void darken(const iris_image *image, int32_t rows)
{
    for (int32_t y = 0; y < rows && y < image->h; y++) {
        uint8_t *row = iris_image_row(image, y);
        for (int32_t i = 0; i < 3 * image->w; i++) {
            row[i] = (uint8_t)(row[i] / 4);
        }
    }
}

static iris_color state_color(iris_line_state state)
{
    static const iris_color found = {90, 255, 120}, stale = {255, 220, 60}, lost = {255, 90, 80};
    return state == IRIS_LINE_FOUND ? found : state == IRIS_LINE_STALE ? stale : lost;
}

static void draw_numbers(const canvas *c, const follow_answer *answer)
{
    const iris_follow_result *line = &answer->line;
    int32_t scale = c->image.w >= 2 * READABLE_W ? c->image.w / READABLE_W : 1;
    int32_t cell_w = IRIS_TEXT_CELL_W * scale, cell_h = IRIS_TEXT_CELL_H * scale, edge = 3 * scale;
    char first[80], second[80], next[16] = "";
    if (line->has_next) {
        snprintf(next, sizeof next, "  next %+.0f", iris_angle_to_centidegrees(line->next_angle) / 100.0);
    }
    snprintf(first, sizeof first, "angle %+.1f%s  offset %+.2f",
             iris_angle_to_centidegrees(line->angle) / 100.0, next, line->offset_q16 / 65536.0);
    snprintf(second, sizeof second, "steer %+.2f (%+.1f deg)  speed %.2f",
             answer->command.steer_permil / 1000.0, answer->wheel_centideg / 100.0,
             answer->command.speed_permil / 1000.0);
    darken(&c->image, 3 * edge + 2 * cell_h);
    iris_draw_text(&c->image, edge, edge, follow_state_name(line->state), scale, state_color(line->state));
    if (line->state != IRIS_LINE_LOST) {
        iris_draw_text(&c->image, edge + 7 * cell_w, edge, first, scale, TEXT);
    }
    iris_draw_text(&c->image, edge + 7 * cell_w, 2 * edge + cell_h, second, scale, TEXT);
}

/* The frame itself, or the enlarged copy. Returns a status of picture_reserve. */
static iris_status enlarge(canvas *c, const iris_image *frame)
{
    *c = (canvas){*frame, 1};
    while (frame->w * c->scale < READABLE_W && c->scale < ENLARGE_MAX) {
        c->scale++;
    }
    if (c->scale == 1) {
        return IRIS_OK;
    }
    iris_size size = {frame->w * c->scale, frame->h * c->scale};
    if (size.h > IRIS_SIDE_MAX) {
        c->scale = 1;
        return IRIS_OK;
    }
    iris_status status = picture_reserve(&enlarged, size, IRIS_RGB888);
    if (status == IRIS_OK) {
        c->image = enlarged.image;
        iris_resize_nearest(&c->image, frame);
    }
    return status;
}

int follow_overlay_write(const char *folder, const iris_image *frame, const follow_answer *answer)
{
    char path[PATH_MAX];
    canvas c;
    iris_status status = enlarge(&c, frame);
    if (status != IRIS_OK) {
        complain(answer->file, "%s", picture_problem(status, answer->size));
        return EXIT_BAD_DATA;
    }
    if (!path_of(path, folder, answer->file, answer->frame)) {
        complain(answer->file, "%s", strerror(ENAMETOOLONG));
        return EXIT_BAD_DATA;
    }
    draw_edges(&c, answer);
    if (answer->line.state != IRIS_LINE_LOST) {
        draw_segments(&c, &answer->line);
        draw_arrow(&c, answer);
    }
    draw_numbers(&c, answer);
    return picture_write(path, &c.image) ? EXIT_DONE : EXIT_BAD_DATA;
}

void follow_overlay_end(void)
{
    picture_free(&enlarged);
}
