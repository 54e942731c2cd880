/* IRIS - what every function returns.
 *
 * A function that returns an error because of its arguments or its working memory has not touched its outputs.
 * IRIS_ERR_FULL, IRIS_ERR_TRUNCATED and IRIS_ERR_IO leave a valid part behind; the function's comment says which.
 */
#ifndef IRIS_STATUS_H
#define IRIS_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    IRIS_OK = 0,
    IRIS_ERR_ARG,         /* a null pointer, or a config value outside its documented range */
    IRIS_ERR_RANGE,       /* a size, count, or rectangle that does not fit */
    IRIS_ERR_FORMAT,      /* this operation does not take this pixel format */
    IRIS_ERR_ALIGN,       /* an address, stride, or x position is not aligned as the format needs */
    IRIS_ERR_ALIAS,       /* destination and source overlap in a way the operation does not allow */
    IRIS_ERR_SCRATCH,     /* working memory too small: use the header's ..._SCRATCH_BYTES */
    IRIS_ERR_FULL,        /* more results than the output array holds: the best were kept */
    IRIS_ERR_TRUNCATED,   /* the input ended early */
    IRIS_ERR_IO,          /* the caller's source or sink reported a failure */
    IRIS_ERR_DATA,        /* the input contradicts its own format */
    IRIS_ERR_UNSUPPORTED, /* the input is well formed, but of a kind that is not read */
    IRIS_ERR_END,         /* nothing more: the input ended where it may end */
    IRIS_ERR_TIMEOUT      /* nothing came within the time given */
} iris_status;

/* A short English sentence for a status, such as "working memory too small". Never null; static storage. */
const char *iris_status_text(iris_status status);

#ifdef __cplusplus
}
#endif

#endif
