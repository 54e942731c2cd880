#include "ply_text.h"

#define DECIMALS 9

char *iris_ply_put_whole(char *to, uint64_t n, int least)
{
    char digits[20];
    int count = 0;
    do {
        digits[count++] = (char)('0' + n % 10);
        n /= 10;
    } while (n > 0 || count < least);
    while (count > 0) {
        *to++ = digits[--count];
    }
    return to;
}

static char *put_number(char *to, iris_q32 a)
{
    const uint64_t scale = 1000000000, size = a < 0 ? 0u - (uint64_t)a : (uint64_t)a;
    uint64_t whole = size >> 32, fraction = ((size & UINT32_MAX) * scale + ((uint64_t)1 << 31)) >> 32;
    whole += fraction == scale;
    fraction = fraction == scale ? 0 : fraction;
    if (a < 0 && (whole | fraction) != 0) {
        *to++ = '-';
    }
    to = iris_ply_put_whole(to, whole, 1);
    *to++ = '.';
    return iris_ply_put_whole(to, fraction, DECIMALS);
}

char *iris_ply_put_vertex(char *to, iris_vec3 place, const iris_carve_color *color)
{
    to = put_number(to, place.x);
    *to++ = ' ';
    to = put_number(to, place.y);
    *to++ = ' ';
    to = put_number(to, place.z);
    if (color) {
        *to++ = ' ';
        to = iris_ply_put_whole(to, color->r, 1);
        *to++ = ' ';
        to = iris_ply_put_whole(to, color->g, 1);
        *to++ = ' ';
        to = iris_ply_put_whole(to, color->b, 1);
    }
    *to++ = '\n';
    return to;
}
