/* libcamera names formats as DRM does: letters from the most significant bits of a little-endian number down, so that its
 * BGR888 is bytes R, G, B in memory. */
#include "formats.hpp"

#include <algorithm>

#include "failure.hpp"

namespace iris
{

namespace
{

struct meaning {
    libcamera::PixelFormat format;
    int32_t iris;
};

/* The header of libcamera 0.0.3 forgets this bit. */
constexpr uint32_t big_endian = 1u << 31;

/* What serves best comes first: formats with a gray picture in them, which cost no conversion, before others. */
const meaning meanings[] = {
    {libcamera::formats::NV12, IRIS_CAPTURE_NV12},
    {libcamera::formats::YUYV, IRIS_YUYV},
    {libcamera::formats::UYVY, IRIS_UYVY},
    {libcamera::formats::R8, IRIS_GRAY8},
    {libcamera::formats::BGR888, IRIS_RGB888},
    {libcamera::formats::RGB888, IRIS_BGR888},
    {libcamera::formats::ABGR8888, IRIS_RGBA8888},
    {libcamera::formats::XBGR8888, IRIS_RGBA8888},
    {libcamera::formats::RGB565, IRIS_RGB565},
    {libcamera::PixelFormat(libcamera::formats::RGB565.fourcc() | big_endian), IRIS_RGB565_SWAP},
    {libcamera::formats::SRGGB8, IRIS_BAYER8_RGGB},
    {libcamera::formats::SGRBG8, IRIS_BAYER8_GRBG},
    {libcamera::formats::SGBRG8, IRIS_BAYER8_GBRG},
    {libcamera::formats::SBGGR8, IRIS_BAYER8_BGGR},
};

std::string names_of(const std::vector<libcamera::PixelFormat> &formats)
{
    std::string names;
    for (const auto &format : formats) {
        names += (names.empty() ? "" : " ") + format.toString();
    }
    return names.empty() ? "none" : names;
}

} // namespace

libcamera::PixelFormat choose_format(const libcamera::StreamConfiguration &offer, int32_t wanted)
{
    const auto offered = offer.formats().pixelformats();
    for (const auto &known : meanings) {
        if ((wanted == 0 || wanted == known.iris) &&
            std::find(offered.begin(), offered.end(), known.format) != offered.end()) {
            return known.format;
        }
    }
    throw failure(IRIS_ERR_FORMAT,
                  std::string(wanted == 0 ? "no format that IRIS reads" : "not this format") +
                      "; the camera offers (DRM's names): " + names_of(offered));
}

int32_t format_of(const libcamera::PixelFormat &format)
{
    for (const auto &known : meanings) {
        if (known.format == format) {
            return known.iris;
        }
    }
    return 0;
}

bool is_bayer(int32_t format)
{
    return format >= IRIS_BAYER8_RGGB && format <= IRIS_BAYER8_BGGR;
}

bool is_yuv(int32_t format)
{
    return format == IRIS_CAPTURE_NV12 || format == IRIS_YUYV || format == IRIS_UYVY;
}

iris_color_matrix matrix_of(const std::optional<libcamera::ColorSpace> &space)
{
    if (space) {
        switch (space->ycbcrEncoding) {
        case libcamera::ColorSpace::YcbcrEncoding::Rec601:
            return IRIS_MATRIX_BT601;
        case libcamera::ColorSpace::YcbcrEncoding::Rec709:
            return IRIS_MATRIX_BT709;
        case libcamera::ColorSpace::YcbcrEncoding::Rec2020:
            return IRIS_MATRIX_BT2020;
        case libcamera::ColorSpace::YcbcrEncoding::None:
            break;
        }
    }
    return IRIS_MATRIX_UNKNOWN;
}

iris_color_range range_of(const std::optional<libcamera::ColorSpace> &space)
{
    if (!space) {
        return IRIS_RANGE_UNKNOWN;
    }
    return space->range == libcamera::ColorSpace::Range::Full ? IRIS_RANGE_FULL : IRIS_RANGE_LIMITED;
}

} // namespace iris
