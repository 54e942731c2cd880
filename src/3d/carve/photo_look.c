/* The pixels that a view has of a voxel. */
#include "photo_parts.h"
#include "voxel_parts.h"

#define ONE  256       /* a pixel; a lattice step of an eye */
#define HALF 128       /* of a pixel */
#define FAR  (1 << 28) /* beside any picture */

typedef struct {
    int32_t x, y; /* pixels with 8 fraction bits */
} spot;

/* A side of a projection. What is inside has values from 0 up. */
typedef struct {
    int64_t value;            /* at the middle of the first pixel of a row */
    int64_t along_x, along_y; /* from a pixel to the next */
    int64_t touch;            /* -touch is at a pixel whose square touches it */
    int64_t own;              /* -own: a 256th of a pixel outside, what places are rounded to */
} edge;

typedef struct {
    edge edges[12];
    int count;
    int32_t left, right, top, bottom; /* pixels, right and bottom excluded */
} footprint;

static int32_t quotient(int64_t numerator, int64_t depth)
{
    const int64_t at = numerator * ONE / depth;
    return at > FAR ? FAR : at < -FAR ? -FAR : (int32_t)at;
}

static int32_t clipped(int32_t a, int32_t most)
{
    return a < 0 ? 0 : a > most ? most : a;
}

/* 0: a corner is not in front of the camera, or the picture shows none of the voxel. */
static int show_corners(footprint *f, spot corners[8], const iris_photo_eye *eye, iris_voxel voxel)
{
    int32_t left = FAR, right = -FAR, top = FAR, bottom = -FAR;
    for (int i = 0; i < 8; i++) {
        const iris_voxel at = {2 * voxel.x + 2 * (i & 1), 2 * voxel.y + (i & 2), 2 * voxel.z + (i >> 1 & 2)};
        const int64_t depth = iris_voxel_homogeneous(&eye->view, 2, at);
        if (depth <= 0) {
            return 0;
        }
        const int32_t x = quotient(iris_voxel_homogeneous(&eye->view, 0, at), depth);
        const int32_t y = quotient(iris_voxel_homogeneous(&eye->view, 1, at), depth);
        corners[i] = (spot){x, y};
        left = x < left ? x : left;
        right = x > right ? x : right;
        top = y < top ? y : top;
        bottom = y > bottom ? y : bottom;
    }
    f->left = clipped((left + HALF) >> 8, eye->sides[0]);
    f->right = clipped(((right + HALF) >> 8) + 1, eye->sides[0]);
    f->top = clipped((top + HALF) >> 8, eye->sides[1]);
    f->bottom = clipped(((bottom + HALF) >> 8) + 1, eye->sides[1]);
    return f->left < f->right && f->top < f->bottom;
}

/* Which faces are turned to the eye: bits as in iris_photo_voxel. */
static unsigned facing(const iris_photo_eye *eye, iris_voxel voxel)
{
    const int32_t at[3] = {voxel.x, voxel.y, voxel.z};
    unsigned sides = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int64_t low = 2 * ONE * (int64_t)at[axis];
        sides |= eye->eye[axis] < low             ? 1u << (2 * axis)
                 : eye->eye[axis] > low + 2 * ONE ? 2u << (2 * axis)
                                                  : 0u;
    }
    return sides;
}

static void add_edge(footprint *f, spot a, spot b)
{
    const int64_t dx = (int64_t)b.x - a.x, dy = (int64_t)b.y - a.y;
    const int64_t size = (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
    f->edges[f->count++] =
        (edge){.value = dx * ((int64_t)ONE * f->top - a.y) - dy * ((int64_t)ONE * f->left - a.x),
               .along_x = -dy * ONE,
               .along_y = dx * ONE,
               .touch = HALF * size,
               .own = size};
}

/* The outline of the faces: edges of one of them only, all the same way around. */
static void make_outline(footprint *f, const spot corners[8], unsigned faces)
{
    static const uint8_t around[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    unsigned leads_to[8] = {0};
    int64_t area = 0;
    for (int side = 0; side < 6; side++) {
        for (int i = 0; i < 4 && (faces >> side & 1u) != 0; i++) {
            const int from = around[side][i], to = around[side][(i + 1) % 4];
            leads_to[from] |= 1u << to;
            area += (int64_t)corners[from].x * corners[to].y - (int64_t)corners[from].y * corners[to].x;
        }
    }
    f->count = 0;
    for (int i = 0; i < 64; i++) {
        const int from = i / 8, to = i % 8;
        if ((leads_to[from] >> to & 1u) != 0 && (leads_to[to] >> from & 1u) == 0) {
            add_edge(f, corners[area > 0 ? from : to], corners[area > 0 ? to : from]);
        }
    }
}

/* Are all pixels within the footprint's bounds flagged? Then the view has nothing of the voxel. */
static int is_flagged(const footprint *f, const iris_photo_work *work, int32_t view)
{
    for (int32_t y = f->top; y < f->bottom; y++) {
        const size_t row = (size_t)view * work->view_words + (size_t)y * work->row_words;
        for (int32_t i = f->left / 32; i <= (f->right - 1) / 32; i++) {
            uint32_t bits = UINT32_MAX;
            bits &= i == f->left / 32 ? UINT32_MAX << (f->left % 32) : UINT32_MAX;
            bits &= i == (f->right - 1) / 32 ? UINT32_MAX >> (31 - (f->right - 1) % 32) : UINT32_MAX;
            if ((bits & ~(work->explained[row + (size_t)i] | work->hidden[row + (size_t)i])) != 0) {
                return 0;
            }
        }
    }
    return 1;
}

static void add_pixel(iris_photo_pixels *seen, const iris_image *picture, int32_t x, int32_t y, int owns)
{
    const uint8_t *row = iris_image_row(picture, y);
    for (int i = 0; i < 3; i++) {
        const int channel = picture->format == IRIS_BGR888 ? 2 - i : i;
        const uint8_t level = picture->format == IRIS_GRAY8 ? row[x] : row[3 * x + channel];
        seen->least[i] = level < seen->least[i] ? level : seen->least[i];
        seen->most[i] = level > seen->most[i] ? level : seen->most[i];
        seen->sums[i] += owns ? level : 0u;
    }
}

static int is_selected(const iris_image *silhouette, int32_t x, int32_t y)
{
    const uint32_t *row = silhouette ? iris_image_row(silhouette, y) : NULL;
    return !row || (row[x / 32] >> (x % 32) & 1u) != 0;
}

typedef enum { BESIDE, TOUCHES, OWNS } share;

/* The pixel that is `along` behind the first one of the row. */
static share share_of(const footprint *f, int32_t along)
{
    share is = OWNS;
    for (int i = 0; i < f->count; i++) {
        const edge *e = &f->edges[i];
        const int64_t value = e->value + along * e->along_x;
        if (value < -e->touch) {
            return BESIDE;
        }
        is = value < -e->own ? TOUCHES : is;
    }
    return is;
}

static void look_along(iris_photo_pixels *seen, iris_photo_work *work, int32_t view, const footprint *f,
                       int32_t y)
{
    const iris_carve_photo *photo = &work->photos[view];
    const size_t row = (size_t)view * work->view_words + (size_t)y * work->row_words;
    for (int32_t x = f->left; x < f->right; x++) {
        const share is = share_of(f, x - f->left);
        const size_t word = row + (size_t)x / 32;
        const uint32_t bit = (uint32_t)1 << (x % 32);
        if (is == BESIDE) {
            continue;
        }
        const int selected = is_selected(photo->silhouette, x, y);
        int owns = 0;
        if (is == OWNS) {
            owns = selected && ((work->explained[word] | work->hidden[word]) & bit) == 0 &&
                   seen->own < IRIS_PHOTO_OWN_MAX;
            work->hidden[word] |= bit;
            seen->own += owns;
            seen->all++;
        }
        if (selected) {
            add_pixel(seen, &photo->picture, x, y, owns);
        }
    }
}

int iris_photo_look(iris_photo_pixels *seen, iris_photo_work *work, int32_t view,
                    const iris_photo_voxel *voxel)
{
    iris_photo_eye *eye = &work->eyes[view];
    const iris_voxel at = iris_photo_voxel_at(work, voxel);
    const unsigned faces = facing(eye, at);
    footprint f;
    spot corners[8];
    *seen = (iris_photo_pixels){0, 0, {255, 255, 255}, {0, 0, 0}, {0, 0, 0}};
    if ((faces & voxel->exposed) == 0 || !show_corners(&f, corners, eye, at) || is_flagged(&f, work, view)) {
        return 0;
    }
    make_outline(&f, corners, faces);
    for (int32_t y = f.top; y < f.bottom; y++) {
        look_along(seen, work, view, &f, y);
        for (int i = 0; i < f.count; i++) {
            f.edges[i].value += f.edges[i].along_y;
        }
    }
    eye->top = f.top < eye->top ? f.top : eye->top;
    eye->bottom = f.bottom > eye->bottom ? f.bottom : eye->bottom;
    return seen->own > 0 && seen->own >= seen->all / 2;
}
