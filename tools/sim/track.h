/* The simulator's course: tape on a floor, made of straights, arcs, and one sharp corner.
 *
 * The world is in centimeters, x to the east and y to the north; headings are in radians, counterclockwise
 * from east. s is the way along the center line from the start; a lateral distance is positive to the left of
 * the course.
 */
#ifndef SIM_TRACK_H
#define SIM_TRACK_H

#define SIM_PIECES_MAX 24
#define SIM_MARKS      6

typedef struct {
    double x, y, heading;
} sim_pose;

typedef struct {
    sim_pose start;
    double s;         /* way along the course where this piece starts */
    double length;    /* cm */
    double curvature; /* 1/cm, positive to the left; 0 for a straight */
    double before;    /* cm of tape in front of the start and behind the end: makes a corner square */
    double behind;
    int taped; /* 0 in the gap */
} sim_piece;

/* A difficult place of the course. */
typedef struct {
    const char *name;
    double s;                /* way along the course */
    double label_x, label_y; /* cm from there to where the map writes its name */
} sim_mark;

typedef struct {
    sim_piece piece[SIM_PIECES_MAX];
    int count;
    double length; /* cm of the closed course */
    double tape;   /* cm, width of the tape */
    sim_mark mark[SIM_MARKS];
    double glare_s;      /* where the glare's center is */
    double glare_length; /* cm of tape saturated over its full width */
    double left, right;  /* the floor: x from left to right, y from bottom to top */
    double bottom, top;
} sim_track;

/* Builds the one course of the demo, closed to within rounding. */
void sim_track_build(sim_track *track);

/* The center line's pose at s (any value; the course repeats). */
sim_pose sim_track_at(const sim_track *track, double s);

/* Signed distance from (x, y) to the edge of the tape in cm, negative on the tape. */
double sim_track_tape(const sim_track *track, double x, double y);

/* Lateral distance of (x, y) from the center line (the gap belongs to it), searched within `window` cm of *s
 * only, so that a neighboring part of the course is never taken for this one. Moves *s to the nearest point,
 * which may run past the course's length (laps are counted by it). */
double sim_track_lateral(const sim_track *track, double x, double y, double window, double *s);

#endif
