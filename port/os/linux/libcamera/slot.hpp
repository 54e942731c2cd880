/* One of a camera's buffers: its memory as views, and the request that carries it there and back. */
#ifndef IRIS_LIBCAMERA_SLOT_HPP
#define IRIS_LIBCAMERA_SLOT_HPP

#include <memory>

#include <libcamera/libcamera.h>

#include "iris/capture.h"

namespace iris
{

/* A plane of a buffer in this process's memory, to be read only. */
class mapping
{
  public:
    mapping() = default;
    ~mapping();
    mapping(const mapping &) = delete;
    mapping &operator=(const mapping &) = delete;

    /* Throws where the plane is not all there, or does not hold what it should. */
    void map(iris_image *view, const libcamera::FrameBuffer::Plane &plane, iris_size size, ptrdiff_t stride,
             iris_format format);

    /* Before reading, and after: some processors do not see by themselves what a device wrote. */
    void begin_reading() const;
    void end_reading() const;

    size_t needed = 0; /* bytes of a whole picture */

  private:
    void *memory = nullptr;
    size_t bytes = 0;
    int handle = -1; /* the buffer's own */
};

struct slot {
    enum place { idle, at_camera, waiting, borrowed };

    place where = idle;
    libcamera::FrameBuffer *buffer = nullptr;
    std::unique_ptr<libcamera::Request> request;
    iris_image image = {}, chroma = {};
    mapping planes[2]; /* the second one is NV12's */

    void map(const iris_capture_grant &grant);
    bool is_whole() const; /* did the camera call it good, and fill it? */
    void begin_reading() const;
    void end_reading() const;
};

} // namespace iris

#endif
