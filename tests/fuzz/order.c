/* Reads any bytes as lines of orders. What is accepted is written, and read again as it was. */
#include <stdlib.h>
#include <string.h>

#include "iris/runtime/order.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static void expect(int good)
{
    if (!good) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    const char *at = (const char *)data, *end = at + bytes;
    while (at < end) {
        const char *next = memchr(at, '\n', (size_t)(end - at));
        const size_t length = (size_t)((next ? next : end) - at);
        iris_order order = {IRIS_ORDER_NONE, 0, 0}, again = {IRIS_ORDER_NONE, 0, 0};
        int32_t column = -1;
        const iris_status status = iris_order_read(&order, &column, at, length);
        expect(column >= 0 && (size_t)column <= length + 1);
        expect((column > 0) == (status == IRIS_ERR_DATA || status == IRIS_ERR_RANGE));
        if (status == IRIS_OK) {
            char text[IRIS_ORDER_TEXT_BYTES];
            size_t written = 0;
            expect(iris_order_check(&order) == IRIS_OK);
            expect(iris_order_write(text, sizeof text, &written, &order) == IRIS_OK);
            expect(iris_order_read(&again, &column, text, written) == IRIS_OK);
            expect(again.verb == order.verb && again.a == order.a && again.b == order.b);
        }
        at += length + 1;
    }
    return 0;
}
