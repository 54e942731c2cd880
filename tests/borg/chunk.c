#include "iris/borg/chunk.h"

#include "test.h"

/* 258 UNITS=3 TIMEOUT=60 [ WHILE Signal(BUMPED,2) OR NOT Signal(TIME_OUT): UNITS(2).Go(-1,65536); Signal(START):
 * UNITS=2
 * [ Signal(VOTE_WIN): Turn(-2); ] ], by hand. */
static uint8_t chunk[] = {'B', 'C', 1,  3,  2, 1, 60, 0, 61, 0, 2, 0, 0, 0,  0,  0, /* header */
                          1,   0,   10, 10, 0, 9, 2,  0, 1,  3, 0, 0, 1, 66, 65, 4, 2, 255, 255, 255, 255,
                          0,   0,   1,  0, /* WHILE */
                          0,   2,   4,  11, 0, 0, 0,  0, 1,  0, 0, 4, 4, 0,  5,  0, 0, 1,   6,   0,   254};
/* the last action's last byte is added below */
static uint8_t whole[sizeof chunk + 2];
static size_t length;

static void seal(void)
{
    uint32_t sum = 2166136261u;
    whole[8] = (uint8_t)length;
    for (size_t i = 0; i < length; i++) {
        sum = i >= 12 && i < 16 ? sum : (sum ^ whole[i]) * 16777619u;
    }
    for (int i = 0; i < 4; i++) {
        whole[12 + i] = (uint8_t)(sum >> 8 * i);
    }
}

static void start(void)
{
    memcpy(whole, chunk, sizeof chunk);
    length = sizeof chunk;
    whole[length++] = 255;
    /* election: body has a handler of 5 + 4 bytes of condition, and an action of 4 */
    whole[16 + 25 + 3] = 13;
    seal();
}

static void is_read(void **state)
{
    (void)state;
    start();
    assert_int_equal(borg_chunk_check(whole, length), IRIS_OK);
    assert_int_equal(borg_chunk_units(whole), 3);
    assert_int_equal(borg_chunk_ref(whole), 258);
    assert_int_equal(borg_chunk_timeout_s(whole), 60);
    borg_reader r = borg_chunk_handlers(whole);
    borg_handler h, inner;
    borg_term t;
    borg_action a;
    assert_int_equal(borg_handler_next(&h, &r), 1);
    assert_int_equal(h.repeats, 1);
    assert_int_equal(h.winners, 0);
    assert_int_equal(borg_term_next(&t, &h.condition), 1);
    assert_int_equal(t.op, BORG_BUMPED);
    assert_int_equal(t.ref, 2);
    assert_int_equal(borg_term_next(&t, &h.condition), 1);
    assert_int_equal(t.op, BORG_TIME_OUT);
    assert_int_equal(borg_term_next(&t, &h.condition), 1);
    assert_int_equal(t.op, BORG_NOT);
    assert_int_equal(borg_term_next(&t, &h.condition), 1);
    assert_int_equal(t.op, BORG_OR);
    assert_int_equal(borg_term_next(&t, &h.condition), 0);
    assert_int_equal(borg_action_next(&a, &h.body), 1);
    assert_int_equal(a.verb, BORG_GO);
    assert_int_equal(a.unit, 2);
    assert_int_equal(a.a, -1);
    assert_int_equal(a.b, 65536);
    assert_int_equal(borg_action_next(&a, &h.body), 0);
    assert_int_equal(borg_handler_next(&h, &r), 1);
    assert_int_equal(h.winners, 2);
    assert_int_equal(borg_handler_next(&inner, &h.body), 1);
    assert_int_equal(borg_action_next(&a, &inner.body), 1);
    assert_int_equal(a.verb, BORG_TURN);
    assert_int_equal(a.a, -2);
    assert_int_equal(borg_handler_next(&h, &r), 0);
}

static void every_damage_is_seen(void **state)
{
    (void)state;
    start();
    for (size_t i = 0; i < length; i++) {
        for (int bit = 0; bit < 8; bit++) {
            whole[i] ^= (uint8_t)(1 << bit);
            assert_int_not_equal(borg_chunk_check(whole, length), IRIS_OK);
            whole[i] ^= (uint8_t)(1 << bit);
        }
    }
    for (size_t i = 0; i < length; i++) {
        assert_int_equal(borg_chunk_check(whole, i), IRIS_ERR_TRUNCATED);
    }
    assert_int_equal(borg_chunk_check(NULL, 16), IRIS_ERR_ARG);
    whole[2] = 2;
    assert_int_equal(borg_chunk_check(whole, length), IRIS_ERR_UNSUPPORTED);
}

/* One byte changed, and the check of the whole right again. */
static void changed(size_t at, uint8_t value)
{
    const uint8_t was = whole[at];
    whole[at] = value;
    seal();
    if (borg_chunk_check(whole, length) != IRIS_ERR_DATA) {
        fail_msg("byte %d of %d", (int)at, (int)value);
    }
    whole[at] = was;
    seal();
    assert_int_equal(borg_chunk_check(whole, length), IRIS_OK);
}

static void contents_are_checked(void **state)
{
    (void)state;
    start();
    static const struct {
        uint8_t at, value;
    } changes[] = {{3, 0},  {3, 1},    {6, 0},  {10, 1}, {10, 3},  {11, 1}, {16, 2},  {17, 4},      {18, 0},
                   {18, 9}, {18, 255}, {19, 9}, {20, 1}, {21, 11}, {24, 0}, {29, 65}, {30, 64 + 3}, {31, 10},
                   {31, 7}, {36, 1},   {42, 0}, {42, 4}, {50, 2},  {51, 1}, {59, 9}};
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        changed(changes[i].at, changes[i].value);
    }
}

/* Published values of FNV-1a, in one piece and in two. */
static void numbers_of_scripts(void **state)
{
    (void)state;
    static const uint8_t foobar[] = {'f', 'o', 'o', 'b', 'a', 'r'};
    assert_true(borg_chunk_number(0, foobar, 6) == 0xbf9cf968u);
    assert_true(borg_chunk_number(0, foobar, 1) == 0xe30c2799u);
    assert_true(borg_chunk_number(borg_chunk_number(0, foobar, 2), foobar + 2, 4) == 0xbf9cf968u);
    assert_true(borg_chunk_number(7, NULL, 6) == 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(is_read),
        cmocka_unit_test(every_damage_is_seen),
        cmocka_unit_test(contents_are_checked),
        cmocka_unit_test(numbers_of_scripts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
