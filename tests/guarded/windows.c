#include "guarded.h"

#include <windows.h>

int guarded_by_pages(void)
{
    return 1;
}

size_t guarded_page_bytes(void)
{
    SYSTEM_INFO system;
    GetSystemInfo(&system);
    return system.dwPageSize;
}

uint8_t *guarded_memory(size_t bytes)
{
    size_t page = guarded_page_bytes();
    DWORD before;
    uint8_t *map = VirtualAlloc(NULL, bytes + 2 * page, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
    if (!map || !VirtualProtect(map, page, PAGE_NOACCESS, &before) ||
        !VirtualProtect(map + page + bytes, page, PAGE_NOACCESS, &before)) {
        return NULL;
    }
    return map + page;
}
