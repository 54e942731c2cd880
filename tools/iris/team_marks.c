#include "team_marks.h"

static const iris_color edge = {255, 255, 255};

/* A mark's corners, in parts of TEAM_MARK to the right and down. */
typedef struct {
    const char *text;
    iris_color color;
    int corners;
    double at[10][2];
} mark_kind;

#define SQUARE                                                                                               \
    {                                                                                                        \
        {-0.8, -0.8}, {0.8, -0.8}, {0.8, 0.8},                                                               \
        {                                                                                                    \
            -0.8, 0.8                                                                                        \
        }                                                                                                    \
    }
#define DIAMOND                                                                                              \
    {                                                                                                        \
        {0, -1.1}, {1.1, 0}, {0, 1.1},                                                                       \
        {                                                                                                    \
            -1.1, 0                                                                                          \
        }                                                                                                    \
    }
#define UP                                                                                                   \
    {                                                                                                        \
        {0, -1}, {1.1, 0.9},                                                                                 \
        {                                                                                                    \
            -1.1, 0.9                                                                                        \
        }                                                                                                    \
    }
#define DOWN                                                                                                 \
    {                                                                                                        \
        {0, 1}, {1.1, -0.9},                                                                                 \
        {                                                                                                    \
            -1.1, -0.9                                                                                       \
        }                                                                                                    \
    }
#define RIGHTS                                                                                               \
    {                                                                                                        \
        {-0.8, -1.1}, {1.1, 0},                                                                              \
        {                                                                                                    \
            -0.8, 1.1                                                                                        \
        }                                                                                                    \
    }
#define STAR                                                                                                 \
    {                                                                                                        \
        {0, -1.2}, {0.3, -0.4}, {1.14, -0.37}, {0.48, 0.15}, {0.7, 0.97}, {0, 0.5}, {-0.7, 0.97},            \
            {-0.48, 0.15}, {-1.14, -0.37},                                                                   \
        {                                                                                                    \
            -0.3, -0.4                                                                                       \
        }                                                                                                    \
    }
#define HOURGLASS                                                                                            \
    {                                                                                                        \
        {-0.9, -1}, {0.9, -1}, {-0.9, 1},                                                                    \
        {                                                                                                    \
            0.9, 1                                                                                           \
        }                                                                                                    \
    }

static const mark_kind marks[BORG_SIGNAL_KINDS] = {
    [BORG_START] = {"starts", {90, 90, 90}, 3, RIGHTS},
    [BORG_OBJ_DETECT_TRUE] = {"object seen", {220, 40, 30}, 4, DIAMOND},
    [BORG_OBJ_DETECT_FALSE] = {"object lost", {240, 160, 150}, 4, DIAMOND},
    [BORG_TIME_OUT] = {"time-out", {130, 60, 160}, 4, HOURGLASS},
    [BORG_REACHED] = {"reached", {0, 140, 70}, 3, UP},
    [BORG_VOTE_WIN] = {"chosen", {230, 150, 0}, 10, STAR},
    [BORG_VOTE_LOST] = {"not chosen", {170, 170, 170}, 10, STAR},
    [BORG_STOPPED] = {"stopped", {20, 20, 20}, 4, SQUARE},
    [BORG_LINE_END] = {"line ends", {0, 110, 190}, 3, DOWN},
    [BORG_BUMPED] = {"bumped", {190, 100, 30}, 3, UP},
    [BORG_BATTERY_LOW] = {"battery low", {150, 130, 0}, 3, DOWN},
};

void team_mark_draw(const smooth_picture *picture, int kind, canvas_point at)
{
    const mark_kind *mark = &marks[kind];
    canvas_point outer[10], inner[10];
    for (int i = 0; i < mark->corners; i++) {
        const double x = mark->at[i][0], y = mark->at[i][1];
        outer[i] = (canvas_point){at.x + x * (TEAM_MARK + 2.5), at.y + y * (TEAM_MARK + 2.5)};
        inner[i] = (canvas_point){at.x + x * TEAM_MARK, at.y + y * TEAM_MARK};
    }
    smooth_polygon(picture, outer, mark->corners, edge);
    smooth_polygon(picture, inner, mark->corners, mark->color);
}

const char *team_mark_text(int kind)
{
    return marks[kind].text;
}

iris_color team_mark_color(int kind)
{
    return marks[kind].color;
}
