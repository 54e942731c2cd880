/* Text that is written into the caller's bytes, and notices when it does not fit. */
#ifndef IRIS_BORG_TEXT_OUT_H
#define IRIS_BORG_TEXT_OUT_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    char *text;
    size_t capacity, used; /* used may pass capacity */
} borg_text_out;

static inline void borg_put_char(borg_text_out *out, char c)
{
    if (out->used < out->capacity) {
        out->text[out->used] = c;
    }
    out->used++;
}

static inline void borg_put_word(borg_text_out *out, const char *word)
{
    for (; *word != '\0'; word++) {
        borg_put_char(out, *word);
    }
}

/* With zeros before it up to `digits` digits. */
static inline void borg_put_number(borg_text_out *out, int32_t value, int digits)
{
    char reversed[12];
    int count = 0;
    uint32_t rest = value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
    if (value < 0) {
        borg_put_char(out, '-');
    }
    do {
        reversed[count++] = (char)('0' + rest % 10);
        rest /= 10;
    } while (rest > 0 || count < digits);
    while (count > 0) {
        borg_put_char(out, reversed[--count]);
    }
}

#endif
