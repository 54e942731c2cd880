/* Accumulators as pictures. */
#include "iris/xt/votes.h"
#include "../picture.h"

static uint16_t bins[64 * 8];
static uint8_t levels[70 * 8];

static iris_image votes_of(int32_t w, int32_t h)
{
    iris_image view;
    assert_int_equal(iris_image_wrap(&view, bins, sizeof bins, (iris_size){w, h}, 128, IRIS_GRAY_U16),
                     IRIS_OK);
    return view;
}

static iris_image gray_of(int32_t w, int32_t h)
{
    iris_image view;
    assert_int_equal(iris_image_wrap(&view, levels, sizeof levels, (iris_size){w, h}, -70, IRIS_GRAY8),
                     IRIS_OK);
    return view;
}

static void by_hand(void **state)
{
    (void)state;
    static const uint16_t in[][5] = {
        {0, 1, 2, 3, 4}, {0, 65535, 32768, 128, 129}, {0, 0, 0, 0, 0}, {255, 254, 100, 1, 0}};
    static const uint8_t out[][5] = {
        {0, 64, 128, 191, 255}, {0, 255, 128, 0, 1}, {0, 0, 0, 0, 0}, {255, 254, 100, 1, 0}};
    for (int i = 0; i < 4; i++) {
        iris_image votes = votes_of(5, 1), gray = gray_of(5, 1);
        memcpy(bins, in[i], sizeof in[i]);
        assert_int_equal(iris_votes_show(&gray, &votes), IRIS_OK);
        assert_memory_equal(gray.data, out[i], 5);
    }
}

/* The most may be anywhere; nothing else is written. */
static void views(void **state)
{
    (void)state;
    for (int32_t at = 0; at < 21; at++) {
        memset(bins, 0xFF, sizeof bins);
        memset(levels, 7, sizeof levels);
        iris_image votes = votes_of(7, 3), gray = gray_of(7, 3);
        for (int32_t i = 0; i < 21; i++) {
            ((uint16_t *)iris_image_row(&votes, i / 7))[i % 7] = (uint16_t)(i == at ? 50 : 10);
        }
        assert_int_equal(iris_votes_show(&gray, &votes), IRIS_OK);
        int sum = 0;
        for (int32_t i = 0; i < 21; i++) {
            assert_int_equal(((const uint8_t *)iris_image_row(&gray, i / 7))[i % 7], i == at ? 255 : 51);
        }
        for (size_t i = 0; i < sizeof levels; i++) {
            sum += levels[i];
        }
        assert_int_equal(sum, 255 + 20 * 51 + ((int)sizeof levels - 21) * 7);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    iris_image votes = votes_of(5, 2), gray = gray_of(5, 2), small = gray_of(4, 2), over, broken = votes;
    broken.h = 0;
    assert_int_equal(iris_image_wrap(&over, bins, 10, (iris_size){5, 2}, 0, IRIS_GRAY8), IRIS_OK);
    memset(levels, 9, sizeof levels);
    assert_int_equal(iris_votes_show(NULL, &votes), IRIS_ERR_ARG);
    assert_int_equal(iris_votes_show(&gray, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_votes_show(&gray, &broken), IRIS_ERR_RANGE);
    assert_int_equal(iris_votes_show(&gray, &gray), IRIS_ERR_FORMAT);
    assert_int_equal(iris_votes_show(&votes, &votes), IRIS_ERR_FORMAT);
    assert_int_equal(iris_votes_show(&small, &votes), IRIS_ERR_RANGE);
    assert_int_equal(iris_votes_show(&over, &votes), IRIS_ERR_ALIAS);
    for (size_t i = 0; i < sizeof levels; i++) {
        assert_int_equal(levels[i], 9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(views),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests_name("votes", tests, NULL, NULL);
}
