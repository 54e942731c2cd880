/* The list of cases. */
#include "bench.h"

#define BENCH_MODULE(module) bench_##module,
const bench_case *const bench_modules[] = {
#include "modules.def"
    NULL,
};
#undef BENCH_MODULE
