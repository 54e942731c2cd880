/* A broker on a free port of the loopback, which the test starts by itself, and ends of a team at it. */
#ifndef IRIS_TEST_MQTT_BROKER_H
#define IRIS_TEST_MQTT_BROKER_H

#include "iris/mqtt.h"
#include "test.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <stdio.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { PATIENCE = 20000 }; /* ms that something may take on a busy machine */

static pid_t broker;
static int32_t port;
static char folder[] = "/tmp/iris-mqtt-XXXXXX", config_path[64];
static const char *why_not; /* why nothing can be tested here; null: it can */

static void sleep_ms(long ms)
{
    nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000}, NULL);
}

static double now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

static struct sockaddr_in loopback(int32_t at)
{
    struct sockaddr_in address;
    memset(&address, 0, sizeof address);
    address.sin_family = AF_INET;
    address.sin_port = htons((uint16_t)at);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

/* A socket that listens on a free port, *at. */
static int listen_anywhere(int32_t *at)
{
    struct sockaddr_in address = loopback(0);
    socklen_t length = sizeof address;
    const int handle = socket(AF_INET, SOCK_STREAM, 0);
    assert_true(handle >= 0);
    assert_int_equal(bind(handle, (struct sockaddr *)&address, sizeof address), 0);
    assert_int_equal(listen(handle, 5), 0);
    assert_int_equal(getsockname(handle, (struct sockaddr *)&address, &length), 0);
    *at = ntohs(address.sin_port);
    return handle;
}

static int connect_to(int32_t at)
{
    const struct sockaddr_in address = loopback(at);
    const int handle = socket(AF_INET, SOCK_STREAM, 0);
    if (connect(handle, (const struct sockaddr *)&address, sizeof address) == 0) {
        return handle;
    }
    close(handle);
    return -1;
}

/* 1: it listens. */
static int start_broker(void)
{
    broker = fork();
    if (broker == 0) {
        const int nowhere = open("/dev/null", O_RDWR);
        dup2(nowhere, 1);
        dup2(nowhere, 2);
        execl("/usr/sbin/mosquitto", "mosquitto", "-c", config_path, (char *)NULL);
        _exit(77);
    }
    for (int i = 0; i < PATIENCE / 10; i++) {
        const int handle = connect_to(port);
        if (handle >= 0) {
            close(handle);
            return 1;
        }
        if (waitpid(broker, NULL, WNOHANG) == broker) {
            broker = 0;
            return 0;
        }
        sleep_ms(10);
    }
    return 0;
}

static void kill_broker(void)
{
    if (broker > 0) {
        kill(broker, SIGKILL);
        waitpid(broker, NULL, 0);
    }
    broker = 0;
}

/* The port was free a moment ago: where another program was quicker, another one is taken. */
static int find_broker(void **state)
{
    (void)state;
    iris_mqtt mqtt;
    iris_mqtt_config config;
    iris_mqtt_defaults(&config);
    config.host = "127.0.0.1";
    if (iris_mqtt_open(&mqtt, &config) == IRIS_ERR_UNSUPPORTED) {
        why_not = "this build has no libmosquitto";
        return 0;
    }
    iris_mqtt_close(&mqtt);
    if (access("/usr/sbin/mosquitto", X_OK) != 0) {
        why_not = "no broker: mosquitto is not installed";
        return 0;
    }
    if (!mkdtemp(folder)) {
        return 1;
    }
    snprintf(config_path, sizeof config_path, "%s/mosquitto.conf", folder);
    for (int i = 0; i < 5; i++) {
        close(listen_anywhere(&port));
        FILE *out = fopen(config_path, "w");
        if (!out) {
            return 1;
        }
        fprintf(out,
                "listener %d 127.0.0.1\nallow_anonymous true\npersistence false\nuser root\nlog_dest none\n",
                (int)port);
        fclose(out);
        if (start_broker()) {
            return 0;
        }
    }
    return 1;
}

static int leave_broker(void **state)
{
    (void)state;
    kill_broker();
    unlink(config_path);
    rmdir(folder);
    return 0;
}

static void need_broker(void)
{
    if (why_not) {
        printf("#: %s\n", why_not);
        skip();
    }
}

typedef struct {
    iris_mqtt mqtt;
    borg_transport transport;
} end;

static iris_mqtt_config usual(const char *topic)
{
    iris_mqtt_config config;
    iris_mqtt_defaults(&config);
    config.host = "127.0.0.1";
    config.port = port;
    config.topic = topic;
    config.reconnect_ms = 50;
    return config;
}

static size_t take(end *e, uint8_t bytes[BORG_DATAGRAM_BYTES_MAX])
{
    size_t count = 99;
    const iris_status status =
        e->transport.receive(e->transport.context, bytes, BORG_DATAGRAM_BYTES_MAX, &count);
    assert_true(status == IRIS_OK || (status == IRIS_ERR_IO && count == 0));
    return count;
}

static void open_end(end *e, const iris_mqtt_config *config)
{
    assert_int_equal(iris_mqtt_open(&e->mqtt, config), IRIS_OK);
    assert_int_equal(iris_mqtt_transport(&e->transport, &e->mqtt), IRIS_OK);
}

/* Works until this many connections were made. What is sent next may still come before the broker has read the subscription:
 * so each end says something to itself until it hears it. */
static void wait_for(end *e, uint32_t connects)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    const double start = now_ms();
    int heard = 0;
    while (e->mqtt.connects < connects || !heard) {
        assert_true(now_ms() - start < PATIENCE);
        const uint8_t probe = 0xff;
        if (e->mqtt.connects >= connects) {
            (void)e->transport.send(e->transport.context, &probe, 1);
        }
        sleep_ms(5);
        heard = take(e, bytes) == 1 && bytes[0] == 0xff && e->mqtt.connects >= connects;
    }
}

/* What comes next, without the probes above. */
static size_t hear(end *e, uint8_t bytes[BORG_DATAGRAM_BYTES_MAX], double patience)
{
    const double start = now_ms();
    while (now_ms() - start < patience) {
        const size_t count = take(e, bytes);
        if (count > 0 && !(count == 1 && bytes[0] == 0xff)) {
            return count;
        }
        if (count == 0) {
            sleep_ms(1);
        }
    }
    return 0;
}

static iris_status say(end *e, uint8_t first, size_t count)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    for (size_t i = 0; i < count; i++) {
        bytes[i] = (uint8_t)(first + i);
    }
    return e->transport.send(e->transport.context, bytes, count);
}

static void hears(end *e, uint8_t first, size_t count)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    assert_int_equal(hear(e, bytes, PATIENCE), count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(bytes[i], (uint8_t)(first + i));
    }
}

#endif
