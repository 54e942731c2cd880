/* Calls of operations on pictures, as tests/random_calls.c makes them, but chosen by the input. */
#include "../calls/calls.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

#define CALLS_MODULE(module) calls_##module,
static const random_call *const modules[] = {
#include "../calls/modules.def"
};
#undef CALLS_MODULE
enum { MODULES = sizeof modules / sizeof modules[0] };

/* The first byte chooses the module, the second the function. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    if (bytes < 2) {
        return 0;
    }
    const random_call *module = modules[data[0] % MODULES];
    int count = 0;
    while (module[count].name) {
        count++;
    }
    const random_call *function = &module[data[1] % count];
    calls_start(0, function->name);
    calls_choose(data + 2, bytes - 2);
    function->call();
    return 0;
}
