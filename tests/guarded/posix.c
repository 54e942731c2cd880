#include "guarded.h"

#include <sys/mman.h>
#include <unistd.h>

int guarded_by_pages(void)
{
    return 1;
}

size_t guarded_page_bytes(void)
{
    return (size_t)sysconf(_SC_PAGESIZE);
}

uint8_t *guarded_memory(size_t bytes)
{
    size_t page = guarded_page_bytes();
    uint8_t *map = mmap(NULL, bytes + 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (map == MAP_FAILED || mprotect(map, page, PROT_NONE) != 0 ||
        mprotect(map + page + bytes, page, PROT_NONE) != 0) {
        return NULL;
    }
    return map + page;
}
