/* Runs every case once between two marker instructions (icnt.c) and prints `pixels name`, ordered by the counts. */
#include "bench.h"
#include "markers.h"

#define W 160
#define H 120

static IRIS_SCRATCH_BUFFER(memory, 3u << 19); /* firmware, which the boards of 4 MB have room for */

static void print_number(int32_t number)
{
    char text[12], *digit = text + sizeof text - 1;
    *digit = '\0';
    do {
        *--digit = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    target_print(digit);
}

int main(void)
{
    for (const bench_case *const *module = bench_modules; *module; module++) {
        for (const bench_case *c = *module; c->name; c++) {
            bench_frame_begin((iris_size){W, H}, memory.memory, sizeof memory.memory);
            if (c->prepare) {
                c->prepare();
            }
            START();
            iris_status status = c->run();
            STOP();
            print_number(W * H);
            target_print(" ");
            target_print(c->name);
            target_print(bench_refused(status) ? " is refused\n" : "\n");
            if (bench_refused(status)) {
                return 1;
            }
        }
    }
    return 0;
}
