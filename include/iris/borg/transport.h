/* IRIS - how machines of a team hear each other: two functions, behind which any network can be.
 *
 * A transport carries datagrams of 1 to BORG_DATAGRAM_BYTES_MAX bytes to everybody of the team, whole or not at all. They may
 * be lost, come twice, or in another order, whatever the network is like. Who sends may hear itself or not. What is received
 * comes from anywhere: it is data to check, not to trust.
 *
 * in_process.h fills it for tests and simulators, iris/udp.h for one network, iris/mqtt.h through a broker.
 */
#ifndef IRIS_BORG_TRANSPORT_H
#define IRIS_BORG_TRANSPORT_H

#include <stddef.h>
#include <stdint.h>

#include "iris/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define BORG_DATAGRAM_BYTES_MAX 48

/* Neither function ever waits. */
typedef struct {
    /* Gives `count` bytes to the network, 1 to BORG_DATAGRAM_BYTES_MAX; they are copied. IRIS_OK: given, which does not say that
     * anybody gets them. IRIS_ERR_FULL: no room at this moment; IRIS_ERR_IO: the network is away, and later calls try again: in
     * both cases these bytes are lost. IRIS_ERR_RANGE: count; IRIS_ERR_ARG: null pointer. */
    iris_status (*send)(void *context, const uint8_t *bytes, size_t count);

    /* Takes the next datagram, and says how many bytes it has; *count is 0 when nothing is there. `capacity` is at least
     * BORG_DATAGRAM_BYTES_MAX, or else IRIS_ERR_RANGE. IRIS_ERR_IO: the network is away, and later calls try again, *count
     * is 0; IRIS_ERR_ARG: null pointer. */
    iris_status (*receive)(void *context, uint8_t *bytes, size_t capacity, size_t *count);

    void *context; /* what both are called with */
} borg_transport;

#ifdef __cplusplus
}
#endif

#endif
