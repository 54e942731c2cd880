#include "track.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { FIT_EAST = -1, FIT_SOUTH = -2 }; /* straights whose lengths close the course, by where they lead */

/* One step of the course. A straight has turn 0; an arc has a radius; a turn without radius is a sharp
 * corner. */
typedef struct {
    double length; /* of a straight */
    double radius;
    double turn; /* degrees, positive to the left */
    int taped;
} step;

static const step COURSE[] = {
    {FIT_EAST, 0, 0, 1},  /* 0: along the bottom; the glare lies here */
    {0, 35, 90, 1},       /* to the north */
    {26, 0, 0, 1},        /* 2 */
    {5, 0, 0, 0},         /* the gap */
    {34, 0, 0, 1},        /* 4 */
    {0, 25, 180, 1},      /* the hairpin, tightest radius */
    {22, 0, 0, 1},        /* 6: to the south */
    {0, 30, -90, 1},      /* to the west */
    {0, 45, -45, 1},      /* an S */
    {0, 45, 45, 1},       /* 9 */
    {62, 0, 0, 1},        /* 10: to the west */
    {0, 0, 90, 1},        /* the sharp corner, to the south */
    {FIT_SOUTH, 0, 0, 1}, /* 12 */
    {0, 25, 90, 1},       /* to the east again */
};

enum { STEPS = sizeof COURSE / sizeof COURSE[0] };

/* Lengths of the two straights that close the course. */
typedef struct {
    double east, south;
} fitted;

static double step_length(const step *st, fitted fit)
{
    if (st->length == FIT_EAST) {
        return fit.east;
    }
    if (st->length == FIT_SOUTH) {
        return fit.south;
    }
    return st->turn != 0 ? st->radius * fabs(st->turn) * PI / 180 : st->length;
}

static sim_pose advance(sim_pose from, double curvature, double way)
{
    sim_pose to = from;
    if (curvature == 0) {
        to.x += way * cos(from.heading);
        to.y += way * sin(from.heading);
        return to;
    }
    to.heading += way * curvature;
    to.x += (sin(to.heading) - sin(from.heading)) / curvature;
    to.y -= (cos(to.heading) - cos(from.heading)) / curvature;
    return to;
}

static sim_pose lay(sim_track *track, fitted fit)
{
    sim_pose pose = {0, 0, 0};
    double behind = 0;
    track->count = 0;
    track->length = 0;
    for (int i = 0; i < STEPS; i++) {
        const step *st = &COURSE[i];
        double length = step_length(st, fit);
        double turn = st->turn * PI / 180;
        if (length == 0) { /* sharp corner: both pieces run on to the tape's far edge */
            track->piece[track->count - 1].behind = track->tape / 2;
            behind = track->tape / 2;
            pose.heading += turn;
            continue;
        }
        sim_piece piece = {pose, track->length, length, turn / length, behind, 0, st->taped};
        behind = 0;
        track->piece[track->count++] = piece;
        track->length += length;
        pose = advance(pose, piece.curvature, length);
    }
    return pose;
}

/* The floor reaches 25 cm beyond the center line. */
static void measure_floor(sim_track *track)
{
    track->left = track->bottom = 1e9;
    track->right = track->top = -1e9;
    for (double s = 0; s < track->length; s += 1) {
        sim_pose at = sim_track_at(track, s);
        track->left = fmin(track->left, at.x - 25);
        track->right = fmax(track->right, at.x + 25);
        track->bottom = fmin(track->bottom, at.y - 25);
        track->top = fmax(track->top, at.y + 25);
    }
}

void sim_track_build(sim_track *track)
{
    track->tape = 3;
    fitted fit = {1, 1};
    sim_pose end = lay(track, fit);
    fit.east -= end.x;
    fit.south += end.y;
    lay(track, fit);
    measure_floor(track);
    track->glare_s = 0.55 * fit.east;
    track->glare_length = 8;
    const sim_piece *p = track->piece;
    const sim_mark marks[SIM_MARKS] = {
        {"glare, 8 cm", track->glare_s, -13, 17},
        {"gap, 5 cm", p[3].s + p[3].length / 2, -30, -3},
        {"hairpin, radius 25 cm", p[5].s + p[5].length / 2, -25, 11},
        {"radius 30 cm", p[7].s + p[7].length / 2, -1, -7},
        {"S, radius 45 cm", p[9].s, -36, -6},
        {"90-degree corner", p[11].s, 7, -8},
    };
    memcpy(track->mark, marks, sizeof marks);
}

sim_pose sim_track_at(const sim_track *track, double s)
{
    s = fmod(s, track->length);
    s += s < 0 ? track->length : 0;
    int i = 0;
    while (i + 1 < track->count && track->piece[i + 1].s <= s) {
        i++;
    }
    return advance(track->piece[i].start, track->piece[i].curvature, s - track->piece[i].s);
}

/* The point of a piece nearest to (x, y): way from the piece's start, clamped to it, and lateral distance
 * there. */
static double project(const sim_piece *piece, double x, double y, double *lateral)
{
    double c = cos(piece->start.heading), s = sin(piece->start.heading);
    double along = (x - piece->start.x) * c + (y - piece->start.y) * s;
    double across = (y - piece->start.y) * c - (x - piece->start.x) * s;
    if (piece->curvature == 0) {
        *lateral = across;
        return along;
    }
    double side = piece->curvature > 0 ? 1 : -1;
    double radius = side / piece->curvature;
    double turned = atan2(along, radius - side * across); /* angle seen from the arc's center */
    double full = piece->length / radius;
    if (turned < (full - 2 * PI) / 2) {
        turned += 2 * PI;
    }
    *lateral = side * (radius - hypot(along, radius - side * across));
    return turned * radius;
}

static double to_point(sim_pose p, double x, double y)
{
    return hypot(x - p.x, y - p.y);
}

static double tape_of_piece(const sim_piece *piece, double half, double x, double y)
{
    double lateral;
    double way = project(piece, x, y, &lateral);
    if (piece->curvature != 0) {
        if (way < 0 || way > piece->length) {
            sim_pose end = advance(piece->start, piece->curvature, piece->length);
            return fmin(to_point(piece->start, x, y), to_point(end, x, y)) - half;
        }
        return fabs(lateral) - half;
    }
    double out = fmax(-piece->before - way, way - piece->length - piece->behind);
    double wide = fabs(lateral) - half;
    return out > 0 && wide > 0 ? hypot(out, wide) : fmax(out, wide);
}

double sim_track_tape(const sim_track *track, double x, double y)
{
    double best = 1e9;
    for (int i = 0; i < track->count; i++) {
        if (track->piece[i].taped) {
            best = fmin(best, tape_of_piece(&track->piece[i], track->tape / 2, x, y));
        }
    }
    return best;
}

double sim_track_lateral(const sim_track *track, double x, double y, double window, double *s)
{
    double best = 1e9, best_s = *s;
    double lap = floor(*s / track->length);
    for (int i = 0; i < 3 * track->count; i++) {
        const sim_piece *piece = &track->piece[i % track->count];
        double base = (lap + i / track->count - 1) * track->length + piece->s;
        double low = fmax(0, *s - window - base), high = fmin(piece->length, *s + window - base);
        if (low > high) {
            continue;
        }
        double lateral;
        double way = project(piece, x, y, &lateral);
        if (way < low || way > high) {
            way = way < low ? low : high;
            sim_pose p = advance(piece->start, piece->curvature, way);
            double across = (y - p.y) * cos(p.heading) - (x - p.x) * sin(p.heading);
            lateral = across < 0 ? -to_point(p, x, y) : to_point(p, x, y);
        }
        if (fabs(lateral) < fabs(best)) {
            best = lateral;
            best_s = base + way;
        }
    }
    *s = best_s;
    return best;
}
