#include "iris/xt/votes.h"

#include "../../foundation/views.h"

static uint32_t most_votes(const iris_image *votes)
{
    uint32_t most = 0;
    for (int32_t y = 0; y < votes->h; y++) {
        const uint16_t *row = (const uint16_t *)iris_image_row(votes, y);
        for (int32_t x = 0; x < votes->w; x++) {
            most = row[x] > most ? row[x] : most;
        }
    }
    return most;
}

iris_status iris_votes_show(const iris_image *gray, const iris_image *votes)
{
    iris_status status = iris_views_check_formats(gray, IRIS_GRAY8, votes, IRIS_GRAY_U16);
    if (status != IRIS_OK) {
        return status;
    }
    uint32_t most = most_votes(votes);
    most = most > 0 ? most : 1;
    for (int32_t y = 0; y < votes->h; y++) {
        const uint16_t *from = (const uint16_t *)iris_image_row(votes, y);
        uint8_t *to = (uint8_t *)iris_image_row(gray, y);
        for (int32_t x = 0; x < votes->w; x++) {
            to[x] = (uint8_t)((from[x] * 255u + most / 2) / most);
        }
    }
    return IRIS_OK;
}
