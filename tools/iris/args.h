/* The command line of one command: options and operands in any order.
 *
 * --name, --name=value, --name value, and single letters (-o value, -ovalue). "--" ends the options, "-" is an operand
 * (standard input; once). Options with a value are given once. --help prints the command's help.
 */
#ifndef IRIS_TOOL_ARGS_H
#define IRIS_TOOL_ARGS_H

#include <stddef.h>
#include <stdint.h>

#include "iris/image.h"

/* What args_parse returns when the command is to go on; anything else is the exit code. */
#define ARGS_GO (-1)

typedef struct {
    const char *name;   /* without dashes */
    char letter;        /* the short form; 0: none */
    int *flag;          /* becomes 1 when given; null for an option with a value */
    const char **value; /* becomes the value, which is given once; null for a flag */
} args_option;

typedef struct {
    const char *help; /* what --help prints */
    const args_option *options;
    size_t option_count; /* at most 64 */
    char **operands;     /* what is no option, in order: the front of argv, which is reordered */
    int operand_count;
} arguments;

/* argv[0] is the command's name. Complains about what is wrong; returns ARGS_GO, EXIT_DONE (help was printed), or
 * EXIT_BAD_CALL. */
int args_parse(arguments *args, int argc, char **argv);

/* Reads exactly `count` whole numbers with `separator` between them: "320x240", "1,2,3,4". 1 when text is that, else 0
 * with numbers undefined. */
int args_numbers(int32_t *numbers, int count, char separator, const char *text);

/* An option whose value is a whole number within limits. */
typedef struct {
    const char *option; /* with dashes */
    const char *text;   /* null: not given, *to stays */
    int32_t *to;
    int32_t least, most;
} args_whole;

/* Reads all of them. Complains about the first that is wrong and returns 0. */
int args_wholes(const args_whole *numbers, size_t count);

/* Reads a decimal number such as "1.4", "-0.25", or "3" with 16 fraction bits, rounded half away from zero. 1 when text
 * is that and within `least` to `most`, else 0 with *number undefined. */
int args_q16(int32_t *number, int32_t least_q16, int32_t most_q16, const char *text);

/* Reads x,y,w,h with x and y at least 0, w and h at least 1. Complains about `option` and returns 0 otherwise. */
int args_rect(iris_rect *rect, const char *option, const char *text);

#endif
