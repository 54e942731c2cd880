#include "steering_say.h"

#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

void steering_say_bytes(const char *bytes, size_t count)
{
    struct pollfd end = {STDERR_FILENO, POLLOUT, 0};
    if (poll(&end, 1, 0) == 1 && (end.revents & POLLOUT) != 0) { /* a pipe has room for a page then */
        (void)!write(STDERR_FILENO, bytes, count);
    }
}

void steering_say(const char *subject, const char *text)
{
    char line[1280]; /* the rest of what is longer says nothing new */
    snprintf(line, sizeof line - 1, "iris follow: %s%s%s", subject ? subject : "", subject ? ": " : "", text);
    size_t length = strlen(line);
    for (size_t i = 0; i < length; i++) {
        unsigned char byte = (unsigned char)line[i];
        line[i] = (char)(byte < ' ' || byte == 0x7F ? '?' : byte);
    }
    line[length++] = '\n';
    steering_say_bytes(line, length);
}
