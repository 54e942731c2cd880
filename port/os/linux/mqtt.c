/* MQTT: what is asked for, what waits, and when to connect again; libmosquitto is asked through mqtt_client.h. */
#include "iris/mqtt.h"

#include <errno.h>
#include <string.h>
#include <time.h>

#include "mqtt_client.h"

static uint32_t now_ms(void)
{
    struct timespec now = {0, 0};
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)now.tv_sec * 1000u + (uint32_t)(now.tv_nsec / 1000000);
}

void iris_mqtt_say(iris_mqtt *mqtt, const char *text)
{
    size_t length = strlen(text);
    length = length < sizeof mqtt->problem ? length : sizeof mqtt->problem - 1;
    while (length > 0 && (text[length - 1] == '.' || text[length - 1] == '\n')) {
        length--;
    }
    memcpy(mqtt->problem, text, length);
    mqtt->problem[length] = '\0';
}

static size_t with_ending(char *text, const iris_mqtt *mqtt, const char *ending)
{
    const size_t length = strlen(mqtt->topic), more = strlen(ending);
    memcpy(text, mqtt->topic, length);
    memcpy(text + length, ending, more + 1);
    return length + more;
}

void iris_mqtt_team_topic(char *text, const iris_mqtt *mqtt)
{
    (void)with_ending(text, mqtt, "/team");
}

void iris_mqtt_kept_topic(char *text, const iris_mqtt *mqtt, int32_t number)
{
    size_t at = with_ending(text, mqtt, "/kept/");
    int32_t unit = 10000;
    while (unit > 1 && number / unit == 0) {
        unit /= 10;
    }
    for (; unit > 0; unit /= 10) {
        text[at++] = (char)('0' + number / unit % 10);
    }
    text[at] = '\0';
}

void iris_mqtt_take(iris_mqtt *mqtt, const uint8_t *bytes, size_t count, int kept)
{
    if (kept) {
        if (count > IRIS_MQTT_KEPT_BYTES_MAX) {
            mqtt->refused++;
        } else {
            if (count > 0) {
                memcpy(mqtt->kept_bytes, bytes, count);
            }
            mqtt->kept_count = count;
        }
        return;
    }
    if (count < 1 || count > BORG_DATAGRAM_BYTES_MAX) {
        mqtt->refused++;
        return;
    }
    if (mqtt->waiting == IRIS_MQTT_WAITING) {
        mqtt->first = (mqtt->first + 1) % IRIS_MQTT_WAITING;
        mqtt->waiting--;
        mqtt->dropped++;
    }
    iris_mqtt_datagram *place = &mqtt->datagrams[(mqtt->first + mqtt->waiting) % IRIS_MQTT_WAITING];
    place->count = (uint32_t)count;
    memcpy(place->bytes, bytes, count);
    mqtt->waiting++;
}

void iris_mqtt_defaults(iris_mqtt_config *config)
{
    if (config) { /* one by one: of a whole one with an address in it some compilers keep a copy that can be written */
        memset(config, 0, sizeof *config);
        config->port = IRIS_MQTT_PORT;
        config->topic = "iris";
        config->reconnect_ms = 500;
        config->keep_alive_s = 10;
        config->kept = -1;
    }
}

static int is_topic(const char *topic)
{
    const size_t length = topic ? strlen(topic) : 0;
    if (length < 1 || length >= IRIS_MQTT_TOPIC_BYTES || topic[0] == '/' || topic[length - 1] == '/') {
        return 0;
    }
    for (size_t i = 0; i < length; i++) {
        if (topic[i] <= ' ' || topic[i] > '~' || topic[i] == '+' || topic[i] == '#' || topic[i] == '$') {
            return 0;
        }
    }
    return 1;
}

static int is_right(const iris_mqtt_config *config)
{
    const size_t length = config && config->host ? strlen(config->host) : 0;
    return length >= 1 && length < IRIS_MQTT_HOST_BYTES && is_topic(config->topic) && config->port >= 1 &&
           config->port <= 65535 && config->reconnect_ms >= 10 && config->reconnect_ms <= 60000 &&
           config->keep_alive_s >= 5 && config->keep_alive_s <= 3600 && config->kept >= -1 &&
           config->kept <= 65535 &&
           (config->will ? config->will_count >= 1 && config->will_count <= BORG_DATAGRAM_BYTES_MAX
                         : config->will_count == 0);
}

static iris_status try_connect(iris_mqtt *mqtt)
{
    mqtt->tried_ms = now_ms();
    mqtt->tried = iris_mqtt_client_connect(mqtt) == 0;
    return mqtt->tried ? IRIS_OK : IRIS_ERR_IO;
}

iris_status iris_mqtt_open(iris_mqtt *mqtt, const iris_mqtt_config *config)
{
    if (!mqtt || !is_right(config)) {
        return IRIS_ERR_ARG;
    }
    memset(mqtt, 0, sizeof *mqtt);
    memcpy(mqtt->host, config->host, strlen(config->host));
    memcpy(mqtt->topic, config->topic, strlen(config->topic));
    mqtt->port = config->port;
    mqtt->reconnect_ms = config->reconnect_ms;
    mqtt->keep_alive_s = config->keep_alive_s;
    mqtt->kept = config->kept;
    mqtt->will_count = (uint32_t)config->will_count;
    if (config->will_count > 0) {
        memcpy(mqtt->will, config->will, config->will_count);
    }
    iris_mqtt_say(mqtt, "no answer from the broker yet");
    const int error = iris_mqtt_client_open(mqtt);
    if (error != 0) {
        iris_mqtt_say(mqtt, error == ENOSYS ? "this build of IRIS has no MQTT: libmosquitto was not there"
                                            : "no memory");
        return error == ENOSYS ? IRIS_ERR_UNSUPPORTED : IRIS_ERR_IO;
    }
    mqtt->open = 1;
    return try_connect(mqtt);
}

/* Has the broker not answered in time? */
static int is_late(iris_mqtt *mqtt, uint32_t since_ms)
{
    if (mqtt->connected || since_ms < (uint32_t)mqtt->keep_alive_s * 1000u) {
        return 0;
    }
    iris_mqtt_say(mqtt, "the broker does not answer");
    return 1;
}

/* Does what is to be done, and connects again when it is time to. IRIS_ERR_IO: not connected. */
static iris_status work(iris_mqtt *mqtt)
{
    if (!mqtt->open) {
        return IRIS_ERR_IO;
    }
    const uint32_t since = now_ms() - mqtt->tried_ms;
    if (!mqtt->tried && since >= (uint32_t)mqtt->reconnect_ms) {
        (void)try_connect(mqtt);
    } else if (mqtt->tried && (iris_mqtt_client_work(mqtt) != 0 || is_late(mqtt, since))) {
        mqtt->tried = 0;
        mqtt->connected = 0;
    }
    return mqtt->connected ? IRIS_OK : IRIS_ERR_IO;
}

static iris_status publish(iris_mqtt *mqtt, const char *topic, const uint8_t *bytes, size_t count, int keep)
{
    iris_status status = work(mqtt);
    if (status == IRIS_OK && mqtt->unconfirmed >= IRIS_MQTT_UNCONFIRMED_MAX) {
        status = IRIS_ERR_FULL;
    }
    if (status == IRIS_OK && iris_mqtt_client_publish(mqtt, topic, bytes, count, keep) != 0) {
        status = IRIS_ERR_IO;
    }
    mqtt->unconfirmed += status == IRIS_OK;
    return status;
}

static iris_status mqtt_send(void *context, const uint8_t *bytes, size_t count)
{
    iris_mqtt *mqtt = context;
    if (!mqtt || !bytes) {
        return IRIS_ERR_ARG;
    }
    if (count < 1 || count > BORG_DATAGRAM_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    char topic[IRIS_MQTT_FULL_TOPIC_BYTES];
    iris_mqtt_team_topic(topic, mqtt);
    const iris_status status = publish(mqtt, topic, bytes, count, 0);
    mqtt->sent += status == IRIS_OK;
    mqtt->lost += status != IRIS_OK;
    return status;
}

iris_status iris_mqtt_keep(iris_mqtt *mqtt, int32_t number, const uint8_t *bytes, size_t count)
{
    if (!mqtt || !bytes) {
        return IRIS_ERR_ARG;
    }
    if (number < 0 || number > 65535 || count > IRIS_MQTT_KEPT_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    char topic[IRIS_MQTT_FULL_TOPIC_BYTES];
    iris_mqtt_kept_topic(topic, mqtt, number);
    return publish(mqtt, topic, bytes, count, 1);
}

static iris_status mqtt_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    iris_mqtt *mqtt = context;
    if (!mqtt || !bytes || !count) {
        return IRIS_ERR_ARG;
    }
    if (capacity < BORG_DATAGRAM_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    *count = 0;
    const iris_status status = mqtt->waiting > 0 ? IRIS_OK : work(mqtt);
    if (mqtt->waiting > 0) { /* also what came before the connection was lost */
        const iris_mqtt_datagram *datagram = &mqtt->datagrams[mqtt->first];
        *count = datagram->count;
        memcpy(bytes, datagram->bytes, datagram->count);
        mqtt->first = (mqtt->first + 1) % IRIS_MQTT_WAITING;
        mqtt->waiting--;
        mqtt->received++;
        return IRIS_OK;
    }
    return status;
}

iris_status iris_mqtt_transport(borg_transport *transport, iris_mqtt *mqtt)
{
    if (!transport || !mqtt) {
        return IRIS_ERR_ARG;
    }
    *transport = (borg_transport){mqtt_send, mqtt_receive, mqtt};
    return IRIS_OK;
}

void iris_mqtt_close(iris_mqtt *mqtt)
{
    if (!mqtt || !mqtt->open) {
        return;
    }
    iris_mqtt_client_close(mqtt);
    mqtt->open = 0;
    mqtt->connected = 0;
    mqtt->waiting = 0;
}

const char *iris_mqtt_problem(const iris_mqtt *mqtt)
{
    return mqtt ? mqtt->problem : "no connection";
}
