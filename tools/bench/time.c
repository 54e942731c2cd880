/* Times every case on this machine and prints `nanoseconds-per-pixel name`: the best of many short rounds. */
#include "bench.h"

#include <stdio.h>
#include <time.h>

#define ROUNDS     15
#define ROUND_NSEC 4e6

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
        c->run();
    }
    return now_ns() - start;
}

int main(void)
{
    for (const bench_case *c = bench_cases; c->name; c++) {
        c->prepare();
        int runs = 1;
        while (round_of(c, runs) < ROUND_NSEC) {
            runs *= 2;
        }
        double best = round_of(c, runs);
        for (int i = 1; i < ROUNDS; i++) {
            double took = round_of(c, runs);
            best = took < best ? took : best;
        }
        printf("%.3f %s\n", best / runs / c->pixels, c->name);
    }
    return 0;
}
