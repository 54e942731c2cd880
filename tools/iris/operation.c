#include "operation.h"

#include <string.h>

#define OPTIONS_MAX 32

/* --border: replicate, reflect, constant, constant:N, or skip. */
static int read_border(iris_border *border, const char *text)
{
    static const char *const rules[] = {"replicate", "reflect", "constant", "skip"};
    static const char constant[] = "constant:";
    int32_t value;
    for (int rule = IRIS_BORDER_REPLICATE; rule <= IRIS_BORDER_SKIP; rule++) {
        if (strcmp(text, rules[rule]) == 0) {
            *border = (iris_border){(iris_border_rule)rule, 0};
            return 1;
        }
    }
    if (strncmp(text, constant, sizeof constant - 1) == 0 &&
        args_numbers(&value, 1, ',', text + sizeof constant - 1) && value >= 0 && value <= 255) {
        *border = (iris_border){IRIS_BORDER_CONSTANT, (uint8_t)value};
        return 1;
    }
    complain("--border", "skip, replicate, reflect, constant, or constant:0 to constant:255, not '%s'", text);
    return 0;
}

/* Options that words of a pipe may not have are left out. */
static size_t shared_options(args_option *options, operation_words *words, const char **roi,
                             const char **border)
{
    const operation *run = words->stage->operation;
    size_t count = 0;
    if (!run->reshapes) {
        options[count++] = (args_option){"roi", 0, NULL, roi};
    }
    if (run->has_border || !run->reshapes) {
        options[count++] = (args_option){"border", 0, NULL, border};
    }
    if (!words->in_pipe) {
        options[count++] = (args_option){"output", 'o', NULL, &words->output};
        options[count++] = (args_option){"json", 0, &words->json, NULL};
    }
    return count;
}

int operation_options(operation_words *words, const args_option *options, size_t count)
{
    args_option all[OPTIONS_MAX];
    const char *roi = NULL, *border = NULL;
    if (count > OPTIONS_MAX - 4) {
        complain(NULL, "too many kinds of options");
        words->exit_code = EXIT_BAD_CALL;
        return 0;
    }
    if (count > 0) {
        memcpy(all, options, count * sizeof *options);
    }
    count += shared_options(all + count, words, &roi, &border);
    words->arguments = (arguments){words->stage->operation->help, all, count, NULL, 0};
    words->exit_code = args_parse(&words->arguments, words->argc, words->argv);
    words->arguments.options = NULL;
    if (words->exit_code != ARGS_GO) {
        return 0;
    }
    words->exit_code = EXIT_BAD_CALL;
    if (words->in_pipe && words->arguments.operand_count > 0) {
        complain(NULL, "inputs stand behind the quoted operations, not among them: '%s'",
                 words->arguments.operands[0]);
        return 0;
    }
    if (border && !read_border(&words->stage->border, border)) {
        return 0;
    }
    if (roi && !args_rect(&words->stage->roi, "--roi", roi)) {
        return 0;
    }
    words->stage->has_roi = roi != NULL;
    words->exit_code = ARGS_GO;
    return 1;
}

int operation_parse(operation_words *words)
{
    operation_stage *stage = words->stage;
    words->exit_code = EXIT_BAD_CALL;
    stage->settings = stage->memory.bytes;
    if (stage->operation->parse(stage->memory.bytes, words)) {
        words->exit_code = ARGS_GO;
    } else if (words->exit_code == ARGS_GO) {
        words->exit_code = EXIT_BAD_CALL;
    }
    return words->exit_code;
}
