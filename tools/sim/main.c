/* iris-demo: a simulated robot drives around a taped track by its camera alone. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frames.h"

static const char HELP[] =
    "usage: iris-demo --frames DIR [--seed N]\n"
    "  --frames DIR  write 120 camera frames and their truth to the existing folder DIR\n"
    "  --seed N      another floor and other noise (default 1)\n";

int main(int argc, char **argv)
{
    static sim_track track;
    static sim_camera camera;
    static sim_floor floor;
    const char *frames = NULL;
    uint32_t seed = 1;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--frames") == 0 && i + 1 < argc) {
            frames = argv[++i];
        } else if (strcmp(argv[i], "--seed") == 0 && i + 1 < argc) {
            seed = (uint32_t)strtoul(argv[++i], NULL, 10);
        } else {
            fputs(HELP, strcmp(argv[i], "--help") == 0 ? stdout : stderr);
            return strcmp(argv[i], "--help") == 0 ? 0 : 2;
        }
    }
    if (!frames) {
        fputs(HELP, stderr);
        return 2;
    }
    sim_track_build(&track);
    if (!sim_floor_make(&floor, &track, seed)) {
        fprintf(stderr, "iris-demo: not enough memory\n");
        return 1;
    }
    sim_camera_init(&camera, seed);
    printf("course: %.1f cm, floor %.0f x %.0f cm\n", track.length, track.right - track.left,
           track.top - track.bottom);
    int good = sim_frames_write(frames, 120, &camera, &floor);
    sim_floor_free(&floor);
    if (!good) {
        fprintf(stderr, "iris-demo: %s: cannot write frames\n", frames);
    }
    return good ? 0 : 1;
}
