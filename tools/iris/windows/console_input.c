#include "../console_input.h"

#include <windows.h>

/* A console is ready when a key has been pressed, and gives whole lines; of a pipe, what is in it can be asked for; a file is
 * always there. */
int console_input(char *bytes, size_t room)
{
    HANDLE in = GetStdHandle(STD_INPUT_HANDLE);
    DWORD there = 0, count = 0;
    const DWORD kind = GetFileType(in);
    if (kind == FILE_TYPE_PIPE) {
        if (!PeekNamedPipe(in, NULL, 0, NULL, &there, NULL)) {
            return -1;
        }
        if (there == 0) {
            return 0;
        }
    } else if (kind == FILE_TYPE_CHAR && WaitForSingleObject(in, 0) != WAIT_OBJECT_0) {
        return 0;
    }
    return ReadFile(in, bytes, (DWORD)room, &count, NULL) && count > 0 ? (int)count : -1;
}
