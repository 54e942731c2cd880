/* The command sentence. Checksums were worked out apart from the library, by hand and by another program. */
#include "iris/command.h"
#include "test.h"

#include <stdio.h>

static const struct {
    iris_command command;
    const char *sentence;
} known[] = {
    {{42, IRIS_LINE_FOUND, -180, 750, -1250, -93, 880}, "$PIRIS,42,F,-180,750,-1250,-93,880*27\r\n"},
    {{9999, IRIS_LINE_FOUND, -1000, 1000, -9000, -9999, 1000},
     "$PIRIS,9999,F,-1000,1000,-9000,-9999,1000*1E\r\n"},
    {{0, IRIS_LINE_LOST, 0, 0, 0, 0, 0}, "$PIRIS,0,L,0,0,0,0,0*31\r\n"},
    {{7, IRIS_LINE_STALE, 1000, 0, 9000, 9999, 0}, "$PIRIS,7,S,1000,0,9000,9999,0*11\r\n"},
};
enum { KNOWN = sizeof known / sizeof known[0] };

static void assert_same(const iris_command *a, const iris_command *b)
{
    assert_int_equal(a->seq, b->seq);
    assert_int_equal(a->state, b->state);
    assert_int_equal(a->steer_permil, b->steer_permil);
    assert_int_equal(a->speed_permil, b->speed_permil);
    assert_int_equal(a->angle_centideg, b->angle_centideg);
    assert_int_equal(a->offset_permil, b->offset_permil);
    assert_int_equal(a->confidence_permil, b->confidence_permil);
}

/* How many commands come out of these bytes; the last one in *command. */
static int parsed(iris_command *command, iris_command_parser *parser, const char *bytes, size_t count)
{
    int good = 0;
    for (size_t i = 0; i < count; i++) {
        good += iris_command_parse(command, parser, bytes[i]) == IRIS_OK;
    }
    return good;
}

static int accepted(const char *sentence)
{
    iris_command_parser parser = {0};
    iris_command command;
    return parsed(&command, &parser, sentence, strlen(sentence));
}

/* "$body*hh\r\n" with a right checksum. */
static const char *framed(const char *body)
{
    static char sentence[200];
    unsigned sum = 0;
    for (const char *c = body; *c; c++) {
        sum ^= (unsigned char)*c;
    }
    snprintf(sentence, sizeof sentence, "$%s*%02X\r\n", body, sum);
    return sentence;
}

static void known_sentences_both_ways(void **state)
{
    (void)state;
    for (int i = 0; i < KNOWN; i++) {
        char sentence[IRIS_COMMAND_SENTENCE_BYTES];
        size_t length = 0;
        assert_int_equal(iris_command_format(sentence, sizeof sentence, &length, &known[i].command), IRIS_OK);
        assert_string_equal(sentence, known[i].sentence);
        assert_int_equal(length, strlen(known[i].sentence));
        iris_command_parser parser;
        iris_command command;
        iris_command_parser_init(&parser);
        for (size_t j = 0; j < length; j++) {
            iris_status expected = j + 1 == length ? IRIS_OK : IRIS_ERR_TRUNCATED;
            assert_int_equal(iris_command_parse(&command, &parser, sentence[j]), expected);
        }
        assert_same(&command, &known[i].command);
    }
}

/* Every value of every field against printf. */
static void every_value_of_every_field(void **state)
{
    (void)state;
    static const int32_t min[] = {0, -1000, 0, -9000, -9999, 0};
    static const int32_t max[] = {9999, 1000, 1000, 9000, 9999, 1000};
    for (int field = 0; field < 6; field++) {
        for (int32_t value = min[field] - 1; value <= max[field] + 1; value++) {
            int32_t v[6] = {9999, -1000, 1000, -9000, -9999, 1000};
            v[field] = value;
            iris_command command = {v[0], IRIS_LINE_FOUND, v[1], v[2], v[3], v[4], v[5]}, back;
            char body[100], sentence[IRIS_COMMAND_SENTENCE_BYTES];
            size_t length = 0;
            snprintf(body, sizeof body, "PIRIS,%d,F,%d,%d,%d,%d,%d", v[0], v[1], v[2], v[3], v[4], v[5]);
            iris_command_parser parser = {0};
            if (value < min[field] || value > max[field]) {
                assert_int_equal(iris_command_format(sentence, sizeof sentence, &length, &command),
                                 IRIS_ERR_ARG);
                assert_int_equal(accepted(framed(body)), 0);
                continue;
            }
            assert_int_equal(iris_command_format(sentence, sizeof sentence, &length, &command), IRIS_OK);
            assert_string_equal(sentence, framed(body));
            assert_in_range(length, 1, 46);
            assert_int_equal(parsed(&back, &parser, sentence, length), 1);
            assert_same(&back, &command);
        }
    }
}

static void format_refuses_and_leaves_outputs(void **state)
{
    (void)state;
    char sentence[IRIS_COMMAND_SENTENCE_BYTES];
    size_t length = 77;
    memset(sentence, '#', sizeof sentence);
    iris_command command = known[1].command; /* 46 bytes and the 0 */
    assert_int_equal(iris_command_format(NULL, 83, &length, &command), IRIS_ERR_ARG);
    assert_int_equal(iris_command_format(sentence, 83, NULL, &command), IRIS_ERR_ARG);
    assert_int_equal(iris_command_format(sentence, 83, &length, NULL), IRIS_ERR_ARG);
    assert_int_equal(iris_command_format(sentence, 46, &length, &command), IRIS_ERR_RANGE);
    assert_int_equal(iris_command_format(sentence, 0, &length, &command), IRIS_ERR_RANGE);
    static const int32_t wild[] = {INT32_MIN, INT32_MAX, -10000, 10000, 65536};
    for (size_t i = 0; i < sizeof wild / sizeof wild[0]; i++) {
        int32_t *fields[] = {&command.seq,           &command.steer_permil,
                             &command.speed_permil,  &command.angle_centideg,
                             &command.offset_permil, &command.confidence_permil};
        for (int f = 0; f < 6; f++) {
            command = known[1].command;
            *fields[f] = wild[i];
            assert_int_equal(iris_command_format(sentence, 83, &length, &command), IRIS_ERR_ARG);
        }
    }
    command = known[1].command;
    command.state = (iris_line_state)3;
    assert_int_equal(iris_command_format(sentence, 83, &length, &command), IRIS_ERR_ARG);
    command.state = (iris_line_state)-1;
    assert_int_equal(iris_command_format(sentence, 83, &length, &command), IRIS_ERR_ARG);
    for (size_t i = 0; i < sizeof sentence; i++) {
        assert_int_equal(sentence[i], '#');
    }
    assert_int_equal(length, 77);
    assert_int_equal(iris_command_format(sentence, 47, &length, &known[1].command), IRIS_OK);
}

static void other_spellings_are_refused(void **state)
{
    (void)state;
    assert_int_equal(accepted(framed("PIRIS,42,F,-180,750,-1250,-93,880")), 1);
    static const char *const bodies[] = {
        "PIRIS,42,F,-180,750,-1250,-93",
        "PIRIS,42,F,-180,750,-1250,-93,880,",
        "PIRIS,42,F,-180,750,-1250,-93,880,1",
        "PIRIS,42,F,-180,750,-1250,-93,",
        "PIRIS,,F,-180,750,-1250,-93,880",
        "PIRIS,42,,-180,750,-1250,-93,880",
        "PIRIS,42,F,+180,750,-1250,-93,880",
        "PIRIS,42,F,-180,0750,-1250,-93,880",
        "PIRIS,042,F,-180,750,-1250,-93,880",
        "PIRIS,42,F,-0,750,-1250,-93,880",
        "PIRIS,42,F,00,750,-1250,-93,880",
        "PIRIS,42,F,-,750,-1250,-93,880",
        "PIRIS,42,F,--180,750,-1250,-93,880",
        "PIRIS,42,F, 180,750,-1250,-93,880",
        "PIRIS,42,F,-180,7.5,-1250,-93,880",
        "PIRIS,42,F,-180,0x7,-1250,-93,880",
        "PIRIS,42,f,-180,750,-1250,-93,880",
        "PIRIS,42,FF,-180,750,-1250,-93,880",
        "PIRIS,42,X,-180,750,-1250,-93,880",
        "PIRIS,42,F,-180,750,-1250,-93,880 ",
        "PIRIS,4294967338,F,-180,750,0,0,880",
        "PIRIS,42,F,-180,65536,-1250,-93,880",
        "PIRIS,42,F,4294967296,0,0,0,0",
        "piris,42,F,-180,750,-1250,-93,880",
        "PIRIS42,F,-180,750,-1250,-93,880",
        "PIRIX,42,F,-180,750,-1250,-93,880",
        "GPRMC,42,F,-180,750,-1250,-93,880",
        "PIRIS",
        "PIRIS,42,F",
        "",
    };
    for (size_t i = 0; i < sizeof bodies / sizeof bodies[0]; i++) {
        assert_int_equal(accepted(framed(bodies[i])), 0);
    }
    assert_int_equal(accepted("$PIRIS,42,F,-180,750,-1250,-93,880*28\r\n"), 0);
    assert_int_equal(accepted("$PIRIS,42,F,-180,750,-1250,-93,880*27\n"), 0);
    assert_int_equal(accepted("$PIRIS,42,F,-180,750,-1250,-93,880*27\r"), 0);
    assert_int_equal(accepted("$PIRIS,42,F,-180,750,-1250,-93,880*27\r\r\n"), 0);
    assert_int_equal(accepted("$PIRIS,42,F,-180,750,-1250,-93,880*027\r\n"), 0);
    assert_int_equal(accepted("$PIRIS,42,F,-180,750,-1250,-93,880\r\n"), 0);
    assert_int_equal(accepted("PIRIS,42,F,-180,750,-1250,-93,880*27\r\n"), 0);
    assert_int_equal(accepted("$PIRIS,9999,F,-1000,1000,-9000,-9999,1000*1e\r\n"), 0);
    assert_int_equal(accepted("$\n$\r\n$$$\r\n\n\n"), 0);
}

static void parser_says_what_a_byte_did(void **state)
{
    (void)state;
    iris_command_parser parser = {0};
    iris_command command;
    assert_int_equal(iris_command_parse(&command, &parser, 'x'), IRIS_ERR_TRUNCATED);
    assert_int_equal(iris_command_parse(&command, &parser, '\n'), IRIS_ERR_TRUNCATED);
    assert_int_equal(iris_command_parse(&command, &parser, '$'), IRIS_ERR_TRUNCATED);
    assert_int_equal(iris_command_parse(&command, &parser, '$'), IRIS_ERR_DATA);
    assert_int_equal(iris_command_parse(&command, &parser, '\n'), IRIS_ERR_DATA);
    assert_int_equal(iris_command_parse(NULL, &parser, '$'), IRIS_ERR_ARG);
    assert_int_equal(iris_command_parse(&command, NULL, '$'), IRIS_ERR_ARG);
    iris_command_parser_init(NULL);
    /* 82 bytes are a sentence, the 83rd ends it */
    for (int i = 0; i < 83; i++) {
        iris_status expected = i < 82 ? IRIS_ERR_TRUNCATED : IRIS_ERR_DATA;
        assert_int_equal(iris_command_parse(&command, &parser, i == 0 ? '$' : 'A'), expected);
    }
    assert_int_equal(iris_command_parse(&command, &parser, '\n'), IRIS_ERR_TRUNCATED);
    /* a damaged parser is survived */
    memset(&parser, 0xff, sizeof parser);
    assert_int_equal(iris_command_parse(&command, &parser, 'A'), IRIS_ERR_DATA);
    assert_int_equal(parsed(&command, &parser, known[0].sentence, strlen(known[0].sentence)), 1);
}

static void damage_never_gives_a_command(void **state)
{
    (void)state;
    for (int k = 0; k < KNOWN; k++) {
        size_t length = strlen(known[k].sentence);
        for (size_t at = 0; at < length; at++) {
            iris_command_parser parser = {0};
            iris_command command;
            char bad[64];
            for (int value = 0; value < 256; value++) { /* one byte changed */
                memcpy(bad, known[k].sentence, length);
                bad[at] = (char)value;
                assert_int_equal(parsed(&command, &parser, bad, length), bad[at] == known[k].sentence[at]);
                assert_int_equal(parsed(&command, &parser, known[k].sentence, length), 1);
                assert_same(&command, &known[k].command);
            }
            memcpy(bad, known[k].sentence, at); /* one byte lost */
            memcpy(bad + at, known[k].sentence + at + 1, length - at - 1);
            assert_int_equal(parsed(&command, &parser, bad, length - 1), 0);
            assert_int_equal(parsed(&command, &parser, known[k].sentence, at), 0); /* cut off */
            assert_int_equal(parsed(&command, &parser, known[k].sentence, length), 1);
        }
    }
}

static uint32_t random_next(uint32_t *seed)
{
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

/* A million bytes, half of them from the sentence's own alphabet; a good sentence after every hundred or so.
 */
static void good_sentences_survive_garbage(void **state)
{
    (void)state;
    static const char alphabet[] = "$PIRIS,0123456789-FSL*\r\n";
    uint32_t seed = 20041122;
    iris_command_parser parser = {0};
    iris_command command;
    int sent = 0, received = 0;
    for (int i = 0; i < 1000000; i++) {
        uint32_t r = random_next(&seed);
        char byte = r & 1 ? alphabet[(r >> 8) % (sizeof alphabet - 1)] : (char)(r >> 24);
        received += iris_command_parse(&command, &parser, byte) == IRIS_OK;
        if (random_next(&seed) % 100 == 0) {
            int k = sent++ % KNOWN;
            assert_int_equal(parsed(&command, &parser, known[k].sentence, strlen(known[k].sentence)), 1);
            assert_same(&command, &known[k].command);
        }
    }
    assert_true(sent > 9000);
    assert_int_equal(received, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_sentences_both_ways),         cmocka_unit_test(every_value_of_every_field),
        cmocka_unit_test(format_refuses_and_leaves_outputs), cmocka_unit_test(other_spellings_are_refused),
        cmocka_unit_test(parser_says_what_a_byte_did),       cmocka_unit_test(damage_never_gives_a_command),
        cmocka_unit_test(good_sentences_survive_garbage),
    };
    return cmocka_run_group_tests_name("command", tests, NULL, NULL);
}
