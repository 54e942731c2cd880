/* What the calibrations print in JSON. */
#ifndef IRIS_TOOL_CALIBRATE_JSON_H
#define IRIS_TOOL_CALIBRATE_JSON_H

#include "iris/wide.h"
#include "json.h"

static inline double calibrate_real(iris_q32 number)
{
    return (double)number / 4294967296.0;
}

/* "key":number */
static inline void calibrate_number(json_writer *json, const char *key, iris_q32 number)
{
    json_key(json, key);
    json_number(json, calibrate_real(number), 9);
}

/* "key":[...], or with more than one row "key":[[...],...] */
static inline void calibrate_numbers(json_writer *json, const char *key, const iris_q32 *numbers, int rows,
                                     int columns)
{
    json_key(json, key);
    json_open(json, '[');
    for (int i = 0; i < rows * columns; i++) {
        if (rows > 1 && i % columns == 0) {
            json_open(json, '[');
        }
        json_number(json, calibrate_real(numbers[i]), 9);
        if (rows > 1 && i % columns == columns - 1) {
            json_close(json, ']');
        }
    }
    json_close(json, ']');
}

#endif
