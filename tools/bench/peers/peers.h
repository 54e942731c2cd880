/* What `make bench-peers` measures of IRIS, beside the same operation of another library: cases by the names of the rows
 * in peers.py, on the pictures that it sends. */
#ifndef IRIS_BENCH_PEERS_H
#define IRIS_BENCH_PEERS_H

#include "bench.h"

typedef struct {
    const char *name;         /* the row of peers.py */
    iris_status (*run)(void); /* the operation, on bench_frame: what is measured */
    void (*prepare)(void);    /* makes what run needs, and says where its result is: peer_result */
    void (*report)(void);     /* brings what run found into peer_result; null when it is there already */
} peer_case;

/* Each ends with a null name. */
extern const peer_case peer_color[], peer_filter[], peer_edge[], peer_mask[], peer_place[], peer_space[],
    peer_file[];

/* What goes back to be compared: a picture, or numbers as the pixels of one (IRIS_GRAY_U32). */
extern iris_image peer_result;

/* The result is bench_frame's gray_to, rgb_to, or mask_to; or so many numbers. */
void peer_gives_gray(void);
void peer_gives_color(void);
void peer_gives_mask(void);
void peer_gives_numbers(int32_t w, int32_t h);
void peer_number(int32_t x, int32_t y, int64_t number); /* its low 32 bits */

#endif
