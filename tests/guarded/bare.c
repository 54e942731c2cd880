/* Bare metal has no pages: a write past an end is seen by who compares what is around. */
#include "guarded.h"

#include <stdlib.h>

int guarded_by_pages(void)
{
    return 0;
}

size_t guarded_page_bytes(void)
{
    return 64;
}

uint8_t *guarded_memory(size_t bytes)
{
    return malloc(bytes);
}
