#include "iris/borg/in_process.h"

#include "test.h"

enum { ENDS = 5, DEPTH = 7 };

typedef struct {
    borg_bus bus;
    borg_bus_datagram ring[DEPTH];
    borg_bus_end ends[ENDS];
    borg_transport at[ENDS];
} team;

static void gather(team *t)
{
    assert_int_equal(borg_bus_init(&t->bus, t->ring, DEPTH, t->ends, ENDS), IRIS_OK);
    for (int32_t i = 0; i < ENDS; i++) {
        assert_int_equal(borg_bus_transport(&t->at[i], &t->bus, i), IRIS_OK);
    }
}

static void say(const borg_transport *transport, uint8_t first, size_t count)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    for (size_t i = 0; i < count; i++) {
        bytes[i] = (uint8_t)(first + i);
    }
    assert_int_equal(transport->send(transport->context, bytes, count), IRIS_OK);
    memset(bytes, 0xee, sizeof bytes); /* the bus has a copy */
}

/* Hears nothing (count 0), or bytes as said above. */
static void hear(const borg_transport *transport, uint8_t first, size_t count)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    size_t got = 99;
    memset(bytes, 0x77, sizeof bytes);
    assert_int_equal(transport->receive(transport->context, bytes, sizeof bytes, &got), IRIS_OK);
    assert_int_equal(got, count);
    for (size_t i = 0; i < sizeof bytes; i++) {
        assert_int_equal(bytes[i], i < count ? (uint8_t)(first + i) : 0x77);
    }
}

static void everybody_else_hears_in_order(void **state)
{
    (void)state;
    team t;
    gather(&t);
    say(&t.at[0], 10, 1);
    say(&t.at[3], 20, BORG_DATAGRAM_BYTES_MAX);
    say(&t.at[0], 30, 5);
    for (int32_t i = 0; i < ENDS; i++) {
        if (i != 0) {
            hear(&t.at[i], 10, 1);
        }
        if (i != 3) {
            hear(&t.at[i], 20, BORG_DATAGRAM_BYTES_MAX);
        }
        if (i != 0) {
            hear(&t.at[i], 30, 5);
        }
        hear(&t.at[i], 0, 0);
        hear(&t.at[i], 0, 0);
        assert_int_equal(t.ends[i].dropped, 0);
    }
}

/* End 1 does not listen; end 2 does after each. Of what end 0 and end 1 say, the bus keeps the newest DEPTH. */
static void who_does_not_listen_loses_the_oldest(void **state)
{
    (void)state;
    team t;
    gather(&t);
    for (int n = 0; n < 3 * DEPTH; n++) {
        say(&t.at[n % 3 == 2], (uint8_t)n, 2);
        hear(&t.at[2], (uint8_t)n, 2);
    }
    assert_int_equal(t.ends[2].dropped, 0);
    for (int n = 2 * DEPTH; n < 3 * DEPTH; n++) {
        if (n % 3 != 2) {
            hear(&t.at[1], (uint8_t)n, 2);
        }
    }
    hear(&t.at[1], 0, 0);
    hear(&t.at[2], 0, 0);
    int others = 0; /* that were said to end 1 and are gone */
    for (int n = 0; n < 2 * DEPTH; n++) {
        others += n % 3 != 2;
    }
    assert_int_equal(t.ends[1].dropped, others);
    assert_int_equal(t.ends[4].dropped, 2 * DEPTH);
    say(&t.at[4], 200, 3); /* and it goes on */
    hear(&t.at[1], 200, 3);
    hear(&t.at[2], 200, 3);
}

/* A bus of one datagram and one end: it talks to itself and hears nothing. */
static void the_smallest_bus(void **state)
{
    (void)state;
    borg_bus bus;
    borg_bus_datagram ring[1];
    borg_bus_end ends[2];
    borg_transport a, b;
    assert_int_equal(borg_bus_init(&bus, ring, 1, ends, 1), IRIS_OK);
    assert_int_equal(borg_bus_transport(&a, &bus, 0), IRIS_OK);
    say(&a, 1, 1);
    say(&a, 2, 1);
    hear(&a, 0, 0);
    assert_int_equal(ends[0].dropped, 0);
    assert_int_equal(borg_bus_init(&bus, ring, 1, ends, 2), IRIS_OK);
    assert_int_equal(borg_bus_transport(&a, &bus, 0), IRIS_OK);
    assert_int_equal(borg_bus_transport(&b, &bus, 1), IRIS_OK);
    say(&a, 1, 1);
    say(&a, 2, 1);
    hear(&b, 2, 1);
    hear(&b, 0, 0);
    assert_int_equal(ends[1].dropped, 1);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    team t;
    gather(&t);
    borg_bus bus;
    assert_int_equal(borg_bus_init(NULL, t.ring, 1, t.ends, 1), IRIS_ERR_ARG);
    assert_int_equal(borg_bus_init(&bus, NULL, 1, t.ends, 1), IRIS_ERR_ARG);
    assert_int_equal(borg_bus_init(&bus, t.ring, 1, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(borg_bus_init(&bus, t.ring, 0, t.ends, 1), IRIS_ERR_RANGE);
    assert_int_equal(borg_bus_init(&bus, t.ring, 1, t.ends, INT32_MIN), IRIS_ERR_RANGE);
    const borg_transport *a = &t.at[0];
    borg_transport untouched = *a, other = *a;
    assert_int_equal(borg_bus_transport(NULL, &t.bus, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_bus_transport(&other, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_bus_transport(&other, &t.bus, -1), IRIS_ERR_RANGE);
    assert_int_equal(borg_bus_transport(&other, &t.bus, ENDS), IRIS_ERR_RANGE);
    assert_memory_equal(&other, &untouched, sizeof other);

    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX + 1] = {0};
    size_t count;
    assert_int_equal(a->send(NULL, bytes, 1), IRIS_ERR_ARG);
    assert_int_equal(a->send(a->context, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(a->send(a->context, bytes, 0), IRIS_ERR_RANGE);
    assert_int_equal(a->send(a->context, bytes, BORG_DATAGRAM_BYTES_MAX + 1), IRIS_ERR_RANGE);
    assert_int_equal(a->receive(NULL, bytes, sizeof bytes, &count), IRIS_ERR_ARG);
    assert_int_equal(a->receive(a->context, NULL, sizeof bytes, &count), IRIS_ERR_ARG);
    assert_int_equal(a->receive(a->context, bytes, sizeof bytes, NULL), IRIS_ERR_ARG);
    assert_int_equal(a->receive(a->context, bytes, BORG_DATAGRAM_BYTES_MAX - 1, &count), IRIS_ERR_RANGE);
    hear(&t.at[1], 0, 0); /* nothing was sent */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everybody_else_hears_in_order),
        cmocka_unit_test(who_does_not_listen_loses_the_oldest),
        cmocka_unit_test(the_smallest_bus),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
