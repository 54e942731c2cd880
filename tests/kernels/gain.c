/* What each kernel of this port is worth beside its plain body.
 *
 *     kernel_gain           runs both between the markers that icnt.c counts; prints `case`, plain before port
 *     kernel_gain --time    prints `plain port case`: nanoseconds per pixel, the least of many rounds
 *
 * A case is called with the parameters that it draws for a test, the same ones for both bodies. */
#include "kernels.h"
#include "markers.h"

#include <stdio.h>
#include <time.h>

enum { WIDTH = 640, DRAWS = 8, ROUNDS = 40, CALLS = 16, AROUND = 1024 };
enum { ROOM = 64 }; /* bytes of a pixel, at most */

#define KERNEL_FAMILY(family) &kernels_##family,
static const kernel_family *const families[] = {
#include "families.def"
};
#undef KERNEL_FAMILY

static uint8_t memory[KERNEL_ROWS][WIDTH * ROOM + 2 * AROUND] __attribute__((aligned(64)));

static void fill_rows(const kernel_case *c, uint8_t **rows)
{
    if (c->choose) {
        c->choose();
    }
    for (int k = 0; k < KERNEL_ROWS && c->rows[k].fill; k++) {
        size_t bytes = c->rows[k].fixed ? c->rows[k].fixed : sizeof memory[k];
        size_t first = c->rows[k].fixed ? AROUND : 0;
        c->rows[k].fill(memory[k] + first, bytes);
        rows[k] = memory[k] + AROUND;
    }
}

static void count(const kernel_case *c, uint8_t **rows)
{
    for (int plain = 1; plain >= 0; plain--) {
        START();
        c->run(plain, rows, WIDTH);
        STOP();
        puts(c->name);
    }
}

static double nanoseconds(const kernel_case *c, int plain, uint8_t **rows)
{
    struct timespec start, end;
    clock_gettime(CLOCK_MONOTONIC, &start);
    for (int call = 0; call < CALLS; call++) {
        c->run(plain, rows, WIDTH);
    }
    clock_gettime(CLOCK_MONOTONIC, &end);
    return ((double)(end.tv_sec - start.tv_sec) * 1e9 + (double)(end.tv_nsec - start.tv_nsec)) / CALLS;
}

static void measure_time(const kernel_case *c, uint8_t **rows)
{
    double least[2] = {1e12, 1e12};
    for (int round = 0; round < ROUNDS; round++) {
        for (int plain = 0; plain < 2; plain++) {
            double took = nanoseconds(c, plain, rows);
            least[plain] = took < least[plain] ? took : least[plain];
        }
    }
    printf("%.4f %.4f %s\n", least[1] / WIDTH, least[0] / WIDTH, c->name);
}

int main(int argc, char **argv)
{
    int timed = argc > 1 && strcmp(argv[1], "--time") == 0;
    uint8_t *rows[KERNEL_ROWS];
    for (size_t f = 0; f < sizeof families / sizeof families[0]; f++) {
        for (size_t i = 0; i < families[f]->count; i++) {
            const kernel_case *c = &families[f]->cases[i];
            for (int draw = 0; c->port != c->plain && draw < DRAWS; draw++) {
                fill_rows(c, rows);
                if (timed) {
                    measure_time(c, rows);
                } else {
                    count(c, rows);
                }
            }
        }
    }
    return 0;
}
