/* libcamera's list of cameras, which exists once in a process: shared by all that use it, and gone with the last. */
#ifndef IRIS_LIBCAMERA_MANAGER_HPP
#define IRIS_LIBCAMERA_MANAGER_HPP

#include <memory>

#include <libcamera/libcamera.h>

namespace iris
{

class manager
{
  public:
    manager();
    ~manager();
    manager(const manager &) = delete;
    manager &operator=(const manager &) = delete;

    /* By id, by number, or the first for "". Throws when there is none. */
    std::shared_ptr<libcamera::Camera> find(const char *path) const;

    libcamera::CameraManager *operator->() const
    {
        return shared.get();
    }

  private:
    std::shared_ptr<libcamera::CameraManager> shared;
};

} // namespace iris

#endif
