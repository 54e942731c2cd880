/* iris-score: measures what IRIS promises, and says whether it is reached. */
#include <stdio.h>
#include <string.h>

#include "score.h"

static const char HELP[] =
    "usage: iris-score [--tap] [--only PART] [--figures DIR] [--pictures DIR]\n"
    "\n"
    "Prints every figure that IRIS promises: what is required and what is reached. Reads the shared data "
    "from the\n"
    "folder IRIS_DATA (default ../shared/data). Exit code 1 when a figure is missed.\n"
    "\n"
    "  --tap           print TAP, one test per figure, for the tests\n"
    "  --only PART     one part of the table: tape, stereo, map, and so on, as the files of tools/score are "
    "named\n"
    "  --figures DIR   what the demo, the benchmark and the linker said, as `make score` collects it\n"
    "  --pictures DIR  write what was found: every line frame as it is, and the changed ones that failed\n"
    "\n"
    "example: make score PICTURES=/tmp/pictures\n";

/* In the order of the table. */
static const struct {
    const char *name;
    void (*score)(score *s);
} parts[] = {{"tape", score_tape},
             {"dashes", score_dashes},
             {"lane", score_lane},
             {"drive", score_drive},
             {"hsl", score_hsl},
             {"tone", score_tone},
             {"blur", score_blur},
             {"bmp", score_bmp},
             {"skeleton", score_skeleton},
             {"shapes", score_shapes},
             {"quadtree", score_quadtree},
             {"edges", score_edges},
             {"blobs", score_blobs},
             {"circles", score_circles},
             {"shapes_found", score_shapes_found},
             {"floor", score_floor},
             {"lines", score_lines},
             {"junctions", score_junctions},
             {"paths", score_paths},
             {"lock", score_lock},
             {"camera", score_camera},
             {"calib", score_calib},
             {"motion", score_motion},
             {"stereo", score_stereo},
             {"pair", score_pair},
             {"carve", score_carve},
             {"map", score_map},
             {"carve_photo", score_carve_photo},
             {"cost", score_cost}};

int main(int argc, char **argv)
{
    score s = {0};
    const char *only = NULL;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            fputs(HELP, stdout);
            return 0;
        }
        if (strcmp(argv[i], "--tap") == 0) {
            s.tap = 1;
        } else if (strcmp(argv[i], "--only") == 0 && i + 1 < argc) {
            only = argv[++i];
        } else if (strcmp(argv[i], "--figures") == 0 && i + 1 < argc) {
            s.figures = argv[++i];
        } else if (strcmp(argv[i], "--pictures") == 0 && i + 1 < argc) {
            s.pictures = argv[++i];
        } else {
            fprintf(stderr, "iris-score: bad option: %s (--help tells more)\n", argv[i]);
            return 2;
        }
    }
    score_head(&s);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (!only || strcmp(only, parts[i].name) == 0) {
            parts[i].score(&s);
        }
    }
    score_totals(&s);
    return s.missed > 0;
}
