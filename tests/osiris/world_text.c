/* World files: what they say, and what is wrong with them. */
#include "iris/osiris/world_text.h"

#include "random_within.h"
#include "test.h"

static osiris_world world;
static osiris_world_memory memory;
static osiris_problem problem;

static iris_status reads(const char *text)
{
    return osiris_world_read_text(&world, &memory, &problem, text, strlen(text));
}

static const char room[] = "# a room\n"
                           "wall 0 0 6000 0 6000 -4000\n"
                           "wall 10 10 20 20 # behind it\n"
                           "line 600 700 600 3000 1000 3400\r\n"
                           "object 5500 1800 radius 60 color orange\n"
                           "object 1 2 color 0aF0c3\n"
                           "object 3 4\n\n"
                           "start 600 700 facing 90\n"
                           "start 5 6";

static void every_word(void **state)
{
    (void)state;
    assert_int_equal(reads(room), IRIS_OK);
    assert_int_equal(osiris_world_check(&world), IRIS_OK);
    assert_int_equal(world.wall_count, 3);
    assert_int_equal(world.walls[1].x0_mm, 6000);
    assert_int_equal(world.walls[1].y1_mm, -4000);
    assert_int_equal(world.walls[2].x0_mm, 10);
    assert_int_equal(world.line_count, 2);
    assert_int_equal(world.lines[1].x0_mm, 600);
    assert_int_equal(world.lines[1].y0_mm, 3000);
    assert_int_equal(world.object_count, 3);
    assert_int_equal(world.objects[0].radius_mm, 60);
    assert_int_equal(world.objects[0].color, 0xFF8000);
    assert_int_equal(world.objects[1].color, 0x0AF0C3);
    assert_int_equal(world.objects[2].radius_mm, 50);
    assert_int_equal(world.objects[2].color, 0xFF0000);
    assert_int_equal(world.start_count, 2);
    assert_int_equal(world.starts[0].heading, 16384);
    assert_int_equal(world.starts[1].y_mm, 6);
    assert_int_equal(reads(""), IRIS_OK);
    assert_int_equal(world.wall_count, 0);
}

static void errors(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int line;
        const char *words;
    } wrong[] = {
        {"floor 1 2\n", 1, "wall, line, object, or start"},
        {"\nwall 1 2\n", 2, "two places"},
        {"wall 1 2 3\n", 1, "two places"},
        {"wall 1 2 3 4 5\n", 1, "two places"},
        {"wall 1 2 3 x\n", 1, "two places"},
        {"line 1 2 3 1048576\n", 1, "two places"},
        {"line 1 2 3 1.5\n", 1, "two places"},
        {"object 1\n", 1, "a place"},
        {"object 1 2 radius 0\n", 1, "radius in mm"},
        {"object 1 2 color pink\n", 1, "color with a name"},
        {"object 1 2 color 12345\n", 1, "color with a name"},
        {"object 1 2 color 1234567\n", 1, "color with a name"},
        {"object 1 2 size 5\n", 1, "color with a name"},
        {"start\n", 1, "a place"},
        {"start 1 2 facing\n", 1, "facing in degrees"},
        {"start 1 2 3\n", 1, "the end of the line"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(reads(wrong[i].text), IRIS_ERR_DATA);
        assert_int_equal(problem.line, wrong[i].line);
        if (!strstr(problem.expected, wrong[i].words)) {
            assert_string_equal(problem.expected, wrong[i].words);
        }
    }
    assert_int_equal(osiris_world_read_text(NULL, &memory, &problem, room, 5), IRIS_ERR_ARG);
    assert_int_equal(osiris_world_read_text(&world, NULL, &problem, room, 5), IRIS_ERR_ARG);
    assert_int_equal(osiris_world_read_text(&world, &memory, NULL, room, 5), IRIS_ERR_ARG);
    assert_int_equal(osiris_world_read_text(&world, &memory, &problem, NULL, 5), IRIS_ERR_ARG);
}

static void too_many(void **state)
{
    (void)state;
    static const struct {
        const char *line;
        int most;
    } kinds[] = {{"wall 1 2 3 4\n", OSIRIS_WALLS_MAX},
                 {"line 1 2 3 4\n", OSIRIS_LINES_MAX},
                 {"object 1 2\n", OSIRIS_OBJECTS_MAX},
                 {"start 1 2\n", OSIRIS_STARTS_MAX}};
    static char text[16 * (OSIRIS_LINES_MAX + 1)];
    for (size_t i = 0; i < 4; i++) {
        size_t length = 0;
        for (int k = 0; k <= kinds[i].most; k++) {
            memcpy(text + length, kinds[i].line, strlen(kinds[i].line));
            length += strlen(kinds[i].line);
        }
        assert_int_equal(osiris_world_read_text(&world, &memory, &problem, text, length), IRIS_ERR_FULL);
        assert_int_equal(problem.line, kinds[i].most + 1);
        assert_int_equal(
            osiris_world_read_text(&world, &memory, &problem, text, length - strlen(kinds[i].line)), IRIS_OK);
    }
}

static void hostile(void **state)
{
    (void)state;
    static const char bytes[] = "\0\n# \t-.9aZ\x7f\xff";
    char text[sizeof room];
    int read = 0;
    for (int i = 0; i < 4000; i++) {
        memcpy(text, room, sizeof room);
        const size_t length = (size_t)random_within(0, (int32_t)sizeof room - 1);
        for (int k = random_within(0, 5); k > 0; k--) {
            text[random_within(0, (int32_t)sizeof room - 1)] =
                bytes[random_within(0, (int32_t)sizeof bytes - 1)];
        }
        const iris_status status = osiris_world_read_text(&world, &memory, &problem, text, length);
        assert_true(status == IRIS_OK ? osiris_world_check(&world) == IRIS_OK
                                      : problem.line >= 1 && problem.expected != NULL);
        read += status == IRIS_OK;
    }
    assert_true(read > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_word),
        cmocka_unit_test(errors),
        cmocka_unit_test(too_many),
        cmocka_unit_test(hostile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
