/* Times every case on this machine and prints `nanoseconds-per-pixel name`: the best of many short rounds.
 *     bench-time [PART]      only the cases with this in their name */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define W          640
#define H          480
#define ROUNDS     15
#define ROUND_NSEC 3e6

static IRIS_SCRATCH_BUFFER(memory, 24u << 20);

static double now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
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

static double best_of(const bench_case *c)
{
    bench_frame_begin((iris_size){W, H}, memory.memory, sizeof memory.memory);
    if (c->prepare) {
        c->prepare();
    }
    iris_status status = c->run();
    if (bench_refused(status)) {
        fprintf(stderr, "%s: %s\n", c->name, iris_status_text(status));
        exit(1);
    }
    int runs = 1;
    while (round_of(c, runs) < ROUND_NSEC) {
        runs *= 2;
    }
    double best = round_of(c, runs);
    for (int i = 1; i < ROUNDS; i++) {
        double took = round_of(c, runs);
        best = took < best ? took : best;
    }
    return best / runs;
}

int main(int argc, char **argv)
{
    for (const bench_case *const *module = bench_modules; *module; module++) {
        for (const bench_case *c = *module; c->name; c++) {
            if (argc < 2 || strstr(c->name, argv[1])) {
                printf("%.3f %s\n", best_of(c) / (W * H), c->name);
            }
        }
    }
    return 0;
}
