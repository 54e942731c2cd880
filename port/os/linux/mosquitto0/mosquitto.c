/* Built without libmosquitto. */
#include "../mqtt_client.h"

#include <errno.h>

int iris_mqtt_client_open(iris_mqtt *mqtt)
{
    mqtt->client = NULL;
    return ENOSYS;
}

int iris_mqtt_client_connect(iris_mqtt *mqtt)
{
    (void)mqtt;
    return ENOSYS;
}

int iris_mqtt_client_work(iris_mqtt *mqtt)
{
    (void)mqtt;
    return ENOSYS;
}

int iris_mqtt_client_publish(iris_mqtt *mqtt, const char *topic, const uint8_t *bytes, size_t count, int keep)
{
    (void)mqtt;
    (void)topic;
    (void)bytes;
    (void)count;
    (void)keep;
    return ENOSYS;
}

void iris_mqtt_client_close(iris_mqtt *mqtt)
{
    (void)mqtt;
}
