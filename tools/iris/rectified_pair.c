#include "rectified_pair.h"

#include <stdlib.h>
#include <string.h>

#include "camera_file.h"
#include "complain.h"
#include "system.h"

#define FINE_BELOW (256 * IRIS_Q32_ONE) /* focal length: small pictures bend within few pixels */

int rectified_keep_read(iris_rectify_keep *keep, const char *text)
{
    *keep = strcmp(text, "all") == 0 ? IRIS_RECTIFY_ALL : IRIS_RECTIFY_VALID;
    if (*keep == IRIS_RECTIFY_VALID && strcmp(text, "valid") != 0) {
        complain("--keep", RECTIFIED_KEEPS ", not '%s'", text);
        return 0;
    }
    return 1;
}

static void complain_flaw(const char *calib, iris_rectify_flaw flaw)
{
    static const char *const said[] = {
        [IRIS_RECTIFY_FINE] = "",
        [IRIS_RECTIFY_ONE_PLACE] = "the cameras are at one place: there is no depth to be seen",
        [IRIS_RECTIFY_SWAPPED] = "the left camera is on the right: give the right picture first, and "
                                 "make the pair file so, too",
        [IRIS_RECTIFY_ALONG] =
            "a camera looks along the line to the other one, by 30 degrees or less beside it: "
            "that cannot be rectified",
        [IRIS_RECTIFY_APART] = "the cameras look apart, and see nothing in common"};
    complain(calib, "%s", said[flaw]);
}

/* The view of a picture takes its place. */
static iris_status remap(picture_buffer *picture, iris_remap_view *view, const iris_sensor *camera)
{
    const iris_size source = {picture->image.w, picture->image.h};
    picture_buffer flat = {0};
    iris_remap map;
    view->step_bits = camera->intrinsics.alpha_u < FINE_BELOW ? 0 : 2;
    iris_place *places =
        system_scratch(IRIS_REMAP_PLACES(view->size.w, view->size.h, view->step_bits) * sizeof *places);
    iris_status status =
        places ? picture_reserve(&flat, view->size, picture->image.format) : IRIS_ERR_SCRATCH;
    status = status == IRIS_OK ? iris_remap_init(&map, places, view, camera, source) : status;
    status = status == IRIS_OK ? iris_remap_draw(&flat.image, &picture->image, &map) : status;
    if (status == IRIS_OK) {
        picture_free(picture);
        *picture = flat;
    } else {
        picture_free(&flat);
    }
    free(places);
    return status;
}

int rectified_pair_make(iris_rectified *made, picture_buffer pictures[2], const char *const names[2],
                        const char *calib, iris_rectify_keep keep)
{
    static IRIS_SCRATCH_BUFFER(memory, IRIS_RECTIFY_SCRATCH_BYTES);
    const iris_rectify_config config = {{0, 0}, keep};
    iris_size sizes[2];
    iris_sensor cameras[2];
    iris_scratch scratch;
    iris_pair pair;
    if (!pair_file_read(&pair, calib)) {
        return EXIT_BAD_DATA;
    }
    for (int k = 0; k < 2; k++) {
        sizes[k] = (iris_size){pictures[k].image.w, pictures[k].image.h};
        if (!camera_fits(&pair.cameras[k], names[k], sizes[k])) {
            return EXIT_BAD_DATA;
        }
    }
    iris_pair_sensors(cameras, &pair);
    (void)iris_scratch_init(&scratch, memory.memory, sizeof memory.memory);
    iris_status status = iris_rectify(made, cameras, sizes, &config, &scratch);
    if (status == IRIS_ERR_DATA) {
        complain_flaw(calib, made->flaw);
        return EXIT_BAD_DATA;
    }
    for (int k = 0; k < 2; k++) {
        status = status == IRIS_OK ? remap(&pictures[k], &made->views[k], &cameras[k]) : status;
    }
    if (status != IRIS_OK) {
        complain(calib, "%s", picture_problem(status, sizes[0]));
    }
    return status == IRIS_OK ? EXIT_DONE : EXIT_BAD_DATA;
}
