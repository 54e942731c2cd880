/* Picture files in memory: BMP of 24 bits, and PGM. */
#include <string.h>

#include "iris/bmp.h"
#include "iris/pnm.h"
#include "peers.h"

static iris_image bgr, bgr_to;
static iris_memory_sink written;

static iris_status encode(void)
{
    written.used = 0;
    return iris_bmp_write(iris_sink_memory(&written), &bgr);
}

static void prepare_encode(void)
{
    bgr = bench_frame.rgb;
    bgr.format = IRIS_BGR888;
    bgr_to = bench_frame.rgb_to;
    bgr_to.format = IRIS_BGR888;
    written.capacity = (iris_format_row_bytes(IRIS_BGR888, bgr.w) + 4u) * (size_t)bgr.h + 256u;
    written.data = iris_scratch_take(&bench_frame.scratch, written.capacity);
    peer_gives_numbers((int32_t)((written.capacity + 3u) / 4u / (size_t)bgr.h) + 1, bgr.h);
}

/* The file's bytes, then zeros. */
static void report_file(void)
{
    memcpy(peer_result.data, written.data, written.used);
}

static void prepare_decode(void)
{
    prepare_encode();
    (void)encode();
    peer_result = bgr_to;
}

static iris_status decode(void)
{
    iris_memory_source source = {written.data, written.used, 0};
    iris_stream stream;
    iris_bmp_reader reader;
    iris_status status = iris_stream_init(&stream, iris_source_memory(&source));
    status = status == IRIS_OK ? iris_bmp_begin(&reader, &stream) : status;
    return status == IRIS_OK ? iris_bmp_read(&bgr_to, &reader) : status;
}

static iris_status encode_pgm(void)
{
    written.used = 0;
    return iris_pnm_write(iris_sink_memory(&written), &bench_frame.gray);
}

static void prepare_decode_pgm(void)
{
    prepare_encode();
    (void)encode_pgm();
    peer_gives_gray();
}

static iris_status decode_pgm(void)
{
    iris_memory_source source = {written.data, written.used, 0};
    iris_stream stream;
    iris_pnm_reader reader;
    iris_status status = iris_stream_init(&stream, iris_source_memory(&source));
    status = status == IRIS_OK ? iris_pnm_begin(&reader, &stream) : status;
    return status == IRIS_OK ? iris_pnm_read(&bench_frame.gray_to, &reader) : status;
}

const peer_case peer_file[] = {
    {"BMP24 decode in memory", decode, prepare_decode, NULL},
    {"BMP24 encode in memory", encode, prepare_encode, report_file},
    {"PGM decode in memory", decode_pgm, prepare_decode_pgm, NULL},
    {"PGM encode in memory", encode_pgm, prepare_encode, report_file},
    {NULL, NULL, NULL, NULL},
};
