/* A camera's lines in a text: see camera_text.h for the format. */
#ifndef IRIS_CAMERA_LINES_H
#define IRIS_CAMERA_LINES_H

#include "../../foundation/text_lines.h"
#include "iris/3d/camera_text.h"

#define IRIS_CAMERA_LINES   8 /* from the size to the decentering */
#define IRIS_CAMERA_NUMBERS 12
#define IRIS_CAMERA_LIMIT   (1000000000 * IRIS_Q32_ONE) /* numbers are nearer to 0 */

/* What the lines say. */
typedef struct {
    int64_t w, h;
    int corrects;
    iris_q32 numbers[IRIS_CAMERA_NUMBERS];
    int count;
} iris_camera_content;

/* The content of a model. Returns 0: it is none that can be written. */
int iris_camera_content_of(iris_camera_content *content, const iris_camera_model *model);

/* Writes all lines; returns where they end. */
char *iris_camera_put_lines(char *at, const iris_camera_content *content);

/* Line i of a content that began with zeros; 0 when it is wrong. */
int iris_camera_take_line(iris_camera_content *content, iris_text_lines *r, int i);

/* The model of a content. Returns 0: it is none that can be written. */
int iris_camera_content_model(iris_camera_model *model, const iris_camera_content *content);

uint32_t iris_camera_content_check(uint32_t check, const iris_camera_content *content);

#endif
