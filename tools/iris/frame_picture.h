/* A captured frame as a picture that files hold. */
#ifndef IRIS_TOOL_FRAME_PICTURE_H
#define IRIS_TOOL_FRAME_PICTURE_H

#include "iris/capture.h"
#include "picture.h"

/* Makes *view the frame itself when it is IRIS_GRAY8, IRIS_RGB888, or IRIS_BGR888, else its colors as IRIS_RGB888 in
 * *room. The errors of picture_reserve. */
iris_status frame_picture(iris_image *view, picture_buffer *room, const iris_frame *frame);

#endif
