/* The cameras of a text file, and which silhouette and photograph belong to which. */
#ifndef IRIS_TOOL_CARVE_VIEWS_H
#define IRIS_TOOL_CARVE_VIEWS_H

#include "iris/wide.h"

#define CARVE_VIEWS_MAX 512
#define CARVE_NAME_MAX  128

typedef struct {
    char name[CARVE_NAME_MAX]; /* of the picture */
    iris_q32 m[12];            /* K [R | t] */
    const char *silhouette;    /* null: none */
    const char *photo;
    int shows; /* any of the box */
} carve_view;

typedef struct {
    carve_view views[CARVE_VIEWS_MAX];
    int count;
    int by_name; /* how the last pictures were matched */
} carve_views;

/* Reads the cameras: how many, then for each a name, K and R (3 x 3, row by row), and t; "-" is standard input. K has
 * focal lengths above 0, and R is a rotation but for what a text rounds.
 * Complains; returns 1, or 0. */
int carve_views_read(carve_views *views, const char *path);

typedef enum { CARVE_SILHOUETTES, CARVE_PHOTOS } carve_kind;

/* Gives each picture to a camera: the one whose name, without extension, its file's name begins with (of several the
 * longest); or by order, when none has a name like that and there are as many as cameras. Complains; returns 1, or 0.
 * path: the cameras' file. */
int carve_views_match(carve_views *views, carve_kind kind, char **pictures, int count, const char *path);

#endif
