/* MQTT with publishers that mean no good, and with what only looks like a broker. */
#include "mqtt_broker.h"

/* A publisher of another make, written by hand: datagrams that are none, and a flood of which the newest are kept. */
static void hostile_publishers_are_refused(void **state)
{
    (void)state;
    need_broker();
    static end e;
    const iris_mqtt_config config = usual("t");
    open_end(&e, &config);
    wait_for(&e, 1);
    const int handle = connect_to(port);
    static const uint8_t hello[] = {0x10, 13, 0, 4, 'M', 'Q', 'T', 'T', 4, 2, 0, 60, 0, 1, 'h'};
    assert_int_equal(write(handle, hello, sizeof hello), sizeof hello);
    static const uint8_t sizes[] = {0, BORG_DATAGRAM_BYTES_MAX + 1, 110};
    for (size_t i = 0; i < sizeof sizes; i++) {
        uint8_t packet[128] = {0x30, (uint8_t)(8 + sizes[i]), 0, 6, 't', '/', 't', 'e', 'a', 'm'};
        assert_int_equal(write(handle, packet, 10 + sizes[i]), 10 + sizes[i]);
    }
    const uint8_t good[] = {0x30, 11, 0, 6, 't', '/', 't', 'e', 'a', 'm', 7, 8, 9};
    assert_int_equal(write(handle, good, sizeof good), sizeof good);
    hears(&e, 7, 3);
    assert_int_equal(e.mqtt.refused, sizeof sizes);

    for (int i = 0; i < 300; i++) {
        const uint8_t one[] = {0x30, 10, 0, 6, 't', '/', 't', 'e', 'a', 'm', (uint8_t)(i >> 8), (uint8_t)i};
        assert_int_equal(write(handle, one, sizeof one), sizeof one);
    }
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX] = {0};
    const double start = now_ms();
    while (e.mqtt.dropped < 100) { /* works without taking anything */
        (void)iris_mqtt_keep(&e.mqtt, 1, bytes, 0);
        assert_true(now_ms() - start < PATIENCE);
    }
    int last = -1, heard = 0;
    while (last < 299) { /* the newest of them arrive, in order */
        assert_int_equal(hear(&e, bytes, PATIENCE), 2);
        const int number = bytes[0] << 8 | bytes[1];
        assert_true(number > last);
        last = number;
        heard++;
    }
    assert_int_equal((uint32_t)heard + e.mqtt.dropped, 300);
    close(handle);
    iris_mqtt_close(&e.mqtt);
}

/* What listens there is no broker: it says nothing, nonsense, no, or hangs up. Nothing waits, nothing breaks. */
static void hostile_brokers(void **state)
{
    (void)state;
    if (why_not && strstr(why_not, "libmosquitto")) {
        need_broker();
    }
    static const struct {
        const char *bytes;
        size_t count;
    } answers[] = {{"", 0},
                   {"HTTP/1.1 400 Bad Request\r\n\r\n", 28},
                   {"\x20\x02\x00\x05", 4},                           /* refused: not authorized */
                   {"\x20\x02\x00\x00\x30\xff\xff\xff\x7f", 9},       /* taken; a packet of 256 MB */
                   {"\x20\x02\x00\x00\x30\x05\x00\x40/teamteam", 16}, /* a topic longer than its packet */
                   {"\x20\x02\x00\x00\xff\xff\xff\xff\xff\xff\xff", 11} /* no length at all */};
    for (size_t i = 0; i < sizeof answers / sizeof answers[0]; i++) {
        static end e;
        int32_t at;
        const int listener = listen_anywhere(&at);
        iris_mqtt_config config = usual("iris");
        config.port = at;
        open_end(&e, &config);
        const int handle = accept(listener, NULL, NULL);
        assert_true(handle >= 0);
        assert_int_equal(write(handle, answers[i].bytes, answers[i].count), (ssize_t)answers[i].count);
        const double start = now_ms();
        uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
        for (int n = 0; n < 50; n++) {
            (void)say(&e, 1, 1);
            (void)take(&e, bytes);
            sleep_ms(1);
        }
        assert_int_equal(e.mqtt.received, 0);
        assert_true(now_ms() - start < PATIENCE);
        close(handle);
        close(listener);
        for (int n = 0; n < 50 && e.mqtt.connected; n++) {
            (void)take(&e, bytes);
            sleep_ms(1);
        }
        iris_mqtt_close(&e.mqtt);
    }
}

/* A broker that takes all and confirms nothing: what waits for it is bounded. */
static void a_silent_broker_fills_up(void **state)
{
    (void)state;
    if (why_not && strstr(why_not, "libmosquitto")) {
        need_broker();
    }
    static end e;
    int32_t at;
    const int listener = listen_anywhere(&at);
    iris_mqtt_config config = usual("iris");
    config.port = at;
    open_end(&e, &config);
    const int handle = accept(listener, NULL, NULL);
    assert_int_equal(write(handle, "\x20\x02\x00\x00", 4), 4);
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    const double start = now_ms();
    while (!e.mqtt.connected) {
        (void)take(&e, bytes);
        assert_true(now_ms() - start < PATIENCE);
        sleep_ms(1);
    }
    for (int i = 0; i < IRIS_MQTT_UNCONFIRMED_MAX; i++) {
        assert_int_equal(say(&e, 1, 1), IRIS_OK);
    }
    for (int i = 0; i < 10; i++) {
        assert_int_equal(say(&e, 1, 1), IRIS_ERR_FULL);
    }
    assert_int_equal(e.mqtt.lost, 10);
    close(handle);
    close(listener);
    iris_mqtt_close(&e.mqtt);
}

static void nobody_listens(void **state)
{
    (void)state;
    if (why_not && strstr(why_not, "libmosquitto")) {
        need_broker();
    }
    static end e;
    int32_t at;
    close(listen_anywhere(&at));
    iris_mqtt_config config = usual("iris");
    config.port = at;
    const iris_status status = iris_mqtt_open(&e.mqtt, &config);
    assert_true(status == IRIS_OK || status == IRIS_ERR_IO);
    assert_int_equal(iris_mqtt_transport(&e.transport, &e.mqtt), IRIS_OK);
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    for (int i = 0; i < 100; i++) {
        assert_int_equal(say(&e, 1, 1), IRIS_ERR_IO);
        assert_int_equal(take(&e, bytes), 0);
        sleep_ms(1);
    }
    assert_int_equal(e.mqtt.lost, 100);
    assert_string_equal(iris_mqtt_problem(&e.mqtt), "no broker answers there");
    iris_mqtt_close(&e.mqtt);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hostile_publishers_are_refused),
        cmocka_unit_test(hostile_brokers),
        cmocka_unit_test(a_silent_broker_fills_up),
        cmocka_unit_test(nobody_listens),
    };
    return cmocka_run_group_tests(tests, find_broker, leave_broker);
}
