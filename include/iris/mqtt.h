/* IRIS - a team across networks: datagrams through an MQTT broker (MQTT 3.1.1), such as mosquitto.
 *
 * All that open the same topic at the same broker hear each other, wherever they are. Datagrams are published under
 * "<topic>/team" with quality of service 1: what the broker has taken comes at least once to everybody who is connected.
 * A broker can do two more things for a team. It publishes a datagram that a machine leaves with it when it connects, its last
 * will, once the machine is gone without having said so. And it keeps bytes for those who come late: "<topic>/kept/<number>",
 * such as a robot's chunk.
 *
 * A broker that disappears is an error that the loop survives: what is sent meanwhile is lost, and later calls connect again.
 * A broker that starts anew may have forgotten what it kept: keep again what you keep whenever `connects` has grown.
 *
 * Through libmosquitto, if it is built in, without threads of its own: it works within the calls below. libmosquitto allocates.
 * A broker can be anybody: what comes from it is checked for its size here, all else is for the reader to check. Neither
 * passwords nor encryption: for brokers on a network that is trusted. The operating system's part is in port/os.
 */
#ifndef IRIS_MQTT_H
#define IRIS_MQTT_H

#include "iris/borg/transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The usual port of a broker. */
#define IRIS_MQTT_PORT 1883

#define IRIS_MQTT_HOST_BYTES      64  /* room for a host, with a terminating 0 */
#define IRIS_MQTT_TOPIC_BYTES     64  /* room for a topic, with a terminating 0 */
#define IRIS_MQTT_KEPT_BYTES_MAX  640 /* the most that is kept under one number */
#define IRIS_MQTT_WAITING         64 /* datagrams that wait for the caller; further ones push out the oldest */
#define IRIS_MQTT_UNCONFIRMED_MAX 64  /* datagrams that wait for the broker's word that it has them */
#define IRIS_MQTT_PROBLEM_BYTES   128 /* room for why something failed, with a terminating 0 */

/* All is copied, or used during the call only. */
typedef struct {
    const char *
        host; /* a number with dots or a name; a name is looked up by each attempt to connect, which may take long */
    int32_t port;         /* 1 to 65535 */
    const char *topic;    /* such as "iris": not empty, without + # and spaces, and no / at either end */
    int32_t reconnect_ms; /* the least time between two attempts to connect, 10 to 60000 */
    int32_t
        keep_alive_s; /* a machine that is silent for one and a half of it is gone, 5 to 3600; what ends is known at once */
    const uint8_t *will; /* the datagram that the broker publishes then; null: none */
    size_t will_count;   /* 1 to BORG_DATAGRAM_BYTES_MAX; 0 with a null will */
    int32_t kept;        /* number of what this machine wants of what is kept; -1: nothing */
} iris_mqtt_config;

/* Port 1883, topic "iris", 500 ms, 10 s, no will, nothing kept; the host is left null. Null: nothing. */
void iris_mqtt_defaults(iris_mqtt_config *config);

typedef struct {
    uint32_t count;
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
} iris_mqtt_datagram;

/* Read the first nine; the rest belongs to the functions. */
typedef struct {
    uint32_t sent;      /* datagrams given to the broker */
    uint32_t confirmed; /* that it said it has, with what is kept */
    uint32_t received;  /* given to the caller; a program hears itself */
    uint32_t refused;   /* empty or too long */
    uint32_t dropped;   /* pushed out by newer ones */
    uint32_t lost;      /* not given to the broker, which was away or too slow */
    uint32_t connects;  /* times that the broker took this machine */
    uint8_t connected;  /* 1: at this moment it is */
    size_t kept_count;  /* bytes of what is kept; 0: none so far */

    uint8_t open; /* 0: closed for good */
    uint8_t tried;
    uint8_t kept_bytes[IRIS_MQTT_KEPT_BYTES_MAX];
    int32_t kept;
    int32_t port;
    int32_t reconnect_ms;
    int32_t keep_alive_s;
    uint32_t tried_ms;
    uint32_t unconfirmed;
    uint32_t will_count;
    int32_t first;   /* of the datagrams that wait */
    int32_t waiting; /* how many */
    void *client;    /* libmosquitto's */
    uint8_t will[BORG_DATAGRAM_BYTES_MAX];
    char host[IRIS_MQTT_HOST_BYTES];
    char topic[IRIS_MQTT_TOPIC_BYTES];
    char problem[IRIS_MQTT_PROBLEM_BYTES];
    iris_mqtt_datagram datagrams[IRIS_MQTT_WAITING];
} iris_mqtt;

/* Begins to connect; the calls of the transport go on with it, and `connected` tells when it is done. *mqtt must stay where it
 * is until it is closed. IRIS_ERR_ARG: null pointer, or a value outside the lists above, *mqtt untouched. Otherwise *mqtt is
 * open. IRIS_ERR_UNSUPPORTED: built without libmosquitto: close it; IRIS_ERR_IO: the first attempt failed, and
 * iris_mqtt_problem says why. Some ms, with the look-up of a name longer. */
iris_status iris_mqtt_open(iris_mqtt *mqtt, const iris_mqtt_config *config);

/* The transport over *mqtt. IRIS_ERR_FULL of its send: the broker has not confirmed IRIS_MQTT_UNCONFIRMED_MAX ones. Each call
 * does what the broker's connection has to do, without waiting, O(what has come). IRIS_ERR_ARG: null pointer. */
iris_status iris_mqtt_transport(borg_transport *transport, iris_mqtt *mqtt);

/* Has the broker keep `count` bytes under a number, 0 to 65535; 0 bytes: nothing any longer. IRIS_ERR_ARG: null pointer;
 * IRIS_ERR_RANGE: number, or more than IRIS_MQTT_KEPT_BYTES_MAX; IRIS_ERR_IO: not connected; IRIS_ERR_FULL: as with send.
 * What arrived of the number of the config is in kept_bytes and kept_count, the newest of it; a longer one is refused. O(count). */
iris_status iris_mqtt_keep(iris_mqtt *mqtt, int32_t number, const uint8_t *bytes, size_t count);

/* Takes leave of the broker, which does not publish the will then, and ends. What it has not confirmed may be lost. Every later
 * call but iris_mqtt_open returns IRIS_ERR_IO. Null and a second call do nothing; never waits. */
void iris_mqtt_close(iris_mqtt *mqtt);

/* Why the connection failed last, such as "the broker refused the connection". Never null; belongs to *mqtt. */
const char *iris_mqtt_problem(const iris_mqtt *mqtt);

#ifdef __cplusplus
}
#endif

#endif
