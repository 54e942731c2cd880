#include <string.h>

#include "iris/fixed.h"
#include "signature_cells.h"

#define PIECE       IRIS_SIGNATURE_PIECE
#define WHOLE       16384 /* evidence of all pixels of a kind */
#define GRAY_BELOW  6     /* distance of the mean U, V from gray */
#define HUE_BINS    180   /* of 2 degrees */
#define CHROMA_BINS 160

/* What the object's pixels are like: how many have which value. */
typedef struct {
    uint32_t hue[HUE_BINS]; /* by chroma */
    uint32_t s[101], l[101], chroma[CHROMA_BINS];
} tally;

typedef char tally_fits_scratch[4 * 542 == sizeof(tally) ? 1 : -1];

typedef enum { OBJECT, RING, BEYOND, BETWEEN } kind;

typedef struct {
    const iris_image *image;
    iris_rect rect, inner, outer; /* the object; what belongs to neither; all of the ring */
    int16_t *evidence;
    tally *is;
    int32_t step[BETWEEN];   /* every so manieth column and row counts for this kind */
    int32_t count[BETWEEN];  /* pixels looked at */
    int32_t weight[BETWEEN]; /* of each in evidence */
    int32_t positive; /* of the object's, in cells with evidence for it; 0: too few, evidence is not asked */
    int32_t has[BETWEEN]; /* of each kind, those that have the signature */
    const iris_signatures *signatures;
    uint32_t bit;
    int64_t sums[3], yuv_u, yuv_v; /* of the pixels in the tally */
    uint32_t tallied;
} pupil;

static int is_within(const iris_rect *rect, int32_t x, int32_t y)
{
    return x >= rect->x && x < rect->x + rect->w && y >= rect->y && y < rect->y + rect->h;
}

static iris_rect grown(iris_rect rect, int32_t by_x, int32_t by_y)
{
    return (iris_rect){rect.x - by_x, rect.y - by_y, rect.w + 2 * by_x, rect.h + 2 * by_y};
}

/* In the ellipse that fits into the rectangle? */
static int is_object(const iris_rect *rect, int32_t x, int32_t y)
{
    int64_t w = rect->w, h = rect->h, dx = 2 * (x - rect->x) + 1 - w, dy = 2 * (y - rect->y) + 1 - h;
    return dx * dx * h * h + dy * dy * w * w <= w * w * h * h;
}

static kind kind_of(const pupil *job, int32_t x, int32_t y)
{
    if (is_within(&job->rect, x, y)) {
        return is_object(&job->rect, x, y) ? OBJECT : BETWEEN;
    }
    return is_within(&job->inner, x, y) ? BETWEEN : is_within(&job->outer, x, y) ? RING : BEYOND;
}

/* Calls `look` for each pixel of these kinds that counts. */
typedef void looker(pupil *job, kind k, int32_t cell, const uint8_t *rgb);

static void walk_piece(pupil *job, looker *look, int32_t from_x, int32_t y)
{
    const iris_image *image = job->image;
    const uint8_t *row = (const uint8_t *)iris_image_row(image, y);
    uint16_t cells[PIECE];
    uint8_t rgb[3 * PIECE];
    int32_t n = image->w - from_x < PIECE ? image->w - from_x : PIECE;
    iris_signature_cells_row(cells, row, image->format, from_x, n);
    (void)iris_color_rgb_row(rgb, row + (from_x > 0 ? iris_format_row_bytes(image->format, from_x) : 0),
                             image->format, n);
    for (int32_t i = 0; i < n; i++) {
        kind k = kind_of(job, from_x + i, y);
        if (k != BETWEEN && y % job->step[k] == 0 && (from_x + i) % job->step[k] == 0) {
            look(job, k, cells[i], rgb + 3 * (size_t)i);
        }
    }
}

static void walk(pupil *job, looker *look, const iris_rect *part)
{
    for (int32_t y = part->y < 0 ? 0 : part->y; y < part->y + part->h && y < job->image->h; y++) {
        int32_t x = part->x < 0 ? 0 : part->x / PIECE * PIECE;
        for (; x < part->x + part->w && x < job->image->w; x += PIECE) {
            walk_piece(job, look, x, y);
        }
    }
}

/* --- evidence --- */

static void count_kind(pupil *job, kind k, int32_t cell, const uint8_t *rgb)
{
    (void)cell;
    (void)rgb;
    job->count[k]++;
}

static void add_evidence(pupil *job, kind k, int32_t cell, const uint8_t *rgb)
{
    (void)rgb;
    int32_t sum = job->evidence[cell] + (k == OBJECT ? job->weight[k] : -job->weight[k]);
    job->evidence[cell] = (int16_t)(sum > INT16_MAX ? INT16_MAX : sum < INT16_MIN ? INT16_MIN : sum);
}

/* The least step with which an area has at most WHOLE pixels looked at. */
static int32_t step_for(int64_t area)
{
    int32_t step = 1;
    while (area / step / step > WHOLE / 2) {
        step++;
    }
    return step;
}

static void gather_evidence(pupil *job)
{
    const iris_rect all = {0, 0, job->image->w, job->image->h};
    job->step[OBJECT] = step_for((int64_t)job->rect.w * job->rect.h);
    job->step[RING] = step_for((int64_t)job->outer.w * job->outer.h);
    job->step[BEYOND] = step_for((int64_t)all.w * all.h / 2);
    walk(job, count_kind, &all);
    for (int k = 0; k < BETWEEN; k++) {
        job->weight[k] = job->count[k] > 0 ? (WHOLE + job->count[k] / 2) / job->count[k] : 0;
    }
    memset(job->evidence, 0, sizeof *job->evidence * IRIS_SIGNATURE_CELLS);
    walk(job, add_evidence, &all);
}

/* --- the range --- */

static void count_positive(pupil *job, kind k, int32_t cell, const uint8_t *rgb)
{
    (void)rgb;
    job->positive += k == OBJECT && job->evidence[cell] > 0;
}

static int32_t chroma_of(int32_t u, int32_t v)
{
    return (int32_t)iris_sqrt_u32((uint32_t)(u * u + v * v));
}

static void tally_pixel(pupil *job, kind k, int32_t cell, const uint8_t *rgb)
{
    if (k == OBJECT && (!job->positive || job->evidence[cell] > 0)) {
        const iris_hsl hsl = iris_hsl_from_color((iris_color){rgb[0], rgb[1], rgb[2]});
        const iris_signature_yuv yuv = iris_signature_yuv_of(rgb[0], rgb[1], rgb[2]);
        int32_t chroma = chroma_of(yuv.u, yuv.v);
        job->is->hue[hsl.h * HUE_BINS / 1536] += (uint32_t)chroma;
        job->is->s[(hsl.s * 100 + 32767) / 65535]++;
        job->is->l[(hsl.l * 100 + 255) / 510]++;
        job->is->chroma[chroma < CHROMA_BINS ? chroma : CHROMA_BINS - 1]++;
        for (int i = 0; i < 3; i++) {
            job->sums[i] += rgb[i];
        }
        job->yuv_u += yuv.u;
        job->yuv_v += yuv.v;
        job->tallied++;
    }
}

/* The first bin, from `start` on around the circle, with which at least permil of all counts are behind. */
static int32_t percentile(const uint32_t *bins, int32_t n, int32_t start, uint64_t permil)
{
    uint64_t sum = 0, all = 0;
    int32_t i = 0;
    for (int32_t k = 0; k < n; k++) {
        all += bins[k];
    }
    for (; i < n - 1; i++) {
        sum += bins[(start + i) % n];
        if (sum * 1000 > all * permil) {
            break;
        }
    }
    return i;
}

/* Hue is cut open opposite of where a third of the circle has the most. */
static int32_t hue_cut(const uint32_t *hue)
{
    uint64_t best = 0;
    int32_t at = 0;
    for (int32_t start = 0; start < HUE_BINS; start++) {
        uint64_t sum = 0;
        for (int32_t i = 0; i < HUE_BINS / 3; i++) {
            sum += hue[(start + i) % HUE_BINS];
        }
        if (sum > best) {
            best = sum;
            at = start;
        }
    }
    return (at + HUE_BINS / 6 + HUE_BINS / 2) % HUE_BINS;
}

static int32_t limited(int32_t value, int32_t low, int32_t high)
{
    return value < low ? low : value > high ? high : value;
}

/* 10 degrees beyond the percentiles, and at most 40 to each side of the median. */
static void hue_range(iris_hsl_range *range, const uint32_t *hue)
{
    int32_t cut = hue_cut(hue), middle = percentile(hue, HUE_BINS, cut, 500);
    int32_t h0 = percentile(hue, HUE_BINS, cut, 50) - 5, h1 = percentile(hue, HUE_BINS, cut, 950) + 6;
    h0 = limited(h0, middle - 20, middle - 6);
    h1 = limited(h1, middle + 7, middle + 21);
    range->h0 = 2 * ((cut + h0 + HUE_BINS) % HUE_BINS);
    range->h1 = 2 * ((cut + h1 + HUE_BINS) % HUE_BINS);
}

static void find_range(iris_signature_lesson *result, const pupil *job)
{
    const tally *is = job->is;
    int64_t n = job->tallied > 0 ? job->tallied : 1;
    int32_t l0 = percentile(is->l, 101, 0, 50), l1 = percentile(is->l, 101, 0, 950);
    int32_t chroma0 = percentile(is->chroma, CHROMA_BINS, 0, 50);
    int32_t chroma1 = percentile(is->chroma, CHROMA_BINS, 0, 950);
    int is_gray = chroma_of((int32_t)(job->yuv_u / n), (int32_t)(job->yuv_v / n)) < GRAY_BELOW;
    result->color = (iris_color){(uint8_t)((job->sums[0] + n / 2) / n), (uint8_t)((job->sums[1] + n / 2) / n),
                                 (uint8_t)((job->sums[2] + n / 2) / n)};
    if (is_gray) {
        result->range = (iris_hsl_range){0, 360, 0, 100, limited(l0 - 8, 0, 100), limited(l1 + 8, 0, 100)};
        result->chroma0 = 0;
        result->chroma1 = chroma1 + 3;
    } else {
        int32_t s0 = percentile(is->s, 101, 0, 50);
        result->range = (iris_hsl_range){0, 0, s0 / 2, 100, l0 * 2 / 5, limited(l1 * 9 / 5 + 5, 0, 100)};
        hue_range(&result->range, is->hue);
        result->chroma0 = limited(chroma0 / 2, 5, CHROMA_BINS);
        result->chroma1 = limited(chroma1 * 2 + 10, 0, CHROMA_BINS);
    }
}

/* --- the signature --- */

static int cell_is_in_range(int32_t cell, const iris_signature_lesson *l, const iris_hsl_range_test *test)
{
    const iris_color color = iris_signature_color_of(cell, (iris_signature_yuv){2, 2, 2}, NULL);
    const iris_signature_yuv yuv = iris_signature_yuv_of(color.r, color.g, color.b);
    const int32_t chroma = chroma_of(yuv.u, yuv.v);
    return chroma >= l->chroma0 && chroma <= l->chroma1 && iris_hsl_range_has(test, color);
}

static void write_cells(iris_signatures *signatures, uint32_t bit, const pupil *job,
                        const iris_signature_lesson *result, int in_range_only)
{
    iris_hsl_range_test test;
    (void)iris_hsl_range_prepare(&test, &result->range);
    const int32_t against = -2 * (job->weight[BEYOND] > 0 ? job->weight[BEYOND] : 1), strong = WHOLE / 50;
    for (int32_t cell = 0; cell < IRIS_SIGNATURE_CELLS; cell++) {
        int32_t evidence = job->positive ? job->evidence[cell] : 0;
        int is_strong = evidence >= strong && !in_range_only;
        int is_in = is_strong || (evidence > against && cell_is_in_range(cell, result, &test));
        signatures->cells[cell] = (uint8_t)((signatures->cells[cell] & ~bit) | (is_in ? bit : 0));
    }
}

static void count_those_that_have(pupil *job, kind k, int32_t cell, const uint8_t *rgb)
{
    (void)rgb;
    job->has[k] += (job->signatures->cells[cell] & job->bit) != 0;
}

static int32_t permil(int32_t part, int32_t all)
{
    return all > 0 ? (int32_t)(((int64_t)part * 1000 + all / 2) / all) : 0;
}

/* How well the cells tell the object. */
static void measure(iris_signature_lesson *result, pupil *job)
{
    walk(job, count_those_that_have, &(iris_rect){0, 0, job->image->w, job->image->h});
    result->share_permil = permil(job->has[OBJECT], job->count[OBJECT]);
    result->elsewhere_permil =
        permil(job->has[RING] + job->has[BEYOND], job->count[RING] + job->count[BEYOND]);
}

/* Bounds of hue are brought to 20 degrees around those of the earlier lesson. */
static void keep_hue(iris_hsl_range *range, const iris_hsl_range *earlier)
{
    int32_t base = earlier->h0 + 350, width = (earlier->h1 - earlier->h0 + 360) % 360 + 20;
    int32_t from = (range->h0 - base + 720) % 360, to = (range->h1 - base + 720) % 360;
    from = from > width ? 0 : from;
    to = to > width || to < from ? width : to;
    range->h0 = (base + from) % 360;
    range->h1 = (base + to) % 360;
}

/* Returns 0 when nothing can be learned from this object. */
static int keep_near(iris_signature_lesson *result, const pupil *job, const iris_signature_lesson *earlier)
{
    iris_hsl_range *range = &result->range;
    const iris_hsl_range *was = &earlier->range;
    int is_gray = result->chroma0 == 0;
    if ((int64_t)job->positive * 2 < job->count[OBJECT] || is_gray != (earlier->chroma0 == 0)) {
        return 0;
    }
    if (!is_gray) {
        keep_hue(range, was);
    }
    range->s0 = limited(range->s0, was->s0 * 3 / 4, was->s1);
    result->chroma0 = limited(result->chroma0, earlier->chroma0 / 2, CHROMA_BINS);
    range->l0 = limited(range->l0, was->l0 / 2, was->l1);
    range->l1 = limited(range->l1, range->l0, limited(was->l1 * 3 / 2, 0, 100));
    return 1;
}

/* The whole lesson but the cells: evidence and range. */
static void look_at(iris_signature_lesson *result, pupil *job, int is_all)
{
    gather_evidence(job);
    walk(job, count_positive, &job->rect);
    if (is_all || (int64_t)job->positive * 5 < job->count[OBJECT]) {
        job->positive = 0;
    }
    memset(job->is, 0, sizeof *job->is);
    walk(job, tally_pixel, &job->rect);
    find_range(result, job);
}

static iris_status check(const iris_signatures *signatures, int32_t which, const iris_image *image,
                         iris_rect rect, const iris_scratch *scratch)
{
    iris_status status = signatures && image && scratch ? iris_image_check(image) : IRIS_ERR_ARG;
    if (status != IRIS_OK) {
        return status;
    }
    if (!iris_color_takes(image->format)) {
        return IRIS_ERR_FORMAT;
    }
    int is_inside = rect.x >= 0 && rect.y >= 0 && rect.w > 0 && rect.h > 0 && rect.w <= image->w &&
                    rect.h <= image->h && rect.x <= image->w - rect.w && rect.y <= image->h - rect.h;
    return which < 0 || which >= IRIS_SIGNATURES || !is_inside ? IRIS_ERR_RANGE : IRIS_OK;
}

iris_status iris_signature_learn(iris_signature_lesson *lesson, iris_signatures *signatures, int32_t which,
                                 const iris_signature_scene *scene, iris_scratch *scratch)
{
    iris_signature_lesson result;
    const iris_rect rect = scene->rect;
    pupil job = {.image = scene->image, .rect = rect, .signatures = signatures};
    size_t start = iris_scratch_mark(scratch);
    job.evidence = (int16_t *)iris_scratch_take(scratch, sizeof *job.evidence * IRIS_SIGNATURE_CELLS);
    job.is = (tally *)iris_scratch_take(scratch, sizeof *job.is);
    uint8_t *kept = (uint8_t *)iris_scratch_take(scratch, IRIS_SIGNATURE_KEPT_BYTES);
    if (!job.evidence || !job.is || !kept) {
        iris_scratch_release(scratch, start);
        return IRIS_ERR_SCRATCH;
    }
    job.inner = grown(rect, rect.w / 8 + 1, rect.h / 8 + 1);
    job.outer = grown(job.inner, rect.w / 2 + 3, rect.h / 2 + 3);
    job.bit = 1u << which;
    look_at(&result, &job, scene->is_all);
    iris_status status = scene->near && !keep_near(&result, &job, scene->near) ? IRIS_ERR_DATA : IRIS_OK;
    if (status == IRIS_OK) {
        iris_signature_keep(kept, signatures, job.bit);
        write_cells(signatures, job.bit, &job, &result, scene->near != NULL);
        measure(&result, &job);
        if (scene->near && result.elsewhere_permil > 2 * scene->near->elsewhere_permil + 2) {
            iris_signature_restore(signatures, job.bit, kept);
            status = IRIS_ERR_DATA;
        }
    }
    if (status == IRIS_OK && lesson) {
        *lesson = result;
    }
    iris_scratch_release(scratch, start);
    return status;
}

iris_status iris_signature_teach(iris_signature_lesson *lesson, iris_signatures *signatures, int32_t which,
                                 const iris_image *image, iris_rect rect, iris_scratch *scratch)
{
    iris_status status = check(signatures, which, image, rect, scratch);
    const iris_signature_scene scene = {image, rect, NULL, 0};
    return status == IRIS_OK ? iris_signature_learn(lesson, signatures, which, &scene, scratch) : status;
}
