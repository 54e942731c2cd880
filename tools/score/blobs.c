/* Blobs against flooding, pixel by pixel: on every picture of the shared data, and on random masks. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "iris/draw.h"
#include "iris/xt/blob.h"
#include "iris/xt/threshold.h"
#include "picture.h"
#include "score.h"

/* A mask as one number per pixel: -1 not selected, else its blob. All of these are null when there is no memory. */
typedef struct {
    int32_t w, h, count, holes;
    int32_t *label, *stack;
    iris_blob *truth; /* one per blob */
} flooded;

static int32_t label_at(const flooded *f, int32_t x, int32_t y)
{
    return x < 0 || y < 0 || x >= f->w || y >= f->h ? -1 : f->label[y * f->w + x];
}

/* Gives `number` to what hangs together with pixel `start` and has its label. */
static void flood(const flooded *f, int32_t start, int32_t number, int connectivity)
{
    static const int32_t dx[8] = {1, -1, 0, 0, 1, 1, -1, -1}, dy[8] = {0, 0, 1, -1, 1, -1, 1, -1};
    int32_t used = 0, of = f->label[start];
    f->label[start] = number;
    f->stack[used++] = start;
    while (used > 0) {
        int32_t x = f->stack[--used] % f->w, y = f->stack[used] / f->w;
        for (int k = 0; k < connectivity; k++) {
            int32_t to_x = x + dx[k], to_y = y + dy[k], to = to_y * f->w + to_x;
            if (to_x >= 0 && to_y >= 0 && to_x < f->w && to_y < f->h && f->label[to] == of) {
                f->label[to] = number;
                f->stack[used++] = to;
            }
        }
    }
}

/* Parts of what is not selected, all around counted once, less one: as many as all blobs have holes. */
static int32_t count_holes(const flooded *f, const iris_image *mask, int connectivity)
{
    flooded rest = {f->w + 2, f->h + 2, 0, 0, NULL, NULL, NULL};
    size_t pixels = (size_t)rest.w * (size_t)rest.h;
    int32_t parts = -1;
    rest.label = calloc(pixels, sizeof *rest.label);
    rest.stack = malloc(pixels * sizeof *rest.stack);
    for (int32_t i = 0; rest.label && rest.stack && i < rest.w * rest.h; i++) {
        int32_t x = i % rest.w - 1, y = i / rest.w - 1;
        int inside = x >= 0 && y >= 0 && x < f->w && y < f->h;
        rest.label[i] = inside && (((const uint32_t *)iris_image_row(mask, y))[x / 32] >> x % 32 & 1);
    }
    for (int32_t i = 0; rest.label && rest.stack && i < rest.w * rest.h; i++) {
        if (rest.label[i] == 0) {
            flood(&rest, i, 2, connectivity == 8 ? 4 : 8);
            parts++;
        }
    }
    free(rest.label);
    free(rest.stack);
    return parts;
}

/* A pixel's share in the description of its blob. */
static void add_pixel(iris_blob *b, const flooded *f, int32_t x, int32_t y)
{
    int32_t own = label_at(f, x, y), right = b->box.x + b->box.w - 1;
    if (b->area++ == 0) {
        b->box = (iris_rect){x, y, 1, 1};
        b->first_x = right = x;
    }
    b->box.x = x < b->box.x ? x : b->box.x;
    b->box.w = (x > right ? x : right) - b->box.x + 1;
    b->box.h = y - b->box.y + 1;
    iris_moments_add(&b->moments, x, y);
    for (int k = 0; k < 4; k++) {
        int32_t aside = k & 1 ? 1 : -1, along = k & 2 ? 1 : -1;
        int side = label_at(f, x + aside, y) == own, end = label_at(f, x, y + along) == own;
        int corner = label_at(f, x + aside, y + along) == own;
        b->edges += k < 2 ? !side : 0;
        b->edges += k == 0 || k == 2 ? !end : 0;
        /* an outer corner here, or, once for its three pixels, an inner one */
        b->corners += (!side && !end) + (side && end && !corner);
    }
}

static flooded flood_all(const iris_image *mask, int connectivity)
{
    flooded f = {mask->w, mask->h, 0, 0, NULL, NULL, NULL};
    size_t pixels = (size_t)f.w * (size_t)f.h;
    f.label = calloc(pixels, sizeof *f.label);
    f.stack = malloc(pixels * sizeof *f.stack);
    f.truth = calloc(pixels, sizeof *f.truth);
    if (!f.label || !f.stack || !f.truth) {
        return f;
    }
    for (int32_t i = 0; i < f.w * f.h; i++) {
        const uint32_t *row = iris_image_row(mask, i / f.w);
        f.label[i] = row[i % f.w / 32] >> i % f.w % 32 & 1 ? INT32_MAX : -1;
    }
    for (int32_t i = 0; i < f.w * f.h; i++) {
        if (f.label[i] == INT32_MAX) {
            flood(&f, i, f.count++, connectivity);
        }
    }
    for (int32_t i = 0; i < f.w * f.h; i++) {
        if (f.label[i] >= 0) {
            add_pixel(&f.truth[f.label[i]], &f, i % f.w, i / f.w);
        }
    }
    f.holes = count_holes(&f, mask, connectivity);
    return f;
}

static void give_back(flooded *f)
{
    free(f->label);
    free(f->stack);
    free(f->truth);
}

/* Is a before b in the table? */
static int is_before(const iris_blob *a, const iris_blob *b)
{
    int32_t first_a = a->box.y * 65536 + a->first_x, first_b = b->box.y * 65536 + b->first_x;
    return a->area > b->area || (a->area == b->area && first_a < first_b);
}

static int is_alike(const iris_blob *a, const iris_blob *b)
{
    double n = a->area;
    return a->area == b->area && memcmp(&a->box, &b->box, sizeof a->box) == 0 && a->first_x == b->first_x &&
           memcmp(&a->moments, &b->moments, sizeof a->moments) == 0 && a->edges == b->edges &&
           a->corners == b->corners && a->x_q16 == (int32_t)((double)b->moments.x * 65536 / n + 0.5) &&
           a->y_q16 == (int32_t)((double)b->moments.y * 65536 / n + 0.5);
}

/* Are these the blobs that flooding finds: in order, and of all the largest? */
static int are_true(const iris_blob_table *table, const flooded *f)
{
    int32_t kept = table->count < table->capacity ? table->count : table->capacity, before = 0, holes = 0;
    int same = f->truth && table->count == f->count;
    for (int32_t i = 0; same && i < kept; i++) {
        const iris_blob *b = &table->blobs[i];
        int32_t label = label_at(f, b->first_x, b->box.y);
        same = label >= 0 && is_alike(b, &f->truth[label]) && (i == 0 || is_before(b - 1, b));
        holes += b->holes;
    }
    for (int32_t i = 0; same && kept > 0 && i < f->count; i++) {
        before += is_before(&f->truth[i], &table->blobs[kept - 1]);
    }
    return same && (kept == 0 || before == kept - 1) && (kept < f->count || holes == f->holes);
}

/* Both connectivities; capacity 0: as many as there are pixels. */
static int is_right(const iris_image *mask, int32_t capacity)
{
    int32_t room = capacity > 0 ? capacity : mask->w * mask->h;
    size_t bytes = IRIS_BLOB_SCRATCH_BYTES(mask->w, room);
    iris_blob *blobs = malloc((size_t)room * sizeof *blobs);
    void *memory = NULL;
    int right = posix_memalign(&memory, IRIS_SCRATCH_ALIGN, bytes) == 0 && blobs;
    for (int connectivity = 4; right && connectivity <= 8; connectivity += 4) {
        iris_scratch scratch;
        iris_blob_config config;
        iris_blob_table table = {blobs, room, 0};
        flooded f = flood_all(mask, connectivity);
        iris_blob_defaults(&config);
        config.connectivity = connectivity;
        iris_scratch_init(&scratch, memory, bytes);
        iris_status status = iris_blobs(&table, mask, NULL, &config, &scratch);
        right = status == (f.count > room ? IRIS_ERR_FULL : IRIS_OK) && are_true(&table, &f);
        give_back(&f);
    }
    free(blobs);
    free(memory);
    return right;
}

typedef struct {
    int right, tried; /* masks */
} tally;

/* What is above 127 of a picture of the shared data, if there is such a picture. */
static void try_picture(tally *t, const char *name)
{
    iris_image gray;
    if (picture_load(&gray, name, IRIS_GRAY8) == IRIS_OK && (int64_t)gray.w * gray.h <= 1 << 21) {
        iris_image mask = picture_make(gray.w, gray.h, IRIS_MASK1);
        if (mask.data && iris_threshold(&mask, &gray, 127, IRIS_SELECT_BRIGHT) == IRIS_OK) {
            t->tried++;
            t->right += is_right(&mask, 0);
        }
        free(mask.data);
    }
    free(gray.data);
}

static void try_folder(tally *t, const char *folder, int depth)
{
    char path[512];
    const char *root = getenv("IRIS_DATA");
    snprintf(path, sizeof path, "%s/%s", root ? root : "../shared/data", folder);
    DIR *listing = opendir(path);
    for (struct dirent *entry; listing && (entry = readdir(listing));) {
        const char *ending = strrchr(entry->d_name, '.');
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (ending && (strcmp(ending, ".bmp") == 0 || strcmp(ending, ".pgm") == 0)) {
            try_picture(t, path);
        } else if (!ending && depth > 0) {
            try_folder(t, path, depth - 1);
        }
    }
    if (listing) {
        closedir(listing);
    }
}

/* Of all densities from none to all, and sides of 1 to 160; half of them with room for a few blobs only. */
static tally random_masks(int count)
{
    tally t = {0, 0};
    uint32_t state = 1;
    for (int i = 0; i < count; i++) {
        state = state * 1664525u + 1013904223u;
        iris_image mask =
            picture_make(1 + (int32_t)(state >> 8) % 160, 1 + (int32_t)(state >> 16) % 100, IRIS_MASK1);
        for (int32_t k = 0; mask.data && k < mask.w * mask.h; k++) {
            state = state * 1664525u + 1013904223u;
            uint32_t *row = iris_image_row(&mask, k / mask.w),
                     selected = state >> 8 < (uint32_t)i * (1u << 24) / (uint32_t)count;
            row[k % mask.w / 32] |= selected << k % mask.w % 32;
        }
        t.tried++;
        t.right += mask.data && is_right(&mask, i % 2 ? 1 + i % 37 : 0);
        free(mask.data);
    }
    return t;
}

/* The boxes of the largest blobs of the coins. */
static void show_coins(const score *s)
{
    static iris_blob blobs[32];
    static IRIS_SCRATCH_BUFFER(memory, IRIS_BLOB_SCRATCH_BYTES(640, 32));
    iris_blob_table table = {blobs, 32, 0};
    iris_scratch scratch;
    iris_image gray;
    iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    if (picture_load(&gray, "hough/coins.pgm", IRIS_GRAY8) == IRIS_OK) {
        iris_image mask = picture_make(gray.w, gray.h, IRIS_MASK1);
        if (mask.data && iris_threshold(&mask, &gray, 127, IRIS_SELECT_BRIGHT) == IRIS_OK) {
            (void)iris_blobs(&table, &mask, NULL, NULL, &scratch);
        }
        for (int32_t i = 0; i < table.count && i < 32; i++) {
            iris_draw_rect(&gray, blobs[i].box, (iris_color){255, 255, 255});
        }
        picture_save(&gray, s->pictures, "blobs-coins.bmp");
        free(mask.data);
    }
    free(gray.data);
}

void score_blobs(score *s)
{
    tally data = {0, 0}, random = random_masks(600);
    const char *what = "blobs as by flooding, the data's pictures above 127, 4 and 8";
    try_folder(&data, "carve", 1);
    static const char *const folders[] = {"shapes", "edges",  "stereo", "hough", "line",
                                          "track",  "colour", "calib",  "bmp"};
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        try_folder(&data, folders[i], 1);
    }
    if (data.tried == 0) {
        score_row(s, what, "identical", SCORE_SKIPPED, "no shared data");
    } else {
        score_row(s, what, "identical", score_if(data.right == data.tried), "%d of %d", data.right,
                  data.tried);
    }
    score_row(s, "blobs as by flooding, random masks, half of all kept in part", "identical",
              score_if(random.right == random.tried), "%d of %d", random.right, random.tried);
    score_cost_row(s, "blobs of half the frame, 16 kept", "blobs: half the frame",
                   IRIS_BLOB_SCRATCH_BYTES(160, 16) + 16 * sizeof(iris_blob));
    if (s->pictures) {
        show_coins(s);
    }
}
