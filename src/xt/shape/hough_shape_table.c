/* The table of a shape: made from a template's edge points, and checked. */
#include <string.h>

#include "hough_shape_parts.h"

#define POINTS_MAX 32767
#define SIDE_MAX   16383 /* of a silhouette: twice that is an int16_t */
#define BIN_SHIFT  10    /* of a direction */
#define FARTHEST                                                                                             \
    92688         /* the diagonal of all that an entry can hold: beyond it there are no more than 8 entries */
#define LIKE 8192 /* directions that differ by less than 45 degrees are alike */

static const uint8_t magic[6] = {'I', 'R', 'S', 'H', 1, 0};

void iris_hough_shape_teaching_defaults(iris_hough_shape_teaching *config)
{
    if (config) {
        *config = (iris_hough_shape_teaching){.entries = 256};
    }
}

static void put_u16(uint8_t *to, uint32_t value)
{
    to[0] = (uint8_t)(value & 255);
    to[1] = (uint8_t)(value >> 8 & 255);
}

static void put_u32(uint8_t *to, uint32_t value)
{
    put_u16(to, value & 65535);
    put_u16(to + 2, value >> 16);
}

static uint32_t crc(uint32_t sum, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        sum ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) {
            sum = sum >> 1 ^ (0xEDB88320u & (0u - (sum & 1)));
        }
    }
    return sum;
}

static uint32_t table_sum(const uint8_t *table, size_t bytes)
{
    uint32_t sum = crc(0xFFFFFFFFu, table, TABLE_CRC);
    return ~crc(sum, table + TABLE_STARTS, bytes - TABLE_STARTS);
}

/* Entries lie by their bins, and the bins one behind the other. */
static int bins_are_right(const uint8_t *table, int32_t entries)
{
    int32_t bin = 0;
    for (int32_t i = 0; i < entries; i++) {
        int32_t own = (int32_t)(table_u16(table_entry(table, i), 4) >> BIN_SHIFT);
        for (; bin < own; bin++) {
            if (table_start(table, bin + 1) != i) {
                return 0;
            }
        }
        if (own < bin) {
            return 0;
        }
    }
    for (; bin < IRIS_HOUGH_SHAPE_BINS; bin++) {
        if (table_start(table, bin + 1) != entries) {
            return 0;
        }
    }
    return table_start(table, 0) == 0;
}

iris_status iris_hough_shape_check(const uint8_t *table, size_t bytes)
{
    if (bytes < TABLE_HEAD) {
        return IRIS_ERR_TRUNCATED;
    }
    for (int i = 0; i < 4; i++) {
        if (table[i] != magic[i]) {
            return IRIS_ERR_DATA;
        }
    }
    if (table[4] != magic[4] || table[5] != magic[5]) {
        return IRIS_ERR_UNSUPPORTED;
    }
    int32_t entries = (int32_t)table_u16(table, 6);
    if (entries < 1 || entries > IRIS_HOUGH_SHAPE_ENTRIES_MAX) {
        return IRIS_ERR_DATA;
    }
    size_t needed = IRIS_HOUGH_SHAPE_TABLE_BYTES(entries);
    if (bytes < needed) {
        return IRIS_ERR_TRUNCATED;
    }
    uint32_t sum = table_u16(table, TABLE_CRC) | table_u16(table, TABLE_CRC + 2) << 16;
    return sum == table_sum(table, needed) && bins_are_right(table, entries) ? IRIS_OK : IRIS_ERR_DATA;
}

static iris_q16 table_q16(const uint8_t *table, int32_t at)
{
    return (iris_q16)(table_u16(table, at) | table_u16(table, at + 2) << 16);
}

iris_status iris_hough_shape_table(int32_t *entries, iris_q16 *x_q16, iris_q16 *y_q16, const uint8_t *table,
                                   size_t bytes)
{
    if (!entries || !x_q16 || !y_q16 || !table) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_hough_shape_check(table, bytes);
    if (status == IRIS_OK) {
        *entries = (int32_t)table_u16(table, 6);
        *x_q16 = table_q16(table, 8);
        *y_q16 = table_q16(table, 12);
    }
    return status;
}

static int is_selected(const iris_image *mask, int32_t x, int32_t y)
{
    if (x < 0 || y < 0 || x >= mask->w || y >= mask->h) {
        return 0;
    }
    const uint32_t *row = iris_image_row(mask, y);
    return row[x / 32] >> x % 32 & 1;
}

/* Where the selected pixels lie around the middle of the side that a pixel shares with the one right of it (right is 1) or
 * below it: their sum, seen from there, within 3.6 pixels. */
static iris_angle direction_at(const iris_image *mask, int32_t x, int32_t y, int right)
{
    int32_t sum_x = 0, sum_y = 0;
    for (int32_t row = -3; row <= 4; row++) {
        for (int32_t column = -3; column <= 4; column++) {
            int32_t dx = 2 * column - right, dy = 2 * row - !right;
            if (dx * dx + dy * dy <= 52 && is_selected(mask, x + column, y + row)) {
                sum_x += dx;
                sum_y += dy;
            }
        }
    }
    return iris_atan2_angle(sum_y, sum_x);
}

iris_status iris_hough_shape_silhouette(iris_edge_point *points, int32_t capacity, int32_t *count,
                                        const iris_image *mask)
{
    if (!count || capacity < 0 || (!points && capacity > 0)) {
        return IRIS_ERR_ARG;
    }
    iris_status status = iris_image_check(mask);
    if (status != IRIS_OK) {
        return status;
    }
    if (mask->format != IRIS_MASK1) {
        return IRIS_ERR_FORMAT;
    }
    if (mask->w > SIDE_MAX || mask->h > SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    int32_t all = 0;
    for (int32_t y = -1; y < mask->h; y++) {
        for (int32_t x = -1; x < mask->w; x++) {
            int selected = is_selected(mask, x, y);
            for (int right = 1; right >= 0; right--) {
                if (is_selected(mask, x + right, y + !right) == selected) {
                    continue;
                }
                if (all < capacity) {
                    points[all] = (iris_edge_point){(int16_t)(2 * x + right), (int16_t)(2 * y + !right),
                                                    direction_at(mask, x, y, right)};
                }
                all++;
            }
        }
    }
    *count = all;
    return all > capacity ? IRIS_ERR_FULL : IRIS_OK;
}

/* The mean of all points. */
static void find_centroid(iris_hough_shape_teaching *config, const iris_edge_point *points, int32_t count)
{
    int64_t sum_x = 0, sum_y = 0;
    for (int32_t i = 0; i < count; i++) {
        sum_x += points[i].x;
        sum_y += points[i].y;
    }
    config->x_q16 = (iris_q16)((sum_x * 65536 >> config->fraction_bits) / count);
    config->y_q16 = (iris_q16)((sum_y * 65536 >> config->fraction_bits) / count);
}

/* Where a coordinate with so many fraction bits lies from the reference point's, 4 fraction bits. */
static int64_t from_reference(int32_t coordinate, int32_t fraction_bits, iris_q16 reference_q16)
{
    return iris_round_shift((int64_t)coordinate * (65536 >> fraction_bits) - reference_q16, 12);
}

static int is_far(int64_t distance_q4)
{
    return distance_q4 > IRIS_HOUGH_SHAPE_REACH_MAX * 16 || distance_q4 < -IRIS_HOUGH_SHAPE_REACH_MAX * 16;
}

static int points_are_far(const iris_hough_shape_teaching *config, const iris_edge_point *points,
                          int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        if (is_far(from_reference(points[i].x, config->fraction_bits, config->x_q16)) ||
            is_far(from_reference(points[i].y, config->fraction_bits, config->y_q16))) {
            return 1;
        }
    }
    return 0;
}

/* Is an entry of like direction nearer to the point than the distance, pixels, 4 fraction bits? */
static int is_covered(const uint8_t *table, int32_t entries, int32_t x_q4, int32_t y_q4, iris_angle angle,
                      int32_t distance_q4)
{
    for (int32_t i = entries - 1; i >= 0; i--) {
        const uint8_t *entry = table_entry(table, i);
        int32_t dx = table_s16(entry, 0) - x_q4, dy = table_s16(entry, 2) - y_q4;
        int32_t turn = iris_angle_wrap((int32_t)table_u16(entry, 4) - angle);
        if (dx < distance_q4 && -dx < distance_q4 && dy < distance_q4 && -dy < distance_q4 && turn < LIKE &&
            turn > -LIKE && (int64_t)dx * dx + (int64_t)dy * dy < (int64_t)distance_q4 * distance_q4) {
            return 1;
        }
    }
    return 0;
}

/* Takes points as entries that keep a distance from each other. Returns how many: most + 1 when there are more than
 * `most`. */
static int32_t select_points(uint8_t *table, int32_t most, const iris_edge_point *points, int32_t count,
                             const iris_hough_shape_teaching *config, int32_t distance_q4)
{
    int32_t taken = 0;
    for (int32_t i = 0; i < count; i++) {
        int32_t x = (int32_t)from_reference(points[i].x, config->fraction_bits, config->x_q16);
        int32_t y = (int32_t)from_reference(points[i].y, config->fraction_bits, config->y_q16);
        if (distance_q4 > 0 && is_covered(table, taken, x, y, points[i].angle, distance_q4)) {
            continue;
        }
        if (taken == most) {
            return most + 1;
        }
        uint8_t *entry = table + TABLE_HEAD + (size_t)taken * TABLE_ENTRY_BYTES;
        put_u16(entry, (uint32_t)x & 65535);
        put_u16(entry + 2, (uint32_t)y & 65535);
        put_u16(entry + 4, (uint16_t)points[i].angle);
        taken++;
    }
    return taken;
}

/* The even selection: the least distance by which there are not too many. */
static int32_t cover(uint8_t *table, int32_t most, const iris_edge_point *points, int32_t count,
                     const iris_hough_shape_teaching *config)
{
    int32_t too_near = 0, enough = FARTHEST;
    if (count <= most) {
        return select_points(table, most, points, count, config, 0);
    }
    while (enough - too_near > 1) {
        int32_t middle = (too_near + enough) / 2;
        if (select_points(table, most, points, count, config, middle) > most) {
            too_near = middle;
        } else {
            enough = middle;
        }
    }
    return select_points(table, most, points, count, config, enough);
}

/* By bins; within a bin as the points came. */
static void sort_entries(uint8_t *table, int32_t entries)
{
    for (int32_t i = 1; i < entries; i++) {
        uint8_t moved[TABLE_ENTRY_BYTES];
        memcpy(moved, table_entry(table, i), sizeof moved);
        uint32_t bin = table_u16(moved, 4) >> BIN_SHIFT;
        int32_t at = i;
        for (; at > 0 && table_u16(table_entry(table, at - 1), 4) >> BIN_SHIFT > bin; at--) {
            memcpy(table + TABLE_HEAD + (size_t)at * TABLE_ENTRY_BYTES, table_entry(table, at - 1),
                   sizeof moved);
        }
        memcpy(table + TABLE_HEAD + (size_t)at * TABLE_ENTRY_BYTES, moved, sizeof moved);
    }
    int32_t at = 0;
    for (uint32_t bin = 0; bin <= IRIS_HOUGH_SHAPE_BINS; bin++) {
        while (at < entries && table_u16(table_entry(table, at), 4) >> BIN_SHIFT < bin) {
            at++;
        }
        put_u16(table + TABLE_STARTS + 2 * bin, (uint32_t)at);
    }
}

iris_status iris_hough_shape_teach(uint8_t *table, size_t capacity, size_t *bytes,
                                   const iris_edge_point *points, int32_t count,
                                   const iris_hough_shape_teaching *config)
{
    iris_hough_shape_teaching by;
    iris_hough_shape_teaching_defaults(&by);
    if (config) {
        by = *config;
    }
    if (!table || !bytes || !points || by.entries < IRIS_HOUGH_SHAPE_ENTRIES_MIN ||
        by.entries > IRIS_HOUGH_SHAPE_ENTRIES_MAX || (by.is_chosen != 0 && by.is_chosen != 1) ||
        by.fraction_bits < 0 || by.fraction_bits > 4) {
        return IRIS_ERR_ARG;
    }
    if (count < IRIS_HOUGH_SHAPE_ENTRIES_MIN || count > POINTS_MAX) {
        return IRIS_ERR_RANGE;
    }
    if (!by.is_chosen) {
        find_centroid(&by, points, count);
    }
    if (points_are_far(&by, points, count)) {
        return IRIS_ERR_RANGE;
    }
    int32_t most = count < by.entries ? count : by.entries;
    *bytes = IRIS_HOUGH_SHAPE_TABLE_BYTES(most);
    if (capacity < *bytes) {
        return IRIS_ERR_FULL;
    }
    int32_t entries = cover(table, most, points, count, &by);
    *bytes = IRIS_HOUGH_SHAPE_TABLE_BYTES(entries);
    memcpy(table, magic, sizeof magic);
    put_u16(table + 6, (uint32_t)entries);
    put_u32(table + 8, (uint32_t)by.x_q16);
    put_u32(table + 12, (uint32_t)by.y_q16);
    sort_entries(table, entries);
    put_u32(table + TABLE_CRC, table_sum(table, *bytes));
    return IRIS_OK;
}
