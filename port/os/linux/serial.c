/* Serial ports by termios. */
#include "iris/serial.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

/* The system's constant for a speed; B0 for one that it does not have. */
static speed_t speed_of(int32_t baud)
{
    static const struct {
        int32_t baud;
        speed_t speed;
    } speeds[] = {
        {1200, B1200},       {1800, B1800},       {2400, B2400},       {4800, B4800},
        {9600, B9600},       {19200, B19200},     {38400, B38400},     {57600, B57600},
        {115200, B115200},   {230400, B230400},   {460800, B460800},   {500000, B500000},
        {576000, B576000},   {921600, B921600},   {1000000, B1000000}, {1152000, B1152000},
        {1500000, B1500000}, {2000000, B2000000}, {2500000, B2500000}, {3000000, B3000000},
        {3500000, B3500000}, {4000000, B4000000},
    };
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        if (speeds[i].baud == baud) {
            return speeds[i].speed;
        }
    }
    return B0;
}

/* Raw 8N1 at this speed. 0, or errno. */
static int configure(int handle, speed_t speed)
{
    struct termios wanted, got;
    if (tcgetattr(handle, &wanted) != 0) {
        return errno;
    }
    cfmakeraw(&wanted);
    wanted.c_iflag &= ~(tcflag_t)(IXOFF | IXANY | INPCK);
    wanted.c_cflag &= ~(tcflag_t)(CSTOPB | CRTSCTS);
    wanted.c_cflag |= CLOCAL | CREAD;
    wanted.c_cc[VMIN] = 1;
    wanted.c_cc[VTIME] = 0;
    if (cfsetispeed(&wanted, speed) != 0 || cfsetospeed(&wanted, speed) != 0 ||
        tcsetattr(handle, TCSANOW, &wanted) != 0 || tcgetattr(handle, &got) != 0) {
        return errno;
    }
    /* tcsetattr is content when it could set anything at all */
    const tcflag_t frame = CSIZE | CSTOPB | PARENB | CRTSCTS;
    if (cfgetospeed(&got) != speed || ((got.c_cflag ^ wanted.c_cflag) & frame) != 0 ||
        (got.c_lflag & ICANON) != 0) {
        return EINVAL;
    }
    return 0;
}

static iris_status try_open(iris_serial *serial, uint32_t now_ms)
{
    serial->tried_ms = now_ms;
    int handle = open(serial->path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (handle < 0) {
        serial->error = errno;
        return IRIS_ERR_IO;
    }
    /* TIOCEXCL does not keep root out; a lock does, before the port is set to another speed. */
    int error = flock(handle, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK ? EBUSY : 0;
    error = error == 0 ? configure(handle, speed_of(serial->baud)) : error;
    error = error == EIO ? ENXIO : error; /* a node that no hardware stands behind opens, too */
    if (error != 0) {
        serial->error = error;
        (void)close(handle);
        return IRIS_ERR_IO;
    }
    (void)ioctl(handle, TIOCEXCL); /* a courtesy: the port works without */
    serial->handle = handle;
    return IRIS_OK;
}

iris_status iris_serial_open(iris_serial *serial, const char *path, int32_t baud, int32_t reconnect_ms,
                             uint32_t now_ms)
{
    if (!serial || !path || speed_of(baud) == B0 || reconnect_ms < 0 || reconnect_ms > 60000) {
        return IRIS_ERR_ARG;
    }
    memset(serial, 0, sizeof *serial);
    serial->path = path;
    serial->baud = baud;
    serial->reconnect_ms = reconnect_ms;
    serial->handle = -1;
    return try_open(serial, now_ms);
}

static void release(iris_serial *serial)
{
    serial->dropped += (uint32_t)(serial->length > 0) + (uint32_t)(serial->waiting > 0);
    serial->length = 0;
    serial->waiting = 0;
    (void)ioctl(serial->handle, TIOCNXCL);
    (void)flock(serial->handle, LOCK_UN); /* also where a child has a copy of it */
    (void)close(serial->handle);
    serial->handle = -1;
}

static iris_status lose(iris_serial *serial, int error, uint32_t now_ms)
{
    serial->error = error;
    serial->tried_ms = now_ms;
    (void)tcflush(serial->handle, TCOFLUSH); /* or closing may wait for bytes that nobody takes */
    release(serial);
    return IRIS_ERR_IO;
}

static iris_status connect_again(iris_serial *serial, uint32_t now_ms)
{
    if (serial->path && serial->handle >= 0) {
        return IRIS_OK;
    }
    if (!serial->path || now_ms - serial->tried_ms < (uint32_t)serial->reconnect_ms) {
        return IRIS_ERR_IO;
    }
    iris_status status = try_open(serial, now_ms);
    serial->reconnects += status == IRIS_OK;
    return status;
}

/* Adds to *written what the port takes now of the rest of text. IRIS_ERR_FULL: not all. */
static iris_status write_rest(size_t *written, iris_serial *serial, const char *text, size_t length,
                              uint32_t now_ms)
{
    ssize_t count = write(serial->handle, text + *written, length - *written);
    if (count < 0 && errno != EAGAIN && errno != EINTR) {
        return lose(serial, errno, now_ms);
    }
    *written += count > 0 ? (size_t)count : 0;
    if (*written < length) {
        return IRIS_ERR_FULL;
    }
    serial->sent++;
    return IRIS_OK;
}

/* Starts the sentence that waits, once the line is free: in the system's queue it could not be replaced. */
static iris_status write_next(iris_serial *serial, uint32_t now_ms)
{
    int queued = 0;
    if (ioctl(serial->handle, TIOCOUTQ, &queued) == 0 && queued > 0) {
        return IRIS_ERR_FULL;
    }
    size_t written = 0;
    iris_status status = write_rest(&written, serial, serial->next, serial->waiting, now_ms);
    if (status == IRIS_ERR_FULL && written > 0) {
        memcpy(serial->sentence, serial->next, serial->waiting);
        serial->length = serial->waiting;
        serial->written = written;
    }
    if (written > 0) {
        serial->waiting = 0;
    }
    return status;
}

iris_status iris_serial_continue(iris_serial *serial, uint32_t now_ms)
{
    if (!serial) {
        return IRIS_ERR_ARG;
    }
    iris_status status = connect_again(serial, now_ms);
    if (status == IRIS_OK && serial->length > 0) {
        status = write_rest(&serial->written, serial, serial->sentence, serial->length, now_ms);
        if (status == IRIS_OK) {
            serial->length = 0;
        }
    }
    if (status == IRIS_OK && serial->waiting > 0) {
        status = write_next(serial, now_ms);
    }
    return status;
}

iris_status iris_serial_send(iris_serial *serial, const char *sentence, size_t length, uint32_t now_ms)
{
    if (!serial || !sentence) {
        return IRIS_ERR_ARG;
    }
    if (length < 1 || length > IRIS_SERIAL_SENTENCE_MAX) {
        return IRIS_ERR_RANGE;
    }
    if (connect_again(serial, now_ms) != IRIS_OK) {
        serial->dropped++;
        return IRIS_ERR_IO;
    }
    serial->dropped += serial->waiting > 0;
    memcpy(serial->next, sentence, length);
    serial->waiting = length;
    return iris_serial_continue(serial, now_ms);
}

iris_status iris_serial_receive(void *bytes, size_t *count, iris_serial *serial, size_t capacity,
                                uint32_t now_ms)
{
    if (!bytes || !count || !serial) {
        return IRIS_ERR_ARG;
    }
    *count = 0;
    iris_status status = connect_again(serial, now_ms);
    if (status != IRIS_OK || capacity == 0) {
        return status;
    }
    ssize_t got = read(serial->handle, bytes, capacity);
    if (got > 0) {
        *count = (size_t)got;
        return IRIS_OK;
    }
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) {
        return IRIS_OK;
    }
    return lose(serial, got == 0 ? EIO : errno, now_ms); /* 0 is the end of a line that hung up */
}

void iris_serial_close(iris_serial *serial)
{
    if (!serial || !serial->path) {
        return;
    }
    if (serial->handle >= 0) {
        if (serial->length > 0) {
            (void)tcflush(serial->handle, TCOFLUSH); /* the start of a sentence that gets no end */
        }
        release(serial);
    }
    serial->path = NULL;
}

const char *iris_serial_error(const iris_serial *serial)
{
    switch (serial ? serial->error : 0) {
    case 0:
        return "no error";
    case ENOENT:
    case ENOTDIR:
        return "no such device";
    case ENODEV:
    case ENXIO:
        return "no device behind this name";
    case EACCES:
    case EPERM:
        return "no permission (is the user in the group that owns the port, often dialout?)";
    case EBUSY:
        return "another program has the port";
    case ENOTTY:
    case EISDIR:
        return "not a serial port";
    case EINVAL:
        return "the port does not run at this speed, or not as 8N1";
    case EIO:
        return "the other end hung up, or the device was unplugged";
    default:
        return "input or output failed";
    }
}
