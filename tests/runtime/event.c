#include "iris/runtime/event.h"

#include "test.h"

static void events_have_names(void **state)
{
    (void)state;
    assert_string_equal(iris_event_name(IRIS_EVENT_OBJECT_DETECTED), "object detected");
    assert_string_equal(iris_event_name(IRIS_EVENT_LINE_END), "line end");
    assert_string_equal(iris_event_name(IRIS_EVENT_EXPIRED), "expired");
    for (int32_t kind = 0; kind < IRIS_EVENT_KINDS; kind++) {
        assert_non_null(iris_event_name(kind));
        for (int32_t other = 0; other < kind; other++) {
            assert_true(strcmp(iris_event_name(kind), iris_event_name(other)) != 0);
        }
    }
    assert_null(iris_event_name(-1));
    assert_null(iris_event_name(IRIS_EVENT_KINDS));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(events_have_names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
