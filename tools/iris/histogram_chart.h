/* The picture of a histogram: one curve for gray, three for color, with axes and statistics. */
#ifndef IRIS_TOOL_HISTOGRAM_CHART_H
#define IRIS_TOOL_HISTOGRAM_CHART_H

#include "iris/color.h"
#include "iris/image.h"
#include "iris/xt/histogram.h"

#define CHART_CHANNELS_MAX 3

typedef struct {
    const char *name;
    iris_color line;
    uint32_t count[256];
    iris_histogram_statistics is;
    uint8_t otsu;
} chart_channel;

typedef struct {
    int channels;
    int levels; /* 256, or 2 of a mask */
    chart_channel channel[CHART_CHANNELS_MAX];
} chart;

iris_size chart_size(const chart *of);

/* image: IRIS_RGB888 of that size. */
void chart_draw(const iris_image *image, const chart *of);

#endif
