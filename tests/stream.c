/* Byte streams: exact reads over sources of any habit, looking ahead, failures. */
#include "iris/stream.h"
#include "picture.h"

static iris_stream stream_of(awkward_source *from)
{
    iris_stream stream;
    assert_int_equal(iris_stream_init(&stream, (iris_source){awkward_read, from}), IRIS_OK);
    return stream;
}

static void reads_are_exact_or_say_why_not(void **state)
{
    (void)state;
    static const uint8_t data[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    for (size_t most = 1; most <= sizeof data; most++) {
        awkward_source from = {data, sizeof data, 0, most, SIZE_MAX, NULL, 0};
        iris_stream stream = stream_of(&from);
        uint8_t buffer[16] = {0};
        assert_int_equal(iris_stream_read(&stream, buffer, 4), IRIS_OK);
        assert_memory_equal(buffer, data, 4);
        assert_int_equal(iris_stream_skip(&stream, 2), IRIS_OK);
        assert_int_equal(stream.position, 6);
        assert_int_equal(iris_stream_read(&stream, buffer, 4), IRIS_ERR_TRUNCATED);
        assert_memory_equal(buffer, data + 6, 3);
        assert_int_equal(stream.position, 9);
        assert_int_equal(iris_stream_read(&stream, buffer, 4), IRIS_ERR_END);
        assert_int_equal(iris_stream_read(&stream, buffer, 0), IRIS_OK);
        assert_int_equal(iris_stream_skip(&stream, 1), IRIS_ERR_END);
    }
}

static void looking_ahead_consumes_nothing(void **state)
{
    (void)state;
    static const uint8_t data[] = {1, 2, 3, 4, 5};
    for (size_t before = 0; before <= 4; before++) {
        awkward_source from = {data, sizeof data, 0, 1, SIZE_MAX, NULL, 0};
        iris_stream stream = stream_of(&from);
        uint8_t next[2], buffer[8];
        assert_int_equal(iris_stream_peek(next, &stream), IRIS_OK);
        assert_int_equal(iris_stream_read(&stream, buffer, before), IRIS_OK);
        assert_memory_equal(buffer, data, before);
        assert_int_equal(stream.position, before);
        iris_status expected = before == 4 ? IRIS_ERR_TRUNCATED : IRIS_OK;
        for (int again = 0; again < 2; again++) {
            assert_int_equal(iris_stream_peek(next, &stream), expected);
            assert_memory_equal(next, data + before, before == 4 ? 1 : 2);
        }
        assert_int_equal(iris_stream_skip(&stream, 5 - before), IRIS_OK);
        assert_int_equal(iris_stream_peek(next, &stream), IRIS_ERR_END);
        assert_int_equal(stream.position, 5);
    }
}

static void kinds_are_told_by_two_bytes(void **state)
{
    (void)state;
    const struct {
        const char *text;
        iris_status status;
        iris_picture_kind kind;
    } cases[] = {
        {"BMxx", IRIS_OK, IRIS_PICTURE_BMP},
        {"P5", IRIS_OK, IRIS_PICTURE_PNM},
        {"P6\n", IRIS_OK, IRIS_PICTURE_PNM},
        {"P1", IRIS_OK, IRIS_PICTURE_PNM},
        {"P8", IRIS_ERR_DATA, 0},
        {"PM", IRIS_ERR_DATA, 0},
        {"B5", IRIS_ERR_DATA, 0},
        {"B", IRIS_ERR_TRUNCATED, 0},
        {"", IRIS_ERR_END, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        iris_memory_source memory = {(const uint8_t *)cases[i].text, strlen(cases[i].text), 0};
        iris_stream stream;
        iris_picture_kind kind = 0;
        assert_int_equal(iris_stream_init(&stream, iris_source_memory(&memory)), IRIS_OK);
        assert_int_equal(iris_stream_kind(&kind, &stream), cases[i].status);
        assert_int_equal(kind, cases[i].kind);
        assert_int_equal(stream.position, 0);
    }
}

/* Sources and sinks that break their contract. */
static ptrdiff_t too_many(void *user, uint8_t *buffer, size_t bytes)
{
    (void)user;
    memset(buffer, 0, bytes);
    return (ptrdiff_t)bytes + 1;
}

static ptrdiff_t takes_too_many(void *user, const uint8_t *data, size_t bytes)
{
    (void)data;
    ++*(int *)user;
    return (ptrdiff_t)bytes + 1;
}

static ptrdiff_t takes_nothing(void *user, const uint8_t *data, size_t bytes)
{
    (void)user;
    (void)data;
    (void)bytes;
    return 0;
}

static void failures_are_told(void **state)
{
    (void)state;
    static const uint8_t data[] = {1, 2, 3, 4, 5};
    uint8_t buffer[8], next[2];
    for (size_t n = 0; n < sizeof data; n++) {
        awkward_source from = {data, sizeof data, 0, 2, n, NULL, 0};
        iris_stream stream = stream_of(&from);
        assert_int_equal(iris_stream_peek(next, &stream), n < 2 ? IRIS_ERR_IO : IRIS_OK);
        assert_int_equal(iris_stream_read(&stream, buffer, 5), IRIS_ERR_IO);
        from.position = 0;
        stream = stream_of(&from);
        assert_int_equal(iris_stream_skip(&stream, 5), IRIS_ERR_IO);
    }
    iris_stream stream;
    assert_int_equal(iris_stream_init(&stream, (iris_source){too_many, NULL}), IRIS_OK);
    assert_int_equal(iris_stream_read(&stream, buffer, 4), IRIS_ERR_IO);
    int calls = 0;
    assert_int_equal(iris_sink_write(&(iris_sink){takes_too_many, &calls}, data, 4), IRIS_ERR_IO);
    assert_int_equal(calls, 1);
    assert_int_equal(iris_sink_write(&(iris_sink){takes_nothing, NULL}, data, 4), IRIS_ERR_IO);
    assert_int_equal(iris_sink_write(&(iris_sink){takes_nothing, NULL}, data, 0), IRIS_OK);
    assert_int_equal(iris_sink_write(&(iris_sink){0}, data, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_sink_write(NULL, data, 4), IRIS_ERR_ARG);
    assert_int_equal(iris_stream_init(&stream, (iris_source){0}), IRIS_ERR_ARG);
    assert_int_equal(iris_stream_init(NULL, (iris_source){too_many, NULL}), IRIS_ERR_ARG);
    assert_int_equal(iris_stream_read(NULL, buffer, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_stream_read(&stream, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_stream_skip(NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_stream_peek(NULL, &stream), IRIS_ERR_ARG);
    assert_int_equal(iris_stream_kind(NULL, &stream), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_are_exact_or_say_why_not),
        cmocka_unit_test(looking_ahead_consumes_nothing),
        cmocka_unit_test(kinds_are_told_by_two_bytes),
        cmocka_unit_test(failures_are_told),
    };
    return cmocka_run_group_tests_name("stream", tests, NULL, NULL);
}
