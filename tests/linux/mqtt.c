/* MQTT through a broker that this program starts. */
#include "mqtt_broker.h"

static void everybody_of_the_topic_hears(void **state)
{
    (void)state;
    need_broker();
    static end ends[3], elsewhere;
    const iris_mqtt_config config = usual("iris/test/1"), other = usual("iris/test/2");
    for (int i = 0; i < 3; i++) {
        open_end(&ends[i], &config);
        wait_for(&ends[i], 1);
    }
    open_end(&elsewhere, &other);
    wait_for(&elsewhere, 1);
    assert_int_equal(say(&ends[0], 10, 1), IRIS_OK);
    hears(&ends[1], 10, 1);
    assert_int_equal(say(&ends[1], 20, BORG_DATAGRAM_BYTES_MAX), IRIS_OK);
    for (int i = 0; i < 3; i++) {
        if (i != 1) {
            hears(&ends[i], 10, 1);
        }
        hears(&ends[i], 20, BORG_DATAGRAM_BYTES_MAX);
    }
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    assert_int_equal(hear(&elsewhere, bytes, 100), 0);
    const double start = now_ms();
    while (ends[1].mqtt.confirmed !=
           ends[1].mqtt.sent) { /* quality of service 1: the broker says that it has them */
        (void)hear(&ends[1], bytes, 5);
        assert_true(now_ms() - start < PATIENCE);
    }
    for (int i = 0; i < 3; i++) {
        assert_int_equal(ends[i].mqtt.lost + ends[i].mqtt.dropped + ends[i].mqtt.refused, 0);
        iris_mqtt_close(&ends[i].mqtt);
    }
    iris_mqtt_close(&elsewhere.mqtt);
}

/* A machine that dies has its will published; one that takes its leave has not. */
static void the_last_will_is_published(void **state)
{
    (void)state;
    need_broker();
    static end heir, polite;
    iris_mqtt_config config = usual("iris/will");
    const uint8_t will[3] = {60, 61, 62};
    open_end(&heir, &config);
    wait_for(&heir, 1);
    config.will = will;
    config.will_count = sizeof will;
    open_end(&polite, &config);
    wait_for(&polite, 1);
    iris_mqtt_close(&polite.mqtt);
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    assert_int_equal(hear(&heir, bytes, 300), 0);
    int ready[2];
    assert_int_equal(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0) {
        static end mortal;
        size_t count;
        (void)iris_mqtt_open(&mortal.mqtt, &config);
        (void)iris_mqtt_transport(&mortal.transport, &mortal.mqtt);
        for (int told = 0;; sleep_ms(1)) {
            (void)mortal.transport.receive(mortal.transport.context, bytes, sizeof bytes, &count);
            if (mortal.mqtt.connected && !told) {
                told = write(ready[1], "r", 1) == 1;
            }
        }
    }
    char letter;
    assert_int_equal(read(ready[0], &letter, 1), 1);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    hears(&heir, 60, 3);
    close(ready[0]);
    close(ready[1]);
    iris_mqtt_close(&heir.mqtt);
}

static void wait_for_kept(end *e, size_t count, uint32_t refused)
{
    const double start = now_ms();
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    while (e->mqtt.kept_count != count || e->mqtt.refused != refused) {
        (void)hear(e, bytes, 5);
        assert_true(now_ms() - start < PATIENCE);
    }
}

static void who_comes_late_gets_what_is_kept(void **state)
{
    (void)state;
    need_broker();
    static end giver, late, other;
    uint8_t chunk[IRIS_MQTT_KEPT_BYTES_MAX + 1];
    for (size_t i = 0; i < sizeof chunk; i++) {
        chunk[i] = (uint8_t)(i * 7);
    }
    iris_mqtt_config config = usual("iris/kept");
    open_end(&giver, &config);
    assert_int_equal(iris_mqtt_keep(NULL, 1, chunk, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 1, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, -1, chunk, 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 65536, chunk, 1), IRIS_ERR_RANGE);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 1, chunk, IRIS_MQTT_KEPT_BYTES_MAX + 1), IRIS_ERR_RANGE);
    wait_for(&giver, 1);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 40, chunk, 500), IRIS_OK);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 65535, chunk + 1, IRIS_MQTT_KEPT_BYTES_MAX), IRIS_OK);
    config.kept = 40;
    open_end(&late, &config);
    config.kept = 65535;
    open_end(&other, &config);
    wait_for_kept(&late, 500, 0);
    assert_memory_equal(late.mqtt.kept_bytes, chunk, 500);
    wait_for_kept(&other, IRIS_MQTT_KEPT_BYTES_MAX, 0);
    assert_memory_equal(other.mqtt.kept_bytes, chunk + 1, IRIS_MQTT_KEPT_BYTES_MAX);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 40, chunk, 20), IRIS_OK); /* a newer one */
    wait_for_kept(&late, 20, 0);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 40, chunk, 0), IRIS_OK);
    wait_for_kept(&late, 0, 0);
    assert_int_equal(iris_mqtt_keep(&giver.mqtt, 65535, chunk, 0), IRIS_OK);
    wait_for_kept(&other, 0, 0);
    iris_mqtt_close(&giver.mqtt);
    iris_mqtt_close(&late.mqtt);
    iris_mqtt_close(&other.mqtt);
}

/* The broker is killed and comes back: what is said meanwhile is lost, no call waits, and all of them find it again. */
static void a_broker_comes_back(void **state)
{
    (void)state;
    need_broker();
    static end a, b;
    const iris_mqtt_config config = usual("iris/again");
    open_end(&a, &config);
    open_end(&b, &config);
    for (uint32_t round = 1; round <= 3; round++) {
        wait_for(&a, round);
        wait_for(&b, round);
        assert_int_equal(say(&a, (uint8_t)round, 5), IRIS_OK);
        hears(&b, (uint8_t)round, 5);
        kill_broker();
        const uint32_t lost = a.mqtt.lost;
        double longest = 0;
        for (int i = 0; i < 100; i++) {
            const double start = now_ms();
            uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
            (void)say(&a, 100, 2);
            (void)hear(&b, bytes, 1);
            (void)hear(&a, bytes, 1);
            longest = now_ms() - start > longest ? now_ms() - start : longest;
        }
        assert_true(longest <
                    2000); /* on a busy machine; a call that waits for a broker would wait much longer */
        assert_in_range(a.mqtt.lost - lost, 90, 100);
        assert_int_equal(a.mqtt.connected + b.mqtt.connected, 0);
        assert_true(strlen(iris_mqtt_problem(&b.mqtt)) > 5);
        assert_int_equal(start_broker(), 1);
    }
    wait_for(&a, 4);
    iris_mqtt_close(&a.mqtt);
    iris_mqtt_close(&b.mqtt);
}

static void wishes_are_checked(void **state)
{
    (void)state;
    static iris_mqtt mqtt, untouched;
    memset(&mqtt, 0x5a, sizeof mqtt);
    memset(&untouched, 0x5a, sizeof untouched);
    iris_mqtt_defaults(NULL);
    const uint8_t will[BORG_DATAGRAM_BYTES_MAX + 1] = {0};
    const iris_mqtt_config right = usual("iris");
    iris_mqtt_config bad[24];
    size_t n = 0;
    for (size_t i = 0; i < 24; i++) {
        bad[i] = right;
        bad[i].port = 1883;
    }
    static const char *const no_topics[] = {
        "",   "a b", "a+",   "#",
        "/a", "a/",  "$SYS", "0123456789012345678901234567890123456789012345678901234567890123"};
    for (size_t i = 0; i < sizeof no_topics / sizeof no_topics[0]; i++) {
        bad[n++].topic = no_topics[i];
    }
    bad[n++].topic = NULL;
    bad[n++].host = NULL;
    bad[n++].host = "";
    bad[n++].host = no_topics[7];
    bad[n++].port = 0;
    bad[n++].port = 65536;
    bad[n++].reconnect_ms = 9;
    bad[n++].reconnect_ms = 60001;
    bad[n++].keep_alive_s = 4;
    bad[n++].keep_alive_s = 3601;
    bad[n++].will = will;
    bad[n++].will_count = 1;
    bad[n].will = will;
    bad[n++].will_count = sizeof will;
    bad[n++].kept = -2;
    bad[n++].kept = 65536;
    for (size_t i = 0; i < n; i++) {
        assert_int_equal(iris_mqtt_open(&mqtt, &bad[i]), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_mqtt_open(&mqtt, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_mqtt_open(NULL, &right), IRIS_ERR_ARG);
    assert_memory_equal(&mqtt, &untouched, sizeof mqtt);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    iris_mqtt closed = {0};
    borg_transport t;
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX + 1] = {0};
    size_t count = 99;
    assert_int_equal(iris_mqtt_transport(&t, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_mqtt_transport(NULL, &closed), IRIS_ERR_ARG);
    assert_int_equal(iris_mqtt_transport(&t, &closed), IRIS_OK);
    assert_int_equal(t.send(NULL, bytes, 1), IRIS_ERR_ARG);
    assert_int_equal(t.send(t.context, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(t.send(t.context, bytes, 0), IRIS_ERR_RANGE);
    assert_int_equal(t.send(t.context, bytes, BORG_DATAGRAM_BYTES_MAX + 1), IRIS_ERR_RANGE);
    assert_int_equal(t.receive(NULL, bytes, sizeof bytes, &count), IRIS_ERR_ARG);
    assert_int_equal(t.receive(t.context, NULL, sizeof bytes, &count), IRIS_ERR_ARG);
    assert_int_equal(t.receive(t.context, bytes, sizeof bytes, NULL), IRIS_ERR_ARG);
    assert_int_equal(t.receive(t.context, bytes, BORG_DATAGRAM_BYTES_MAX - 1, &count), IRIS_ERR_RANGE);
    assert_int_equal(t.send(t.context, bytes, 1), IRIS_ERR_IO); /* closed is closed */
    assert_int_equal(t.receive(t.context, bytes, sizeof bytes, &count), IRIS_ERR_IO);
    assert_int_equal(count, 0);
    assert_int_equal(iris_mqtt_keep(&closed, 1, bytes, 1), IRIS_ERR_IO);
    iris_mqtt_close(NULL);
    iris_mqtt_close(&closed);
    assert_non_null(iris_mqtt_problem(NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everybody_of_the_topic_hears),
        cmocka_unit_test(the_last_will_is_published),
        cmocka_unit_test(who_comes_late_gets_what_is_kept),
        cmocka_unit_test(a_broker_comes_back),
        cmocka_unit_test(wishes_are_checked),
        cmocka_unit_test(arguments_are_checked),
    };
    return cmocka_run_group_tests(tests, find_broker, leave_broker);
}
