/* UDP multicast on the loopback, with all ends in this program; and in a network of its own, where interfaces come and go. */
#include "iris/udp.h"
#include "test.h"

#include <arpa/inet.h>
#include <errno.h>
#include <linux/sched.h>
#include <net/if.h>
#include <netinet/in.h>
#include <stdio.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* The library's sendto comes here, so that the network can fail. */
static int send_error; /* errno of the next sendto; 0: none */

/* NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): the system's are reserved names */
ssize_t sendto(int handle, const void *bytes, size_t count, int flags, const struct sockaddr *to,
               socklen_t length)
{
    if (send_error != 0) {
        errno = send_error;
        send_error = 0;
        return -1;
    }
    return syscall(SYS_sendto, handle, bytes, count, flags, to, length);
}

typedef struct {
    iris_udp udp;
    borg_transport transport;
} end;

/* A port that two runs of this test at one time do not share. */
static int32_t own_port(void)
{
    return 20000 + (int32_t)(getpid() % 10000) * 4;
}

static void open_end(end *e, int32_t port)
{
    assert_int_equal(iris_udp_open(&e->udp, "239.255.73.82", port, "lo"), IRIS_OK);
    assert_int_equal(iris_udp_transport(&e->transport, &e->udp), IRIS_OK);
}

static iris_status say(end *e, uint8_t first, size_t count)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    for (size_t i = 0; i < count; i++) {
        bytes[i] = (uint8_t)(first + i);
    }
    return e->transport.send(e->transport.context, bytes, count);
}

/* What comes within ten seconds; 0 when nothing does. Of what follows what has come, nothing is lost on the loopback. */
static size_t hear(end *e, uint8_t bytes[BORG_DATAGRAM_BYTES_MAX], int patience)
{
    size_t count = 0;
    for (int i = 0; i < patience && count == 0; i++) {
        assert_int_equal(e->transport.receive(e->transport.context, bytes, BORG_DATAGRAM_BYTES_MAX, &count),
                         IRIS_OK);
        if (count == 0) {
            nanosleep(&(struct timespec){0, 1000000}, NULL);
        }
    }
    return count;
}

static void hears(end *e, uint8_t first, size_t count)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    assert_int_equal(hear(e, bytes, 10000), count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(bytes[i], (uint8_t)(first + i));
    }
}

static void hears_nothing(end *e)
{
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    assert_int_equal(hear(e, bytes, 20), 0);
}

static void everybody_of_the_group_hears(void **state)
{
    (void)state;
    end ends[3], elsewhere, other_group;
    for (int i = 0; i < 3; i++) {
        open_end(&ends[i], own_port());
    }
    open_end(&elsewhere, own_port() + 1);
    assert_int_equal(iris_udp_open(&other_group.udp, "239.255.73.83", own_port(), "lo"), IRIS_OK);
    assert_int_equal(iris_udp_transport(&other_group.transport, &other_group.udp), IRIS_OK);
    assert_int_equal(say(&ends[0], 10, 1), IRIS_OK);
    assert_int_equal(say(&ends[1], 20, BORG_DATAGRAM_BYTES_MAX), IRIS_OK);
    for (int i = 0; i < 3; i++) { /* itself, too */
        hears(&ends[i], 10, 1);
        hears(&ends[i], 20, BORG_DATAGRAM_BYTES_MAX);
        hears_nothing(&ends[i]);
        assert_int_equal(ends[i].udp.received, 2);
        assert_int_equal(ends[i].udp.sent, i < 2);
        assert_int_equal(ends[i].udp.lost + ends[i].udp.refused + ends[i].udp.reconnects, 0);
        assert_string_equal(iris_udp_error(&ends[i].udp), "no error");
        iris_udp_close(&ends[i].udp);
    }
    hears_nothing(&elsewhere);
    hears_nothing(&other_group);
    iris_udp_close(&elsewhere.udp);
    iris_udp_close(&other_group.udp);
}

static int raw_socket(void)
{
    int handle = socket(AF_INET, SOCK_DGRAM, 0);
    assert_true(handle >= 0);
    struct ip_mreqn lo;
    memset(&lo, 0, sizeof lo);
    lo.imr_ifindex = (int)if_nametoindex("lo");
    assert_int_equal(setsockopt(handle, IPPROTO_IP, IP_MULTICAST_IF, &lo, sizeof lo), 0);
    return handle;
}

static void throw_at(int handle, const char *address, int32_t port, size_t count)
{
    static uint8_t bytes[65507];
    struct sockaddr_in to;
    memset(&to, 0, sizeof to);
    to.sin_family = AF_INET;
    to.sin_port = htons((uint16_t)port);
    assert_int_equal(inet_pton(AF_INET, address, &to.sin_addr), 1);
    memset(bytes, (int)(count & 0xff), sizeof bytes);
    assert_int_equal(sendto(handle, bytes, count, 0, (struct sockaddr *)&to, sizeof to), count);
}

/* What is too short or too long is passed and counted, what is good behind it is heard, and a flood does not hold a call. */
static void hostile_datagrams_are_refused(void **state)
{
    (void)state;
    end e;
    open_end(&e, own_port());
    const int handle = raw_socket();
    const size_t sizes[] = {0, BORG_DATAGRAM_BYTES_MAX + 1, 100, 1400, 9000, 60000};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        throw_at(handle, "239.255.73.82", own_port(), sizes[i]);
        assert_int_equal(say(&e, (uint8_t)(60 + i), 7), IRIS_OK);
        hears(&e, (uint8_t)(60 + i), 7);
        assert_int_equal(e.udp.refused, i + 1);
    }
    throw_at(handle, "127.0.0.1", own_port(), 5); /* not to the group: not ours */
    hears_nothing(&e);

    const uint32_t before = e.udp.refused;
    for (int i = 0; i < 100; i++) {
        throw_at(handle, "239.255.73.82", own_port(), 0);
    }
    assert_int_equal(say(&e, 1, 1), IRIS_OK);
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    size_t count = 99;
    assert_int_equal(e.transport.receive(e.transport.context, bytes, sizeof bytes, &count), IRIS_OK);
    assert_int_equal(count, 0);
    assert_in_range(e.udp.refused - before, 1, 64);
    hears(&e, 1, 1);
    assert_int_equal(e.udp.refused - before, 100);
    close(handle);
    iris_udp_close(&e.udp);
}

/* A raw reader sees the time to live that routers would. */
static void datagrams_stay_on_the_network(void **state)
{
    (void)state;
    end e;
    open_end(&e, own_port());
    assert_int_equal(setsockopt(e.udp.handle, IPPROTO_IP, IP_RECVTTL, &(int){1}, sizeof(int)), 0);
    assert_int_equal(say(&e, 1, 4), IRIS_OK);
    char control[64];
    uint8_t bytes[64];
    struct iovec piece = {bytes, sizeof bytes};
    struct msghdr message = {
        .msg_iov = &piece, .msg_iovlen = 1, .msg_control = control, .msg_controllen = sizeof control};
    ssize_t got = -1;
    for (int i = 0; i < 10000 && got < 0; i++) {
        got = recvmsg(e.udp.handle, &message, MSG_DONTWAIT);
        nanosleep(&(struct timespec){0, got < 0 ? 1000000 : 0}, NULL);
    }
    assert_int_equal(got, 4);
    const struct cmsghdr *part = CMSG_FIRSTHDR(&message);
    assert_non_null(part);
    assert_int_equal(part->cmsg_type, IP_TTL);
    int ttl = 0;
    memcpy(&ttl, CMSG_DATA(part), sizeof ttl);
    assert_int_equal(ttl, 1);
    iris_udp_close(&e.udp);
}

/* Nobody reads: the socket's queue fills, and not one call waits. */
static void no_call_waits(void **state)
{
    (void)state;
    end deaf, speaker;
    open_end(&deaf, own_port());
    open_end(&speaker, own_port());
    int taken = 0;
    for (int i = 0; i < 5000; i++) {
        const iris_status status = say(&speaker, (uint8_t)i, BORG_DATAGRAM_BYTES_MAX);
        assert_true(status == IRIS_OK || status == IRIS_ERR_FULL);
        taken += status == IRIS_OK;
    }
    assert_int_equal(speaker.udp.sent, taken);
    assert_int_equal(speaker.udp.sent + speaker.udp.lost, 5000);
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    int heard = 0;
    while (hear(&deaf, bytes, 20) > 0) {
        heard++;
    }
    assert_in_range(heard, 1, taken);
    iris_udp_close(&deaf.udp);
    iris_udp_close(&speaker.udp);
}

static void a_lost_network_is_opened_again(void **state)
{
    (void)state;
    static const int passing[] = {EAGAIN, ENOBUFS, EINTR};
    static const int lasting[] = {ENODEV, ENETUNREACH, ENETDOWN, EPERM, EADDRNOTAVAIL, EIO};
    end e;
    open_end(&e, own_port());
    uint32_t lost = 0, reconnects = 0;
    for (size_t i = 0; i < sizeof passing / sizeof passing[0]; i++) {
        send_error = passing[i];
        assert_int_equal(say(&e, 1, 1), IRIS_ERR_FULL);
        assert_int_equal(e.udp.lost, ++lost);
        assert_true(e.udp.handle >= 0);
    }
    for (size_t i = 0; i < sizeof lasting / sizeof lasting[0]; i++) {
        send_error = lasting[i];
        assert_int_equal(say(&e, 1, 1), IRIS_ERR_IO);
        assert_int_equal(e.udp.lost, ++lost);
        assert_int_equal(e.udp.handle, -1);
        assert_true(strlen(iris_udp_error(&e.udp)) > 8);
        assert_int_equal(say(&e, (uint8_t)i, 9), IRIS_OK);
        assert_int_equal(e.udp.reconnects, ++reconnects);
        hears(&e, (uint8_t)i, 9);
    }
    iris_udp_close(&e.udp);
}

static void arguments_are_checked(void **state)
{
    (void)state;
    iris_udp udp, untouched;
    memset(&udp, 0x5a, sizeof udp);
    memset(&untouched, 0x5a, sizeof untouched);
    static const char *const no_groups[] = {"",          "239.1.1",   "223.255.255.255",
                                            "240.0.0.0", "127.0.0.1", "239.255.73.820",
                                            "ff02::1",   "team",      "239.255.73.82 "};
    for (size_t i = 0; i < sizeof no_groups / sizeof no_groups[0]; i++) {
        assert_int_equal(iris_udp_open(&udp, no_groups[i], 7000, "lo"), IRIS_ERR_ARG);
    }
    assert_int_equal(iris_udp_open(NULL, IRIS_UDP_GROUP, 7000, "lo"), IRIS_ERR_ARG);
    assert_int_equal(iris_udp_open(&udp, NULL, 7000, "lo"), IRIS_ERR_ARG);
    assert_int_equal(iris_udp_open(&udp, IRIS_UDP_GROUP, 7000, "sixteen-letters-"), IRIS_ERR_ARG);
    assert_int_equal(iris_udp_open(&udp, IRIS_UDP_GROUP, 0, "lo"), IRIS_ERR_RANGE);
    assert_int_equal(iris_udp_open(&udp, IRIS_UDP_GROUP, 65536, "lo"), IRIS_ERR_RANGE);
    assert_memory_equal(&udp, &untouched, sizeof udp);
    assert_int_equal(iris_udp_open(&udp, IRIS_UDP_GROUP, 7000, "no-such-face"), IRIS_ERR_IO);
    assert_string_equal(iris_udp_error(&udp), "no network interface of this name");

    end e;
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX + 1] = {0};
    size_t count = 99;
    open_end(&e, own_port());
    const borg_transport *t = &e.transport;
    assert_int_equal(iris_udp_transport(NULL, &e.udp), IRIS_ERR_ARG);
    assert_int_equal(iris_udp_transport(&e.transport, NULL), IRIS_ERR_ARG);
    assert_int_equal(t->send(NULL, bytes, 1), IRIS_ERR_ARG);
    assert_int_equal(t->send(t->context, NULL, 1), IRIS_ERR_ARG);
    assert_int_equal(t->send(t->context, bytes, 0), IRIS_ERR_RANGE);
    assert_int_equal(t->send(t->context, bytes, BORG_DATAGRAM_BYTES_MAX + 1), IRIS_ERR_RANGE);
    assert_int_equal(t->receive(NULL, bytes, sizeof bytes, &count), IRIS_ERR_ARG);
    assert_int_equal(t->receive(t->context, NULL, sizeof bytes, &count), IRIS_ERR_ARG);
    assert_int_equal(t->receive(t->context, bytes, sizeof bytes, NULL), IRIS_ERR_ARG);
    assert_int_equal(t->receive(t->context, bytes, BORG_DATAGRAM_BYTES_MAX - 1, &count), IRIS_ERR_RANGE);
    iris_udp_close(NULL);
    iris_udp_close(&e.udp);
    iris_udp_close(&e.udp);
    assert_int_equal(t->send(t->context, bytes, 1), IRIS_ERR_IO); /* closed is closed */
    assert_int_equal(t->receive(t->context, bytes, sizeof bytes, &count), IRIS_ERR_IO);
    assert_int_equal(count, 0);
    iris_udp zeroed = {0};
    iris_udp_close(&zeroed); /* does not close standard input */
    assert_non_null(iris_udp_error(NULL));
    for (int error = -1; error < 200; error++) {
        zeroed.error = error;
        assert_true(strlen(iris_udp_error(&zeroed)) > 5);
    }
}

static int raise_interface(const char *name)
{
    struct ifreq request;
    memset(&request, 0, sizeof request);
    strncpy(request.ifr_name, name, sizeof request.ifr_name - 1);
    request.ifr_flags = IFF_UP | IFF_RUNNING;
    const int handle = socket(AF_INET, SOCK_DGRAM, 0);
    const int result = ioctl(handle, SIOCSIFFLAGS, &request);
    close(handle);
    return result;
}

/* In a network that has only a loopback, and that is down at first. 0: as it should be; 77: not allowed here; else the step. */
static int start_before_the_network(void)
{
    if (syscall(SYS_unshare, CLONE_NEWUSER | CLONE_NEWNET) != 0 && syscall(SYS_unshare, CLONE_NEWNET) != 0) {
        return 77;
    }
    end routed, named;
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX] = {7};
    size_t count = 0;
    if (iris_udp_open(&routed.udp, IRIS_UDP_GROUP, IRIS_UDP_PORT, NULL) != IRIS_ERR_IO ||
        !strstr(iris_udp_error(&routed.udp), "no route for multicast")) {
        return 1;
    }
    (void)iris_udp_open(&named.udp, IRIS_UDP_GROUP, IRIS_UDP_PORT, "lo");
    (void)iris_udp_transport(&named.transport, &named.udp);
    const borg_transport *t = &named.transport;
    if (t->send(t->context, bytes, 1) != IRIS_ERR_IO || named.udp.lost != 1) {
        return 2;
    }
    if (raise_interface("lo") != 0) {
        return 77;
    }
    if (t->send(t->context, bytes, 1) != IRIS_OK) {
        return 3;
    }
    for (int i = 0; i < 10000 && count == 0; i++) {
        if (t->receive(t->context, bytes, sizeof bytes, &count) != IRIS_OK) {
            return 4;
        }
        nanosleep(&(struct timespec){0, 1000000}, NULL);
    }
    return count == 1 && bytes[0] == 7 ? 0 : 5;
}

static void a_program_starts_before_its_network(void **state)
{
    (void)state;
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        _exit(start_before_the_network());
    }
    int result = 0;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result));
    if (WEXITSTATUS(result) == 77) {
        printf("#: no network of one's own is allowed here\n");
        skip();
    }
    assert_int_equal(WEXITSTATUS(result), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everybody_of_the_group_hears),
        cmocka_unit_test(hostile_datagrams_are_refused),
        cmocka_unit_test(datagrams_stay_on_the_network),
        cmocka_unit_test(no_call_waits),
        cmocka_unit_test(a_lost_network_is_opened_again),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(a_program_starts_before_its_network),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
