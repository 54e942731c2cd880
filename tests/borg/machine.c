#include "iris/borg/machine.h"

#include <stdio.h>

#include "iris/borg/chunk_text.h"
#include "iris/borg/script.h"
#include "test.h"

static uint8_t chunk[BORG_CHUNK_BYTES_MAX];
static size_t length;
static borg_machine machine;
static char told[600];

static void load(const char *text, int32_t unit)
{
    borg_problem problem;
    size_t position = 0;
    const borg_text of = {text, strlen(text)};
    assert_int_equal(borg_chunk_read_text(chunk, sizeof chunk, &length, &position, &problem, &of), IRIS_OK);
    assert_int_equal(borg_machine_init(&machine, chunk, length, unit), IRIS_OK);
}

static void comes(uint8_t kind, uint16_t ref, uint8_t unit, int32_t x, int32_t y)
{
    const borg_signal signal = {kind, unit, ref, x, y};
    assert_int_equal(borg_machine_signal(&machine, &signal), IRIS_OK);
}

static void own(uint8_t kind)
{
    comes(kind, 0, 0, 0, 0);
}

static void write_output(char *to, size_t room, const borg_output *o)
{
    static const char *const verbs[] = {"line", "detect", "explore", "map",  "go",
                                        "?",    "turn",   "stop",    "reset"};
    const borg_signal *s = &o->signal;
    switch (o->what) {
    case BORG_DO_ACTION:
        assert_true(o->action.verb < BORG_MULTICAST && o->action.verb != BORG_GO_TARGET);
        if (o->action.verb == BORG_GO) {
            snprintf(to, room, " go(%d,%d)", (int)o->action.a, (int)o->action.b);
        } else if (o->action.a) {
            snprintf(to, room, " %s(%d)", verbs[o->action.verb], (int)o->action.a);
        } else {
            snprintf(to, room, " %s", verbs[o->action.verb]);
        }
        break;
    case BORG_DO_MULTICAST:
        snprintf(to, room, " tell %s,%d(%d)@%d,%d", borg_signal_name(s->kind), s->ref, s->unit, (int)s->x,
                 (int)s->y);
        break;
    default:
        snprintf(to, room, " elect%d=%d", o->election, o->winners);
        if (o->has_target) {
            snprintf(to + strlen(to), room - strlen(to), "@%d,%d", (int)s->x, (int)s->y);
        }
    }
}

/* All that it does at this time, in a line. */
static const char *does(uint32_t now_ms)
{
    told[0] = '\0';
    for (int i = 0; i < 300; i++) {
        borg_output out;
        assert_int_equal(borg_machine_step(&out, &machine, now_ms), IRIS_OK);
        if (out.what == BORG_DO_NOTHING) {
            return told[0] ? told + 1 : told;
        }
        write_output(told + strlen(told), sizeof told - strlen(told), &out);
    }
    fail_msg("no end: %s", told);
    return NULL;
}

static void load_group(const char *script_text, int32_t group, int32_t unit)
{
    static borg_script script;
    borg_problem problem;
    const borg_text of = {script_text, strlen(script_text)};
    assert_int_equal(borg_script_read(&script, &problem, &of), IRIS_OK);
    assert_int_equal(borg_script_decompose(chunk, sizeof chunk, &length, &script, group), IRIS_OK);
    assert_int_equal(borg_machine_init(&machine, chunk, length, unit), IRIS_OK);
}

static const char example[] =
    "000 START\n010 UNITS=1: LineFollow,ObjDetect;\n020 UNITS=4: AutoExplore, MapBuild;\n"
    "030 IF (REF(10):UNITS(1).ObjDetect==TRUE)\n040 [\n"
    "050  REF(20):UNITS(2 OF 4).Go(REF(10):UNITS(1).Target);\n060 ]\n"
    "070 IF (REF(10):UNITS(1).TimeOut==TRUE)\n080 [\n090  REF(10):UNITS(1).Stop\n"
    "100  REF(20):UNITS(4 OF 4).Stop\n110 ]\n120 END\n";

/* The report's first example: the machine that follows the line. */
static void the_finder(void **state)
{
    (void)state;
    load_group(example, 0, 1);
    assert_string_equal(does(5), "");
    own(BORG_OBJ_DETECT_TRUE); /* before START: of no interest */
    own(BORG_START);
    assert_string_equal(does(1000), "reset line detect");
    comes(BORG_OBJ_DETECT_TRUE, 0, 0, 700, -300);
    assert_string_equal(does(41000), "reset tell OBJ_DETECT_TRUE,10(1)@700,-300");
    comes(BORG_OBJ_DETECT_TRUE, 0, 0, 701, -300);
    assert_string_equal(does(100999), "");
    assert_string_equal(does(101000), "stop");
    assert_string_equal(does(200000), "");
}

/* One of the explorers wins, reaches, and stops; one loses; both stop when their time is out. */
static void the_explorers(void **state)
{
    (void)state;
    load_group(example, 1, 3);
    own(BORG_START);
    assert_string_equal(does(0), "reset explore map");
    comes(BORG_OBJ_DETECT_TRUE, 10, 1, 700, -300);
    assert_string_equal(does(20000), "elect1=2@700,-300");
    own(BORG_REACHED); /* not of the winner's way */
    assert_string_equal(does(20000), "");
    assert_int_equal(borg_machine_vote(&machine, 1, 1), IRIS_OK);
    assert_string_equal(does(21000), "reset go(700,-300)");
    own(BORG_REACHED);
    assert_string_equal(does(33000), "stop");
    assert_string_equal(does(80999), "");
    assert_string_equal(does(81000), "stop");
    own(BORG_START);
    assert_string_equal(does(90000), "reset explore map");
    assert_int_equal(borg_machine_vote(&machine, 1, 1), IRIS_ERR_RANGE);
    comes(BORG_OBJ_DETECT_TRUE, 10, 1, 1, 2);
    assert_string_equal(does(90001), "elect1=2@1,2");
    assert_int_equal(borg_machine_vote(&machine, 1, 0), IRIS_OK);
    assert_string_equal(does(90002), "");
    assert_string_equal(does(150000), "stop");
}

/* A loser whose winner died goes; a winner that is to lose stops, and what it did as a winner is over. */
static void votes_change(void **state)
{
    (void)state;
    load_group(example, 1, 1);
    own(BORG_START);
    (void)does(0);
    comes(BORG_OBJ_DETECT_TRUE, 10, 1, 5, 6);
    assert_string_equal(does(1), "elect1=2@5,6");
    assert_int_equal(borg_machine_vote(&machine, 1, 0), IRIS_OK);
    assert_string_equal(does(2), "");
    assert_int_equal(borg_machine_vote(&machine, 1, 1), IRIS_OK);
    assert_string_equal(does(3), "reset go(5,6)");
    assert_int_equal(borg_machine_vote(&machine, 1, 0), IRIS_OK);
    assert_string_equal(does(4), "stop");
    own(BORG_REACHED);
    assert_string_equal(does(5), "");
    assert_int_equal(borg_machine_vote(&machine, 1, 1), IRIS_OK);
    assert_int_equal(borg_machine_vote(&machine, 1, 0), IRIS_OK); /* the last word counts */
    assert_string_equal(does(6), "");
}

/* The report's first pair of chunks, without an election; a detection after a time-out ends in time, too. */
static void the_reports_chunks(void **state)
{
    (void)state;
    load("Chunk 2\n020 UNITS=4\nSignal(START): ResetTime,AutoExplore,MapBuild\n"
         "Signal(OBJ_DETECT_TRUE,010): ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1))\n"
         "Signal(TIME_OUT): Stop\nENDS 020\n",
         4);
    own(BORG_START);
    assert_string_equal(does(UINT32_MAX - 10000), "reset explore map"); /* the clock wraps */
    assert_string_equal(does(49998), "");
    assert_string_equal(does(49999), "stop");
    comes(BORG_OBJ_DETECT_TRUE, 10, 1, 40, 50);
    assert_string_equal(does(70000), "reset go(40,50)");
    comes(BORG_OBJ_DETECT_TRUE, 10, 2, 4, 5); /* the first one is what counts */
    assert_string_equal(does(70001), "");
    assert_string_equal(does(130000), "stop");
}

/* At most one thing in a step, and time passes between them. */
static void one_thing_at_a_time(void **state)
{
    (void)state;
    borg_output out;
    load("010 UNITS=2 TIMEOUT=1 [ Signal(START): "
         "ResetTime,UNITS(1).LineFollow(5),UNITS(2).Turn(-90),ResetTime;"
         "Signal(TIME_OUT): Turn(7); ]",
         2);
    own(BORG_START);
    static const uint8_t verbs[] = {BORG_RESET_TIME, BORG_TURN, BORG_RESET_TIME};
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(borg_machine_step(&out, &machine, i * 2000), IRIS_OK);
        assert_int_equal(out.what, BORG_DO_ACTION);
        assert_int_equal(out.action.verb, verbs[i]);
    }
    assert_string_equal(does(4999), "");
    assert_string_equal(does(5000), "turn(7)");
    assert_string_equal(does(9000), "");
}

/* IF once, WHILE each time, ELSE when it stops being so. */
static void while_and_else(void **state)
{
    (void)state;
    load("010 UNITS=1 [ WHILE Signal(OBJ_DETECT_TRUE,020) AND NOT Signal(BATTERY_LOW,020): Turn(1);"
         "WHILE NOT Signal(OBJ_DETECT_TRUE,020): Turn(2); NOT Signal(OBJ_DETECT_TRUE,020): Turn(3);"
         "Signal(OBJ_DETECT_TRUE,020): Turn(4); WHILE Signal(REACHED): Turn(5); WHILE Signal(BUMPED,20(2)): "
         "Turn(6); ]",
         1);
    own(BORG_START);
    assert_string_equal(does(0), ""); /* NOT holds, but has not become so */
    comes(BORG_OBJ_DETECT_TRUE, 20, 1, 0, 0);
    assert_string_equal(does(0), "turn(1) turn(4)");
    comes(BORG_OBJ_DETECT_TRUE, 20, 1, 0, 0);
    comes(BORG_OBJ_DETECT_TRUE, 20, 2, 0, 0);
    assert_string_equal(does(0), "");
    comes(BORG_OBJ_DETECT_FALSE, 20, 1, 0, 0);
    assert_string_equal(does(0), ""); /* the second one still sees it */
    comes(BORG_OBJ_DETECT_FALSE, 20, 2, 0, 0);
    assert_string_equal(does(0), "turn(2) turn(3)");
    comes(BORG_OBJ_DETECT_TRUE, 20, 2, 0, 0);
    comes(BORG_OBJ_DETECT_FALSE, 20, 2, 0, 0);
    assert_string_equal(does(0), "turn(1) turn(2)");
    comes(BORG_BATTERY_LOW, 20, 1, 0, 0);
    comes(BORG_OBJ_DETECT_TRUE, 20, 1, 0, 0);
    assert_string_equal(does(0), "");
    own(BORG_REACHED);
    own(BORG_REACHED);
    comes(BORG_REACHED, 20, 1, 0, 0);
    assert_string_equal(does(0), "turn(5) turn(5)");
    comes(BORG_BUMPED, 20, 7, 0, 0);
    comes(BORG_BUMPED, 20, 7, 0, 0);
    assert_string_equal(does(0), "");
    comes(BORG_BUMPED, 20, 8, 0, 0);
    comes(BORG_BUMPED, 20, 7, 0, 0);
    assert_string_equal(does(0), "turn(6) turn(6)");
}

/* What another machine of the group noticed is heard, but not told again, and leaves the own telling as it is. */
static void only_its_own_is_told(void **state)
{
    (void)state;
    load("010 UNITS=3 [ Signal(OBJ_DETECT_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010);"
         "Signal(OBJ_DETECT_TRUE,010(2)): Go(OBJ_DETECT_TRUE.Target,010(2));"
         "Signal(OBJ_DETECT_TRUE,010): Turn(1); Signal(OBJ_DETECT_TRUE): Turn(2); ]",
         2);
    own(BORG_START);
    comes(BORG_OBJ_DETECT_TRUE, 10, 1, 1, 1);
    assert_string_equal(does(0), "turn(1)");
    comes(BORG_OBJ_DETECT_TRUE, 10, 2, 2, 2); /* its own, by its number */
    assert_string_equal(does(0), "reset tell OBJ_DETECT_TRUE,10(2)@2,2 go(2,2) turn(2)");
}

static void the_buffer_is_bounded(void **state)
{
    (void)state;
    load("010 UNITS=1 TIMEOUT=3 [ Signal(START): ResetTime; WHILE Signal(REACHED): Turn(1); WHILE "
         "Signal(STOPPED): Turn(2);"
         "WHILE Signal(BUMPED): Turn(3); Signal(TIME_OUT): Stop; ]",
         1);
    own(BORG_START);
    assert_string_equal(does(0), "reset");
    own(BORG_REACHED);
    own(BORG_STOPPED);
    for (int i = 0; i < 100; i++) {
        own(BORG_BUMPED);
        own(BORG_STOPPED);
    }
    assert_int_equal(borg_machine_dropped(&machine), 102 - BORG_WAITING_MAX);
    assert_string_equal(does(3000), "stop turn(2) turn(3) turn(3) turn(3) turn(3) turn(3) turn(3) turn(3)");
    for (int i = 0; i < 70000; i++) {
        own(BORG_BUMPED);
    }
    assert_int_equal(borg_machine_dropped(&machine), 65535);
    own(BORG_START); /* all else is forgotten */
    assert_string_equal(does(3000), "reset");
}

static void start_ends_what_was(void **state)
{
    (void)state;
    borg_output out;
    load(
        "010 UNITS=1 [ Signal(START): Turn(1),Turn(2); Signal(BUMPED): Turn(3),Turn(4);"
        "Signal(BUMPED) AND Signal(REACHED): Turn(5); Signal(LINE_END): UNITS=1 [ Signal(VOTE_WIN): Turn(6); "
        "WHILE Signal(REACHED): Turn(7); Signal(VOTE_LOST): Turn(8); ] ]",
        1);
    own(BORG_START);
    assert_string_equal(does(0), "turn(1) turn(2)");
    own(BORG_BUMPED);
    own(BORG_LINE_END);
    assert_int_equal(borg_machine_step(&out, &machine, 0), IRIS_OK);
    assert_int_equal(out.action.a, 3);
    own(BORG_START);
    assert_string_equal(does(0), "turn(1) turn(2)");
    own(BORG_REACHED);
    assert_string_equal(does(0), "");
    own(BORG_LINE_END);
    assert_string_equal(does(0), "elect3=1");
    assert_int_equal(borg_machine_vote(&machine, 3, 1), IRIS_OK);
    assert_string_equal(does(0), "turn(6)");
    own(BORG_REACHED);
    own(BORG_BUMPED);
    own(BORG_REACHED);
    assert_string_equal(does(0), "turn(7) turn(3) turn(4) turn(5) turn(7)");
    assert_int_equal(borg_machine_vote(&machine, 3, 0), IRIS_OK);
    own(BORG_REACHED);
    assert_string_equal(does(0), "stop turn(8)");
}

/* VOTE_WIN of one election is not another one's. */
static void elections_keep_apart(void **state)
{
    (void)state;
    load("010 UNITS=2 [ Signal(START): UNITS=1 [ Signal(VOTE_WIN): Turn(1); ]"
         "Signal(START): UNITS=1 [ Signal(VOTE_WIN): Go(3,4); ] Signal(VOTE_WIN): Turn(3); ]",
         1);
    own(BORG_START);
    assert_string_equal(does(0), "elect0=1 elect2=1@3,4");
    assert_int_equal(borg_machine_vote(&machine, 2, 1), IRIS_OK);
    assert_string_equal(does(0), "go(3,4) turn(3)");
    assert_int_equal(borg_machine_vote(&machine, 0, 1), IRIS_OK);
    assert_string_equal(does(0), "turn(1)");
}

/* WHILE opens an election anew, and who won the last one stops; a Stop outside ends it. */
static void elections_begin_again_and_end(void **state)
{
    (void)state;
    load("010 UNITS=2 [ WHILE Signal(LINE_END): UNITS=1 [ Signal(VOTE_WIN): Turn(1); WHILE Signal(REACHED): "
         "Stop; ]"
         "WHILE Signal(BUMPED): UNITS(2).Stop,UNITS(1).Turn(2); WHILE Signal(STOPPED): UNITS(1).Stop; ]",
         1);
    own(BORG_START);
    own(BORG_LINE_END);
    assert_string_equal(does(0), "elect0=1");
    assert_int_equal(borg_machine_vote(&machine, 0, 1), IRIS_OK);
    assert_string_equal(does(0), "turn(1)");
    own(BORG_REACHED);
    assert_string_equal(does(0), "stop"); /* inside: it stays its election */
    assert_int_equal(borg_machine_is_open(&machine, 0), 1);
    own(BORG_LINE_END);
    own(BORG_REACHED);
    assert_string_equal(does(0), "elect0=1 stop");
    assert_int_equal(borg_machine_vote(&machine, 0, 1), IRIS_OK);
    assert_string_equal(does(0), "turn(1)");
    own(BORG_BUMPED); /* another one's Stop */
    assert_string_equal(does(0), "turn(2)");
    assert_int_equal(borg_machine_is_open(&machine, 0), 1);
    own(BORG_STOPPED);
    own(BORG_REACHED);
    assert_string_equal(does(0), "stop");
    assert_int_equal(borg_machine_is_open(&machine, 0), 0);
    assert_int_equal(borg_machine_vote(&machine, 0, 1), IRIS_ERR_RANGE);
}

static void wrong_calls(void **state)
{
    (void)state;
    borg_output out;
    borg_signal s = {BORG_BUMPED, 1, 20, 0, 0};
    load("010 UNITS=2 [ Signal(START): Go(OBJ_DETECT_TRUE.Target,20(1)); Signal(BUMPED,20): UNITS=1 [ ] ]",
         1);
    assert_int_equal(borg_machine_init(NULL, chunk, length, 1), IRIS_ERR_ARG);
    assert_int_equal(borg_machine_init(&machine, NULL, length, 1), IRIS_ERR_ARG);
    assert_int_equal(borg_machine_init(&machine, chunk, length - 1, 1), IRIS_ERR_TRUNCATED);
    assert_int_equal(borg_machine_init(&machine, chunk, length, 0), IRIS_ERR_RANGE);
    assert_int_equal(borg_machine_init(&machine, chunk, length, 3), IRIS_ERR_RANGE);
    assert_int_equal(borg_machine_signal(NULL, &s), IRIS_ERR_ARG);
    assert_int_equal(borg_machine_signal(&machine, NULL), IRIS_ERR_ARG);
    assert_int_equal(borg_machine_step(NULL, &machine, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_machine_step(&out, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_machine_vote(NULL, 1, 0), IRIS_ERR_ARG);
    own(BORG_START);
    assert_string_equal(does(0), ""); /* nowhere to go */
    assert_int_equal(borg_machine_skipped(&machine), 1);
    assert_int_equal(borg_machine_vote(&machine, 1, 0), IRIS_ERR_RANGE);
    assert_int_equal(borg_machine_signal(&machine, &s), IRIS_OK);
    assert_string_equal(does(0), "elect1=1");
    for (int32_t i = -2; i < 40; i++) {
        assert_int_equal(borg_machine_vote(&machine, i, 0), i == 1 ? IRIS_OK : IRIS_ERR_RANGE);
    }
    s = (borg_signal){BORG_SIGNAL_KINDS, 1, 20, 0, 0};
    assert_int_equal(borg_machine_signal(&machine, &s), IRIS_ERR_ARG);
    s = (borg_signal){BORG_BUMPED, 0, 20, 0, 0};
    assert_int_equal(borg_machine_signal(&machine, &s), IRIS_ERR_ARG);
    s = (borg_signal){BORG_VOTE_WIN, 1, 10, 0, 0};
    assert_int_equal(borg_machine_signal(&machine, &s), IRIS_ERR_ARG);
    s = (borg_signal){BORG_BUMPED, 1, 20, 0, BORG_PLACE_MAX_MM + 1};
    assert_int_equal(borg_machine_signal(&machine, &s), IRIS_ERR_RANGE);
    s.y = INT32_MIN;
    assert_int_equal(borg_machine_signal(&machine, &s), IRIS_ERR_RANGE);
}

/* 24 different signals are the most that a chunk may need; with one more it is refused. */
static void memory_is_bounded(void **state)
{
    (void)state;
    load("010 UNITS=1 [ Signal(BUMPED,20(14)) AND Signal(OBJ_DETECT_TRUE,30(9)): "
         "Go(OBJ_DETECT_TRUE.Target,30(10)); ]",
         1);
    own(BORG_START);
    for (int i = 1; i <= 40; i++) {
        comes(BORG_OBJ_DETECT_TRUE, 30, (uint8_t)i, i, -i);
        comes(BORG_LINE_END, 20, (uint8_t)i, 0, 0);
        assert_string_equal(does(0), "");
    }
    for (int i = 1; i <= 13; i++) {
        comes(BORG_BUMPED, 20, (uint8_t)(2 * i), 0, 0);
        assert_string_equal(does(0), "");
    }
    comes(BORG_BUMPED, 20, 1, 0, 0);
    assert_string_equal(does(0), "go(10,-10)");
    const char *text = "010 UNITS=1 [ Signal(BUMPED,20(14)) AND Signal(OBJ_DETECT_TRUE,30(9)):"
                       "Go(OBJ_DETECT_TRUE.Target,30(10)),Go(OBJ_DETECT_TRUE.Target,31(1)); ]";
    const borg_text of = {text, strlen(text)};
    borg_problem problem;
    size_t position = 0;
    assert_int_equal(borg_chunk_read_text(chunk, sizeof chunk, &length, &position, &problem, &of), IRIS_OK);
    assert_int_equal(borg_machine_init(&machine, chunk, length, 1), IRIS_ERR_RANGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_finder),
        cmocka_unit_test(the_explorers),
        cmocka_unit_test(votes_change),
        cmocka_unit_test(the_reports_chunks),
        cmocka_unit_test(one_thing_at_a_time),
        cmocka_unit_test(while_and_else),
        cmocka_unit_test(only_its_own_is_told),
        cmocka_unit_test(the_buffer_is_bounded),
        cmocka_unit_test(start_ends_what_was),
        cmocka_unit_test(elections_keep_apart),
        cmocka_unit_test(elections_begin_again_and_end),
        cmocka_unit_test(wrong_calls),
        cmocka_unit_test(memory_is_bounded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
