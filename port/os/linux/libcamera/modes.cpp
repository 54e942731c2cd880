/* What a camera offers for pictures: formats and sizes. */
#include "failure.hpp"
#include "formats.hpp"
#include "iris/libcamera.h"
#include "manager.hpp"

#include <algorithm>

namespace
{

using libcamera::SizeRange;

/* A camera knows either a few sizes, or a range. */
std::vector<SizeRange> sizes_of(const libcamera::StreamFormats &formats, const libcamera::PixelFormat &format)
{
    const SizeRange range = formats.range(format);
    if (range.hStep > 0 && range.vStep > 0) {
        return {range};
    }
    std::vector<SizeRange> sizes;
    for (const libcamera::Size &size : formats.sizes(format)) {
        sizes.emplace_back(size);
    }
    return sizes;
}

int32_t side(unsigned pixels)
{
    return static_cast<int32_t>(std::min(pixels, static_cast<unsigned>(INT32_MAX)));
}

iris_libcamera_mode mode_of(const libcamera::PixelFormat &format, const SizeRange &sizes)
{
    iris_libcamera_mode mode = {};
    const std::string name = format.toString();
    name.copy(mode.name, sizeof mode.name - 1);
    mode.format = iris::format_of(format);
    mode.least = {side(sizes.min.width), side(sizes.min.height)};
    mode.most = {side(sizes.max.width), side(sizes.max.height)};
    if (sizes.min != sizes.max) {
        mode.step = {side(sizes.hStep), side(sizes.vStep)};
    }
    return mode;
}

iris_status list(iris_libcamera_mode *modes, int32_t *count, const char *path, int32_t capacity)
{
    const iris::manager all;
    const auto camera = all.find(path);
    const auto offer = camera->generateConfiguration({libcamera::StreamRole::Viewfinder});
    if (!offer || offer->empty()) {
        return IRIS_ERR_UNSUPPORTED;
    }
    const libcamera::StreamFormats &formats = offer->at(0).formats();
    for (const auto &format : formats.pixelformats()) {
        for (const SizeRange &sizes : sizes_of(formats, format)) {
            if (*count < capacity) {
                modes[*count] = mode_of(format, sizes);
            }
            ++*count;
        }
    }
    return *count <= capacity ? IRIS_OK : IRIS_ERR_FULL;
}

} // namespace

extern "C" iris_status iris_libcamera_list_modes(iris_libcamera_mode *modes, int32_t *count, const char *path,
                                                 int32_t capacity)
{
    if ((!modes && capacity != 0) || !count || !path || capacity < 0) {
        return IRIS_ERR_ARG;
    }
    *count = 0;
    try {
        return list(modes, count, path, capacity);
    } catch (...) {
        *count = 0;
        return IRIS_ERR_IO;
    }
}
