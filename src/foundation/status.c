#include "iris/status.h"

const char *iris_status_text(iris_status status)
{
    switch (status) {
    case IRIS_OK:
        return "done";
    case IRIS_ERR_ARG:
        return "invalid argument";
    case IRIS_ERR_RANGE:
        return "size or position out of range";
    case IRIS_ERR_FORMAT:
        return "pixel format not accepted here";
    case IRIS_ERR_ALIGN:
        return "address, stride or position not aligned";
    case IRIS_ERR_ALIAS:
        return "source and destination overlap";
    case IRIS_ERR_SCRATCH:
        return "working memory too small";
    case IRIS_ERR_FULL:
        return "more results than there is room for";
    case IRIS_ERR_TRUNCATED:
        return "input ends too early";
    case IRIS_ERR_IO:
        return "read or write failed";
    case IRIS_ERR_DATA:
        return "input contradicts its own format";
    case IRIS_ERR_UNSUPPORTED:
        return "kind of file not supported";
    case IRIS_ERR_END:
        return "end of input";
    case IRIS_ERR_TIMEOUT:
        return "nothing came in time";
    }
    return "unknown status";
}
