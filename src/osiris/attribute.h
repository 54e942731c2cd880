/* Words with a number behind them, as robot files and world files have them.
 */
#ifndef OSIRIS_ATTRIBUTE_H
#define OSIRIS_ATTRIBUTE_H

#include <stddef.h>

#include "../foundation/text_lines.h"

typedef struct {
    iris_text_lines lines;
    const char *expected; /* what is wrong with this line; null: nothing */
} osiris_reader;

typedef enum {
    OSIRIS_WHOLE = 0,
    OSIRIS_DEGREES, /* becomes angle units */
    OSIRIS_TENTHS,  /* becomes tenths: percents become permils */
    OSIRIS_HERTZ    /* becomes milliseconds */
} osiris_unit;

/* An int32_t in a struct, and what stands for it in a file. least and most are of what it becomes. */
typedef struct {
    const char *word;
    size_t offset;
    int32_t least, most;
    osiris_unit unit;
    const char *expected;
} osiris_attribute;

osiris_reader osiris_reader_of(const char *text, size_t bytes);

/* Each steps over what it names. 0 when something else stands there; reader->expected is as it was. */
int osiris_take_name(char *name, size_t bytes,
                     osiris_reader *reader); /* letters, digits, and signs but #, that fit */
int osiris_take_thousandths(int64_t *number, osiris_reader *reader); /* a decimal number, below 10^9 */
int osiris_take_place(int32_t *mm, osiris_reader *reader); /* a whole number below OSIRIS_PLACE_MAX_MM */

/* Takes the number of an attribute. 0 when it is none, or outside its range: reader->expected says what was expected. */
int osiris_take_attribute(int32_t *number, osiris_reader *reader, const osiris_attribute *attribute);

/* Takes one of the attributes' words and its number, which goes into *object, and marks it in *seen, so that none is given
 * twice. 1: done; 0: none of these words stands there; -1: reader->expected says what is wrong. */
int osiris_take_one_of(void *object, uint32_t *seen, osiris_reader *reader,
                       const osiris_attribute *attributes, int count);

/* Thousandths of a degree as angle units, rounded. */
int64_t osiris_units_of(int64_t thousandths);

/* reader->expected becomes this; 0. */
int osiris_expect(osiris_reader *reader, const char *expected);

#endif
