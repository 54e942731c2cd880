/* Tones and adjusted colors against long double. */
#include <math.h>
#include <stdint.h>

#include "iris/xt/tone.h"
#include "score.h"

/* Entries that are not the exact value rounded, over constants from a thousandth to a thousand. */
static long wrong_entries(int gamma, long *entries)
{
    long wrong = 0;
    for (int32_t constant = 65; constant < 1000 * IRIS_Q16_ONE; constant += constant / 499 + 1) {
        iris_tone tone;
        (void)iris_tone_identity(&tone);
        (void)(gamma ? iris_tone_gamma(&tone, constant) : iris_tone_compress(&tone, constant));
        for (int p = 0; p < 256; p++) {
            long double by = constant / 65536.0L;
            long double exact = gamma ? 255 * powl(p / 255.0L, by) : by * logl(1 + p);
            wrong += tone.level[p] != (exact >= 255 ? 255 : (int)floorl(exact + 0.5L));
            ++*entries;
        }
    }
    return wrong;
}

/* How far an adjusted channel is from the real value at most. */
static double adjusted_error(const uint8_t rgb[3], const iris_adjustment *by)
{
    uint8_t is[3];
    iris_image from = {(void *)(uintptr_t)rgb, 3, 1, 1, IRIS_RGB888}, to = {is, 3, 1, 1, IRIS_RGB888};
    double max = fmax(rgb[0], fmax(rgb[1], rgb[2])), min = fmin(rgb[0], fmin(rgb[1], rgb[2]));
    double l = (max + min) / 510, c = max - min, s = c > 0 ? c / (255 - fabs(max + min - 255)) : 0, h = 0,
           error = 0;
    if (c > 0) {
        h = rgb[0] == max   ? (rgb[1] - rgb[2]) / c
            : rgb[1] == max ? 2 + (rgb[2] - rgb[0]) / c
                            : 4 + (rgb[0] - rgb[1]) / c;
        s = fmin(1, fmax(0, s + by->saturation / 100.0));
    }
    l = fmin(1, fmax(0, l + by->lightness / 100.0));
    c = s * (1 - fabs(2 * l - 1));
    (void)iris_adjust(&to, &from, by);
    for (int k = 0; k < 3; k++) {
        double turned = fmod(h + by->hue / 60.0 + 30 - 2 * k, 6);
        double share = fmin(1, fmax(0, fabs(turned - 3) - 1));
        error = fmax(error, fabs(is[k] - 255 * (l - c / 2 + c * share)));
    }
    return error;
}

void score_tone(score *s)
{
    long entries = 0, wrong = wrong_entries(0, &entries) + wrong_entries(1, &entries);
    score_row(s, "range compression and gamma, constants 0.001 to 1000", "exact, rounded",
              score_if(wrong == 0), "%ld of %ld entries differ", wrong, entries);
    double worst = 0;
    uint32_t random = 1;
    for (int i = 0; i < 400000; i++) {
        uint32_t more = random * 1664525u + 1013904223u;
        random = more * 1664525u + 1013904223u;
        uint8_t rgb[3] = {(uint8_t)(random >> 24), (uint8_t)(random >> 16), (uint8_t)(more >> 8)};
        iris_adjustment by = {.hue = (int32_t)(more >> 16) % 360 - 180,
                              .saturation = (int32_t)(random >> 9) % 201 - 100,
                              .lightness = (int32_t)(more >> 10) % 201 - 100};
        worst = fmax(worst, adjusted_error(rgb, &by));
    }
    score_row(s, "hue, saturation, and lightness adjusted, error of a channel", "at most 1",
              score_if(worst <= 1), "%.3f", worst);
}
