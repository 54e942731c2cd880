/* BMP reading: the files of the conformance suite. */
#include <stdlib.h>
#include <string.h>

#include "picture.h"
#include "score.h"

/* Largest difference of a channel where alpha, if there is one, is not 0; 256 for another size. */
static int difference(const iris_image *a, const iris_image *b, const iris_image *alpha)
{
    int largest = 0;
    if (a->w != b->w || a->h != b->h) {
        return 256;
    }
    for (int i = 0; i < 3 * a->w * a->h; i++) {
        int d = abs(((uint8_t *)a->data)[i] - ((uint8_t *)b->data)[i]);
        if (d > largest && (!alpha->data || ((uint8_t *)alpha->data)[i / 3] > 0)) {
            largest = d;
        }
    }
    return largest;
}

/* Within 1 of any reference in a list with commas? */
static int is_right(const iris_image *found, char *references)
{
    int right = 0;
    char *rest = NULL, file[160];
    for (char *name = strtok_r(references, ",", &rest); name && !right; name = strtok_r(NULL, ",", &rest)) {
        iris_image reference, alpha;
        snprintf(file, sizeof file, "bmp/ref/%s.ppm", name);
        iris_status status = picture_load(&reference, file, IRIS_RGB888);
        snprintf(file, sizeof file, "bmp/ref/%s.alpha.pgm", name);
        picture_load(&alpha, file, IRIS_GRAY8);
        right = status == IRIS_OK && difference(found, &reference, &alpha) <= 1;
        free(reference.data);
        free(alpha.data);
    }
    return right;
}

enum { RIGHT, REFUSED, OTHER };

/* One line of the manifest: name, tab, references. */
static void count_file(int counts[3][3], const char *line)
{
    char name[64], references[128], file[80];
    if (line[0] == '#' || sscanf(line, "%63[^\t]\t%127[^\t]", name, references) != 2) {
        return;
    }
    iris_image found;
    snprintf(file, sizeof file, "bmp/%s", name);
    iris_status status = picture_load(&found, file, IRIS_RGB888);
    int outcome = !found.data ? REFUSED : status == IRIS_OK && is_right(&found, references) ? RIGHT : OTHER;
    const char *folders = "gqb", *folder = strchr(folders, name[0]);
    counts[folder ? folder - folders : 2][outcome]++;
    free(found.data);
}

void score_bmp(score *s)
{
    int counts[3][3] = {{0}};
    char line[2048];
    FILE *manifest = data_open("bmp/MANIFEST.txt");
    if (!manifest) {
        score_row(s, "BMP files", "27 of 27", SCORE_SKIPPED, "no shared data");
        return;
    }
    while (fgets(line, sizeof line, manifest)) {
        count_file(counts, line);
    }
    fclose(manifest);
    score_row(s, "BMP good files within 1 of their reference", "27 of 27",
              score_if(counts[0][RIGHT] == 27 && counts[0][REFUSED] + counts[0][OTHER] == 0), "%d of %d",
              counts[0][RIGHT], counts[0][RIGHT] + counts[0][REFUSED] + counts[0][OTHER]);
    score_row(s, "BMP questionable files", "none wrong", score_if(counts[1][OTHER] == 0),
              "%d right, %d refused, %d wrong", counts[1][RIGHT], counts[1][REFUSED], counts[1][OTHER]);
#ifdef IRIS_CHECKED
    score_row(s, "BMP bad files: sanitizer reports", "0", SCORE_REACHED, "0: %d refused, %d read in part",
              counts[2][REFUSED], counts[2][OTHER]);
#else
    score_row(s, "BMP bad files (sanitizers: make score CHECKED=1)", NULL, SCORE_INFORMATION,
              "%d refused, %d read in part", counts[2][REFUSED], counts[2][OTHER]);
#endif
}
