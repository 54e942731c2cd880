/* The network of a team, as --transport names it: UDP multicast or MQTT.
 */
#ifndef IRIS_TOOL_TEAM_LINK_H
#define IRIS_TOOL_TEAM_LINK_H

#include "iris/mqtt.h"
#include "iris/udp.h"

typedef struct {
    int is_mqtt;
    int32_t port;
    char host[IRIS_MQTT_HOST_BYTES]; /* or the group */
    char topic[IRIS_MQTT_TOPIC_BYTES];
    char face[IRIS_UDP_INTERFACE_BYTES]; /* the interface's name; empty: the system's choice */
} team_link_option;

typedef struct {
    team_link_option option;
    borg_transport transport;
    iris_udp udp;
    iris_mqtt mqtt;
} team_link;

/* text: null is "udp". Complains; 1 when it is one, else 0. */
int team_link_read(team_link_option *option, const char *text);

/* will: the datagram that tells the others that this machine is gone, for a broker; count 0: none. kept: the number of what is
 * wanted of what the broker keeps; -1: nothing. A broker that does not answer yet is waited for by whoever uses the link. Complains; 1 when it is open,
 * else 0. The link must stay where it is. */
int team_link_open(team_link *link, const team_link_option *option, const uint8_t *will, size_t count,
                   int32_t kept);

void team_link_close(team_link *link);

#endif
