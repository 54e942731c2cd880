/* Telemetry sentences, by hand, spoiled, and of a robot at the other end of a line. */
#include "iris/osiris/telemetry.h"

#include <stdio.h>

#include "iris/command.h"
#include "iris/osiris/robot_text.h"
#include "random_within.h"
#include "test.h"

static osiris_telemetry_parser parser;
static osiris_telemetry found;

/* What the bytes end with. */
static iris_status parses(const char *bytes, size_t count)
{
    iris_status status = IRIS_ERR_TRUNCATED;
    for (size_t i = 0; i < count; i++) {
        status = osiris_telemetry_parse(&found, &parser, bytes[i]);
    }
    return status;
}

/* A sentence around a body, with its sum. */
static size_t around(char *sentence, const char *body)
{
    unsigned sum = 0;
    for (const char *c = body; *c; c++) {
        sum ^= (unsigned char)*c;
    }
    return (size_t)snprintf(sentence, 120, "$%s*%02X\r\n", body, sum);
}

static void by_hand(void **state)
{
    (void)state;
    char sentence[120], made[OSIRIS_TELEMETRY_BYTES];
    size_t length = 0, count = around(sentence, "PIRIV,42,range,7,V,1234");
    assert_int_equal(parses(sentence, count), IRIS_OK);
    assert_int_equal(found.seq, 42);
    assert_int_equal(found.raw.kind, OSIRIS_RANGE);
    assert_int_equal(found.channel, 7);
    assert_int_equal(found.raw.validity, OSIRIS_VALID);
    assert_int_equal(found.raw.values[0], 1234);
    assert_int_equal(found.raw.values[1], 0);
    assert_int_equal(osiris_telemetry_format(made, sizeof made, &length, &found), IRIS_OK);
    assert_string_equal(made, sentence);
    assert_int_equal(osiris_telemetry_format(made, length + 1, &length, &found), IRIS_OK);
    assert_int_equal(osiris_telemetry_format(made, length, &length, &found), IRIS_ERR_RANGE);
    count = around(sentence, "PIRIV,9999,odometry,255,N,-2147483648,2147483647,-2147483648,-2147483648");
    assert_int_equal(parses(sentence, count), IRIS_OK);
    assert_int_equal(found.raw.validity, OSIRIS_BEYOND);
    assert_int_equal(found.raw.values[1], INT32_MAX);
    assert_int_equal(found.raw.values[3], INT32_MIN);
    assert_true(count <= 82);
}

static void one_spelling(void **state)
{
    (void)state;
    static const char *const bodies[] = {"PIRIV,42,range,7,V",
                                         "PIRIV,42,range,7,V,",
                                         "PIRIV,42,range,7,V,01",
                                         "PIRIV,42,range,7,V,+1",
                                         "PIRIV,42,range,7,V,-0",
                                         "PIRIV,42,range,7,V,1,0",
                                         "PIRIV,42,range,7,V,1,2,3,4,5",
                                         "PIRIV,10000,range,7,V,1",
                                         "PIRIV,-1,range,7,V,1",
                                         "PIRIV,42,range,256,V,1",
                                         "PIRIV,42,ranger,7,V,1",
                                         "PIRIV,42,nothing,7,V,1",
                                         "PIRIV,42,range,7,X,1",
                                         "PIRIV,42,range,7,1",
                                         "PIRIV,42,range,7,V,2147483648",
                                         "PIRIV,42,range,7,V,99999999999",
                                         "PIRIV,42,range,7,V, 1",
                                         "PIRIS,42,range,7,V,1",
                                         "PIRIV",
                                         "",
                                         "PIRIV,42,range,7,V,1x"};
    char sentence[120];
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++) {
        assert_int_equal(parses(sentence, around(sentence, bodies[i])), IRIS_ERR_DATA);
    }
    const size_t count = around(sentence, "PIRIV,42,range,7,V,1");
    sentence[count - 3] ^= 1; /* the sum */
    assert_int_equal(parses(sentence, count), IRIS_ERR_DATA);
    around(sentence, "PIRIV,42,range,7,V,1");
    memcpy(sentence + count - 2, "\n", 2);
    assert_int_equal(parses(sentence, count - 1), IRIS_ERR_DATA); /* without \r */
}

static void there_and_back_and_spoiled(void **state)
{
    (void)state;
    char sentence[OSIRIS_TELEMETRY_BYTES];
    size_t length = 0;
    int good = 0;
    memset(&parser, 0, sizeof parser);
    for (int i = 0; i < 3000; i++) {
        osiris_telemetry t;
        memset(&t, 0, sizeof t);
        t.seq = random_within(0, 9999);
        t.channel = random_within(0, 255);
        t.raw.kind = (osiris_kind)random_within(OSIRIS_CAMERA, OSIRIS_SOUND);
        t.raw.validity = i % 2 ? OSIRIS_VALID : OSIRIS_BEYOND;
        for (int k = random_within(0, 4); k > 0; k--) {
            t.raw.values[k - 1] = random_within(INT32_MIN, INT32_MAX);
        }
        assert_int_equal(osiris_telemetry_format(sentence, sizeof sentence, &length, &t), IRIS_OK);
        assert_int_equal(parses(sentence, length), IRIS_OK);
        assert_memory_equal(&found, &t, sizeof t);
        const int32_t at = random_within(0, (int32_t)length - 1);
        sentence[at] = (char)(sentence[at] ^ (1 << random_within(0, 7)));
        good += parses(sentence, length) == IRIS_OK;
    }
    assert_int_equal(good, 0); /* one bit is never missed */
    const char *text = "noise$PIRIV,1,ra$PIRIV";
    assert_int_equal(parses(text, strlen(text)), IRIS_ERR_TRUNCATED);
    for (int i = 0; i < 200; i++) {
        (void)parses("x", 1);
    }
    assert_int_equal(parses("\n", 1), IRIS_ERR_TRUNCATED); /* the long one is forgotten */
    osiris_telemetry bad;
    memset(&bad, 0, sizeof bad);
    assert_int_equal(osiris_telemetry_format(sentence, sizeof sentence, &length, &bad), IRIS_ERR_ARG);
    assert_int_equal(osiris_telemetry_format(NULL, sizeof sentence, &length, &found), IRIS_ERR_ARG);
    assert_int_equal(osiris_telemetry_format(sentence, sizeof sentence, NULL, &found), IRIS_ERR_ARG);
    assert_int_equal(osiris_telemetry_parse(NULL, &parser, 'x'), IRIS_ERR_ARG);
    assert_int_equal(osiris_telemetry_parse(&found, NULL, 'x'), IRIS_ERR_ARG);
}

/* --- the robot at the other end --- */

static osiris_plan plan;
static osiris_device devices[OSIRIS_DEVICES_MAX];
static osiris_remote_device states[OSIRIS_DEVICES_MAX];
static osiris_remote remote;

static void begin(const char *drive)
{
    char text[400];
    osiris_problem problem;
    snprintf(text, sizeof text,
             "robot r\ndriver a serial p\ndriver b simulated\n%s\nrange one\nrange two by b\nlight lamp\n",
             drive);
    assert_int_equal(osiris_robot_read_text(&plan, devices, OSIRIS_DEVICES_MAX, &problem, text, strlen(text)),
                     IRIS_OK);
    assert_int_equal(osiris_remote_init(&remote, states, &plan, 0), IRIS_OK);
}

static void takes(void **state)
{
    (void)state;
    char text[120];
    osiris_raw raw;
    begin("drive differential track 200 speed 1000");
    assert_int_equal(osiris_remote_read(&remote, &raw, &devices[1]), IRIS_ERR_TIMEOUT);
    assert_int_equal(osiris_remote_read(&remote, &raw, &devices[2]), IRIS_ERR_UNSUPPORTED); /* driver b */
    assert_int_equal(osiris_remote_read(&remote, &raw, &devices[3]), IRIS_ERR_UNSUPPORTED); /* a lamp */
    size_t count = around(text, "PIRIV,1,range,0,V,700");
    assert_int_equal(osiris_remote_take(&remote, "rubbish$", 8, 50), IRIS_OK);
    assert_int_equal(osiris_remote_take(&remote, text, 5, 50), IRIS_OK);
    assert_int_equal(osiris_remote_take(&remote, text + 5, count - 5, 60), IRIS_OK);
    assert_int_equal(osiris_remote_read(&remote, &raw, &devices[1]), IRIS_OK);
    assert_int_equal(raw.values[0], 700);
    assert_int_equal(raw.time_ms, 60);
    assert_int_equal(osiris_remote_read(&remote, &raw, &devices[1]), IRIS_ERR_TIMEOUT);
    assert_int_equal(remote.taken, 1);
    assert_int_equal(remote.refused, 1);
    count = around(text, "PIRIV,2,range,9,V,700"); /* nobody's */
    assert_int_equal(osiris_remote_take(&remote, text, count, 70), IRIS_OK);
    assert_int_equal(remote.refused, 2);
    assert_int_equal(osiris_remote_take(&remote, NULL, 0, 70), IRIS_OK);
    assert_int_equal(osiris_remote_take(&remote, NULL, 1, 70), IRIS_ERR_ARG);
    assert_int_equal(osiris_remote_init(&remote, states, &plan, 2), IRIS_ERR_ARG);
    assert_int_equal(osiris_remote_init(NULL, states, &plan, 0), IRIS_ERR_ARG);
}

/* Speed and steering in permil, and the telemetry of the drive. */
static void tells(void **state)
{
    (void)state;
    static const struct {
        const char *drive;
        int32_t values[4];
        int32_t speed, steer;
    } cases[] = {
        {"drive differential track 200 speed 1000", {500 * 65536, 0, 0, 0}, 500, 0},
        /* 200 mm/s and half a turn a second on a radius of 100 mm: the wheels differ by 314 mm/s to each side, more than 200 */
        {"drive differential track 200 speed 1000", {200 * 65536, 0, 32768 * 256, 0}, 200, 1000},
        /* 5000 units/s are 0.479 radians/s: 47.9 of 500 */
        {"drive differential track 200 speed 1000", {500 * 65536, 0, -5000 * 256, 0}, 500, -96},
        {"drive differential track 200 speed 1000", {0, 0, 32768 * 256, 0}, 0, 0},
        {"drive differential track 200 speed 1000", {-300 * 65536, 0, 0, 0}, 0, 0},
        {"drive ackermann track 160 wheelbase 260 steering 30 speed 1000",
         {250 * 65536, 0, 0, -2731},
         250,
         -500},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[OSIRIS_REMOTE_BYTES];
        size_t length = 0;
        iris_command_parser commands;
        iris_command command = {0};
        osiris_raw raw = {OSIRIS_DRIVE, OSIRIS_VALID, 5, {0, 0, 0, 0}};
        int has_command = 0, has_drive = 0;
        begin(cases[i].drive);
        memset(&parser, 0, sizeof parser);
        iris_command_parser_init(&commands);
        memcpy(raw.values, cases[i].values, sizeof raw.values);
        assert_int_equal(osiris_remote_tell(text, &length, &remote, &devices[0], &raw), IRIS_OK);
        assert_int_equal(strlen(text), length);
        for (size_t k = 0; k < length; k++) {
            has_command += iris_command_parse(&command, &commands, text[k]) == IRIS_OK;
            has_drive += osiris_telemetry_parse(&found, &parser, text[k]) == IRIS_OK;
        }
        assert_true(has_command == 1 && has_drive == 1);
        assert_int_equal(command.speed_permil, cases[i].speed);
        assert_int_equal(command.steer_permil, cases[i].steer);
        assert_int_equal(found.raw.kind, OSIRIS_DRIVE);
        assert_memory_equal(found.raw.values, cases[i].values, sizeof found.raw.values);
        assert_int_equal(osiris_remote_tell(text, &length, &remote, &devices[1], &raw), IRIS_ERR_UNSUPPORTED);
        assert_int_equal(osiris_remote_tell(text, &length, &remote, &devices[3], &raw), IRIS_OK);
        assert_true(strncmp(text, "$PIRIV,1,light,0,V,", 19) == 0);
    }
}

/* The longest there is fits. */
static void the_longest_fits(void **state)
{
    (void)state;
    char text[OSIRIS_REMOTE_BYTES];
    size_t length = 0;
    const osiris_raw raw = {OSIRIS_DRIVE, OSIRIS_VALID, 5, {1048576000, INT32_MIN, INT32_MIN, INT32_MIN}};
    begin("drive differential track 200 speed 16000");
    remote.seq = remote.command_seq = 9999;
    assert_int_equal(osiris_remote_tell(text, &length, &remote, &devices[0], &raw), IRIS_OK);
    assert_true(length < OSIRIS_REMOTE_BYTES);
    assert_int_equal(remote.seq, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(one_spelling),
        cmocka_unit_test(there_and_back_and_spoiled),
        cmocka_unit_test(takes),
        cmocka_unit_test(tells),
        cmocka_unit_test(the_longest_fits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
