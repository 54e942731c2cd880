#include "one_line.h"

void one_line(FILE *out, const char *text)
{
    for (const char *at = text; *at != '\0'; at++) {
        unsigned char byte = (unsigned char)*at;
        fputc(byte < ' ' || byte == 0x7F ? '?' : byte, out);
    }
}
