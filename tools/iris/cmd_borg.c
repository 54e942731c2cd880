#include <stdlib.h>
#include <string.h>

#include "args.h"
#include "cmd_borg_run.h"
#include "commands.h"
#include "complain.h"
#include "file_write.h"
#include "floor_file.h"
#include "iris/borg/chunk_text.h"
#include "iris/borg/script.h"
#include "json.h"

static const char help[] =
    "usage: iris borg check SCRIPT [--timeout S] [--json]\n"
    "       iris borg format SCRIPT [-o OUT]\n"
    "       iris borg decompose SCRIPT [--timeout S] [--chunks] [--bytecode] [--json] [-o OUT]\n"
    "       iris borg run SCRIPT ..., which has a help of its own: iris borg run --help\n\n"
    "BorgCode, one script for a team of robots: check says what is wrong with it, format writes it in one\n"
    "form, and decompose takes it apart into a chunk for each group of robots.\n\n"
    "  --timeout S seconds of groups for which the script names none, 1 to 65535; default: 60\n"
    "  --chunks    SCRIPT is the text of chunks, as decompose writes them and people change them\n"
    "  --bytecode  writes the bytes of chunks, one after the other, at most 512 each\n"
    "  --json      one JSON object: file, script (its number, the same in all of a team), groups or chunks,\n"
    "              each with ref, units, timeout_s, bytes (of bytecode), and of chunks their text\n"
    "  -o OUT      default: standard output\n\n"
    "  script    = START [TIMEOUT=s] {statement} END     statement = group | IF | WHILE | effect\n"
    "  group     = UNITS=n [TIMEOUT=s] : action {, action} [;]        with a line number before it\n"
    "  IF        = IF (condition) block [ELSE block]     WHILE = WHILE (condition) block\n"
    "  block     = \"[\" {IF | WHILE | effect} \"]\"\n"
    "  effect    = REF(line):UNITS(k).action [;] | REF(line):UNITS(k OF n).action [;]\n"
    "  action    = LineFollow[(mm/s)] | ObjDetect | AutoExplore[(mm/s)] | MapBuild | Go(x, y) |\n"
    "              Go(REF(line):UNITS(k).Target) | Turn(degrees) | Stop | ResetTime\n"
    "  condition = REF(line):UNITS(k).predicate [==TRUE | ==FALSE], with AND, OR, NOT, and ( )\n"
    "  predicate = ObjDetect | TimeOut | Reached | LineEnd | Bumped | BatteryLow\n\n"
    "A number at the beginning of a line is that line's, and REF names it; // begins a comment. TIMEOUT is\n"
    "in seconds, 60 where none is named. Each machine counts its own time from its last ResetTime, so a\n"
    "group that reacts to the TimeOut of another one needs the same TIMEOUT.\n\n"
    "example: iris borg decompose examples/scripts/explore.borg\n";

typedef struct {
    uint8_t bytes[BORG_CHUNK_BYTES_MAX];
    size_t length;
    char text[BORG_CHUNK_TEXT_BYTES];
} piece;

typedef struct {
    const char *path, *output;
    int chunks, bytecode, json;
    const char *timeout;
    int32_t timeout_s;
    char source[BORG_TEXT_BYTES_MAX];
    borg_text text;
    borg_script script;
    borg_problem problem;
    char *formatted;
    size_t formatted_length;
    piece *pieces;
    int count;
} work;

#define FORMATTED_BYTES (1 << 22)

/* file:line:column: what was expected */
static int complain_at(const work *w, const borg_problem *problem)
{
    char place[1200];
    snprintf(place, sizeof place, "%.1150s:%d:%d", w->path, (int)problem->line, (int)problem->column);
    complain(place, "%s", problem->expected);
    return EXIT_BAD_DATA;
}

static int add_piece(work *w)
{
    piece *more = realloc(w->pieces, (size_t)(w->count + 1) * sizeof *more);
    if (!more) {
        complain(w->path, "not enough memory");
        return 0;
    }
    w->pieces = more;
    return 1;
}

static int write_piece_text(work *w)
{
    piece *p = &w->pieces[w->count];
    size_t length = 0;
    if (borg_chunk_write_text(p->text, sizeof p->text, &length, p->bytes, p->length) != IRIS_OK) {
        complain(w->path, "a chunk's text is too long");
        return 0;
    }
    w->count++;
    return 1;
}

static int decompose_script(work *w)
{
    if (w->script.timeout_s == 0) {
        w->script.timeout_s = (uint16_t)w->timeout_s; /* 0: none was asked for */
    }
    for (int32_t i = 0; i < w->script.group_count; i++) {
        if (!add_piece(w)) {
            return EXIT_BAD_DATA;
        }
        piece *p = &w->pieces[w->count];
        if (borg_script_decompose(p->bytes, sizeof p->bytes, &p->length, &w->script, i) != IRIS_OK) {
            complain(w->path, "a chunk is too long"); /* which was seen before */
            return EXIT_BAD_DATA;
        }
        if (!write_piece_text(w)) {
            return EXIT_BAD_DATA;
        }
    }
    return EXIT_DONE;
}

static int is_named_twice(const work *w)
{
    for (int i = 0; i < w->count; i++) {
        if (borg_chunk_ref(w->pieces[i].bytes) == borg_chunk_ref(w->pieces[w->count].bytes)) {
            return 1;
        }
    }
    return 0;
}

static int read_chunks(work *w)
{
    size_t position = 0;
    for (;;) {
        if (!add_piece(w)) {
            return EXIT_BAD_DATA;
        }
        piece *p = &w->pieces[w->count];
        const iris_status status =
            borg_chunk_read_text(p->bytes, sizeof p->bytes, &p->length, &position, &w->problem, &w->text);
        if (status == IRIS_ERR_END && w->count > 0) {
            return EXIT_DONE;
        }
        if (status == IRIS_ERR_DATA) {
            return complain_at(w, &w->problem);
        }
        if (status != IRIS_OK || is_named_twice(w)) {
            complain(w->path, "chunk %d: %s", w->count + 1,
                     status == IRIS_OK        ? "a chunk before it is of the same line: a group is named once"
                     : status == IRIS_ERR_END ? "no chunks are in this file"
                                              : "more than 512 bytes of bytecode");
            return EXIT_BAD_DATA;
        }
        if (!write_piece_text(w)) {
            return EXIT_BAD_DATA;
        }
    }
}

static void write_json(FILE *file, const work *w, int with_text)
{
    json_writer json = json_to(file);
    json_open(&json, '{');
    json_key(&json, "file");
    json_string(&json, w->path);
    uint32_t number = 0;
    for (int i = 0; i < w->count; i++) {
        number = borg_chunk_number(number, w->pieces[i].bytes, w->pieces[i].length);
    }
    json_key(&json, "script");
    json_integer(&json, number);
    json_key(&json, with_text ? "chunks" : "groups");
    json_open(&json, '[');
    for (int i = 0; i < w->count; i++) {
        const piece *p = &w->pieces[i];
        const struct {
            const char *key;
            int32_t value;
        } numbers[] = {{"ref", borg_chunk_ref(p->bytes)},
                       {"units", borg_chunk_units(p->bytes)},
                       {"timeout_s", borg_chunk_timeout_s(p->bytes)},
                       {"bytes", (int32_t)p->length}};
        json_open(&json, '{');
        for (size_t j = 0; j < sizeof numbers / sizeof numbers[0]; j++) {
            json_key(&json, numbers[j].key);
            json_integer(&json, numbers[j].value);
        }
        if (with_text) {
            json_key(&json, "text");
            json_string(&json, p->text);
        }
        json_close(&json, '}');
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static int write_formatted(FILE *file, const void *user)
{
    const work *w = user;
    return fwrite(w->formatted, 1, w->formatted_length, file) == w->formatted_length && fflush(file) == 0;
}

static int write_chunks(FILE *file, const void *user)
{
    const work *w = user;
    if (w->json) {
        write_json(file, w, 1);
    }
    for (int i = 0; i < w->count && !w->json; i++) {
        const piece *p = &w->pieces[i];
        if (w->bytecode) {
            fwrite(p->bytes, 1, p->length, file);
        } else {
            fprintf(file, "%s// Chunk %d: %d bytes of bytecode\n%s", i > 0 ? "\n" : "", i + 1, (int)p->length,
                    p->text);
        }
    }
    return fflush(file) == 0 && !ferror(file);
}

static int run_format(work *w)
{
    w->formatted = malloc(FORMATTED_BYTES);
    if (!w->formatted || borg_script_format(w->formatted, FORMATTED_BYTES, &w->formatted_length, &w->script,
                                            &w->problem, &w->text) != IRIS_OK) {
        complain(w->path, "not enough memory");
        return EXIT_BAD_DATA;
    }
    return file_write(w->output, write_formatted, w) ? EXIT_DONE : EXIT_BAD_DATA;
}

static int run(work *w, const char *what)
{
    if (!text_file_read(w->source, sizeof w->source, &w->text.length, w->path)) {
        return EXIT_BAD_DATA;
    }
    w->text.at = w->source;
    if (!w->chunks && borg_script_read(&w->script, &w->problem, &w->text) != IRIS_OK) {
        return complain_at(w, &w->problem);
    }
    if (strcmp(what, "format") == 0) {
        return run_format(w);
    }
    const int code = w->chunks ? read_chunks(w) : decompose_script(w);
    if (code != EXIT_DONE) {
        return code;
    }
    if (strcmp(what, "decompose") == 0) {
        return file_write(w->output, write_chunks, w) ? EXIT_DONE : EXIT_BAD_DATA;
    }
    if (w->json) {
        write_json(stdout, w, 0);
    } else {
        printf("%s: %d group%s, nothing wrong\n", w->path, w->count, w->count == 1 ? "" : "s");
    }
    return EXIT_DONE;
}

/* What was asked for; null when it complained. */
static const char *asked_for(const arguments *args, const work *w)
{
    static const char *const kinds[] = {"check", "format", "decompose"};
    const char *what = args->operand_count > 0 ? args->operands[0] : "";
    size_t kind = 0;
    while (kind < 3 && strcmp(what, kinds[kind]) != 0) {
        kind++;
    }
    if (kind == 3) {
        complain(*what ? what : NULL,
                 "check, format, decompose, or run is to stand behind borg (see --help)");
    } else if (args->operand_count != 2) {
        complain(NULL, "one script is needed (see --help)");
    } else if (kind < 2 && (w->chunks || w->bytecode)) {
        complain(w->chunks ? "--chunks" : "--bytecode", "only with decompose");
    } else if (kind == 0 && strcmp(w->output, "-") != 0) {
        complain("-o", "not with check");
    } else if (w->timeout && (kind == 1 || w->chunks)) {
        complain("--timeout", w->chunks ? "not with --chunks: a chunk has its own" : "not with format");
    } else if (w->json && (kind == 1 || w->bytecode)) {
        complain("--json", "not with %s", kind == 1 ? "format" : "--bytecode");
    } else {
        return kinds[kind];
    }
    return NULL;
}

int cmd_borg(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "run") == 0) {
        return cmd_borg_run(argc - 1, argv + 1);
    }
    static work w;
    const char *output = NULL;
    const args_option options[] = {{"chunks", 0, &w.chunks, NULL},
                                   {"bytecode", 0, &w.bytecode, NULL},
                                   {"json", 0, &w.json, NULL},
                                   {"timeout", 0, NULL, &w.timeout},
                                   {"output", 'o', NULL, &output}};
    arguments args = {.help = help, .options = options, .option_count = sizeof options / sizeof options[0]};
    int code = args_parse(&args, argc, argv);
    if (code != ARGS_GO) {
        return code;
    }
    w.output = output ? output : "-";
    const args_whole timeout = {"--timeout", w.timeout, &w.timeout_s, 1, UINT16_MAX};
    if (w.timeout && !args_wholes(&timeout, 1)) {
        return EXIT_BAD_CALL;
    }
    const char *what = asked_for(&args, &w);
    if (!what) {
        return EXIT_BAD_CALL;
    }
    w.path = args.operands[1];
    code = run(&w, what);
    free(w.pieces);
    free(w.formatted);
    return code;
}
