#ifndef IRIS_TOOL_FILE_NAME_H
#define IRIS_TOOL_FILE_NAME_H

/* The last part of a path, without its folder. */
const char *file_name(const char *path);

#endif
