/* The text beside a map's picture: as map servers write it, and any other. */
#include "iris/3d/map_text.h"

#include <stdio.h>

#include "random_number.h"
#include "test.h"

static const char written[] =
    "image: floor.pgm\nresolution: 0.050\norigin: [-1.250, 3.000, 0.000]\nnegate: 0\n"
    "occupied_thresh: 0.650\nfree_thresh: 0.196\n";

static iris_map_text floor_map(void)
{
    iris_map_text map = {"floor.pgm", 50, -1250, 3000, {0, 0, 0}};
    iris_grid_shades_defaults(&map.shades);
    return map;
}

static iris_status read_text(iris_map_text *map, int32_t *line, const char *text)
{
    return iris_map_read_text(map, line, text, strlen(text));
}

static void assert_same(const iris_map_text *a, const iris_map_text *b)
{
    assert_string_equal(a->image, b->image);
    assert_true(a->cell_mm == b->cell_mm && a->left_mm == b->left_mm && a->bottom_mm == b->bottom_mm);
    assert_true(a->shades.negate == b->shades.negate && a->shades.free_q16 == b->shades.free_q16 &&
                a->shades.occupied_q16 == b->shades.occupied_q16);
}

static void written_and_read(void **state)
{
    (void)state;
    char text[IRIS_MAP_TEXT_BYTES];
    size_t length = 0;
    int32_t line = 0;
    iris_map_text map = floor_map(), back;
    assert_int_equal(iris_map_write_text(text, sizeof written, &length, &map), IRIS_OK);
    assert_string_equal(text, written);
    assert_int_equal(length, sizeof written - 1);
    assert_int_equal(iris_map_write_text(text, sizeof written - 1, &length, &map), IRIS_ERR_RANGE);
    for (int i = 0; i < 3000; i++) {
        snprintf(map.image, sizeof map.image, "%.*s", 1 + i % 199,
                 "a long name/of a file with blanks, that goes on and on and on, so that there is no room "
                 "for anything "
                 "else but this name in that line of the text, which is as long as a name of a picture may "
                 "ever be ok");
        map.image[0] = 'x';
        for (size_t k = strlen(map.image) - 1; map.image[k] == ' '; k--) {
            map.image[k] = '_';
        }
        map.cell_mm = 1 + (int32_t)(random_u64() % IRIS_GRID_CELL_MAX_MM);
        map.left_mm = (int32_t)(random_u64() % (2 * IRIS_MAP_PLACE_MAX_MM - 1)) - IRIS_MAP_PLACE_MAX_MM + 1;
        map.bottom_mm = i % 2 ? IRIS_MAP_PLACE_MAX_MM - 1 : 1 - IRIS_MAP_PLACE_MAX_MM;
        map.shades.occupied_q16 = (iris_q16)(random_u64() % 65537);
        map.shades.free_q16 = (iris_q16)(random_u64() % ((uint64_t)map.shades.occupied_q16 + 1));
        map.shades.negate = i % 3 == 0;
        assert_int_equal(iris_map_write_text(text, sizeof text, &length, &map), IRIS_OK);
        assert_int_equal(strlen(text), length);
        assert_int_equal(iris_map_read_text(&back, &line, text, length + (size_t)(i % 2)), IRIS_OK);
        assert_same(&back, &map);
    }
}

static void as_others_write_it(void **state)
{
    (void)state;
    iris_map_text map;
    int32_t line = 0;
    assert_int_equal(
        read_text(&map, &line,
                  "# a map\r\nmode: trinary\r\nfree_thresh: 0.25\r\norigin: [ -51.224998 ,-7,0.0 ]\r\n"
                  "image: \"my map.pgm\"\r\nresolution: 0.05000000074505806  # meters\r\n"
                  "something: [else]\r\n---\r\n"),
        IRIS_OK);
    const iris_map_text wanted = {"my map.pgm", 50, -51225, -7000, {42598, 16384, 0}};
    assert_same(&map, &wanted);
    assert_int_equal(read_text(&map, &line, "image: 'm'\nresolution: 1\norigin: [.5, -.0006, -0]\nnegate: 1"),
                     IRIS_OK);
    assert_true(map.cell_mm == 1000 && map.left_mm == 500 && map.bottom_mm == -1 && map.shades.negate == 1);
}

static void wrong_texts(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        iris_status status;
        int line;
    } wrong[] = {
        {"", IRIS_ERR_TRUNCATED, 1},
        {"image: m\nresolution: 0.05\n", IRIS_ERR_TRUNCATED, 2},
        {"image:\nresolution: 0.05\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 1},
        {"image: m\nresolution: 0.0125\norigin: [0, 0, 0]\n", IRIS_ERR_UNSUPPORTED, 2},
        {"image: m\nresolution: 0.05\norigin: [0, 0, 0.1]\n", IRIS_ERR_UNSUPPORTED, 3},
        {"image: m\nresolution: 0.05\norigin: [0, 0, 0]\nmode: raw\n", IRIS_ERR_UNSUPPORTED, 4},
        {"image: m\nresolution: nan\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 2},
        {"image: m\nresolution: 1e-2\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 2},
        {"image: m\nresolution: 0\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 3},
        {"image: m\nresolution: -0.05\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 3},
        {"image: m\nresolution: 99999999999999999999999999\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 2},
        {"image: m\nresolution: 999999999999999\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 2},
        {"image: m\nresolution: 0.05\norigin: [0, 0]\n", IRIS_ERR_DATA, 3},
        {"image: m\nresolution: 0.05\norigin: [0, 0, 0] 1\n", IRIS_ERR_DATA, 3},
        {"image: m\nresolution: 0.05\norigin: [300000, 0, 0]\n", IRIS_ERR_DATA, 3},
        {"image: m\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 2\n", IRIS_ERR_DATA, 4},
        {"image: m\nresolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 1.1\n", IRIS_ERR_DATA, 4},
        {"image: m\nresolution: 0.05\norigin: [0, 0, 0]\nfree_thresh: 0.7\n", IRIS_ERR_DATA, 4},
        {"image: m\nimage: n\nresolution: 0.05\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 2},
        {"image: a\tb\nresolution: 0.05\norigin: [0, 0, 0]\n", IRIS_ERR_DATA, 1},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        iris_map_text map = floor_map();
        const iris_map_text before = map;
        int32_t line = -1;
        assert_int_equal(read_text(&map, &line, wrong[i].text), wrong[i].status);
        assert_int_equal(line, wrong[i].line);
        assert_same(&map, &before);
    }
    iris_map_text map = floor_map();
    char text[IRIS_MAP_TEXT_BYTES];
    size_t length;
    int32_t line;
    static const char *const names[] = {"", " m", "m ", "a\nb", "a#b", "a\"b", "a'b"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        snprintf(map.image, sizeof map.image, "%s", names[i]);
        assert_int_equal(iris_map_write_text(text, sizeof text, &length, &map), IRIS_ERR_RANGE);
    }
    memset(map.image, 'a', sizeof map.image); /* no end */
    assert_int_equal(iris_map_write_text(text, sizeof text, &length, &map), IRIS_ERR_RANGE);
    map = floor_map();
    map.cell_mm = 0;
    assert_int_equal(iris_map_write_text(text, sizeof text, &length, &map), IRIS_ERR_RANGE);
    assert_int_equal(iris_map_write_text(NULL, 0, &length, &map), IRIS_ERR_ARG);
    assert_int_equal(iris_map_read_text(&map, NULL, text, 0), IRIS_ERR_ARG);
    assert_int_equal(iris_map_read_text(&map, &line, NULL, 1), IRIS_ERR_ARG);
}

/* Damaged texts: read or refused, every one of them. */
static void any_texts(void **state)
{
    (void)state;
    int taken = 0;
    for (int i = 0; i < 20000; i++) {
        char text[sizeof written];
        iris_map_text map;
        int32_t line = 0;
        memcpy(text, written, sizeof written);
        for (int k = i % 4; k >= 0; k--) {
            text[random_u64() % sizeof text] =
                i % 2 ? (char)random_u64() : "0123456789.-[],:# "[random_u64() % 18];
        }
        taken += iris_map_read_text(&map, &line, text, random_u64() % (sizeof text + 1)) == IRIS_OK;
    }
    assert_true(taken > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(written_and_read),
        cmocka_unit_test(as_others_write_it),
        cmocka_unit_test(wrong_texts),
        cmocka_unit_test(any_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
