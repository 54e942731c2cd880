/* The score of BMP reading: the files of the conformance suite under IRIS_DATA (default ../shared/data). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "iris/bmp.h"
#include "iris/pnm.h"

typedef struct {
    iris_image image; /* data is null when nothing could be read; malloc */
    iris_status status;
} picture;

static ptrdiff_t read_file(void *user, uint8_t *buffer, size_t bytes)
{
    FILE *file = user;
    size_t count = fread(buffer, 1, bytes, file);
    return count == 0 && ferror(file) ? -1 : (ptrdiff_t)count;
}

/* Room for a picture of 64 megapixels at most; data is null otherwise. */
static iris_image make_image(int32_t w, int32_t h, iris_format format)
{
    iris_image image = {0};
    size_t bytes = iris_format_row_bytes(format, w) * (size_t)h;
    void *pixels = bytes <= 192u << 20 ? calloc(bytes, 1) : NULL;
    if (pixels && iris_image_wrap(&image, pixels, bytes, (iris_size){w, h}, 0, format) != IRIS_OK) {
        free(pixels);
    }
    return image;
}

static picture load(const char *folder, const char *name, const char *extension)
{
    const char *root = getenv("IRIS_DATA");
    char path[512];
    picture result = {{0}, IRIS_ERR_IO};
    iris_stream stream;
    iris_bmp_reader bmp;
    iris_pnm_reader pnm;
    snprintf(path, sizeof path, "%s/bmp/%s%s%s", root ? root : "../shared/data", folder, name, extension);
    FILE *file = fopen(path, "rb");
    if (!file) {
        return result;
    }
    iris_stream_init(&stream, (iris_source){read_file, file});
    if (*extension) {
        result.status = iris_pnm_begin(&pnm, &stream);
        if (result.status == IRIS_OK) {
            result.image = make_image(pnm.w, pnm.h, pnm.is_gray ? IRIS_GRAY8 : IRIS_RGB888);
            result.status = iris_pnm_read(&result.image, &pnm);
        }
    } else {
        result.status = iris_bmp_begin(&bmp, &stream);
        if (result.status == IRIS_OK) {
            result.image = make_image(bmp.w, bmp.h, IRIS_RGB888);
            result.status = iris_bmp_read(&result.image, &bmp);
        }
    }
    fclose(file);
    return result;
}

/* Largest difference of a channel where alpha, if there is one, is not 0; 256 for another size. */
static int difference(const iris_image *a, const iris_image *b, const iris_image *alpha)
{
    int largest = 0;
    if (a->w != b->w || a->h != b->h || a->format != b->format) {
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
static int is_right(const picture *found, char *references)
{
    int right = 0;
    char *rest = NULL;
    for (char *name = strtok_r(references, ",", &rest); name && found->status == IRIS_OK && !right;
         name = strtok_r(NULL, ",", &rest)) {
        picture reference = load("ref/", name, ".ppm");
        picture alpha = load("ref/", name, ".alpha.pgm");
        right = reference.status == IRIS_OK && difference(&found->image, &reference.image, &alpha.image) <= 1;
        free(reference.image.data);
        free(alpha.image.data);
    }
    return right;
}

int main(void)
{
    enum { RIGHT, REFUSED, OTHER };
    int counts[3][3] = {{0}};
    const char *folders = "gqb", *root = getenv("IRIS_DATA");
    char path[512], line[2048], name[64], references[128];
    snprintf(path, sizeof path, "%s/bmp/MANIFEST.txt", root ? root : "../shared/data");
    FILE *manifest = fopen(path, "r");
    if (!manifest) {
        printf("BMP files | skipped, no data\n");
        return 0;
    }
    while (fgets(line, sizeof line, manifest)) {
        if (line[0] == '#' || sscanf(line, "%63[^\t]\t%127[^\t]", name, references) != 2) {
            continue;
        }
        picture found = load("", name, "");
        int outcome = is_right(&found, references) ? RIGHT : found.image.data ? OTHER : REFUSED;
        counts[strchr(folders, name[0]) - folders][outcome]++;
        free(found.image.data);
    }
    fclose(manifest);
    printf("BMP good files | %d of %d within 1\n", counts[0][RIGHT],
           counts[0][RIGHT] + counts[0][REFUSED] + counts[0][OTHER]);
    printf("BMP questionable files | %d right, %d refused, %d wrong\n", counts[1][RIGHT], counts[1][REFUSED],
           counts[1][OTHER]);
    printf("BMP bad files | %d read as far as they go, %d refused\n", counts[2][OTHER], counts[2][REFUSED]);
    return counts[0][RIGHT] == 27 && counts[1][OTHER] == 0 ? 0 : 1;
}
