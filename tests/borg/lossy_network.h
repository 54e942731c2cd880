/* A network that loses, doubles, delays, and reorders datagrams, and falls in parts: everybody gets what is sent, or does
 * not. The same for one seed. */
#ifndef IRIS_TEST_LOSSY_NETWORK_H
#define IRIS_TEST_LOSSY_NETWORK_H

#include <stdint.h>
#include <string.h>

#include "iris/borg/message.h"

enum { NET_ENDS = 16, NET_FLYING = 2048 };

typedef struct {
    uint32_t at; /* when it arrives */
    uint8_t to;
    uint8_t bytes[BORG_MESSAGE_BYTES];
} net_datagram;

typedef struct {
    uint64_t random;
    uint32_t loss, twice; /* of 1000 */
    uint32_t delay_ms;    /* at most; but one of 50 takes ten times as long */
    int32_t ends;
    uint8_t part[NET_ENDS];  /* two ends hear each other in the same part, */
    uint16_t deaf[NET_ENDS]; /* but for those that one does not hear: bits */
    int32_t flying;
    net_datagram datagrams[NET_FLYING];
} lossy_network;

/* Splitmix64: S. Vigna, 2015. */
static inline uint32_t net_below(lossy_network *net, uint32_t end)
{
    uint64_t z = net->random += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (uint32_t)(((z ^ z >> 31) >> 32) * end >> 32);
}

static inline void net_send(lossy_network *net, int32_t from, const uint8_t *bytes, uint32_t now)
{
    for (int32_t to = 0; to < net->ends; to++) {
        if (to == from || net->part[to] != net->part[from] || (net->deaf[to] >> from & 1) ||
            net_below(net, 1000) < net->loss) {
            continue;
        }
        for (uint32_t copies = net_below(net, 1000) < net->twice ? 2 : 1; copies > 0; copies--) {
            if (net->flying < NET_FLYING) {
                net_datagram *d = &net->datagrams[net->flying++];
                const uint32_t delay = net_below(net, net->delay_ms + 1);
                d->at = now + (net_below(net, 50) == 0 ? 10 * delay : delay);
                d->to = (uint8_t)to;
                memcpy(d->bytes, bytes, sizeof d->bytes);
            }
        }
    }
}

/* One that has arrived; 0: none. */
static inline int net_receive(lossy_network *net, int32_t *to, uint8_t *bytes, uint32_t now)
{
    for (int32_t i = 0; i < net->flying; i++) {
        net_datagram *d = &net->datagrams[i];
        if ((int32_t)(now - d->at) >= 0) {
            *to = d->to;
            memcpy(bytes, d->bytes, sizeof d->bytes);
            *d = net->datagrams[--net->flying];
            return 1;
        }
    }
    return 0;
}

#endif
