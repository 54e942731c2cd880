#include "iris/borg/script.h"

#include <stdio.h>

#include "iris/borg/chunk_text.h"
#include "test.h"

/* Of the report, verbatim; both its pairs of chunks are in chunk_text.c. */
static const char report[] = "000 START\n"
                             "010 UNITS=1: LineFollow,ObjDetect;\n"
                             "020 UNITS=4: AutoExplore, MapBuild;\n"
                             "030 IF (REF(10):UNITS(1).ObjDetect==TRUE)\n"
                             "040 [\n"
                             "050  REF(20):UNITS(2 OF 4).Go(REF(10):UNITS(1).Target);\n"
                             "060 ]\n"
                             "070 IF (REF(10):UNITS(1).TimeOut==TRUE)\n"
                             "080 [\n"
                             "090  REF(10):UNITS(1).Stop\n"
                             "100  REF(20):UNITS(4 OF 4).Stop\n"
                             "110 ]\n"
                             "120 END\n";

static borg_script script;
static borg_problem problem;

static iris_status read_text(const char *text)
{
    const borg_text of = {text, strlen(text)};
    problem = (borg_problem){0};
    return borg_script_read(&script, &problem, &of);
}

/* The text of a group's chunk. */
static const char *chunk_of(int32_t group)
{
    static char text[BORG_CHUNK_TEXT_BYTES];
    uint8_t bytes[BORG_CHUNK_BYTES_MAX];
    size_t length = 0, text_length = 0;
    assert_int_equal(borg_script_decompose(bytes, sizeof bytes, &length, &script, group), IRIS_OK);
    assert_int_equal(borg_chunk_write_text(text, sizeof text, &text_length, bytes, length), IRIS_OK);
    assert_int_equal(strlen(text), text_length);
    return text;
}

static void example_of_the_report(void **state)
{
    (void)state;
    assert_int_equal(read_text(report), IRIS_OK);
    assert_int_equal(script.group_count, 2);
    assert_string_equal(chunk_of(0),
                        "010 UNITS=1\n"
                        "[\n"
                        "    Signal(START): ResetTime,LineFollow,ObjDetect;\n"
                        "    Signal(OBJ_DETECT_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010);\n"
                        "    Signal(TIME_OUT): Stop;\n"
                        "];\n");
    assert_string_equal(chunk_of(1),
                        "020 UNITS=4\n"
                        "[\n"
                        "    Signal(START): ResetTime,AutoExplore,MapBuild;\n"
                        "    Signal(OBJ_DETECT_TRUE,010): UNITS=2\n"
                        "    [\n"
                        "        Signal(VOTE_WIN): ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1));\n"
                        "        Signal(REACHED): Stop;\n"
                        "    ];\n"
                        "    Signal(TIME_OUT): Stop;\n"
                        "];\n");
}

static void extensions(void **state)
{
    (void)state;
    assert_int_equal(read_text("start timeout=9 // any case\n10 units=3: linefollow(200), OBJDETECT\n"
                               "20 UNITS=2 TIMEOUT=7: Turn(-90),Go(-5,6);\n"
                               "WHILE (REF(10):UNITS(2).ObjDetect AND (REF(20):UNITS(1).Reached OR NOT "
                               "REF(10):UNITS(1).Bumped==FALSE)) [ REF(20):UNITS(2).MapBuild; ]\n"
                               "IF (REF(10):UNITS(1).LineEnd) [ REF(20):UNITS(2 OF 2).AutoExplore(9)\n"
                               " REF(20):UNITS(2 OF 2).ResetTime IF (REF(10):UNITS(1).ObjDetect) [] ELSE [\n"
                               " REF(20):UNITS(1 OF 2).Stop REF(20):UNITS(1 OF 2).ObjDetect ] ]\n"
                               "REF(20):UNITS(2 OF 2).ObjDetect REF(10):UNITS(3 OF 3).Go(1,2) END"),
                     IRIS_OK);
    assert_string_equal(chunk_of(1),
                        "020 UNITS=2 TIMEOUT=7\n"
                        "[\n"
                        "    Signal(START): ResetTime,Turn(-90),Go(-5,6);\n"
                        "    WHILE Signal(REACHED,020): ResetTime,Multicast(REACHED,020);\n"
                        "    WHILE Signal(OBJ_DETECT_TRUE,010(2)) AND (Signal(REACHED,020) OR NOT NOT "
                        "Signal(BUMPED,010)): UNITS(2).ResetTime,UNITS(2).MapBuild;\n"
                        "    Signal(LINE_END,010): ResetTime,AutoExplore(9),ResetTime;\n"
                        "    Signal(LINE_END,010) AND NOT Signal(OBJ_DETECT_TRUE,010): UNITS=1\n"
                        "    [\n"
                        "        Signal(VOTE_WIN): ResetTime,Stop,ObjDetect;\n"
                        "    ];\n"
                        "    Signal(START): ResetTime,ObjDetect;\n"
                        "];\n");
    assert_string_equal(chunk_of(0),
                        "010 UNITS=3 TIMEOUT=9\n"
                        "[\n"
                        "    Signal(START): ResetTime,LineFollow(200),ObjDetect;\n"
                        "    WHILE Signal(OBJ_DETECT_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010);\n"
                        "    WHILE Signal(OBJ_DETECT_FALSE,010): Multicast(OBJ_DETECT_FALSE,010);\n"
                        "    WHILE Signal(LINE_END,010): ResetTime,Multicast(LINE_END,010);\n"
                        "    WHILE Signal(BUMPED,010): ResetTime,Multicast(BUMPED,010);\n"
                        "    Signal(START): ResetTime,Go(1,2);\n"
                        "];\n");
}

#define TWO   "START\n10 UNITS=1: ObjDetect;\n20 UNITS=4: MapBuild;\n"
#define SEEN  "REF(10):UNITS(1).ObjDetect"
#define TIMED "REF(10):UNITS(1).TimeOut"

static void wrong_scripts(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int32_t line, column;
        const char *word; /* of what was expected */
    } wrong[] = {
        {"", 1, 1, "START"},
        {"START\n10 UNITS=1: Stop", 2, 17, "END"},
        {TWO "REF(30):UNITS(1).Stop END", 4, 1, "none has this number"},
        {TWO "REF(20):UNITS(5 OF 4).Stop END", 4, 1, "winners"},
        {TWO "REF(20):UNITS(2 OF 3).Stop END", 4, 1, "behind OF"},
        {TWO "REF(20):UNITS(5).Stop END", 4, 1, "no more units"},
        {TWO "REF(20):UNITS(0 OF 4).Stop END", 4, 15, "1 to 255"},
        {TWO "REF(20):UNITS(1).Go(REF(20):UNITS(1).Target) END", 4, 18,
         "target of a group that does ObjDetect"},
        {TWO "IF (REF(20):UNITS(1).ObjDetect) [ ] END", 4, 5, "ObjDetect"},
        {TWO "IF (" SEEN " AND NOT " SEEN ") [ ] END", 4, 1, "never run"},
        {TWO "IF (" SEEN " AND " SEEN "==FALSE) [ ] END", 4, 1, "never run"},
        {TWO "IF (" SEEN " OR NOT " SEEN ") [ ] END", 4, 1, "never run"},
        {TWO "IF (NOT " TIMED ") [ ] END", 4, 1, "never run"},
        {TWO "IF (" TIMED ") [ ] ELSE [ ] END", 4, 1, "the ELSE can never run"},
        {TWO "IF (" SEEN ") [\nIF (NOT " SEEN ") [ ] ] END", 5, 1, "never run"},
        {TWO "WHILE (" SEEN ") [ ] ELSE [ ] END", 4, 40, "IF"},
        {TWO "IF (" SEEN ") [ END", 4, 35, "']'"},
        {TWO "IF (" SEEN ") [ UNITS=1: Stop ] END", 4, 35, "outside of blocks"},
        {TWO "IF " SEEN " [ ] END", 4, 4, "'('"},
        {TWO "IF (" SEEN " [ ] END", 4, 32, "')'"},
        {TWO "IF ((" SEEN ") [ ] END", 4, 34, "')'"},
        {TWO "IF (" SEEN "=TRUE) [ ] END", 4, 31, "=="},
        {TWO "] END", 4, 1, "no block is open"},
        {TWO "END\n30 REF(10):UNITS(1).Stop", 5, 4, "never run"},
        {TWO "20 UNITS=1: Stop END", 4, 1, "named once"},
        {TWO "15 UNITS=1: Stop END", 4, 1, "above"},
        {TWO "70000 UNITS=1: Stop END", 4, 1, "65535"},
        {TWO "UNITS=1: Stop END", 4, 1, "line number"},
        {"START\n10 UNITS=0: Stop END", 2, 10, "1 to 255"},
        {"START\n10 UNITS=256: Stop END", 2, 10, "1 to 255"},
        {"START\n10 UNITS=1 TIMEOUT=0: Stop END", 2, 20, "seconds"},
        {"START\n10 UNITS=1: Fly END", 2, 13, "action"},
        {"START\n10 UNITS=1: Multicast END", 2, 13, "action"},
        {"START\n10 UNITS=1: Go END", 2, 16, "where to go"},
        {"START\n10 UNITS=1: Go(1) END", 2, 17, "y"},
        {"START\n10 UNITS=1: Go(1,99999999) END", 2, 18, "10000000"},
        {"START\n10 UNITS=1: Turn(999999999999) END", 2, 18, "8 digits"},
        {"START\n10 UNITS=1: Turn(40000) END", 2, 18, "degrees"},
        {"START\n10 UNITS=1: Stop @ END", 2, 18, "one of"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(read_text(wrong[i].text), IRIS_ERR_DATA);
        if (problem.line != wrong[i].line || problem.column != wrong[i].column ||
            !strstr(problem.expected, wrong[i].word)) {
            fail_msg("%s: %d:%d: %s", wrong[i].text, (int)problem.line, (int)problem.column,
                     problem.expected);
        }
    }
}

/* Text of many equal parts. */
static const char *repeated(const char *before, const char *part, int count, const char *behind)
{
    static char text[BORG_TEXT_BYTES_MAX];
    size_t length = (size_t)snprintf(text, sizeof text, "%s", before);
    for (int i = 0; i < count; i++) {
        length += (size_t)snprintf(text + length, sizeof text - length, "%s", part);
    }
    snprintf(text + length, sizeof text - length, "%s", behind);
    return text;
}

static void limits(void **state)
{
    (void)state;
    assert_int_equal(read_text(repeated(TWO, "REF(20):UNITS(4 OF 4).Stop ", BORG_EFFECTS_MAX, "END")),
                     IRIS_OK);
    assert_int_equal(read_text(repeated(TWO, "REF(20):UNITS(4 OF 4).Stop ", BORG_EFFECTS_MAX + 1, "END")),
                     IRIS_ERR_DATA);
    assert_int_equal(read_text(repeated("START 10 UNITS=1: Stop", ",Stop", BORG_ACTIONS_MAX, " END")),
                     IRIS_ERR_DATA);
    assert_int_equal(read_text(repeated(TWO "IF (", "NOT ", 2000, SEEN ") [] END")), IRIS_ERR_DATA);
    assert_int_equal(read_text(repeated(TWO "IF ", "(", 2000, SEEN ") [] END")), IRIS_ERR_DATA);
    assert_int_equal(read_text(repeated(TWO "IF (", "(", BORG_NESTING_MAX, SEEN "))))))))) [] END")),
                     IRIS_OK);
    assert_int_equal(read_text(repeated(TWO, "IF (" SEEN ") [ ", BORG_NESTING_MAX, "]]]]]]]] END")), IRIS_OK);
    assert_int_equal(read_text(repeated(TWO, "IF (" SEEN ") [ ", BORG_NESTING_MAX + 1, "]]]]]]]]] END")),
                     IRIS_ERR_DATA);
    assert_int_equal(read_text(repeated(TWO, "IF (" SEEN ") [ ] ", BORG_GUARDS_MAX + 1, "END")),
                     IRIS_ERR_DATA);
    /* A chunk that is too long, and one that has room for 512 bytes and gets less. */
    uint8_t bytes[BORG_CHUNK_BYTES_MAX];
    size_t length = 0;
    assert_int_equal(read_text(repeated(TWO, "REF(20):UNITS(4 OF 4).Go(1,2) ", 60, "END")), IRIS_ERR_DATA);
    assert_non_null(strstr(problem.expected, "512 bytes"));
    length = 0;
    assert_int_equal(read_text(report), IRIS_OK);
    assert_int_equal(borg_script_decompose(bytes, sizeof bytes, &length, &script, 1), IRIS_OK);
    assert_int_equal(borg_script_decompose(bytes, length, &length, &script, 1), IRIS_OK);
    assert_int_equal(borg_script_decompose(bytes, length - 1, &length, &script, 1), IRIS_ERR_RANGE);
    assert_int_equal(borg_script_decompose(bytes, sizeof bytes, &length, &script, 2), IRIS_ERR_ARG);
    assert_int_equal(borg_script_decompose(bytes, sizeof bytes, &length, &script, -1), IRIS_ERR_ARG);
    assert_int_equal(borg_script_decompose(NULL, sizeof bytes, &length, &script, 0), IRIS_ERR_ARG);
    const borg_text none = {NULL, 0}, missing = {NULL, 1}, long_one = {report, BORG_TEXT_BYTES_MAX + 1};
    assert_int_equal(borg_script_read(&script, &problem, &none), IRIS_ERR_DATA);
    assert_int_equal(borg_script_read(&script, &problem, &missing), IRIS_ERR_ARG);
    assert_int_equal(borg_script_read(&script, &problem, &long_one), IRIS_ERR_ARG);
    assert_int_equal(borg_script_read(&script, NULL, &none), IRIS_ERR_ARG);
}

/* The place is that of the statement with which a group is too much. */
static void chunks_that_are_too_much(void **state)
{
    (void)state;
    char text[6000] = "START\n10 UNITS=1: LineFollow, ObjDetect\n20 UNITS=1: Stop\n";
    const size_t begin = strlen(text);
    static const struct {
        const char *one;
        int32_t most;
        const char *word;
    } all[] = {
        /* 16 bytes of header, 13 of START, and 16 for each line: 509, and 525. */
        {"IF (REF(20):UNITS(1).BatteryLow OR REF(10):UNITS(1).Bumped) [ REF(20):UNITS(1).Stop ]\n", 30,
         "512 bytes"},
        /* One handler each, and START. */
        {"IF (REF(20):UNITS(1).Bumped) [ REF(20):UNITS(1).Stop ]\n", 31, "32 handlers"},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        for (int32_t extra = 0; extra < 3; extra++) {
            text[begin] = '\0';
            for (int32_t j = 0; j < all[i].most + extra; j++) {
                strcat(text, all[i].one);
            }
            strcat(text, "END");
            const iris_status status = read_text(text);
            if (status != (extra ? IRIS_ERR_DATA : IRIS_OK)) {
                fail_msg("%d %d: %d:%d %s", (int)i, (int)extra, (int)problem.line, (int)problem.column,
                         problem.expected);
            }
            if (extra) {
                assert_int_equal(problem.line, 4 + all[i].most);
                assert_non_null(strstr(problem.expected, all[i].word));
            }
        }
    }
}

/* And that of the group where no statement alone is. */
static void chunks_beyond_a_machine(void **state)
{
    (void)state;
    static const struct {
        const char *text, *word;
    } all[] = {
        {"START\n10 UNITS=17: Stop\nIF (REF(10):UNITS(1).Bumped) [ REF(10):UNITS(16 OF 17).Stop ] END",
         "16 units"},
        {"START\n10 UNITS=2: Stop\nIF (REF(10):UNITS(1).Bumped) [ REF(10):UNITS(1 OF 2).Stop ]"
         "IF (REF(10):UNITS(1).Bumped) [ REF(10):UNITS(1 OF 2).Stop ] IF (REF(10):UNITS(1).Bumped) [ "
         "REF(10):UNITS(1 OF 2).Stop ] IF (REF(10):UNITS(1).Bumped) [ REF(10):UNITS(1 OF 2).Stop ]"
         "IF (REF(10):UNITS(1).Bumped) [ REF(10):UNITS(1 OF 2).Stop ] END",
         "4 choices"},
        {"START\n10 UNITS=99: Stop\nIF (REF(10):UNITS(24).Bumped) [ REF(10):UNITS(99 OF 99).Stop ] END",
         "24 different"},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        assert_int_equal(read_text(all[i].text), IRIS_ERR_DATA);
        assert_int_equal(problem.line, 2);
        assert_int_equal(problem.column, 4);
        assert_non_null(strstr(problem.expected, all[i].word));
    }
}

static void each_machine_counts_its_own_time(void **state)
{
    (void)state;
#define STOPS " UNITS=4: MapBuild;\nIF (" TIMED ") [\nIF (" SEEN ") [ REF(20):UNITS(1).Stop ] ] END"
    assert_int_equal(read_text("START TIMEOUT=9\n10 UNITS=1 TIMEOUT=9: ObjDetect;\n20" STOPS), IRIS_OK);
    assert_int_equal(read_text("START\n10 UNITS=1 TIMEOUT=9: ObjDetect;\n20" STOPS), IRIS_ERR_DATA);
    assert_int_equal(problem.line, 4);
    assert_int_equal(problem.column, 5);
    assert_non_null(strstr(problem.expected, "its own time"));
    assert_int_equal(
        read_text("START\n10 UNITS=1 TIMEOUT=9: ObjDetect;\nIF (" TIMED ") [ REF(10):UNITS(1).Stop ] END"),
        IRIS_OK);
}

static void formatted(void **state)
{
    (void)state;
    static const char text[] =
        "// mine\n start 10   units = 1 :LINEFOLLOW,objdetect ;//there\n20 // numbered\n"
        "if(ref(010):units(1).timeout  ==true and not(ref(10):units(1).objdetect))\n"
        "30 [ ref(10) : units(1 of 1) . go( -5,6 ) // go\n ] else [ ref(10):units(1).stop; ]end";
    char out[2048], again[2048];
    size_t length = 0, again_length = 0;
    /* The group's number stands in the middle of a line: it is none. */
    const borg_text wrong = {text, sizeof text - 1};
    assert_int_equal(borg_script_format(out, sizeof out, &length, &script, &problem, &wrong), IRIS_ERR_DATA);
    char right[sizeof text];
    memcpy(right, text, sizeof text);
    right[strchr(text, '1') - text - 1] = '\n';
    const borg_text source = {right, sizeof text - 1};
    assert_int_equal(borg_script_format(out, sizeof out, &length, &script, &problem, &source), IRIS_OK);
    assert_string_equal(out, "// mine\n"
                             "    START\n"
                             "010 UNITS=1: LineFollow, ObjDetect;  //there\n"
                             "020 // numbered\n"
                             "    IF (REF(10):UNITS(1).TimeOut==TRUE AND NOT (REF(10):UNITS(1).ObjDetect))\n"
                             "030 [\n"
                             "        REF(10):UNITS(1 OF 1).Go(-5, 6)  // go\n"
                             "    ]\n"
                             "    ELSE\n"
                             "    [\n"
                             "        REF(10):UNITS(1).Stop;\n"
                             "    ]\n"
                             "    END\n");
    assert_int_equal(length, strlen(out));
    const borg_text once = {out, length};
    assert_int_equal(borg_script_format(again, length + 1, &again_length, &script, &problem, &once), IRIS_OK);
    assert_string_equal(again, out);
    assert_int_equal(borg_script_format(again, length, &again_length, &script, &problem, &once),
                     IRIS_ERR_RANGE);
    assert_int_equal(borg_script_format(NULL, 9, &again_length, &script, &problem, &once), IRIS_ERR_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(example_of_the_report),
        cmocka_unit_test(extensions),
        cmocka_unit_test(wrong_scripts),
        cmocka_unit_test(each_machine_counts_its_own_time),
        cmocka_unit_test(limits),
        cmocka_unit_test(chunks_that_are_too_much),
        cmocka_unit_test(chunks_beyond_a_machine),
        cmocka_unit_test(formatted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
