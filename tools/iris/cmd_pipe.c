#include <stdlib.h>
#include <string.h>

#include "chain.h"
#include "commands.h"

static const char help[] =
    "usage: iris pipe \"OPERATION [options] | OPERATION [options] | ...\" [--raw FORMAT:WxH]\n"
    "                 [--json] IN... -o OUT\n\n"
    "Runs operations one after the other on each picture, without files between them.\n"
    "Every command that turns pictures into pictures is an operation, with its options\n"
    "but without -o and --json. Values with spaces stand in quotes.\n\n" RAW_PICTURE_OPTION
    "  --json            one JSON object per picture, with what the last operation found\n"
    "  -o OUT            .bmp, .pgm, or .ppm; a folder for several inputs; -: standard output\n"
    "                    (IN - and OUT -: every picture that comes, in turn)\n\n"
    "example: iris pipe \"gray | threshold --otsu\" floor.bmp -o mask.bmp\n";

/* The words of the text, each ended by a zero, in place; a bar that is not quoted becomes the word null. Returns how
 * many there are, -1 after complaining. words has room for one per character of text. */
static int split(char **words, char *text)
{
    int count = 0;
    char *end = text; /* of what has been kept */
    for (char *from = text; *from != '\0';) {
        char quote = '\0';
        from += strspn(from, " \t\r\n");
        if (*from == '|') {
            words[count++] = NULL;
            from++;
            continue;
        }
        if (*from == '\0') {
            break;
        }
        words[count++] = end;
        for (; *from != '\0' && (quote || !strchr(" \t\r\n|", *from)); from++) {
            if (quote ? *from == quote : *from == '"' || *from == '\'') {
                quote = quote ? '\0' : *from;
            } else {
                *end++ = *from;
            }
        }
        if (quote) {
            complain(NULL, "a quote is not closed in the operations");
            return -1;
        }
        if (*from == '|') { /* its place is needed for the zero */
            words[count++] = NULL;
        }
        from += *from != '\0';
        *end++ = '\0';
    }
    return count;
}

/* The operation that words[0] names reads the others. ARGS_GO, or an exit code. */
static int parse_stage(operation_stage *stage, int count, char **words)
{
    char name[40];
    if (count == 0) {
        complain(NULL, "an operation is missing beside |");
        return EXIT_BAD_CALL;
    }
    stage->operation = operation_find(words[0]);
    if (!stage->operation) {
        complain(NULL, "no such operation: '%s' (see iris --help)", words[0]);
        return EXIT_BAD_CALL;
    }
    snprintf(name, sizeof name, "pipe: %s", stage->operation->name);
    complain_as(name);
    operation_words call = {.argc = count, .argv = words, .in_pipe = 1, .stage = stage};
    int exit_code = operation_parse(&call);
    complain_as("pipe");
    return exit_code;
}

/* Every stretch of words between nulls. ARGS_GO, or an exit code. */
static int parse_stages(operation_stage *stages, int count, char **words)
{
    for (int first = 0, i = 0; i <= count; i++) {
        if (i < count && words[i]) {
            continue;
        }
        int exit_code = parse_stage(stages++, i - first, words + first);
        if (exit_code != ARGS_GO) {
            return exit_code;
        }
        first = i + 1;
    }
    return ARGS_GO;
}

/* words: of the operations. Returns an exit code. */
static int run_pipe(operation_chain *pipe, int count, char **words, const arguments *inputs)
{
    pipe->count = 1;
    for (int i = 0; i < count; i++) {
        pipe->count += !words[i];
    }
    pipe->stages = chain_stages((size_t)pipe->count);
    if (!pipe->stages) {
        return EXIT_BAD_DATA;
    }
    int exit_code = parse_stages(pipe->stages, count, words);
    if (exit_code == ARGS_GO) {
        exit_code = chain_run(pipe, inputs);
    }
    chain_free(pipe->stages, pipe->count);
    return exit_code;
}

int cmd_pipe(int argc, char **argv)
{
    operation_chain pipe = {.command = argv[0]};
    const char *raw = NULL;
    const args_option options[] = {
        {"output", 'o', NULL, &pipe.output}, {"raw", 0, NULL, &raw}, {"json", 0, &pipe.json, NULL}};
    arguments args = {help, options, sizeof options / sizeof options[0], NULL, 0};
    int exit_code = args_parse(&args, argc, argv);
    if (exit_code != ARGS_GO) {
        return exit_code;
    }
    if (raw && !raw_layout_parse(&pipe.raw, raw)) {
        return EXIT_BAD_CALL;
    }
    if (args.operand_count == 0) {
        complain(NULL, "no operations (see --help)");
        return EXIT_BAD_CALL;
    }
    char *text = args.operands[0];
    char **words = calloc(strlen(text) + 2, sizeof *words);
    if (!words) {
        complain(NULL, "not enough memory");
        return EXIT_BAD_DATA;
    }
    int count = split(words, text);
    args.operands++;
    args.operand_count--;
    exit_code = count < 0 ? EXIT_BAD_CALL : run_pipe(&pipe, count, words, &args);
    free(words);
    return exit_code;
}
