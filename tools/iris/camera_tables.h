/* What cameras there are and what they let be set, as text and as JSON. Where the library has no cameras each says so. */
#ifndef IRIS_TOOL_CAMERA_TABLES_H
#define IRIS_TOOL_CAMERA_TABLES_H

/* Each complains, and returns an exit code. */
int camera_tables_cameras(int json);
int camera_tables_controls(const char *device, int json);

/* words: NAME=VALUE each, cut in two at the '='. */
int camera_tables_set(const char *device, int count, char **words, int json);

#endif
