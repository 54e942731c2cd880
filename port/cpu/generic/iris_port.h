/* The generic port overrides no kernel: every iris_row_* is its plain C body. */
#ifndef IRIS_PORT_H
#define IRIS_PORT_H

#define IRIS_PORT_NAME      "generic"
#define IRIS_PORT_OVERRIDES 0

#endif
