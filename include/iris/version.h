/* IRIS - the version of these headers. */
#ifndef IRIS_VERSION_H
#define IRIS_VERSION_H

#define IRIS_VERSION_MAJOR 0
#define IRIS_VERSION_MINOR 1
#define IRIS_VERSION_PATCH 0
#define IRIS_VERSION_TEXT  "0.1.0"

#endif
