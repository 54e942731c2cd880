/* UDP multicast by sockets. */
#include "iris/udp.h"

#include <arpa/inet.h>
#include <errno.h>
#include <net/if.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* Of refused datagrams, how many one call passes: who floods the network does not hold the loop. */
#define REFUSED_AT_ONCE 64

/* Where it is not in the C library's headers: of what the machine has joined, only this socket's own. */
#ifndef IP_MULTICAST_ALL
#define IP_MULTICAST_ALL 49
#endif

static struct sockaddr_in address_of(const iris_udp *udp)
{
    struct sockaddr_in address;
    memset(&address, 0, sizeof address);
    address.sin_family = AF_INET;
    address.sin_port = htons((uint16_t)udp->port);
    memcpy(&address.sin_addr, udp->group, sizeof udp->group);
    return address;
}

/* Sets an option that is a number. 0, or errno. */
static int set_number(int handle, int level, int option, int value)
{
    return setsockopt(handle, level, option, &value, sizeof value) == 0 ? 0 : errno;
}

/* Binds to the group, so that nothing else arrives, and joins it. 0, or errno. */
static int join(int handle, const iris_udp *udp)
{
    const struct sockaddr_in address = address_of(udp);
    struct ip_mreqn membership;
    memset(&membership, 0, sizeof membership);
    membership.imr_multiaddr = address.sin_addr;
    if (udp->interface_name[0] != '\0') {
        membership.imr_ifindex = (int)if_nametoindex(udp->interface_name);
        if (membership.imr_ifindex == 0) {
            return ENODEV;
        }
    }
    int error = set_number(handle, SOL_SOCKET, SO_REUSEADDR, 1);
    error = error == 0 ? set_number(handle, IPPROTO_IP, IP_MULTICAST_TTL, 1) : error;
    error = error == 0 ? set_number(handle, IPPROTO_IP, IP_MULTICAST_LOOP, 1) : error;
    (void)set_number(handle, IPPROTO_IP, IP_MULTICAST_ALL, 0); /* a courtesy: readers check what comes */
    if (error != 0) {
        return error;
    }
    if (bind(handle, (const struct sockaddr *)&address, sizeof address) != 0 ||
        setsockopt(handle, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0 ||
        (membership.imr_ifindex != 0 &&
         setsockopt(handle, IPPROTO_IP, IP_MULTICAST_IF, &membership, sizeof membership) != 0)) {
        return errno == ENODEV && membership.imr_ifindex == 0 ? ENETUNREACH : errno;
    }
    return 0;
}

static iris_status try_open(iris_udp *udp)
{
    const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const int error = handle < 0 ? errno : join(handle, udp);
    if (error != 0) {
        udp->error = error;
        if (handle >= 0) {
            (void)close(handle);
        }
        return IRIS_ERR_IO;
    }
    udp->handle = handle;
    return IRIS_OK;
}

iris_status iris_udp_open(iris_udp *udp, const char *group, int32_t port, const char *interface_name)
{
    uint8_t address[4];
    if (!udp || !group || inet_pton(AF_INET, group, address) != 1 || address[0] < 224 || address[0] > 239 ||
        (interface_name && strlen(interface_name) >= IRIS_UDP_INTERFACE_BYTES)) {
        return IRIS_ERR_ARG;
    }
    if (port < 1 || port > 65535) {
        return IRIS_ERR_RANGE;
    }
    memset(udp, 0, sizeof *udp);
    memcpy(udp->group, address, sizeof address);
    udp->port = port;
    udp->open = 1;
    udp->handle = -1;
    if (interface_name) {
        memcpy(udp->interface_name, interface_name, strlen(interface_name));
    }
    return try_open(udp);
}

/* An interface that comes back is another one to the system, which the old socket has not joined. */
static iris_status lose(iris_udp *udp, int error)
{
    udp->error = error;
    (void)close(udp->handle);
    udp->handle = -1;
    return IRIS_ERR_IO;
}

static iris_status open_again(iris_udp *udp)
{
    if (!udp->open || udp->handle >= 0) {
        return udp->open ? IRIS_OK : IRIS_ERR_IO;
    }
    const iris_status status = try_open(udp);
    udp->reconnects += status == IRIS_OK;
    return status;
}

static iris_status udp_send(void *context, const uint8_t *bytes, size_t count)
{
    iris_udp *udp = context;
    if (!udp || !bytes) {
        return IRIS_ERR_ARG;
    }
    if (count < 1 || count > BORG_DATAGRAM_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    iris_status status = open_again(udp);
    if (status == IRIS_OK) {
        const struct sockaddr_in address = address_of(udp);
        const ssize_t taken = sendto(udp->handle, bytes, count, MSG_DONTWAIT | MSG_NOSIGNAL,
                                     (const struct sockaddr *)&address, sizeof address);
        if (taken == (ssize_t)count) {
            udp->sent++;
            return IRIS_OK;
        }
        const int busy = taken < 0 && (errno == EAGAIN || errno == EINTR || errno == ENOBUFS);
        status = busy ? IRIS_ERR_FULL : lose(udp, errno);
    }
    udp->lost++;
    return status;
}

static iris_status udp_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    iris_udp *udp = context;
    if (!udp || !bytes || !count) {
        return IRIS_ERR_ARG;
    }
    if (capacity < BORG_DATAGRAM_BYTES_MAX) {
        return IRIS_ERR_RANGE;
    }
    *count = 0;
    const iris_status status = open_again(udp);
    for (int i = 0; status == IRIS_OK && i < REFUSED_AT_ONCE; i++) {
        uint8_t datagram[BORG_DATAGRAM_BYTES_MAX + 1]; /* one more: longer ones are known by it */
        const ssize_t got = recv(udp->handle, datagram, sizeof datagram, MSG_DONTWAIT);
        if (got < 0 && errno != EINTR) {
            return errno == EAGAIN ? IRIS_OK : lose(udp, errno);
        }
        if (got > 0 && got <= BORG_DATAGRAM_BYTES_MAX) {
            memcpy(bytes, datagram, (size_t)got);
            *count = (size_t)got;
            udp->received++;
            return IRIS_OK;
        }
        udp->refused += got >= 0;
    }
    return status;
}

iris_status iris_udp_transport(borg_transport *transport, iris_udp *udp)
{
    if (!transport || !udp) {
        return IRIS_ERR_ARG;
    }
    *transport = (borg_transport){udp_send, udp_receive, udp};
    return IRIS_OK;
}

void iris_udp_close(iris_udp *udp)
{
    if (!udp || !udp->open) {
        return;
    }
    if (udp->handle >= 0) {
        (void)close(udp->handle);
    }
    udp->handle = -1;
    udp->open = 0;
}

const char *iris_udp_error(const iris_udp *udp)
{
    switch (udp ? udp->error : 0) {
    case 0:
        return "no error";
    case ENODEV:
        return "no network interface of this name";
    case ENETUNREACH:
    case EHOSTUNREACH:
        return "no route for multicast: name an interface, such as wlan0, or lo on one machine alone";
    case ENETDOWN:
        return "the network interface is down";
    case EADDRNOTAVAIL:
        return "the network interface has no IPv4 address";
    case EADDRINUSE:
        return "another program has this port, and shares it with nobody";
    case EACCES:
    case EPERM:
        return "no permission (a firewall, or a port below 1024)";
    case EMFILE:
    case ENFILE:
        return "too many open files";
    case EAFNOSUPPORT:
        return "this system has no IPv4";
    default:
        return "the network failed";
    }
}
