/* Sentences about what is wrong, without stdio. */
#include "problem_text.h"

problem_text problem_text_in(char *bytes, size_t capacity)
{
    problem_text text = {bytes, capacity, 0};
    bytes[0] = 0;
    return text;
}

void problem_text_add(problem_text *text, const char *words)
{
    while (*words && text->length + 1 < text->capacity) {
        text->bytes[text->length++] = *words++;
    }
    text->bytes[text->length] = 0;
}

void problem_text_add_number(problem_text *text, int64_t number)
{
    char digits[24];
    size_t at = sizeof digits - 1;
    uint64_t rest = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;
    digits[at] = 0;
    do {
        digits[--at] = (char)('0' + (int)(rest % 10));
        rest /= 10;
    } while (rest != 0);
    if (number < 0) {
        digits[--at] = '-';
    }
    problem_text_add(text, digits + at);
}

void problem_text_copy(char *to, size_t capacity, const void *from, size_t bytes)
{
    const unsigned char *letters = from;
    size_t length = 0;
    while (length < bytes && length + 1 < capacity && letters[length] != 0) {
        to[length] = (char)(letters[length] >= ' ' && letters[length] <= '~' ? letters[length] : '?');
        length++;
    }
    while (length > 0 && to[length - 1] == ' ') {
        length--;
    }
    to[length] = 0;
}
