#include "iris/command.h"

enum { FIELDS = 6 };

static const char start[] = "$PIRIS";
static const char state_letters[] = "LSF"; /* in the order of iris_line_state */
static const char hex_digits[] = "0123456789ABCDEF";

/* The numbers of a command in the order of the sentence; the state stands behind the first. */
static const struct {
    int16_t min, max;
} limits[FIELDS] = {{0, 9999}, {-1000, 1000}, {0, 1000}, {-9000, 9000}, {-9999, 9999}, {0, 1000}};

/* value is within -9999..9999. */
static char *put_number(char *at, int32_t value)
{
    char digits[4];
    int count = 0;
    if (value < 0) {
        *at++ = '-';
        value = -value;
    }
    do {
        digits[count++] = (char)('0' + value % 10);
        value /= 10;
    } while (value > 0);
    while (count > 0) {
        *at++ = digits[--count];
    }
    return at;
}

static char *put_checksum(char *at, const char *first)
{
    unsigned sum = 0;
    for (const char *c = first; c < at; c++) {
        sum ^= (unsigned char)*c;
    }
    *at++ = '*';
    *at++ = hex_digits[sum >> 4];
    *at++ = hex_digits[sum & 15u];
    *at++ = '\r';
    *at++ = '\n';
    return at;
}

iris_status iris_command_format(char *sentence, size_t capacity, size_t *length, const iris_command *command)
{
    if (!sentence || !length || !command || (unsigned)command->state > IRIS_LINE_FOUND) {
        return IRIS_ERR_ARG;
    }
    const int32_t values[FIELDS] = {command->seq,           command->steer_permil,
                                    command->speed_permil,  command->angle_centideg,
                                    command->offset_permil, command->confidence_permil};
    char text[IRIS_COMMAND_SENTENCE_BYTES];
    char *at = text;
    while (start[at - text]) {
        *at = start[at - text];
        at++;
    }
    for (int i = 0; i < FIELDS; i++) {
        if (values[i] < limits[i].min || values[i] > limits[i].max) {
            return IRIS_ERR_ARG;
        }
        *at++ = ',';
        at = put_number(at, values[i]);
        if (i == 0) {
            *at++ = ',';
            *at++ = state_letters[command->state];
        }
    }
    at = put_checksum(at, text + 1);
    *at++ = 0;
    size_t bytes = (size_t)(at - text);
    if (bytes > capacity) {
        return IRIS_ERR_RANGE;
    }
    for (size_t i = 0; i < bytes; i++) {
        sentence[i] = text[i];
    }
    *length = bytes - 1;
    return IRIS_OK;
}

/* Reads an optional minus and up to 5 digits. Stops at the first other byte. */
static const char *get_number(int32_t *value, const char *at)
{
    int negative = *at == '-';
    at += negative;
    int32_t magnitude = 0;
    for (int digits = 0; digits < 5 && *at >= '0' && *at <= '9'; digits++) {
        magnitude = magnitude * 10 + (*at++ - '0');
    }
    *value = negative ? -magnitude : magnitude;
    return at;
}

/* Reads the command of a sentence that ends with '\n' without judging its spelling. Never passes the '\n':
 * each step moves over bytes that it has seen to be something else. */
static int get_command(iris_command *command, const char *at)
{
    int32_t values[FIELDS];
    int state = 0;
    for (int i = 0; start[i]; i++) {
        if (*at++ != start[i]) {
            return 0;
        }
    }
    for (int i = 0; i < FIELDS; i++) {
        if (*at++ != ',') {
            return 0;
        }
        at = get_number(&values[i], at);
        if (i == 0) {
            if (*at++ != ',') {
                return 0;
            }
            while (state_letters[state] != *at) {
                if (++state > IRIS_LINE_FOUND) {
                    return 0;
                }
            }
            at++;
        }
    }
    *command = (iris_command){.seq = values[0],
                              .state = (iris_line_state)state,
                              .steer_permil = values[1],
                              .speed_permil = values[2],
                              .angle_centideg = values[3],
                              .offset_permil = values[4],
                              .confidence_permil = values[5]};
    return 1;
}

void iris_command_parser_init(iris_command_parser *parser)
{
    if (parser) {
        parser->length = 0;
    }
}

/* Good is what formats to the same bytes: one rule for range, spelling, missing and extra fields, and
 * checksum. */
static iris_status read_sentence(iris_command *command, const char *text, size_t length)
{
    iris_command found;
    char again[IRIS_COMMAND_SENTENCE_BYTES];
    size_t again_length;
    if (!get_command(&found, text) ||
        iris_command_format(again, sizeof again, &again_length, &found) != IRIS_OK ||
        again_length != length) {
        return IRIS_ERR_DATA;
    }
    for (size_t i = 0; i < length; i++) {
        if (again[i] != text[i]) {
            return IRIS_ERR_DATA;
        }
    }
    *command = found;
    return IRIS_OK;
}

iris_status iris_command_parse(iris_command *command, iris_command_parser *parser, char byte)
{
    if (!command || !parser) {
        return IRIS_ERR_ARG;
    }
    size_t length = parser->length;
    if (byte == '$') {
        parser->text[0] = byte;
        parser->length = 1;
        return length > 0 ? IRIS_ERR_DATA : IRIS_ERR_TRUNCATED;
    }
    if (length == 0) {
        return IRIS_ERR_TRUNCATED;
    }
    if (length >= sizeof parser->text) {
        parser->length = 0;
        return IRIS_ERR_DATA;
    }
    parser->text[length] = byte;
    parser->length = (uint8_t)(length + 1);
    if (byte != '\n') {
        return IRIS_ERR_TRUNCATED;
    }
    parser->length = 0;
    return read_sentence(command, parser->text, length + 1);
}
