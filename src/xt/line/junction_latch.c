#include "iris/xt/junction_latch.h"

#include <stddef.h>

#define DEGREES(n) ((n)*65536 / 360)

enum {
    SURE = 3,       /* frames that make a junction */
    PATIENCE = 5,   /* frames without it that end it, far away; near the robot it has passed */
    TURN_MS = 4000, /* at most */
    PASS_MS = 1200, /* straight on */
    SETTLED = 3,    /* frames with the branch ahead */
    LEARN_MS = 300, /* of turning until its rate says something */
    SLIDE_MS =
        120, /* a jump of the offset is told so slowly: steering by offset and rate (steer.h) then has no kick */
    JUMP_PER_MS = 262, /* 4 half widths a second: faster is no motion */
    LEAST_CONFIDENCE = 300
};

iris_status iris_junction_latch_init(iris_junction_latch *latch, iris_size size)
{
    if (!latch) {
        return IRIS_ERR_ARG;
    }
    if (size.w < 8 || size.h < 8 || size.w > IRIS_FOLLOW_SIDE_MAX || size.h > IRIS_FOLLOW_SIDE_MAX) {
        return IRIS_ERR_RANGE;
    }
    *latch = (iris_junction_latch){.size = size};
    return IRIS_OK;
}

iris_status iris_junction_latch_take(iris_junction_latch *latch, const iris_turn *turns, int32_t count)
{
    if (!latch || (!turns && count != 0) || count < 0) {
        return IRIS_ERR_ARG;
    }
    for (int32_t i = 0; i < count && i < IRIS_JUNCTION_TURNS_MAX; i++) {
        if ((unsigned)turns[i] > IRIS_TURN_RIGHT) {
            return IRIS_ERR_ARG;
        }
    }
    if (latch->turn_count < 0 || count > IRIS_JUNCTION_TURNS_MAX - latch->turn_count) {
        return IRIS_ERR_FULL;
    }
    for (int32_t i = 0; i < count; i++) {
        latch->turns[latch->turn_count++] = turns[i];
    }
    return IRIS_OK;
}

static int32_t magnitude(int32_t value)
{
    return value < 0 ? -value : value;
}

static int32_t clamp(int32_t value, int32_t low, int32_t high)
{
    return value < low ? low : value > high ? high : value;
}

static void enter(iris_junction_latch *latch, iris_latch_state state)
{
    latch->state = state;
    latch->since_ms = 0;
    latch->hits = latch->misses = 0;
    latch->turned = latch->turned_ms = 0;
}

static void let_go(iris_junction_latch *latch, iris_latch_state outcome)
{
    latch->turn_count--;
    for (int32_t i = 0; i < latch->turn_count; i++) {
        latch->turns[i] = latch->turns[i + 1];
    }
    enter(latch, outcome);
}

/* The branch that leads back: the one nearest to straight down. */
static int32_t way_back(const iris_junction *junction)
{
    int32_t back = 0;
    for (int32_t i = 1; i < junction->branch_count && i < IRIS_JUNCTION_BRANCHES; i++) {
        if (magnitude(junction->branches[i]) > magnitude(junction->branches[back])) {
            back = i;
        }
    }
    return back;
}

/* How much a branch is what was asked for: larger is better; negative when it is not. */
static int32_t suits(iris_turn turn, iris_angle branch)
{
    int32_t side = turn == IRIS_TURN_LEFT ? -branch : branch;
    return turn == IRIS_TURN_STRAIGHT ? DEGREES(35) - magnitude(branch) : side >= DEGREES(20) ? side : -1;
}

/* The number of the branch to take, or -1. */
static int32_t choose(const iris_junction *junction, iris_turn turn)
{
    int32_t back = way_back(junction), best = -1;
    for (int32_t i = 0; i < junction->branch_count && i < IRIS_JUNCTION_BRANCHES; i++) {
        int32_t suit = i == back ? -1 : suits(turn, junction->branches[i]);
        if (suit >= 0 && (best < 0 || suit > suits(turn, junction->branches[best]))) {
            best = i;
        }
    }
    return best;
}

/* Keeps the chosen branch, and how far from it the next one on the other side is. */
static void choose_branch(iris_junction_latch *latch, const iris_junction *junction, int32_t branch)
{
    int32_t back = way_back(junction), side = latch->turn == IRIS_TURN_LEFT ? -1 : 1;
    int32_t angle = junction->branches[branch];
    latch->branch = angle;
    latch->gap = 32768;
    for (int32_t i = 0; i < junction->branch_count && i < IRIS_JUNCTION_BRANCHES; i++) {
        int32_t apart = (angle - junction->branches[i]) * side;
        if (i != back && apart > 0 && apart < latch->gap) {
            latch->gap = apart;
        }
    }
}

/* The nearest real junction, if it is about where the last one was, or lower; null: none, or another. */
static const iris_junction *same_junction(const iris_junction_latch *latch, const iris_junction *junctions,
                                          int32_t count, int32_t branches)
{
    for (int32_t i = 0; i < count; i++) {
        const iris_junction *j = &junctions[i];
        if (j->branch_count < branches || j->confidence_permil < LEAST_CONFIDENCE) {
            continue;
        }
        int32_t aside = magnitude(j->x_q4 / 16 - latch->x), down = j->y_q4 / 16 - latch->y;
        int same = aside <= latch->size.w / 5 && down >= -latch->size.h / 12 && down <= latch->size.h / 3;
        if (latch->hits == 0 || same) {
            return j;
        }
    }
    return NULL;
}

static void see(iris_junction_latch *latch, const iris_junction *junction)
{
    latch->x = junction->x_q4 / 16;
    latch->y = junction->y_q4 / 16;
    latch->hits++;
    latch->misses = 0;
}

static void wait(iris_junction_latch *latch, const iris_junction *junctions, int32_t count)
{
    const iris_junction *junction = same_junction(latch, junctions, count, 3);
    int32_t branch = junction ? choose(junction, latch->turn) : -1;
    if (branch < 0) {
        latch->misses++;
        latch->hits = latch->misses > 1 ? 0 : latch->hits;
        return;
    }
    see(latch, junction);
    choose_branch(latch, junction, branch);
    if (latch->hits >= SURE) {
        enter(latch, IRIS_LATCH_COMING);
        latch->hits = SURE;
    }
}

static iris_q16 offset_of(const iris_junction_latch *latch, int32_t x)
{
    int32_t offset = clamp(2 * x - (latch->size.w - 1), -2 * latch->size.w, 2 * latch->size.w);
    return offset * 65536 / latch->size.w;
}

/* Columns for so many rows up in a direction, at most a frame's width. */
static int32_t columns(const iris_junction_latch *latch, iris_angle angle, int32_t rows)
{
    int32_t c = iris_cos_q30(angle) >> 16, s = iris_sin_q30(angle) >> 16;
    c = magnitude(c) < 2048 ? (c < 0 ? -2048 : 2048) : c; /* 83 degrees */
    return clamp(rows * s / c, -latch->size.w, latch->size.w);
}

/* The line through the junction: from the bottom row to it, and on into the branch. */
static void lead_through(iris_follow_result *line, const iris_junction_latch *latch,
                         const iris_junction *junction)
{
    int32_t h = latch->size.h, x = latch->x, y = latch->y;
    iris_angle stem = iris_angle_wrap((int32_t)junction->branches[way_back(junction)] + 32768);
    stem = (iris_angle)clamp(stem, -DEGREES(60), DEGREES(60));
    int32_t bottom_x = x - columns(latch, stem, h - 1 - y), ahead = (h - 1) / 3;
    int32_t bend = magnitude(iris_angle_wrap(latch->branch - stem));
    int32_t reach = h / 4,
            far_y =
                y - (int32_t)iris_round_shift((int64_t)iris_cos_q30((iris_angle)latch->branch) * reach, 30);
    int32_t far_x =
        x + (int32_t)iris_round_shift((int64_t)iris_sin_q30((iris_angle)latch->branch) * reach, 30);
    line->state = IRIS_LINE_FOUND;
    line->angle = stem;
    line->offset_q16 = offset_of(latch, bottom_x);
    int32_t up = ahead < y && bend < DEGREES(60) ? columns(latch, (iris_angle)latch->branch, y - ahead) : 0;
    line->lookahead_offset_q16 = offset_of(latch, ahead < y ? x + up : x - columns(latch, stem, ahead - y));
    line->has_next = bend > DEGREES(30);
    line->next_angle = line->has_next ? (iris_angle)clamp(latch->branch, -16384, 16384) : 0;
    line->width_px = junction->width_px;
    line->confidence_permil = junction->confidence_permil;
    line->segment_count = 2;
    line->segments[0] = (iris_segment){bottom_x, h - 1, x, y};
    line->segments[1] = (iris_segment){x, y, far_x, far_y};
}

/* The branch in this frame that the chosen one has become, and the line through it. */
static void come_nearer(iris_follow_result *line, iris_junction_latch *latch, const iris_junction *junctions,
                        int32_t count)
{
    const iris_junction *junction = same_junction(latch, junctions, count, 3);
    int32_t low = latch->size.h - 1 - latch->size.h / 8;
    int32_t branch = junction ? choose(junction, latch->turn) : -1;
    if (branch >= 0) {
        see(latch, junction);
        choose_branch(latch, junction, branch);
        lead_through(line, latch, junction);
    } else {
        latch->misses++;
        if (line->state == IRIS_LINE_FOUND && magnitude(latch->branch) > DEGREES(30)) {
            line->has_next = 1;
            line->next_angle = (iris_angle)clamp(latch->branch, -16384, 16384);
        }
    }
    if (latch->y >= low || (latch->misses >= SURE && latch->y * 2 > latch->size.h)) {
        enter(latch, IRIS_LATCH_TURNS);
        latch->branch = clamp(magnitude(latch->branch), 0, 16384);
    } else if (latch->misses >= PATIENCE) {
        enter(latch, IRIS_LATCH_WAITS);
    }
}

static void hide(iris_follow_result *line)
{
    *line = (iris_follow_result){.state = IRIS_LINE_LOST};
}

/* The angle turned since the junction has passed: as last seen, and since then at the rate of then, if that is known,
 * and of 60 degrees a second (small robots turn by 30 to 120). Not beyond the branch. */
static int32_t turned_by_now(const iris_junction_latch *latch)
{
    int32_t rate = DEGREES(60);
    if (latch->turned_ms >= LEARN_MS) {
        int32_t seen = latch->turned * 1000 / latch->turned_ms;
        rate = (rate + clamp(seen, 0, DEGREES(150))) / 2;
    }
    int32_t unseen_ms = clamp(latch->since_ms - latch->turned_ms, 0, TURN_MS);
    int32_t most = latch->turned > latch->branch ? latch->turned : latch->branch;
    return clamp(latch->turned + unseen_ms * rate / 1000, 0, most);
}

static void see_turned(iris_junction_latch *latch, int32_t turned)
{
    latch->turned = clamp(turned, 0, 32768);
    latch->turned_ms = latch->since_ms;
}

/* As long as the junction is in sight it tells how far the branch has come around. */
static void watch_junction(iris_junction_latch *latch, int32_t side, const iris_junction *junctions,
                           int32_t count)
{
    latch->hits = -1; /* where it was */
    const iris_junction *junction = same_junction(latch, junctions, count, 2);
    int32_t expected = latch->branch - turned_by_now(latch), nearest = DEGREES(30) + 1, angle = 0;
    for (int32_t i = 0; junction && i < junction->branch_count && i < IRIS_JUNCTION_BRANCHES; i++) {
        int32_t apart = magnitude(junction->branches[i] * side - expected);
        if (apart < nearest) {
            nearest = apart;
            angle = junction->branches[i] * side;
        }
    }
    if (junction) {
        latch->x = junction->x_q4 / 16;
        latch->y = junction->y_q4 / 16;
    }
    if (nearest <= DEGREES(30)) {
        see_turned(latch, latch->branch - angle);
    }
}

/* Is a line at this angle and offset, to the side of the turn, the branch? The line that goes on elsewhere turns with
 * it, so many degrees behind it, and never back on that side. That tells how far the robot has turned, too. */
static int is_branch(iris_junction_latch *latch, int32_t angle, int32_t offset)
{
    int32_t turned = turned_by_now(latch), by_other = latch->branch - latch->gap - angle;
    int32_t to_branch = magnitude(angle - (latch->branch - turned)), to_other = magnitude(by_other - turned);
    int turned_back = by_other < latch->turned - DEGREES(15) && offset > 16384;
    int can_be_other = to_other <= DEGREES(45) && !turned_back;
    int32_t unseen_ms = clamp(latch->since_ms - latch->turned_ms, 0, 600);
    int32_t at_most = latch->turned + DEGREES(20) + unseen_ms * (DEGREES(150) / 1000);
    int can_be_branch = to_branch <= DEGREES(60) && latch->branch - angle <= at_most;
    if (can_be_branch && (!can_be_other || to_branch * 3 <= to_other * 2)) {
        see_turned(latch, latch->branch - angle);
        return 1;
    }
    if (can_be_other) {
        see_turned(latch, by_other);
    }
    return 0;
}

/* A line across the picture has two ends: the angle of the one that is nearer to what is expected. */
static int32_t ahead_end(const iris_junction_latch *latch, int32_t angle)
{
    int32_t expected = latch->branch - turned_by_now(latch);
    int32_t end = angle > 0 ? angle - 32768 : angle + 32768;
    int across = magnitude(angle) > DEGREES(60);
    return across && magnitude(end - expected) < magnitude(angle - expected) ? end : angle;
}

/* Hides every line but the branch, until that is ahead. latch->branch is the angle to the side of the turn that it had
 * when the junction passed. */
static void turn_aside(iris_follow_result *line, iris_junction_latch *latch, const iris_junction *junctions,
                       int32_t count)
{
    int32_t side = latch->turn == IRIS_TURN_LEFT ? -1 : 1, ahead = latch->misses;
    watch_junction(latch, side, junctions, count);
    int32_t angle = ahead_end(latch, line->angle * side);
    if (line->state != IRIS_LINE_FOUND ||
        !is_branch(latch, angle, clamp(line->offset_q16, -131072, 131072) * side)) {
        hide(line);
        ahead = 0;
    } else {
        ahead = magnitude(angle) <= DEGREES(30) ? ahead + 1 : 0;
        if (magnitude(angle) > DEGREES(60)) {
            line->angle = (iris_angle)(clamp(angle, -16384, 16384) * side);
            line->offset_q16 = line->lookahead_offset_q16 = side * 32768;
            line->has_next = 0;
        }
    }
    latch->misses = ahead;
    if (ahead >= SETTLED) {
        let_go(latch, IRIS_LATCH_DONE);
    } else if (latch->since_ms >= TURN_MS) {
        let_go(latch, IRIS_LATCH_MISSED);
    }
}

/* Keeps straight on over whatever branches off. */
static void pass(iris_follow_result *line, iris_junction_latch *latch)
{
    if (line->state != IRIS_LINE_FOUND || magnitude(line->angle) > DEGREES(35)) {
        hide(line);
        line->state = IRIS_LINE_FOUND;
        line->segment_count = 1;
        line->segments[0] =
            (iris_segment){latch->size.w / 2, latch->size.h - 1, latch->size.w / 2, latch->size.h / 2};
    }
    line->has_next = 0;
    if (latch->since_ms >= PASS_MS) {
        let_go(latch, IRIS_LATCH_DONE);
    }
}

/* A jump in what is told is another line, no motion. It is told little by little. */
static iris_q16 slide(iris_junction_slide *slide, int32_t told, int32_t elapsed_ms, int afresh)
{
    int32_t offset = clamp(told, -131072, 131072), jump = offset - slide->told;
    slide->told = offset;
    if (afresh) {
        slide->behind = 0;
        return told;
    }
    if (magnitude(jump) > clamp(elapsed_ms, 0, 1000) * JUMP_PER_MS) {
        slide->behind = clamp(slide->behind - jump, -262144, 262144);
    }
    slide->behind = (int32_t)((int64_t)slide->behind * SLIDE_MS / (SLIDE_MS + elapsed_ms));
    return clamp(offset + slide->behind, -131072, 131072);
}

static void slide_offsets(iris_follow_result *line, iris_junction_latch *latch, int32_t elapsed_ms)
{
    int afresh = latch->state != IRIS_LATCH_COMING || !latch->sliding;
    latch->sliding = line->state == IRIS_LINE_FOUND;
    if (latch->sliding) {
        line->offset_q16 = slide(&latch->near, line->offset_q16, elapsed_ms, afresh);
        line->lookahead_offset_q16 = slide(&latch->ahead, line->lookahead_offset_q16, elapsed_ms, afresh);
    }
}

iris_status iris_junction_latch_update(iris_follow_result *line, iris_junction_latch *latch,
                                       const iris_junction *junctions, int32_t count, int32_t elapsed_ms)
{
    if (!line || !latch || count < 0 || (!junctions && count > 0)) {
        return IRIS_ERR_ARG;
    }
    if (latch->turn_count <= 0) {
        return IRIS_OK;
    }
    int32_t elapsed = clamp(elapsed_ms, 0, 60000);
    latch->since_ms = clamp(latch->since_ms + elapsed, 0, 60000);
    if (latch->state == IRIS_LATCH_DONE || latch->state == IRIS_LATCH_MISSED) {
        enter(latch, IRIS_LATCH_WAITS);
    }
    latch->turn = latch->turns[0];
    if (latch->state == IRIS_LATCH_WAITS) {
        wait(latch, junctions, count);
        slide_offsets(line, latch, elapsed);
    } else if (latch->state == IRIS_LATCH_COMING) {
        come_nearer(line, latch, junctions, count);
        slide_offsets(line, latch, elapsed);
    } else if (latch->turn == IRIS_TURN_STRAIGHT) {
        pass(line, latch);
    } else {
        turn_aside(line, latch, junctions, count);
    }
    return IRIS_OK;
}
