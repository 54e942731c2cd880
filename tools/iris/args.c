#include "args.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"

static const args_option *find(const arguments *args, const char *name, size_t length)
{
    for (size_t i = 0; i < args->option_count; i++) {
        const char *known = args->options[i].name;
        if (strlen(known) == length && memcmp(known, name, length) == 0) {
            return &args->options[i];
        }
    }
    return NULL;
}

static const args_option *find_letter(const arguments *args, char letter)
{
    for (size_t i = 0; i < args->option_count; i++) {
        if (args->options[i].letter == letter) {
            return &args->options[i];
        }
    }
    return NULL;
}

/* Takes one option that begins at word; *next is the word behind it, null at the end. *next is used up by being
 * made null. *given has a bit for each option that had its value already. Returns 0 after complaining. */
static int take_option(uint64_t *given, const arguments *args, const char *word, const char **next)
{
    int is_long = word[1] == '-';
    const char *equals = is_long ? strchr(word, '=') : NULL;
    size_t length = equals ? (size_t)(equals - word) : is_long ? strlen(word) : 2;
    const args_option *option = is_long ? find(args, word + 2, length - 2) : find_letter(args, word[1]);
    const char *value = equals ? equals + 1 : !is_long && word[2] != '\0' ? word + 2 : NULL;
    if (!option) {
        complain(NULL, "unknown option %.*s (see --help)", (int)length, word);
        return 0;
    }
    if (option->flag) {
        if (value) {
            complain(NULL, "option %.*s takes no value", (int)length, word);
            return 0;
        }
        *option->flag = 1;
        return 1;
    }
    if (!value) {
        value = *next;
        *next = NULL;
    }
    if (!value) {
        complain(NULL, "option %.*s needs a value", (int)length, word);
        return 0;
    }
    const uint64_t bit = UINT64_C(1) << (option - args->options);
    if (*given & bit) { /* the first would be lost */
        complain(NULL, "option %.*s is given twice", (int)length, word);
        return 0;
    }
    *given |= bit;
    *option->value = value;
    return 1;
}

/* Returns 0 after complaining: standard input can be read once. */
static int take_operand(arguments *args, char *word)
{
    for (int i = 0; i < args->operand_count && strcmp(word, "-") == 0; i++) {
        if (strcmp(args->operands[i], "-") == 0) {
            complain(word, "standard input is given twice");
            return 0;
        }
    }
    args->operands[args->operand_count++] = word;
    return 1;
}

int args_parse(arguments *args, int argc, char **argv)
{
    int options_ended = 0;
    uint64_t given = 0;
    args->operands = argv;
    args->operand_count = 0;
    for (int i = 1; i < argc; i++) {
        char *word = argv[i];
        if (options_ended || word[0] != '-' || word[1] == '\0') {
            if (!take_operand(args, word)) {
                return EXIT_BAD_CALL;
            }
        } else if (strcmp(word, "--") == 0) {
            options_ended = 1;
        } else if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) {
            fputs(args->help, stdout);
            return EXIT_DONE;
        } else {
            int has_next = i + 1 < argc;
            const char *next = has_next ? argv[i + 1] : NULL;
            if (!take_option(&given, args, word, &next)) {
                return EXIT_BAD_CALL;
            }
            i += has_next && !next;
        }
    }
    return ARGS_GO;
}

int args_numbers(int32_t *numbers, int count, char separator, const char *text)
{
    for (int i = 0; i < count; i++) {
        int digit = *text == '-' ? text[1] : *text;
        char *end;
        long long number = strtoll(text, &end, 10);
        const char *expected = i + 1 < count ? (char[]){separator, '\0'} : "";
        if (digit < '0' || digit > '9' || *end != *expected || number < INT32_MIN || number > INT32_MAX) {
            return 0;
        }
        numbers[i] = (int32_t)number;
        text = end + 1;
    }
    return 1;
}

int args_wholes(const args_whole *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const args_whole *n = &numbers[i];
        if (n->text && (!args_numbers(n->to, 1, ',', n->text) || *n->to < n->least || *n->to > n->most)) {
            complain(n->option, "a whole number from %d to %d, not '%s'", (int)n->least, (int)n->most,
                     n->text);
            return 0;
        }
    }
    return 1;
}

int args_q16(int32_t *number, int32_t least_q16, int32_t most_q16, const char *text)
{
    int64_t sign = text[0] == '-' ? -1 : 1;
    int64_t whole = 0, fraction = 0, scale = 1;
    int digits = 0, after_point = 0;
    for (text += sign < 0; *text != '\0'; text++) {
        if (*text == '.' && !after_point) {
            after_point = 1;
            continue;
        }
        if (*text < '0' || *text > '9' || whole > INT16_MAX + 1) {
            return 0;
        }
        if (!after_point) {
            whole = whole * 10 + (*text - '0');
        } else if (scale < 1000000000000) { /* further digits weigh nothing */
            fraction = fraction * 10 + (*text - '0');
            scale *= 10;
        }
        digits++;
    }
    int64_t q16 = sign * (whole * 65536 + (fraction * 131072 + scale) / (2 * scale));
    *number = (int32_t)q16;
    return digits > 0 && q16 >= least_q16 && q16 <= most_q16;
}

int args_rect(iris_rect *rect, const char *option, const char *text)
{
    int32_t n[4];
    if (!args_numbers(n, 4, ',', text) || n[0] < 0 || n[1] < 0 || n[2] < 1 || n[3] < 1) {
        complain(option, "x,y,w,h in pixels, w and h at least 1, not '%s'", text);
        return 0;
    }
    *rect = (iris_rect){n[0], n[1], n[2], n[3]};
    return 1;
}
