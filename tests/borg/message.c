#include "iris/borg/message.h"

#include "random_number.h"
#include "test.h"

static const borg_address from = {0x12345678, 20, 0x0102, 4};

/* Made by hand from the header's picture; the check by the FNV-1a of its authors, here in 64 bits. */
static void check_of(uint8_t *bytes)
{
    uint64_t hash = 2166136261u;
    for (int i = 0; i < 44; i++) {
        hash = ((hash ^ bytes[i]) * 16777619u) & 0xFFFFFFFFu;
    }
    for (int i = 0; i < 4; i++) {
        bytes[44 + i] = (uint8_t)(hash >> 8 * i);
    }
}

static void reads(const uint8_t *head, size_t count, borg_message *message)
{
    uint8_t bytes[BORG_MESSAGE_BYTES] = {0}, again[BORG_MESSAGE_BYTES];
    memcpy(bytes, head, count);
    check_of(bytes);
    memset(message, 0xAA, sizeof *message);
    assert_int_equal(borg_message_read(message, bytes, sizeof bytes), IRIS_OK);
    assert_int_equal(borg_message_write(again, message), IRIS_OK);
    assert_memory_equal(again, bytes, sizeof bytes);
}

static void refused(const uint8_t *head, size_t count)
{
    uint8_t bytes[BORG_MESSAGE_BYTES] = {0};
    borg_message message;
    memcpy(bytes, head, count);
    check_of(bytes);
    assert_int_equal(borg_message_read(&message, bytes, sizeof bytes), IRIS_ERR_DATA);
}

#define HEAD(kind) 'B', 'M', 1, kind, 0x78, 0x56, 0x34, 0x12, 20, 0, 4, 2, 1, 5, 0

static void each_kind_is_as_the_header_says(void **state)
{
    (void)state;
    borg_message m;
    const uint8_t signal[] = {HEAD(1), 1, 1, 10, 0, 0xFE, 0xFF, 0xFF, 0xFF, 0x10, 0x27, 0, 0};
    reads(signal, sizeof signal, &m);
    assert_int_equal(m.kind, BORG_MESSAGE_SIGNAL);
    assert_int_equal(m.from.script, from.script);
    assert_int_equal(m.from.ref, from.ref);
    assert_int_equal(m.from.unit, from.unit);
    assert_int_equal(m.from.incarnation, from.incarnation);
    assert_int_equal(m.sequence, 5);
    assert_int_equal(m.is.signal.kind, BORG_OBJ_DETECT_TRUE);
    assert_int_equal(m.is.signal.ref, 10);
    assert_int_equal(m.is.signal.x, -2);
    assert_int_equal(m.is.signal.y, 10000);

    const uint8_t acks[] = {HEAD(2), 2, 10, 0, 1, 3, 0, 7, 0, 1, 0x80, 20, 0, 2, 4, 0, 8, 0, 0, 0};
    reads(acks, sizeof acks, &m);
    assert_int_equal(m.count, 2);
    assert_int_equal(m.is.acks[0].before, 0x8001);
    assert_int_equal(m.is.acks[1].unit, 2);
    assert_int_equal(m.is.acks[1].sequence, 8);

    const uint8_t claim[] = {HEAD(5), 3, 9, 0x50, 0xC3, 0, 0x80, 0x34, 0x12, 9, 0, 1, 2, 3, 4};
    reads(claim, sizeof claim, &m);
    assert_true(borg_message_is_vote(&m));
    assert_int_equal(m.is.vote.handler, 3);
    assert_int_equal(m.is.vote.round, 9);
    assert_int_equal(m.is.vote.bid, 0x8000C350u);
    assert_int_equal(m.is.vote.stamp, 0x1234);
    assert_int_equal(m.is.vote.granted, 9);
    assert_int_equal(m.is.vote.answers[1], 0x0403);

    const uint8_t death[] = {HEAD(7)};
    reads(death, sizeof death, &m);
    assert_false(borg_message_is_vote(&m));

    const uint8_t piece[] = {HEAD(8), 20, 0, 0, 2, 0xFE, 1, 2, 'B', 'C'};
    reads(piece, sizeof piece, &m);
    assert_int_equal(m.is.piece.total, 512);
    assert_int_equal(m.is.piece.at, 510);
    assert_memory_equal(m.is.piece.bytes, "BC", 2);
}

static void what_contradicts_itself_is_refused(void **state)
{
    (void)state;
    const uint8_t cases[][28] = {
        {HEAD(0)},
        {HEAD(9)},
        {HEAD(1), 11, 1, 10}, /* no such signal */
        {HEAD(1), 1, 0, 10},  /* from no machine */
        {HEAD(1), 1, 1, 0},   /* of no group */
        {HEAD(2), 0},         /* no ack, too many, of nobody */
        {HEAD(2), 4},
        {HEAD(2), 1, 0, 0, 1},
        {HEAD(4), 1, 1, 0, 0, 0, 0, 0, 0, 0xFF, 1},      /* nine grants */
        {HEAD(7), 1},                                    /* something where nothing is */
        {HEAD(8), 20, 0, 0, 2, 0xFE, 1, 3, 1, 1},        /* a piece behind the end, */
        {HEAD(8), 20, 0, 1, 2, 0, 0, 1, 1, 1},           /* of too long a chunk, */
        {HEAD(8), 20, 0, 0, 2, 0, 0, 0, 1, 1},           /* of nothing, */
        {HEAD(8), 20, 0, 0, 2, 0, 0, 23, 1, 1},          /* of too much, */
        {HEAD(8), 0, 0, 0, 2, 0, 0, 1, 1},               /* for no group */
        {HEAD(8), 20, 0, 0, 2, 0, 0, 1, 1, 1},           /* more than it says */
        {'B', 'M', 1, 7, 1, 1, 1, 1, 0, 0, 4, 2, 1, 5},  /* from no group */
        {'B', 'M', 1, 7, 1, 1, 1, 1, 20, 0, 0, 2, 1, 5}, /* from no machine */
        {'B', 'C', 1, 7, 1, 1, 1, 1, 20, 0, 1, 2, 1, 5}, /* no message */
        {'B', 'M', 0, 7, 1, 1, 1, 1, 20, 0, 1, 2, 1, 5}  /* no version */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        refused(cases[i], sizeof cases[i]);
    }
}

static void damage_is_noticed(void **state)
{
    (void)state;
    borg_message m = {.kind = BORG_MESSAGE_SIGNAL, .sequence = 77, .from = from}, read;
    uint8_t bytes[BORG_MESSAGE_BYTES + 1] = {0};
    m.is.signal = (borg_signal){BORG_REACHED, 1, 20, 123456, -654321};
    assert_int_equal(borg_message_write(bytes, &m), IRIS_OK);
    for (int bit = 0; bit < 8 * BORG_MESSAGE_BYTES; bit++) {
        bytes[bit / 8] ^= (uint8_t)(1 << bit % 8);
        assert_int_not_equal(borg_message_read(&read, bytes, BORG_MESSAGE_BYTES), IRIS_OK);
        bytes[bit / 8] ^= (uint8_t)(1 << bit % 8);
    }
    for (size_t count = 0; count < BORG_MESSAGE_BYTES; count++) {
        assert_int_equal(borg_message_read(&read, bytes, count), IRIS_ERR_TRUNCATED);
    }
    assert_int_equal(borg_message_read(&read, bytes, BORG_MESSAGE_BYTES + 1), IRIS_ERR_DATA);
    bytes[2] = 2;
    assert_int_equal(borg_message_read(&read, bytes, BORG_MESSAGE_BYTES), IRIS_ERR_UNSUPPORTED);
    assert_int_equal(borg_message_read(NULL, bytes, BORG_MESSAGE_BYTES), IRIS_ERR_ARG);
    assert_int_equal(borg_message_read(&read, NULL, BORG_MESSAGE_BYTES), IRIS_ERR_ARG);
    assert_int_equal(borg_message_write(NULL, &m), IRIS_ERR_ARG);
    assert_int_equal(borg_message_write(bytes, NULL), IRIS_ERR_ARG);
    m.is.signal.kind = BORG_SIGNAL_KINDS;
    assert_int_equal(borg_message_write(bytes, &m), IRIS_ERR_DATA);
}

/* Whatever the struct holds: it is refused, or comes back as the same bytes. */
static void any_struct_is_written_or_refused(void **state)
{
    (void)state;
    int32_t written = 0;
    for (int32_t i = 0; i < 20000; i++) {
        borg_message m = {0}, read;
        uint8_t bytes[BORG_MESSAGE_BYTES], again[BORG_MESSAGE_BYTES];
        for (size_t b = 0; b < sizeof m; b++) {
            const uint64_t random = random_u64() >> 20;
            ((uint8_t *)&m)[b] = (uint8_t)(random & 1 ? random >> 8 : (random >> 8) & 3);
        }
        m.kind = (uint8_t)(m.kind % 10);
        if (borg_message_write(bytes, &m) == IRIS_OK) {
            assert_int_equal(borg_message_read(&read, bytes, sizeof bytes), IRIS_OK);
            assert_int_equal(borg_message_write(again, &read), IRIS_OK);
            assert_memory_equal(again, bytes, sizeof bytes);
            written++;
        }
    }
    assert_true(written > 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_is_as_the_header_says),
        cmocka_unit_test(what_contradicts_itself_is_refused),
        cmocka_unit_test(damage_is_noticed),
        cmocka_unit_test(any_struct_is_written_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
