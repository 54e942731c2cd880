/* IRIS - a team in one program: a bus with n ends in the caller's memory.
 *
 * What is sent at one end waits at all others, in the order of sending. The bus keeps the newest `depth` datagrams of all:
 * an end that has not taken an older one by then has lost it, which is counted. For one thread.
 */
#ifndef IRIS_BORG_IN_PROCESS_H
#define IRIS_BORG_IN_PROCESS_H

#include "iris/borg/transport.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int32_t from; /* end that sent it */
    uint32_t count;
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
} borg_bus_datagram;

typedef struct borg_bus borg_bus;

/* Read `dropped`; the rest belongs to the functions. */
typedef struct {
    uint32_t dropped; /* datagrams of others that this end lost */
    int32_t waiting;  /* of the newest datagrams, those that it has not passed yet, its own among them */
    borg_bus *bus;
} borg_bus_end;

/* The functions' own. */
struct borg_bus {
    borg_bus_datagram *ring;
    int32_t depth;
    int32_t next; /* place in the ring of the next datagram */
    borg_bus_end *ends;
    int32_t end_count;
};

/* Makes a bus on `ring`, of `depth` datagrams, and `ends`, of `end_count`; all three are the bus's until the caller drops it,
 * and must stay where they are. IRIS_ERR_ARG: null pointer; IRIS_ERR_RANGE: depth or end_count below 1. O(end_count). */
iris_status borg_bus_init(borg_bus *bus, borg_bus_datagram *ring, int32_t depth, borg_bus_end *ends,
                          int32_t end_count);

/* The transport of an end, 0 to end_count - 1, which does not hear itself. Sending takes O(end_count) and never fails for want
 * of room; receiving takes O(depth) where all that waits is its own, else O(1). IRIS_ERR_ARG: null pointer;
 * IRIS_ERR_RANGE: no such end, *transport untouched. O(1). */
iris_status borg_bus_transport(borg_transport *transport, borg_bus *bus, int32_t end);

#ifdef __cplusplus
}
#endif

#endif
