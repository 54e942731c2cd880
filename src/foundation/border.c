#include "iris/border.h"

int32_t iris_border_index(int32_t i, int32_t n, iris_border_rule rule)
{
    if (i >= 0 && i < n) {
        return i;
    }
    if (rule == IRIS_BORDER_CONSTANT) {
        return -1;
    }
    if (rule != IRIS_BORDER_REFLECT101) {
        return i < 0 ? 0 : n - 1;
    }
    if (n == 1) {
        return 0;
    }
    int64_t period = 2 * ((int64_t)n - 1);
    int64_t place = i % period;
    place = place < 0 ? place + period : place;
    return (int32_t)(place < n ? place : period - place);
}
