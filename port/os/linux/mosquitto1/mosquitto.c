/* MQTT by libmosquitto, whose library is called libmosquitto.so.1 in its versions 1 and 2. Its loop is run here, never by a
 * thread of its own, and its waits are of no time. */
#include "../mqtt_client.h"

#include <errno.h>
#include <mosquitto.h>
#include <string.h>

/* Of what the broker has sent, how many packets one call takes at most. */
#define PACKETS_AT_ONCE 16

static void on_connect(struct mosquitto *client, void *context, int refused)
{
    iris_mqtt *mqtt = context;
    if (refused != 0) {
        iris_mqtt_say(mqtt, mosquitto_connack_string(refused));
        return;
    }
    char topic[IRIS_MQTT_FULL_TOPIC_BYTES];
    iris_mqtt_team_topic(topic, mqtt);
    int result = mosquitto_subscribe(client, NULL, topic, 1);
    if (result == MOSQ_ERR_SUCCESS && mqtt->kept >= 0) {
        iris_mqtt_kept_topic(topic, mqtt, mqtt->kept);
        result = mosquitto_subscribe(client, NULL, topic, 1);
    }
    mqtt->connected = result == MOSQ_ERR_SUCCESS;
    mqtt->connects += mqtt->connected;
}

static void on_disconnect(struct mosquitto *client, void *context, int reason)
{
    (void)client;
    (void)reason;
    iris_mqtt *mqtt = context;
    mqtt->connected = 0;
}

static void on_publish(struct mosquitto *client, void *context, int number)
{
    (void)client;
    (void)number;
    iris_mqtt *mqtt = context;
    mqtt->confirmed++;
    mqtt->unconfirmed -= mqtt->unconfirmed > 0;
}

static void on_message(struct mosquitto *client, void *context, const struct mosquitto_message *message)
{
    (void)client;
    iris_mqtt *mqtt = context;
    char topic[IRIS_MQTT_FULL_TOPIC_BYTES];
    const size_t count = message->payloadlen > 0 && message->payload ? (size_t)message->payloadlen : 0;
    iris_mqtt_team_topic(topic, mqtt);
    if (message->topic && strcmp(message->topic, topic) == 0) {
        iris_mqtt_take(mqtt, message->payload, count, 0);
    } else if (message->topic && mqtt->kept >= 0) {
        iris_mqtt_kept_topic(topic, mqtt, mqtt->kept);
        if (strcmp(message->topic, topic) == 0) {
            iris_mqtt_take(mqtt, message->payload, count, 1);
        }
    }
}

int iris_mqtt_client_open(iris_mqtt *mqtt)
{
    (void)mosquitto_lib_init();
    struct mosquitto *client = mosquitto_new(NULL, true, mqtt);
    if (!client) {
        (void)mosquitto_lib_cleanup();
        return ENOMEM;
    }
    mosquitto_connect_callback_set(client, on_connect);
    mosquitto_disconnect_callback_set(client, on_disconnect);
    mosquitto_publish_callback_set(client, on_publish);
    mosquitto_message_callback_set(client, on_message);
    (void)mosquitto_max_inflight_messages_set(client, 0); /* as many as are given: they are counted here */
    int result = MOSQ_ERR_SUCCESS;
    if (mqtt->will_count > 0) {
        char topic[IRIS_MQTT_FULL_TOPIC_BYTES];
        iris_mqtt_team_topic(topic, mqtt);
        result = mosquitto_will_set(client, topic, (int)mqtt->will_count, mqtt->will, 1, false);
    }
    mqtt->client = client;
    if (result != MOSQ_ERR_SUCCESS) {
        iris_mqtt_client_close(mqtt);
        return ENOMEM;
    }
    return 0;
}

/* Says why a call failed. */
static int told(iris_mqtt *mqtt, int result)
{
    if (result == MOSQ_ERR_SUCCESS) {
        return 0;
    }
    const int number = errno;
    if (result == MOSQ_ERR_ERRNO && number == ECONNREFUSED) {
        iris_mqtt_say(mqtt, "no broker answers there");
    } else if (result == MOSQ_ERR_CONN_LOST) {
        iris_mqtt_say(mqtt, "the broker is gone");
    } else if (result == MOSQ_ERR_EAI) {
        iris_mqtt_say(mqtt, "no host of this name");
    } else if (result != MOSQ_ERR_NO_CONN) {
        iris_mqtt_say(mqtt, result == MOSQ_ERR_ERRNO ? "the network failed" : mosquitto_strerror(result));
    }
    return result;
}

int iris_mqtt_client_connect(iris_mqtt *mqtt)
{
    return told(mqtt, mosquitto_connect_async(mqtt->client, mqtt->host, mqtt->port, mqtt->keep_alive_s));
}

int iris_mqtt_client_work(iris_mqtt *mqtt)
{
    return told(mqtt, mosquitto_loop(mqtt->client, 0, PACKETS_AT_ONCE));
}

int iris_mqtt_client_publish(iris_mqtt *mqtt, const char *topic, const uint8_t *bytes, size_t count, int keep)
{
    return told(mqtt, mosquitto_publish(mqtt->client, NULL, topic, (int)count, bytes, 1, keep != 0));
}

void iris_mqtt_client_close(iris_mqtt *mqtt)
{
    (void)mosquitto_disconnect(mqtt->client);
    mosquitto_destroy(mqtt->client);
    (void)mosquitto_lib_cleanup();
    mqtt->client = NULL;
}
