#include "team_network.h"

#include <string.h>

/* 0 to 99 (G. Marsaglia, Xorshift RNGs, 2003). */
static int32_t percent(team_network *network)
{
    uint32_t x = network->random;
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
    network->random = x;
    return (int32_t)((x >> 8) % 100);
}

void team_network_init(team_network *network, int32_t count, int32_t loss_percent, uint32_t seed)
{
    memset(network, 0, sizeof *network);
    network->loss_percent = loss_percent;
    network->random = seed * 2654435761u ^ 0x9E3779B9u;
    network->random = network->random ? network->random : 1;
    (void)borg_bus_init(&network->bus, network->ring, TEAM_BUS_DEPTH, network->bus_ends, count);
}

static iris_status send_all(void *context, const uint8_t *bytes, size_t count)
{
    team_end *end = context;
    end->network->sent++;
    return end->bus.send(end->bus.context, bytes, count);
}

static iris_status receive_some(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    team_end *end = context;
    for (;;) {
        const iris_status status = end->bus.receive(end->bus.context, bytes, capacity, count);
        if (status != IRIS_OK || *count == 0) {
            return status;
        }
        if (percent(end->network) >= end->network->loss_percent) {
            borg_message message;
            if (borg_message_read(&message, bytes, *count) == IRIS_OK &&
                message.kind == BORG_MESSAGE_SIGNAL) {
                end->signal_came(end->user, &message);
            }
            return IRIS_OK;
        }
        end->network->lost++;
    }
}

borg_transport team_network_transport(team_network *network, int32_t end,
                                      void (*signal_came)(void *user, const borg_message *message),
                                      void *user)
{
    team_end *e = &network->ends[end];
    *e = (team_end){network, {0}, signal_came, user};
    (void)borg_bus_transport(&e->bus, &network->bus, end);
    return (borg_transport){send_all, receive_some, e};
}
