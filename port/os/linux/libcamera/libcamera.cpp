/* The driver: C on the outside, and no exception passes. */
#include "iris/libcamera.h"

#include <cstdio>
#include <cstring>

#include "failure.hpp"
#include "session.hpp"

namespace
{

iris::session *session_of(const iris_libcamera *device)
{
    return static_cast<iris::session *>(device->session);
}

iris_status tell(iris_libcamera *device, iris_status status, const char *problem) noexcept
{
    std::snprintf(device->problem, sizeof device->problem, "%s", problem);
    return status;
}

/* Does it, and turns what it throws into a status and a text. */
template <typename Action> iris_status guard(void *device_address, Action action) noexcept
{
    auto *device = static_cast<iris_libcamera *>(device_address);
    try {
        return action(device);
    } catch (const iris::failure &failure) {
        return tell(device, failure.status, failure.what());
    } catch (const std::bad_alloc &) {
        return tell(device, IRIS_ERR_IO, "no memory for what libcamera needs");
    } catch (const std::exception &exception) {
        return tell(device, IRIS_ERR_IO, exception.what());
    } catch (...) {
        return tell(device, IRIS_ERR_IO, "libcamera failed, and did not say why");
    }
}

} // namespace

extern "C" {

static iris_status open_device(void *device, iris_capture_grant *grant, const char *path,
                               const iris_capture_config *wanted)
{
    return guard(device, [=](iris_libcamera *opened) {
        opened->session = new iris::session(grant, path, *wanted);
        return IRIS_OK;
    });
}

static iris_status start_device(void *device)
{
    return guard(device, [](iris_libcamera *opened) {
        try {
            session_of(opened)->start();
        } catch (...) {
            session_of(opened)->stop();
            throw;
        }
        return IRIS_OK;
    });
}

static iris_status take_frame(void *device, iris_frame *frame, int32_t timeout_ms)
{
    return guard(device, [=](iris_libcamera *opened) { return session_of(opened)->take(frame, timeout_ms); });
}

static iris_status give_frame(void *device, int32_t buffer)
{
    return guard(device, [=](iris_libcamera *opened) {
        session_of(opened)->give(buffer);
        return IRIS_OK;
    });
}

static void stop_device(void *device)
{
    session_of(static_cast<iris_libcamera *>(device))->stop();
}

static void close_device(void *device)
{
    (void)guard(device, [](iris_libcamera *opened) {
        iris::session *session = session_of(opened);
        opened->session = nullptr;
        delete session;
        return IRIS_OK;
    });
}

static const char *problem_of(const void *device)
{
    return static_cast<const iris_libcamera *>(device)->problem;
}

iris_capture_source iris_libcamera_source(iris_libcamera *device)
{
    static const iris_capture_driver driver = {open_device, start_device, take_frame, give_frame,
                                               stop_device, close_device, problem_of};
    if (device) {
        std::memset(device, 0, sizeof *device);
        (void)tell(device, IRIS_OK, "not opened");
    }
    return {&driver, device};
}
}
