/* A line follower of any config and a small size, fed with any rows: begin, rows, end, several frames. */
#include <stdlib.h>
#include <string.h>

#include "iris/xt/follow.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

typedef struct {
    const uint8_t *data;
    size_t bytes;
} input;

/* The next byte; 0 behind the end. */
static uint8_t take(input *in)
{
    if (in->bytes == 0) {
        return 0;
    }
    in->bytes--;
    return *in->data++;
}

static iris_follow_config config_from(input *in)
{
    static const iris_format formats[] = {IRIS_GRAY8,  IRIS_RGB888, IRIS_BGR888,
                                          IRIS_RGB565, IRIS_YUYV,   IRIS_MASK1};
    iris_follow_config config;
    uint8_t kind = take(in);
    iris_follow_defaults(&config);
    config.kind = (iris_follow_kind)(kind % 3);
    config.lane = kind / 4 % 2;
    config.format = formats[take(in) % 6];
    config.color = (iris_hsl_range){take(in) * 2, take(in) * 2, take(in) % 101, 100, 0, take(in) % 101};
    if (kind & 64) {
        config.contrast_permil = 100 + take(in) * 3;
        config.min_width_permil = 1 + take(in);
        config.lookahead_permil = take(in) * 4;
        config.hold_ms = take(in);
    }
    return config;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    input in = {data, bytes};
    iris_follow_config config = config_from(&in);
    iris_size size = {8 + take(&in) % 73, 8 + take(&in) % 73};
    iris_scratch scratch;
    iris_follow follow;
    iris_follow_result result;
    int gray = config.format == IRIS_GRAY8 && config.kind != IRIS_FOLLOW_COLOR && config.lane != 1;
    size_t room_for =
        gray ? IRIS_FOLLOW_SCRATCH_BYTES(size.w, size.h) : IRIS_FOLLOW_FULL_SCRATCH_BYTES(size.w, size.h);
    void *memory = malloc(room_for); /* malloc's alignment is enough, and its end is watched */
    iris_scratch_init(&scratch, memory, room_for);
    iris_status status = gray ? iris_follow_init(&follow, size, &config, &scratch)
                              : iris_follow_init_full(&follow, size, &config, &scratch);
    if (status != IRIS_OK) {
        free(memory);
        return 0;
    }
    size_t room = iris_format_row_bytes(config.format, size.w);
    uint8_t *row = malloc(room); /* of its own, so that a sanitizer sees reads past its end */
    memset(row, 128, room);
    for (uint32_t frame = 0; frame < 3 && in.bytes > 0; frame++) {
        uint8_t rows = take(&in);
        iris_follow_begin(&follow);
        for (int32_t y = 0; y < (rows < 200 ? size.h : rows % 90); y++) {
            uint8_t from = take(&in), count = take(&in), level = take(&in);
            for (size_t i = 0; i < count && from + i < room; i++) {
                row[from + i] = level & 1 ? take(&in) : level; /* noise or a run; the row before stays */
            }
            iris_follow_row(&follow, row);
        }
        iris_follow_end(&result, &follow, frame * take(&in));
    }
    free(row);
    free(memory);
    return 0;
}
