/* Names in arrays of a fixed size: with a 0 in them, whatever they come from.
 */
#ifndef OSIRIS_NAMES_H
#define OSIRIS_NAMES_H

#include <stddef.h>

/* Is there a 0 among these bytes? */
static inline int osiris_name_ends(const char *name, size_t bytes)
{
    size_t i = 0;
    while (i < bytes && name[i] != 0) {
        i++;
    }
    return i < bytes;
}

/* Two texts that end. */
static inline int osiris_name_is(const char *a, const char *b)
{
    while (*a != 0 && *a == *b) {
        a++;
        b++;
    }
    return *a == *b;
}

#endif
