/* iris-score: measures what IRIS promises, and says whether it is reached. */
#include <stdio.h>
#include <string.h>

#include "score.h"

static const char HELP[] =
    "usage: iris-score [--tap] [--figures DIR] [--pictures DIR]\n"
    "\n"
    "Prints every figure that IRIS promises: what is required and what is reached. Reads the shared data "
    "from the\n"
    "folder IRIS_DATA (default ../shared/data). Exit code 1 when a figure is missed.\n"
    "\n"
    "  --tap           print TAP, one test per figure, for the tests\n"
    "  --figures DIR   what the demo, the benchmark and the linker said, as `make score` collects it\n"
    "  --pictures DIR  write what was found: every line frame as it is, and the changed ones that failed\n"
    "\n"
    "example: make score PICTURES=/tmp/pictures\n";

int main(int argc, char **argv)
{
    score s = {0};
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            fputs(HELP, stdout);
            return 0;
        }
        if (strcmp(argv[i], "--tap") == 0) {
            s.tap = 1;
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
    score_tape(&s);
    score_dashes(&s);
    score_lane(&s);
    score_drive(&s);
    score_hsl(&s);
    score_tone(&s);
    score_blur(&s);
    score_bmp(&s);
    score_skeleton(&s);
    score_shapes(&s);
    score_quadtree(&s);
    score_edges(&s);
    score_blobs(&s);
    score_circles(&s);
    score_shapes_found(&s);
    score_floor(&s);
    score_lines(&s);
    score_junctions(&s);
    score_paths(&s);
    score_lock(&s);
    score_camera(&s);
    score_calib(&s);
    score_motion(&s);
    score_stereo(&s);
    score_pair(&s);
    score_carve(&s);
    score_map(&s);
    score_carve_photo(&s);
    score_cost(&s);
    score_totals(&s);
    return s.missed > 0;
}
