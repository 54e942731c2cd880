/* IRIS's side of `make bench-peers`: does what peers.py says, a line at a time, and answers each line with one.
 *
 *     case W H|GRAY|COLOR|MASK|NAME    prepares a case; the files hold pixels, row by row, or are -:  ok
 *     run N                            calls it N times:                                              nanoseconds
 *     result FILE                      writes the result's rows to it:                                W H FORMAT
 *
 * The clock is the processor time of this process: what else runs on the machine does not count.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "peers.h"

static IRIS_SCRATCH_BUFFER(memory, 128u << 20);
static const peer_case *const modules[] = {peer_color, peer_filter, peer_edge, peer_mask,
                                           peer_place, peer_space,  peer_file};
static const peer_case *now;
iris_image peer_result;

void peer_gives_gray(void)
{
    peer_result = bench_frame.gray_to;
}

void peer_gives_color(void)
{
    peer_result = bench_frame.rgb_to;
}

void peer_gives_mask(void)
{
    peer_result = bench_frame.mask_to;
}

void peer_gives_numbers(int32_t w, int32_t h)
{
    peer_result = bench_canvas_of(IRIS_GRAY_U32, w, h);
}

void peer_number(int32_t x, int32_t y, int64_t number)
{
    ((uint32_t *)iris_image_row(&peer_result, y))[x] = (uint32_t)number;
}

static void fail(const char *what, const char *which)
{
    fprintf(stderr, "bench-peers: %s: %s\n", which, what);
    exit(1);
}

static void load(const iris_image *image, const char *path)
{
    size_t bytes = iris_format_row_bytes(image->format, image->w) * (size_t)image->h;
    FILE *file = strcmp(path, "-") ? fopen(path, "rb") : NULL;
    if (file && fread(image->data, 1, bytes, file) != bytes) {
        fail("too short", path);
    }
    if (file) {
        fclose(file);
    } else if (strcmp(path, "-") != 0) {
        fail("cannot be opened", path);
    }
}

static const peer_case *find(const char *name)
{
    for (size_t m = 0; m < sizeof modules / sizeof modules[0]; m++) {
        for (const peer_case *c = modules[m]; c->name; c++) {
            if (strcmp(c->name, name) == 0) {
                return c;
            }
        }
    }
    fail("no such case", name);
    return NULL;
}

static void begin(char *line)
{
    iris_size size = {0, 0};
    const char *part = strtok(line, "|");
    const char *files[4];
    if (!part || sscanf(part, "%d %d", &size.w, &size.h) != 2) {
        fail("no size", line);
    }
    for (int i = 0; i < 4; i++) {
        files[i] = strtok(NULL, "|");
        if (!files[i]) {
            fail("too few parts", line);
        }
    }
    now = find(files[3]);
    bench_frame_begin(size, memory.memory, sizeof memory.memory);
    load(&bench_frame.gray, files[0]);
    load(&bench_frame.rgb, files[1]);
    load(&bench_frame.mask, files[2]);
    now->prepare();
    if (!peer_result.data) {
        fail("too little memory", now->name);
    }
    iris_status status = now->run();
    if (status != IRIS_OK) {
        fail(iris_status_text(status), now->name);
    }
    puts("ok");
}

/* A profile of instructions begins and ends with this function. */
__attribute__((noinline)) static void run(int32_t times)
{
    struct timespec start, end;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &start);
    for (int32_t i = 0; i < times; i++) {
        (void)now->run();
    }
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    printf("%lld\n", (long long)(end.tv_sec - start.tv_sec) * 1000000000 + (end.tv_nsec - start.tv_nsec));
}

static void result(const char *path)
{
    FILE *file = fopen(path, "wb");
    if (!file) {
        fail("cannot be written", path);
        return;
    }
    if (now->report) {
        now->report();
    }
    for (int32_t y = 0; y < peer_result.h; y++) {
        fwrite(iris_image_row(&peer_result, y), 1, iris_format_row_bytes(peer_result.format, peer_result.w),
               file);
    }
    if (fclose(file) != 0) {
        fail("cannot be written", path);
    }
    printf("%d %d %d\n", peer_result.w, peer_result.h, peer_result.format);
}

int main(void)
{
    char line[4096];
    while (fgets(line, sizeof line, stdin)) {
        line[strcspn(line, "\n")] = '\0';
        if (strncmp(line, "case ", 5) == 0) {
            begin(line + 5);
        } else if (now && strncmp(line, "run ", 4) == 0) {
            run((int32_t)strtol(line + 4, NULL, 10));
        } else if (now && strncmp(line, "result ", 7) == 0) {
            result(line + 7);
        } else {
            fail("not understood", line);
        }
        fflush(stdout);
    }
    return 0;
}
