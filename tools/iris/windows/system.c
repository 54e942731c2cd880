#include "../system.h"

#include <direct.h>
#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <windows.h>

#include "../complain.h"

int system_begin(void)
{
    return _setmode(STDIN_FILENO, _O_BINARY) != -1 && _setmode(STDOUT_FILENO, _O_BINARY) != -1 &&
           _setmode(STDERR_FILENO, _O_BINARY) != -1;
}

/* isatty calls NUL a terminal. */
int system_is_terminal(int fd)
{
    DWORD mode;
    return GetConsoleMode((HANDLE)_get_osfhandle(fd), &mode) != 0;
}

int64_t system_clock_ms(void)
{
    return (int64_t)GetTickCount64();
}

int64_t system_clock_us(void)
{
    return system_clock_ms() * 1000;
}

void system_sleep_ms(int32_t ms)
{
    Sleep((DWORD)ms);
}

/* malloc aligns to 16. */
void *system_scratch(size_t bytes)
{
    return malloc(bytes);
}

int system_is_separator(char c)
{
    return c == '/' || c == '\\' || c == ':';
}

int system_open(const char *path)
{
    return _open(path, _O_RDONLY | _O_BINARY | _O_NOINHERIT);
}

/* Returns 0 when there is no such file. */
static int identify(BY_HANDLE_FILE_INFORMATION *file, const char *path)
{
    HANDLE handle = CreateFileA(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                                OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL);
    int done = handle != INVALID_HANDLE_VALUE && GetFileInformationByHandle(handle, file);
    if (handle != INVALID_HANDLE_VALUE) {
        CloseHandle(handle);
    }
    return done;
}

int system_is_same_file(const char *a, const char *b)
{
    BY_HANDLE_FILE_INFORMATION of_a, of_b;
    return identify(&of_a, a) && identify(&of_b, b) &&
           of_a.dwVolumeSerialNumber == of_b.dwVolumeSerialNumber &&
           of_a.nFileIndexHigh == of_b.nFileIndexHigh && of_a.nFileIndexLow == of_b.nFileIndexLow;
}

int system_make_folder(const char *path)
{
    return _mkdir(path);
}

int system_is_special(const char *path)
{
    struct stat existing;
    return stat(path, &existing) == 0 && !S_ISREG(existing.st_mode);
}

/* Opens a file of a name that nobody has yet, beside `path`. Returns NULL with errno set. */
static FILE *open_beside(char temporary[PATH_MAX], const char *path)
{
    for (unsigned tried = 0; tried < 100; tried++) {
        int length = snprintf(temporary, PATH_MAX, "%s.iris-%lx-%u", path, GetCurrentProcessId(), tried);
        if (length >= PATH_MAX) {
            errno = ENAMETOOLONG;
            return NULL;
        }
        int fd =
            _open(temporary, _O_WRONLY | _O_BINARY | _O_CREAT | _O_EXCL | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
        if (fd >= 0) {
            return _fdopen(fd, "wb");
        }
        if (errno != EEXIST) {
            return NULL;
        }
    }
    return NULL;
}

int system_replace(const char *path, file_writer write, const void *user)
{
    char temporary[PATH_MAX];
    if (_access(path, 0) == 0 && _access(path, 2) != 0) { /* read-only */
        complain(path, "%s", strerror(errno));
        return 0;
    }
    FILE *file = open_beside(temporary, path);
    if (!file) {
        complain(path, "%s", file_write_problem());
        return 0;
    }
    int done = write(file, user);
    if (fclose(file) != 0) {
        done = 0;
    }
    if (done && !MoveFileExA(temporary, path, MOVEFILE_REPLACE_EXISTING)) {
        errno = EACCES; /* somebody has it open */
        done = 0;
    }
    if (!done) {
        const char *problem = file_write_problem();
        _unlink(temporary);
        complain(path, "%s", problem);
    }
    return done;
}
