/* What the floor of the simulated course looks like: tape, texture, light, and glare; and the demo's random
 * numbers. */
#ifndef SIM_LIGHT_H
#define SIM_LIGHT_H

#include <stdint.h>

#include "track.h"

/* xorshift32: the same numbers on every machine. Never 0 once seeded. */
typedef struct {
    uint32_t state;
} sim_random;

void sim_random_seed(sim_random *random, uint32_t seed);
uint32_t sim_random_next(sim_random *random);

/* One point of the floor. */
typedef struct {
    float distance; /* cm to the tape's edge, negative on the tape */
    float bare;     /* gray of the floor there, lit, glare added */
    float taped;    /* gray of tape there */
} sim_cell;

/* The floor as a map, sampled with bilinear interpolation. */
typedef struct {
    const sim_track *track;
    sim_cell *cell;
    int w, h;
} sim_floor;

/* Makes the map; 0 when memory is short. Given back by sim_floor_free. */
int sim_floor_make(sim_floor *map, const sim_track *track, uint32_t seed);
void sim_floor_free(sim_floor *map);

/* Light at (x, y): 1 at the bright side of the course, 0.25 at the dark side. */
double sim_light(const sim_track *track, double x, double y);

/* Glare at (x, y): 1 where it saturates everything, 0 where there is none. */
double sim_glare(const sim_track *track, double x, double y);

/* Gray value of the floor at (x, y) before noise, 0 to 255 and beyond where it saturates. `blur` is the width
 * in cm over which the tape's edge is smeared: the footprint of a pixel. */
double sim_floor_gray(const sim_floor *map, double x, double y, double blur);

#endif
