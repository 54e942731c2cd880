/* The list of picture operations. */
#include <string.h>

#include "commands.h"

#define OPERATION(name) &operation_##name,
const operation *const operations[] = {
#include "operations.def"
    NULL,
};
#undef OPERATION

const operation *operation_find(const char *name)
{
    for (size_t i = 0; operations[i]; i++) {
        if (strcmp(operations[i]->name, name) == 0) {
            return operations[i];
        }
    }
    return NULL;
}
