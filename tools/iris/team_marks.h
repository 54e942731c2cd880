/* Signs for the kinds of signals, the same in all pictures of a team.
 */
#ifndef IRIS_TOOL_TEAM_MARKS_H
#define IRIS_TOOL_TEAM_MARKS_H

#include "iris/borg/signal.h"
#include "smooth.h"

#define TEAM_MARK 8 /* pixels from a sign's middle to its edge */

/* kind: 0 to BORG_SIGNAL_KINDS - 1. */
void team_mark_draw(const smooth_picture *picture, int kind, canvas_point at);
const char *team_mark_text(int kind);
iris_color team_mark_color(int kind);

#endif
