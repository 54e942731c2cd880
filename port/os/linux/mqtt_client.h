/* What mqtt.c asks of libmosquitto: written once with it, and once for a build without it. */
#ifndef IRIS_LINUX_MQTT_CLIENT_H
#define IRIS_LINUX_MQTT_CLIENT_H

#include "iris/mqtt.h"

/* Sets mqtt->client, null when it returns an error: ENOSYS without libmosquitto, ENOMEM. */
int iris_mqtt_client_open(iris_mqtt *mqtt);

/* Begins to connect: 0, or why not is in mqtt->problem. */
int iris_mqtt_client_connect(iris_mqtt *mqtt);

/* Does what is to be done at this moment; what comes goes to the functions below. 0, or the connection is lost, and
 * mqtt->problem says why. */
int iris_mqtt_client_work(iris_mqtt *mqtt);

/* Publishes with quality of service 1. 0, or it was not taken. */
int iris_mqtt_client_publish(iris_mqtt *mqtt, const char *topic, const uint8_t *bytes, size_t count,
                             int keep);

void iris_mqtt_client_close(iris_mqtt *mqtt);

/* mqtt.c's: topics as they are written, room for IRIS_MQTT_TOPIC_BYTES + 16. */
void iris_mqtt_team_topic(char *text, const iris_mqtt *mqtt);
void iris_mqtt_kept_topic(char *text, const iris_mqtt *mqtt, int32_t number);
#define IRIS_MQTT_FULL_TOPIC_BYTES (IRIS_MQTT_TOPIC_BYTES + 16)

/* mqtt.c's: what has come, of the team (kept 0) or of what is kept. */
void iris_mqtt_take(iris_mqtt *mqtt, const uint8_t *bytes, size_t count, int kept);

void iris_mqtt_say(iris_mqtt *mqtt, const char *text);

#endif
