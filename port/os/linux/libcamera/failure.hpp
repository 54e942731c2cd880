/* What goes wrong between C++ and C: thrown inside, a status and a text outside. */
#ifndef IRIS_LIBCAMERA_FAILURE_HPP
#define IRIS_LIBCAMERA_FAILURE_HPP

#include <stdexcept>
#include <string>

#include "iris/status.h"

namespace iris
{

class failure : public std::runtime_error
{
  public:
    failure(iris_status which, const std::string &text) : std::runtime_error(text), status(which)
    {
    }

    const iris_status status;
};

/* Throws unless the result of a call into libcamera is good: 0 or more. */
void check(int result, const char *what);

} // namespace iris

#endif
