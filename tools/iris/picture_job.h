/* What the commands that turn pictures into pictures share: each input is read, worked on, and written. A bad one is
 * complained about, and the others go on.
 */
#ifndef IRIS_TOOL_PICTURE_JOB_H
#define IRIS_TOOL_PICTURE_JOB_H

#include "args.h"
#include "picture.h"

typedef struct picture_job {
    const char *command;
    const char *output; /* of -o: a file, a folder, "-"; null: standard output unless it is a terminal */
    int json;           /* one object per picture on standard output */

    /* Makes *result from *input (IRIS_GRAY8 or IRIS_RGB888): a view of input or of `first` or `second`. Returns an exit
     * code, after complaining about job->file. */
    int (*work)(iris_image *result, const iris_image *input, struct picture_job *job);
    const void *options; /* the command's own */
    const char *file;    /* the input worked on */
    int has_threshold;   /* the JSON says which threshold was used: */
    int threshold;       /* what work chose; negative: none, null */
    picture_buffer input, first, second;
} picture_job;

/* Runs the job over all operands and returns the exit code of the command. */
int picture_job_run(picture_job *job, const arguments *args);

/* picture_reserve that complains about job->file. Returns 1 or 0. */
int picture_job_reserve(picture_job *job, picture_buffer *picture, iris_size size, iris_format format);

/* The input as gray (luma): itself, or converted into job->first. Null after complaining. */
const iris_image *picture_job_gray(picture_job *job, const iris_image *input);

#endif
