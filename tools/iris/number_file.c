#include "number_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "floor_file.h"

#define BYTE_ORDER_MARK "\xEF\xBB\xBF" /* of UTF-8; some editors put it in front of a text */
#define LARGEST         268435456.0    /* 2^28 */

int number_text_read(iris_q32 *number, const char *text)
{
    char *end = NULL;
    if (text[strspn(text, "+-.0123456789eE")] != '\0') { /* no other words that strtod knows */
        return 0;
    }
    double value = strtod(text, &end);
    if (end == text || *end != '\0' || !(fabs(value) <= LARGEST)) {
        return 0;
    }
    *number = (iris_q32)llround(value * 4294967296.0);
    return 1;
}

/* Returns 0 when the line is no rows. */
static int read_line(number_table *table, char *line, int number)
{
    static const char between[] = " \t\r,;";
    int count = 0;
    char *rest = line;
    for (char *word = strtok_r(line, between, &rest); word; word = strtok_r(NULL, between, &rest)) {
        int row = table->rows + count / table->columns;
        iris_q32 ignored = 0,
                 *to = row < table->room ? table->numbers + table->rows * table->columns + count : &ignored;
        if (!number_text_read(to, word)) {
            return 0;
        }
        if (table->lines && row < table->room) {
            table->lines[row] = number;
        }
        count++;
    }
    table->rows += count / table->columns;
    return count % table->columns == 0;
}

int number_file_read(number_table *table, const char *path)
{
    static char text[16 * TEXT_FILE_BYTES];
    size_t length = 0;
    if (!text_file_read(text, sizeof text, &length, path)) {
        return 0;
    }
    text[length] = '\0';
    char *line =
        strncmp(text, BYTE_ORDER_MARK, strlen(BYTE_ORDER_MARK)) == 0 ? text + strlen(BYTE_ORDER_MARK) : text;
    table->rows = 0;
    for (int number = 1; line; number++) {
        char *end = memchr(line, '\n', (size_t)(text + length - line));
        if (end) {
            *end = '\0';
        }
        line[strcspn(line, "#")] = '\0';
        if (!read_line(table, line, number)) {
            complain(path,
                     "line %d: expected are %d numbers below 268435456, such as 1.5, with blanks, commas, or "
                     "semicolons between them",
                     number, table->columns);
            return 0;
        }
        if (table->rows > table->room) {
            complain(path, "line %d: more than %d points", number, table->room);
            return 0;
        }
        line = end ? end + 1 : NULL;
    }
    return 1;
}
