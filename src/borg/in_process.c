/* A team in one program: one ring of datagrams, and for each end how far it is behind. */
#include "iris/borg/in_process.h"

#include <string.h>

iris_status borg_bus_init(borg_bus *bus, borg_bus_datagram *ring, int32_t depth, borg_bus_end *ends,
                          int32_t end_count)
{
    if (!bus || !ring || !ends) {
        return IRIS_ERR_ARG;
    }
    if (depth < 1 || end_count < 1) {
        return IRIS_ERR_RANGE;
    }
    *bus = (borg_bus){ring, depth, 0, ends, end_count};
    for (int32_t i = 0; i < end_count; i++) {
        ends[i] = (borg_bus_end){0, 0, bus};
    }
    return IRIS_OK;
}

/* The oldest datagram that this end has not passed. */
static const borg_bus_datagram *oldest(const borg_bus *bus, const borg_bus_end *end)
{
    const int32_t place = bus->next - end->waiting;
    return &bus->ring[place < 0 ? place + bus->depth : place];
}

static iris_status bus_send(void *context, const uint8_t *bytes, size_t count)
{
    borg_bus_end *self = context;
    if (!self || !bytes) {
        return IRIS_ERR_ARG;
    }
    if (count < 1 || count > BORG_DATAGRAM_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    borg_bus *bus = self->bus;
    for (int32_t i = 0; i < bus->end_count; i++) {
        borg_bus_end *end = &bus->ends[i];
        if (end->waiting < bus->depth) {
            end->waiting++;
        } else {
            end->dropped += bus->ring[bus->next].from != i;
        }
    }
    borg_bus_datagram *place = &bus->ring[bus->next];
    place->from = (int32_t)(self - bus->ends);
    place->count = (uint32_t)count;
    memcpy(place->bytes, bytes, count);
    bus->next = bus->next + 1 < bus->depth ? bus->next + 1 : 0;
    return IRIS_OK;
}

static iris_status bus_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    borg_bus_end *self = context;
    if (!self || !bytes || !count) {
        return IRIS_ERR_ARG;
    }
    if (capacity < BORG_DATAGRAM_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    *count = 0;
    const int32_t own = (int32_t)(self - self->bus->ends);
    while (self->waiting > 0 && *count == 0) {
        const borg_bus_datagram *datagram = oldest(self->bus, self);
        self->waiting--;
        if (datagram->from != own) {
            *count = datagram->count;
            memcpy(bytes, datagram->bytes, datagram->count);
        }
    }
    return IRIS_OK;
}

iris_status borg_bus_transport(borg_transport *transport, borg_bus *bus, int32_t end)
{
    if (!transport || !bus) {
        return IRIS_ERR_ARG;
    }
    if (end < 0 || end >= bus->end_count) {
        return IRIS_ERR_RANGE;
    }
    *transport = (borg_transport){bus_send, bus_receive, &bus->ends[end]};
    return IRIS_OK;
}
