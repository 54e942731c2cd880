#include "hsl_text.h"

#include <string.h>

#include "args.h"
#include "complain.h"

/* Reads "low-high" up to `end` and steps behind it. Returns 0 when *text is not that. */
static int read_bounds(int32_t bounds[2], const char **text, char separator, int is_last)
{
    char piece[24];
    const char *end = strchr(*text, separator);
    size_t length = end ? (size_t)(end - *text) : strlen(*text);
    if (length >= sizeof piece || is_last != !end) {
        return 0;
    }
    memcpy(piece, *text, length);
    piece[length] = '\0';
    *text += length + !is_last;
    return args_numbers(bounds, 2, '-', piece);
}

static int are_within(const int32_t bounds[2], int32_t most)
{
    return bounds[0] >= 0 && bounds[0] <= most && bounds[1] >= 0 && bounds[1] <= most;
}

int hsl_text_read(iris_hsl_range *range, const char *option, const char *text)
{
    const char separator = strchr(text, ',') ? ',' : ':';
    int32_t h[2], s[2], l[2];
    const char *at = text;
    if (!read_bounds(h, &at, separator, 0) || !read_bounds(s, &at, separator, 0) ||
        !read_bounds(l, &at, separator, 1)) {
        complain(option, "hsl:" HSL_TEXT " in whole numbers, commas or colons, not 'hsl:%s'", text);
        return 0;
    }
    if (!are_within(h, 360)) {
        complain(option, "hue is 0 to 360 degrees, not %d-%d", (int)h[0], (int)h[1]);
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        const int32_t *bounds = i == 0 ? s : l;
        if (!are_within(bounds, 100) || bounds[0] > bounds[1]) {
            complain(option, "%s is 0 to 100 percent, low to high, not %d-%d",
                     i == 0 ? "saturation" : "lightness", (int)bounds[0], (int)bounds[1]);
            return 0;
        }
    }
    *range = (iris_hsl_range){h[0], h[1], s[0], s[1], l[0], l[1]};
    return 1;
}
