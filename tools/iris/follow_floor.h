/* `iris follow --floor`: the line in millimeters, and steering by them. */
#ifndef IRIS_TOOL_FOLLOW_FLOOR_H
#define IRIS_TOOL_FOLLOW_FLOOR_H

#include "iris/xt/junction.h"
#include "iris/xt/pursuit.h"
#include "json.h"

#define FOLLOW_FLOOR_HELP                                                                                    \
    "  --floor FLOOR  steer by millimeters: the floor file that iris floor has made for this camera\n"       \
    "  --lookahead MM how far ahead of the axle the line is steered for, 10 to 10000, default 200\n"         \
    "  --radius MM    of the curve that full steering drives, default 75: half of the wheels' distance\n"    \
    "  --axle MM      where the middle of the axle is ahead of the floor's (0, 0), default 0\n"

/* The options as texts, null where not given. */
typedef struct {
    const char *floor, *lookahead, *radius, *axle;
} follow_floor_texts;

typedef struct {
    int used; /* 0: no --floor */
    iris_floor floor;
    iris_pursuit_config config;
} follow_floor;

/* Returns an exit code after complaining. */
int follow_floor_read(follow_floor *by, const follow_floor_texts *texts);

/* The command and the goal of a line: by the floor if it is used, else by the picture, and no goal. */
void follow_floor_steer(iris_command *command, iris_pursuit_goal *goal, iris_steer *steer,
                        const iris_follow_result *line, const follow_floor *by, int32_t elapsed_ms);

/* Members of the answer's JSON object, and its words; nothing when the floor is not used. */
void follow_floor_json(json_writer *json, const iris_pursuit_goal *goal, const iris_follow_result *line,
                       const follow_floor *by);
void follow_floor_print(const iris_pursuit_goal *goal, const follow_floor *by);

/* The same of a junction: where it is, and the true angles of its branches. */
void follow_floor_json_junction(json_writer *json, const iris_junction *junction, const follow_floor *by);
void follow_floor_print_junction(const iris_junction *junction, const follow_floor *by);

#endif
