/* A camera that is open: what libcamera calls back, and what the driver calls. */
#ifndef IRIS_LIBCAMERA_SESSION_HPP
#define IRIS_LIBCAMERA_SESSION_HPP

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>

#include <libcamera/libcamera.h>

#include "iris/capture.h"
#include "manager.hpp"
#include "slot.hpp"

namespace iris
{

/* A camera that this process has for itself. */
class hold
{
  public:
    explicit hold(std::shared_ptr<libcamera::Camera> found);
    ~hold();
    hold(const hold &) = delete;
    hold &operator=(const hold &) = delete;

    const std::shared_ptr<libcamera::Camera> camera;
};

/* Functions throw failures, and mean what iris_capture_driver says. */
class session
{
  public:
    session(iris_capture_grant *grant, const char *path, const iris_capture_config &wanted);
    ~session();
    session(const session &) = delete;
    session &operator=(const session &) = delete;

    void start();
    iris_status take(iris_frame *frame, int32_t timeout_ms);
    void give(int32_t buffer);
    void stop() noexcept;

  private:
    void negotiate(iris_capture_grant *grant, const iris_capture_config &wanted);
    void set_rate(iris_capture_grant *grant, int32_t rate_millihz);
    void allocate(iris_capture_grant *grant);
    void queue(slot &slot);
    int32_t next(int32_t timeout_ms);
    void forget();

    /* On a thread of libcamera's. */
    void completed(libcamera::Request *request);
    void disconnected();

    /* In the order that they need each other; destroyed from the end. */
    const manager all;
    const hold held;
    libcamera::Camera &camera;
    std::unique_ptr<libcamera::CameraConfiguration> config;
    std::unique_ptr<libcamera::ControlList> controls; /* null: none to be set */
    std::unique_ptr<libcamera::FrameBufferAllocator> allocator;
    std::array<slot, IRIS_CAPTURE_BUFFERS_MAX> slots;
    int32_t slot_count = 0;

    std::mutex mutex; /* of what follows, and of slots' where */
    std::condition_variable arrived;
    std::array<int32_t, IRIS_CAPTURE_BUFFERS_MAX> line = {}; /* slots whose frames wait, the oldest first */
    int32_t line_length = 0;
    bool running = false; /* a request that is canceled now means that the stream broke */
    bool broken = false;
    bool gone = false; /* for good */
};

} // namespace iris

#endif
