/* IRIS - a team on one network: datagrams by UDP multicast (IPv4).
 *
 * All that open the same group and port on the same network hear each other, without a server and without knowing of each
 * other; several programs of one machine, too. Datagrams do not pass routers (time to live 1). Anybody on the network can send:
 * what is not of a transport's size is refused here, all else is for the reader to check.
 *
 * A network that disappears is an error that the loop survives: what is sent meanwhile is lost, and later calls open it again.
 * The operating system's part is in port/os.
 */
#ifndef IRIS_UDP_H
#define IRIS_UDP_H

#include "iris/borg/transport.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where teams meet if they do not say otherwise: of the addresses that an organization may use as it likes (RFC 2365). */
#define IRIS_UDP_GROUP "239.255.73.82"
#define IRIS_UDP_PORT  7382

/* Room for an interface's name, with a terminating 0. */
#define IRIS_UDP_INTERFACE_BYTES 16

/* Read the first six; the rest belongs to the functions. */
typedef struct {
    uint32_t sent;       /* datagrams that the system took */
    uint32_t received;   /* given to the caller; a program hears itself */
    uint32_t refused;    /* empty, or longer than a transport's */
    uint32_t lost;       /* that the system did not take */
    uint32_t reconnects; /* times that the network was opened again */
    int error;           /* errno of the last failure; 0 before the first */

    int handle;   /* file descriptor; -1 while the network is away */
    uint8_t open; /* 0: closed for good */
    int32_t port;
    uint8_t group[4];
    char interface_name[IRIS_UDP_INTERFACE_BYTES]; /* empty: the system's choice */
} iris_udp;

/* Joins the group.
 *   group           four numbers with dots, 224.0.0.0 to 239.255.255.255
 *   port            1 to 65535
 *   interface_name  such as wlan0; lo for programs of one machine; null: where the system's routes lead
 * IRIS_ERR_ARG: null pointer other than interface_name, no such address, or a name that is too long; IRIS_ERR_RANGE: port; *udp
 * is untouched. IRIS_ERR_IO: not joined, and iris_udp_error says why; *udp is ready, and the calls of the transport go on
 * trying. O(1). */
iris_status iris_udp_open(iris_udp *udp, const char *group, int32_t port, const char *interface_name);

/* The transport over *udp, which must stay where it is. A call takes O(1) where the network is in order, and a few calls of the
 * system to open it where it is not; one that receives passes at most 64 refused datagrams. IRIS_ERR_ARG: null pointer. */
iris_status iris_udp_transport(borg_transport *transport, iris_udp *udp);

/* Leaves the group. Every later call but iris_udp_open returns IRIS_ERR_IO. Null and a second call do nothing. */
void iris_udp_close(iris_udp *udp);

/* Why the network failed last, such as "no network interface of this name". Never null; static storage. */
const char *iris_udp_error(const iris_udp *udp);

#ifdef __cplusplus
}
#endif

#endif
