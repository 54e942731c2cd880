#include "../console_input.h"

#include <errno.h>
#include <poll.h>
#include <unistd.h>

int console_input(char *bytes, size_t room)
{
    struct pollfd in = {STDIN_FILENO, POLLIN, 0};
    if (poll(&in, 1, 0) <= 0) {
        return 0;
    }
    const ssize_t count = read(STDIN_FILENO, bytes, room);
    return count > 0 ? (int)count : count < 0 && (errno == EINTR || errno == EAGAIN) ? 0 : -1;
}
