#include "iris/borg/chunk_text.h"

#include "test.h"

/* The first pair of the report, and the second one with its comments. */
static const char report[] =
    "Chunk 1\n\n010 UNITS=1\n\nSignal(START): ResetTime,LineFollow,ObjDetect\n\n"
    "Signal(OBJ_DET_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010)\n\n"
    "// Note that this code is not wrong, the signal buffer can be filled by external multicast data.\n\n"
    "Signal(TIME_OUT_TRUE): Stop\n\nENDS 010\n\nChunk 2\n\n020 UNITS=4\n\n"
    "Signal(START): ResetTime,AutoExplore,MapBuild\n\n"
    "Signal(OBJ_DETECT_TRUE,010): ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1))\n\n"
    "// The (1) is there if more than one machine were assigned to detection and detected positive.\n\n"
    "Signal(TIME_OUT): Stop\n\nENDS 020\n\n"
    "Chunk 1\n\n010 UNITS=1\n\n[  \n    Signal(START): ResetTime,LineFollow,ObjDetect;  \n"
    "    Signal(OBJ_DET_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010);  \n"
    "    // Note that this code is not wrong, the signal buffer can be filled by external  \n"
    "    Signal(TIME_OUT_TRUE): Stop;  \n];\n\nChunk 2\n\n020 UNITS=4\n\n[  \n"
    "    Signal(START): ResetTime,AutoExplore,MapBuild;  \n    Signal(OBJ_DETECT_TRUE,010): UNITS=2  \n    [ "
    " \n"
    "        Signal(VOTE_WIN): ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1))  \n        Signal(REACHED): Stop; "
    " \n"
    "    ];  \n  \n    // The (1) is there if more than one machine were assigned to detection and detected  "
    "\n"
    "    // positive.  \n    Signal(TIME_OUT): Stop;\n\n ];\n";

static uint8_t bytes[BORG_CHUNK_BYTES_MAX];
static size_t length;
static borg_problem problem;

static iris_status read_next(const char *text, size_t *position)
{
    const borg_text of = {text, strlen(text)};
    return borg_chunk_read_text(bytes, sizeof bytes, &length, position, &problem, &of);
}

static const char *text_of(void)
{
    static char text[BORG_CHUNK_TEXT_BYTES];
    size_t text_length = 0;
    assert_int_equal(borg_chunk_write_text(text, sizeof text, &text_length, bytes, length), IRIS_OK);
    return text;
}

static void chunks_of_the_report(void **state)
{
    (void)state;
    static const char one[] = "010 UNITS=1\n[\n    Signal(START): ResetTime,LineFollow,ObjDetect;\n"
                              "    Signal(OBJ_DETECT_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010);\n"
                              "    Signal(TIME_OUT): Stop;\n];\n";
    size_t position = 0;
    assert_int_equal(read_next(report, &position), IRIS_OK);
    assert_string_equal(text_of(), one);
    assert_int_equal(read_next(report, &position), IRIS_OK);
    assert_string_equal(text_of(),
                        "020 UNITS=4\n[\n    Signal(START): ResetTime,AutoExplore,MapBuild;\n"
                        "    Signal(OBJ_DETECT_TRUE,010): "
                        "ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1));\n    Signal(TIME_OUT): Stop;\n];\n");
    assert_int_equal(read_next(report, &position), IRIS_OK);
    assert_string_equal(text_of(), one);
    assert_int_equal(read_next(report, &position), IRIS_OK);
    assert_string_equal(text_of(),
                        "020 UNITS=4\n[\n    Signal(START): ResetTime,AutoExplore,MapBuild;\n"
                        "    Signal(OBJ_DETECT_TRUE,010): UNITS=2\n    [\n"
                        "        Signal(VOTE_WIN): ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1));\n"
                        "        Signal(REACHED): Stop;\n    ];\n    Signal(TIME_OUT): Stop;\n];\n");
    assert_int_equal(read_next(report, &position), IRIS_ERR_END);
}

/* What is written as it stands here. */
static void every_form(void **state)
{
    (void)state;
    static const char text[] =
        "007 UNITS=255 TIMEOUT=65535\n[\n"
        "    WHILE (Signal(BUMPED) OR NOT Signal(LINE_END,000(2))) AND (Signal(STOPPED,002(3)) AND "
        "Signal(VOTE_LOST)) OR NOT (Signal(REACHED) OR Signal(START)): LineFollow(65535),AutoExplore(1);\n"
        "    Signal(BUMPED) OR Signal(STOPPED) AND Signal(REACHED): Stop;\n"
        "    NOT NOT Signal(BATTERY_LOW): "
        "UNITS(255).Turn(-32768),Turn(32767),Go(-10000000,10000000),Turn(0),UNITS(1).Go(OBJ_DETECT_FALSE."
        "Target,65535(255));\n"
        "    Signal(START) OR (Signal(START) OR Signal(START)): UNITS=255\n    [\n"
        "        WHILE Signal(VOTE_WIN): Stop;\n    ];\n];\n";
    size_t position = 0;
    assert_int_equal(read_next(text, &position), IRIS_OK);
    assert_string_equal(text_of(), text);
    assert_int_equal(position, sizeof text - 1);
}

static void wrong_texts(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int32_t line, column;
        const char *word;
    } wrong[] = {
        {"x", 1, 1, "line of a group"},
        {"0 UNITS=1 []", 1, 1, "1 to 65535"},
        {"1 UNITS=0 []", 1, 9, "1 to 255"},
        {"1 UNITS=2\n[ Signal(START): UNITS=3 [ ] ]", 2, 24, "winner"},
        {"1 UNITS=2\n[ Signal(STAR): Stop ]", 2, 10, "signal"},
        {"1 UNITS=2\n[ Signal(START) Stop ]", 2, 17, "':'"},
        {"1 UNITS=2\n[ Signal(START): ]", 2, 18, "action"},
        {"1 UNITS=2\n[ Signal(START): Stop", 2, 22, "Signal"},
        {"1 UNITS=2\nSignal(START): Stop ENDS 2", 2, 26, "began with"},
        {"1 UNITS=2\n[ Signal(START): Multicast(START,0) ]", 2, 34, "line of a group"},
        {"1 UNITS=2\n[ Signal(START): Go(START.Target,1) ]", 2, 35, "'('"},
        {"1 UNITS=2\n[ Signal(START): UNITS=1 [ Signal(START): UNITS=1 [] ] ]", 2, 48, "'('"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        size_t position = 0;
        assert_int_equal(read_next(wrong[i].text, &position), IRIS_ERR_DATA);
        if (problem.line != wrong[i].line || problem.column != wrong[i].column ||
            !strstr(problem.expected, wrong[i].word)) {
            fail_msg("%s: %d:%d: %s", wrong[i].text, (int)problem.line, (int)problem.column,
                     problem.expected);
        }
    }
}

/* A value more than a machine keeps at once. */
static void deep_conditions(void **state)
{
    (void)state;
    for (int values = BORG_STACK_MAX; values <= BORG_STACK_MAX + 1; values++) {
        char text[1024] = "1 UNITS=1 [ ";
        for (int i = 1; i < values; i++) {
            strcat(text, "Signal(BUMPED) OR (");
        }
        strcat(text, "Signal(BUMPED)");
        for (int i = 1; i < values; i++) {
            strcat(text, ")");
        }
        strcat(text, ": Stop ]");
        size_t position = 0;
        assert_int_equal(read_next(text, &position), values == BORG_STACK_MAX ? IRIS_OK : IRIS_ERR_RANGE);
    }
}

static void sizes(void **state)
{
    (void)state;
    size_t position = 0, text_length = 0;
    char text[BORG_CHUNK_TEXT_BYTES];
    assert_int_equal(read_next(report, &position), IRIS_OK);
    const size_t room = strlen(text_of()) + 1;
    assert_int_equal(borg_chunk_write_text(text, room, &text_length, bytes, length), IRIS_OK);
    assert_int_equal(borg_chunk_write_text(text, room - 1, &text_length, bytes, length), IRIS_ERR_RANGE);
    assert_int_equal(borg_chunk_write_text(text, 0, &text_length, bytes, length), IRIS_ERR_RANGE);
    assert_int_equal(borg_chunk_write_text(NULL, room, &text_length, bytes, length), IRIS_ERR_ARG);
    const borg_text of = {report, sizeof report - 1};
    uint8_t small[BORG_CHUNK_BYTES_MAX];
    size_t small_length = 0;
    position = 0;
    assert_int_equal(borg_chunk_read_text(small, length, &small_length, &position, &problem, &of), IRIS_OK);
    position = 0;
    assert_int_equal(borg_chunk_read_text(small, length - 1, &small_length, &position, &problem, &of),
                     IRIS_ERR_RANGE);
    position = sizeof report;
    assert_int_equal(borg_chunk_read_text(small, length, &small_length, &position, &problem, &of),
                     IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chunks_of_the_report), cmocka_unit_test(every_form), cmocka_unit_test(wrong_texts),
        cmocka_unit_test(deep_conditions),      cmocka_unit_test(sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
