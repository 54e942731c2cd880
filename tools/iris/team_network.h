/* The bus of a simulated team, which loses some of what is sent on the way to each end, and shows the signals that arrive.
 */
#ifndef IRIS_TOOL_TEAM_NETWORK_H
#define IRIS_TOOL_TEAM_NETWORK_H

#include "iris/borg/in_process.h"
#include "iris/borg/message.h"

typedef struct team_network team_network;

/* Belongs to the functions. */
typedef struct {
    team_network *network;
    borg_transport bus; /* without losses */
    void (*signal_came)(void *user, const borg_message *message);
    void *user;
} team_end;

#define TEAM_ENDS_MAX  64
#define TEAM_BUS_DEPTH 1024

struct team_network {
    borg_bus bus;
    borg_bus_datagram ring[TEAM_BUS_DEPTH];
    borg_bus_end bus_ends[TEAM_ENDS_MAX];
    team_end ends[TEAM_ENDS_MAX];
    int32_t loss_percent;
    uint32_t random;
    uint32_t sent, lost;
};

/* count: 1 to TEAM_ENDS_MAX. The network must stay where it is. */
void team_network_init(team_network *network, int32_t count, int32_t loss_percent, uint32_t seed);

/* The transport of an end, which calls signal_came(user, ...) with each BORG_MESSAGE_SIGNAL that arrives, repeated ones too. */
borg_transport team_network_transport(team_network *network, int32_t end,
                                      void (*signal_came)(void *user, const borg_message *message),
                                      void *user);

#endif
