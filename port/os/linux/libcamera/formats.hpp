/* What libcamera's names of formats and color spaces mean here. */
#ifndef IRIS_LIBCAMERA_FORMATS_HPP
#define IRIS_LIBCAMERA_FORMATS_HPP

#include <optional>

#include <libcamera/libcamera.h>

#include "iris/capture.h"

namespace iris
{

/* Of those that are offered, the one to ask for: this IRIS format, or with 0 the one that serves best. Throws an
 * IRIS_ERR_FORMAT that names what is offered. */
libcamera::PixelFormat choose_format(const libcamera::StreamConfiguration &offer, int32_t wanted);

/* The IRIS format; 0 for one that IRIS does not read. */
int32_t format_of(const libcamera::PixelFormat &format);

bool is_bayer(int32_t format);
bool is_yuv(int32_t format);

iris_color_matrix matrix_of(const std::optional<libcamera::ColorSpace> &space);
iris_color_range range_of(const std::optional<libcamera::ColorSpace> &space);

} // namespace iris

#endif
