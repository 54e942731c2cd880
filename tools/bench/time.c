/* Times every case on this machine, and prints a line for each sample: nanoseconds per pixel, bytes of working memory per
 * pixel, the size, and the name.
 *     bench-time SIZE,... [PART]       sizes as 640x480; only the cases with this in their name
 *
 * A sample is a short round of calls, in processor time: what else runs on the machine does not count. The bytes are what
 * the call takes from its working memory, at the most. A case that refuses a size has no line. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SAMPLES         3
#define SAMPLE_NSEC     1e6
#define BYTES_PER_PIXEL 64 /* of all pictures and working memory of a case, and some megabytes */
#define BYTES_MORE      ((size_t)4 << 20)

static double now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

static double round_of(const bench_case *c, int runs)
{
    double start = now_ns();
    for (int i = 0; i < runs; i++) {
        (void)c->run();
    }
    return now_ns() - start;
}

static void time_case(const bench_case *c, iris_size size, uint8_t *memory, size_t bytes)
{
    double pixels = (double)size.w * size.h;
    bench_frame_begin(size, memory, bytes);
    if (c->prepare) {
        c->prepare();
    }
    size_t held = iris_scratch_mark(&bench_frame.scratch);
    bench_frame.scratch.peak = held;
    if (bench_refused(c->run())) {
        return;
    }
    double working = (double)(bench_frame.scratch.peak - held) / pixels;
    int runs = 1;
    while (round_of(c, runs) < SAMPLE_NSEC) {
        runs *= 2;
    }
    for (int i = 0; i < SAMPLES; i++) {
        printf("%.4f %.3f %dx%d %s\n", round_of(c, runs) / runs / pixels, working, size.w, size.h, c->name);
    }
}

static int time_size(iris_size size, const char *part)
{
    size_t bytes = (size_t)size.w * (size_t)size.h * BYTES_PER_PIXEL + BYTES_MORE;
    void *memory;
    if (posix_memalign(&memory, 64, bytes) != 0) {
        return 0;
    }
    for (const bench_case *const *module = bench_modules; *module; module++) {
        for (const bench_case *c = *module; c->name; c++) {
            if (strstr(c->name, part)) {
                time_case(c, size, memory, bytes);
            }
        }
    }
    free(memory);
    return 1;
}

int main(int argc, char **argv)
{
    char *sizes = argc > 1 ? argv[1] : NULL;
    for (const char *text = strtok(sizes, ","); text; text = strtok(NULL, ",")) {
        iris_size size;
        char end;
        if (sscanf(text, "%dx%d%c", &size.w, &size.h, &end) != 2 || size.w < 16 || size.h < 16 ||
            size.w > 8191 || size.h > 8191) {
            fprintf(stderr, "bench-time: %s: a size is WxH, 16 to 8191 pixels each\n", text);
            return 2;
        }
        if (!time_size(size, argc > 2 ? argv[2] : "")) {
            fprintf(stderr, "bench-time: %s: too little memory\n", text);
            return 1;
        }
    }
    return 0;
}
