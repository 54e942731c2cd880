#include "iris/borg/signal.h"

#include "test.h"

static int32_t find(const char *name)
{
    return borg_signal_find(name, strlen(name));
}

static void names_are_found_again(void **state)
{
    (void)state;
    for (int32_t kind = 0; kind < BORG_SIGNAL_KINDS; kind++) {
        assert_int_equal(find(borg_signal_name(kind)), kind);
    }
    assert_null(borg_signal_name(-1));
    assert_null(borg_signal_name(BORG_SIGNAL_KINDS));
    assert_string_equal(borg_signal_name(BORG_OBJ_DETECT_TRUE), "OBJ_DETECT_TRUE");
    assert_string_equal(borg_signal_name(BORG_TIME_OUT), "TIME_OUT");
}

static void other_spellings_are_read(void **state)
{
    (void)state;
    assert_int_equal(find("OBJ_DET_TRUE"), BORG_OBJ_DETECT_TRUE);
    assert_int_equal(find("obj_det_false"), BORG_OBJ_DETECT_FALSE);
    assert_int_equal(find("TIME_OUT_TRUE"), BORG_TIME_OUT);
    assert_int_equal(find("Vote_Win"), BORG_VOTE_WIN);
    assert_int_equal(find(""), -1);
    assert_int_equal(find("TIME_OUT_"), -1);
    assert_int_equal(find("TIME"), -1);
    assert_int_equal(borg_signal_find("STARTED", 5), BORG_START);
    assert_int_equal(borg_signal_find(NULL, 5), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_found_again),
        cmocka_unit_test(other_spellings_are_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
