/* Pictures of what `iris follow` found: the frame with the line's edges per row, its segments, its direction at the
 * robot, and the numbers. Small frames are enlarged.
 */
#ifndef IRIS_TOOL_FOLLOW_OVERLAY_H
#define IRIS_TOOL_FOLLOW_OVERLAY_H

#include "follow_report.h"
#include "iris/image.h"

/* Draws into the frame (IRIS_RGB888), or into a larger copy, and writes that under the input's name as a BMP; a frame
 * of standard input is frame_00001.bmp, after its number. Complains; returns an exit code. */
int follow_overlay_write(const char *folder, const iris_image *frame, const follow_answer *answer);

void follow_overlay_end(void);

#endif
