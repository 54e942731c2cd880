/* RGB to HSL48 and back, for every color there is. */
#include <string.h>

#include "iris/color.h"
#include "score.h"

void score_hsl(score *s)
{
    static uint8_t rgb[65536][3], back[65536][3];
    static uint16_t hsl[65536][3];
    long wrong = 0;
    for (int r = 0; r < 256; r++) {
        for (int i = 0; i < 65536; i++) {
            rgb[i][0] = (uint8_t)r;
            rgb[i][1] = (uint8_t)(i >> 8);
            rgb[i][2] = (uint8_t)i;
        }
        for (int i = 0; i < 65536; i += 8192) {
            memset(back[i], r + 1, 8192 * 3);
            (void)iris_color_row(hsl[i], IRIS_HSL48, rgb[i], IRIS_RGB888, 8192);
            (void)iris_color_row(back[i], IRIS_RGB888, hsl[i], IRIS_HSL48, 8192);
        }
        for (int i = 0; i < 65536; i++) {
            wrong += memcmp(rgb[i], back[i], 3) != 0;
        }
    }
    score_row(s, "RGB to HSL48 to RGB, all 16777216 colors", "identity", score_if(wrong == 0), "%ld differ",
              wrong);
}
