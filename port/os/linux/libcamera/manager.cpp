/* The manager that all devices share, and the list of its cameras. */
#include "manager.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "failure.hpp"
#include "iris/libcamera.h"

namespace iris
{

namespace
{

/* A second manager beside the first ends the process, so starting and ending take turns. */
std::mutex turn;
std::weak_ptr<libcamera::CameraManager> current;

} // namespace

void check(int result, const char *what)
{
    if (result < 0) {
        char text[128] = "";
        const char *reason = strerror_r(-result, text, sizeof text);
        throw failure(IRIS_ERR_IO, std::string(what) + ": " + reason);
    }
}

manager::manager()
{
    const std::lock_guard<std::mutex> lock(turn);
    shared = current.lock();
    if (!shared) {
        auto fresh = std::make_shared<libcamera::CameraManager>();
        check(fresh->start(), "libcamera does not start");
        shared = fresh;
        current = fresh;
    }
}

manager::~manager()
{
    const std::lock_guard<std::mutex> lock(turn);
    shared.reset(); /* the last one stops it */
}

std::shared_ptr<libcamera::Camera> manager::find(const char *path) const
{
    const auto cameras = shared->cameras();
    for (const auto &camera : cameras) {
        if (camera->id() == path) {
            return camera;
        }
    }
    char *end = nullptr;
    errno = 0;
    const unsigned long number = std::strtoul(path, &end, 10);
    const bool is_number = *end == '\0' && std::strspn(path, "0123456789") == std::strlen(path) && errno == 0;
    if (is_number && number < cameras.size()) {
        return cameras[number];
    }
    if (cameras.empty()) {
        throw failure(IRIS_ERR_IO, "libcamera finds no camera (is it connected, and enabled in the system?)");
    }
    throw failure(IRIS_ERR_IO, "no such camera; there are " + std::to_string(cameras.size()) +
                                   ", from 0: " + cameras[0]->id() + (cameras.size() > 1 ? ", ..." : ""));
}

namespace
{

template <size_t Bytes> void copy_text(char (&to)[Bytes], const std::string &from)
{
    size_t length = 0;
    for (; length < from.size() && length + 1 < Bytes; length++) {
        to[length] = from[length] >= ' ' && from[length] <= '~' ? from[length] : '?';
    }
    to[length] = '\0';
}

iris_status list(iris_libcamera_info *cameras, int32_t *count, int32_t capacity)
{
    const manager all;
    for (const auto &camera : all->cameras()) {
        if (*count < capacity) {
            const auto model = camera->properties().get(libcamera::properties::Model);
            copy_text(cameras[*count].id, camera->id());
            copy_text(cameras[*count].model, model ? std::string(*model) : std::string());
        }
        ++*count;
    }
    return *count <= capacity ? IRIS_OK : IRIS_ERR_FULL;
}

} // namespace

} // namespace iris

extern "C" iris_status iris_libcamera_list(iris_libcamera_info *cameras, int32_t *count, int32_t capacity)
{
    if ((!cameras && capacity != 0) || !count || capacity < 0) {
        return IRIS_ERR_ARG;
    }
    *count = 0;
    try {
        return iris::list(cameras, count, capacity);
    } catch (...) {
        *count = 0;
        return IRIS_ERR_IO;
    }
}
