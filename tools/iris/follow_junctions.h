/* What `iris follow --junctions` and --take add: the junctions of each frame, and the latch that takes one's branch. */
#ifndef IRIS_TOOL_FOLLOW_JUNCTIONS_H
#define IRIS_TOOL_FOLLOW_JUNCTIONS_H

#include "canvas.h"
#include "follow_floor.h"
#include "iris/xt/follow.h"
#include "iris/xt/junction_latch.h"
#include "json.h"

typedef struct {
    int used; /* 1: --junctions or --take */
    iris_turn turns[IRIS_JUNCTION_TURNS_MAX];
    int turn_count;
} follow_junction_options;

/* What was found in a frame. */
typedef struct {
    iris_junction found[IRIS_JUNCTIONS_MAX];
    int32_t count;                 /* -1: not looked for, and what follows is not there */
    const char *take, *take_state; /* the turn of --take, or null; waiting, approaching, ... */
} follow_junctions;

/* Reads left|right|straight[,..]. Returns 0 after complaining. */
int follow_junctions_take(follow_junction_options *options, const char *text);

/* Finds the junctions of a frame (IRIS_RGB888), and lets the latch change the line. elapsed_ms: since the last frame;
 * below 0: this one has nothing to do with it. Returns an exit code after complaining. */
int follow_junctions_look(follow_junctions *junctions, iris_follow_result *line, const iris_image *frame,
                          const iris_follow_config *config, const follow_junction_options *options,
                          int32_t elapsed_ms);

void follow_junctions_json(json_writer *json, const follow_junctions *junctions, const follow_floor *floor);
void follow_junctions_print(const follow_junctions *junctions, const follow_floor *floor);
void follow_junctions_draw(const canvas *c, const follow_junctions *junctions);
void follow_junctions_end(void);

#endif
