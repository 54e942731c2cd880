/* BorgCode: texts, chunks, machines, and members of teams. */
#include <string.h>

#include "calls.h"
#include "iris/borg/chunk_text.h"
#include "iris/borg/in_process.h"
#include "iris/borg/member.h"
#include "iris/borg/script.h"
#include "test.h"

static const char *const scripts[] = {
    "START\n10 UNITS=1: LineFollow,ObjDetect;\n20 UNITS=4: AutoExplore;\nIF (REF(10):UNITS(1).ObjDetect)\n"
    "[ REF(20):UNITS(2 OF 4).Go(REF(10):UNITS(1).Target) ]\nIF (REF(10):UNITS(1).TimeOut) [ REF(20):UNITS(4 "
    "OF 4).Stop ]"
    "\nEND",
    "START TIMEOUT=9\n30 UNITS=2: Turn(90);\nWHILE (REF(30):UNITS(2).Bumped AND NOT "
    "REF(30):UNITS(1).LineEnd) [ "
    "REF(30):UNITS(1).Go(1, -2) ] END",
};

/* One of them, sometimes with a letter changed, or less of it. */
static const char *any_text(const char *text, size_t *length)
{
    char changed[1024];
    *length = strlen(text);
    memcpy(changed, text, *length);
    if (draw_chance(4)) {
        changed[draw_below((uint32_t)*length)] = "(];:x9 \n"[draw_below(8)];
    }
    *length = draw_chance(8) ? draw_below((uint32_t)*length) : *length;
    return draw_given(changed, *length);
}

static borg_text script_text(void)
{
    borg_text text;
    text.at = any_text(scripts[draw_below(2)], &text.length);
    return text;
}

static borg_script *read_script(void)
{
    static borg_script script;
    borg_problem problem;
    const char *const from = scripts[draw_below(2)];
    const borg_text text = {from, strlen(from)};
    assert_int_equal(borg_script_read(&script, &problem, &text), IRIS_OK);
    return &script;
}

/* A chunk of a script; sometimes with a byte changed. */
static const uint8_t *any_chunk(size_t *length)
{
    uint8_t chunk[BORG_CHUNK_BYTES_MAX] = {0};
    const borg_script *script = read_script();
    const int32_t group = (int32_t)draw_below((uint32_t)script->group_count);
    assert_int_equal(borg_script_decompose(chunk, sizeof chunk, length, script, group), IRIS_OK);
    const uint8_t *given = draw_given(chunk, *length);
    if (draw_chance(8)) {
        chunk[draw_below((uint32_t)*length + 1)] ^= (uint8_t)(1 << draw_below(8));
        given = draw_given(chunk, *length);
    }
    *length -= draw_chance(20) ? draw_below((uint32_t)*length + 1) : 0;
    return given;
}

static void script_read(void)
{
    const borg_text text = script_text();
    borg_script *script = OR_NULL(draw_state(NULL, sizeof *script));
    borg_problem *problem = OR_NULL(draw_state(NULL, sizeof *problem));
    const borg_text *given = OR_NULL(draw_given(&text, sizeof text));
    CALL(borg_script_read(script, problem, given));
}

static void script_format(void)
{
    const borg_text text = script_text();
    const size_t capacity = draw_below(1200);
    char *out = OR_NULL(draw_state(NULL, capacity));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    borg_script *script = OR_NULL(draw_state(NULL, sizeof *script));
    borg_problem *problem = OR_NULL(draw_state(NULL, sizeof *problem));
    const borg_text *given = OR_NULL(draw_given(&text, sizeof text));
    CALL(borg_script_format(out, capacity, length, script, problem, given));
}

static void script_decompose(void)
{
    const size_t capacity = draw_chance(3) ? BORG_CHUNK_BYTES_MAX : draw_below(200);
    const borg_script *script = OR_NULL(draw_given(read_script(), sizeof *script));
    uint8_t *chunk = OR_NULL(draw_state(NULL, capacity));
    size_t *bytes = OR_NULL(draw_results(sizeof *bytes));
    const int32_t group = draw_int(0, 1);
    CALL(borg_script_decompose(chunk, capacity, bytes, script, group));
}

static void chunk_check(void)
{
    size_t length = 0;
    const uint8_t *chunk = OR_NULL(any_chunk(&length));
    CALL(borg_chunk_check(chunk, length));
}

static void chunk_write_text(void)
{
    size_t bytes = 0;
    const uint8_t *chunk = OR_NULL(any_chunk(&bytes));
    const size_t capacity = draw_below(1000);
    char *text = OR_NULL(draw_state(NULL, capacity));
    size_t *length = OR_NULL(draw_results(sizeof *length));
    CALL(borg_chunk_write_text(text, capacity, length, chunk, bytes));
}

static void chunk_read_text(void)
{
    static const char *const texts[] = {
        "010 UNITS=1 [ Signal(START): ResetTime,LineFollow; Signal(TIME_OUT): Stop; ];",
        "20 UNITS=2 TIMEOUT=5 WHILE NOT Signal(BUMPED,10(2)): UNITS=1 [ Signal(VOTE_WIN): Go(1,2) ] ENDS 20"};
    borg_text text;
    text.at = any_text(texts[draw_below(2)], &text.length);
    const size_t capacity = draw_chance(2) ? BORG_CHUNK_BYTES_MAX : draw_below(100);
    uint8_t *chunk = OR_NULL(draw_state(NULL, capacity));
    size_t *bytes = OR_NULL(draw_results(sizeof *bytes));
    const size_t from = draw_chance(4) ? draw_below(99) : 0;
    size_t *position = OR_NULL(draw_state(&from, sizeof from));
    borg_problem *problem = OR_NULL(draw_state(NULL, sizeof *problem));
    const borg_text *given = OR_NULL(draw_given(&text, sizeof text));
    CALL(borg_chunk_read_text(chunk, capacity, bytes, position, problem, given));
}

/* ---- machines ---- */

static void machine_init(void)
{
    size_t length;
    const uint8_t *chunk = any_chunk(&length);
    borg_machine *machine = OR_NULL(draw_results(sizeof *machine));
    const int32_t unit = draw_int(1, 4);
    CALL(borg_machine_init(machine, OR_NULL(chunk), length, unit));
}

static borg_signal any_signal(void)
{
    static const uint16_t refs[] = {0, 10, 20, 30};
    return (borg_signal){(uint8_t)draw_below(BORG_SIGNAL_KINDS + draw_chance(10)), (uint8_t)draw_below(4),
                         refs[draw_below(4)], draw_int(-BORG_PLACE_MAX_MM, BORG_PLACE_MAX_MM), 7};
}

/* One that some signals have come to. */
static borg_machine *any_machine(void)
{
    borg_machine machine;
    borg_output out;
    size_t length;
    const uint8_t *chunk;
    do {
        chunk = any_chunk(&length);
    } while (borg_machine_init(&machine, chunk, length, 1) != IRIS_OK);
    for (uint32_t i = draw_below(12); i > 0; i--) {
        static const borg_signal likely[] = {{BORG_START, 1, 0, 0, 0}, {BORG_OBJ_DETECT_TRUE, 1, 10, 5, 6}};
        const borg_signal signal = draw_chance(2) ? any_signal() : likely[draw_below(2)];
        (void)borg_machine_signal(&machine, &signal);
        (void)borg_machine_step(&out, &machine, 100 * i);
    }
    return OR_NULL(draw_state(&machine, sizeof machine));
}

static void machine_signal(void)
{
    borg_machine *machine = any_machine();
    const borg_signal signal = any_signal();
    const borg_signal *given = OR_NULL(draw_given(&signal, sizeof signal));
    CALL(borg_machine_signal(machine, given));
}

static void machine_vote(void)
{
    borg_machine *machine = any_machine();
    const int32_t election = draw_int(0, 4);
    CALL(borg_machine_vote(machine, election, draw_chance(2)));
}

static void machine_step(void)
{
    borg_machine *machine = any_machine();
    borg_output *out = OR_NULL(draw_results(sizeof *out));
    const uint32_t now_ms = (uint32_t)draw_int(0, 200000);
    CALL(borg_machine_step(out, machine, now_ms));
}

/* ---- messages ---- */

static borg_message any_message(void)
{
    borg_message m = {.kind = (uint8_t)draw_below(10), .sequence = (uint16_t)draw_below(9)};
    m.from =
        (borg_address){draw_chance(9) ? 1 : 0, (uint16_t)(10 * draw_below(4)), 1, (uint8_t)draw_below(5)};
    m.is.signal = any_signal();
    return m;
}

static void message_write(void)
{
    const borg_message message = any_message();
    const borg_message *given = OR_NULL(draw_given(&message, sizeof message));
    uint8_t *bytes = OR_NULL(draw_results(BORG_MESSAGE_BYTES));
    CALL(borg_message_write(bytes, given));
}

static void message_read(void)
{
    uint8_t bytes[BORG_MESSAGE_BYTES] = {0};
    const borg_message message = any_message();
    (void)borg_message_write(bytes, &message);
    bytes[draw_below(48)] ^= (uint8_t)(draw_chance(4) ? draw_below(256) : 0);
    const size_t count = draw_chance(8) ? draw_below(48) : BORG_MESSAGE_BYTES;
    const uint8_t *given = OR_NULL(draw_given(bytes, count));
    borg_message *out = OR_NULL(draw_results(sizeof *out));
    CALL(borg_message_read(out, given, count));
}

static void election_init(void)
{
    const borg_election_config config = {{1, (uint16_t)draw_below(9), 1, (uint8_t)draw_below(6)},
                                         0,
                                         (uint8_t)draw_below(18),
                                         (uint8_t)draw_below(6)};
    const borg_election_config *given = OR_NULL(draw_given(&config, sizeof config));
    borg_election *e = OR_NULL(draw_results(sizeof *e));
    borg_bidder *bidders = OR_NULL(draw_results(BORG_ELECTION_UNITS_MAX * sizeof *bidders));
    CALL(borg_election_init(e, bidders, given, 7));
}

static void post_init(void)
{
    const borg_address me = {1, (uint16_t)draw_below(5), 1, (uint8_t)draw_below(5)};
    const borg_address *given = OR_NULL(draw_given(&me, sizeof me));
    const int32_t count = draw_int(1, 8);
    borg_post *post = OR_NULL(draw_results(sizeof *post));
    borg_sender *senders = OR_NULL(
        draw_results((size_t)(count > 0 && count <= BORG_POST_SENDERS_MAX ? count : 1) * sizeof *senders));
    CALL(borg_post_init(post, senders, count, given));
}

/* ---- members ---- */

typedef struct {
    borg_bidder *bidders;
    borg_sender *senders;
} places;

static borg_member_config any_config(places *of)
{
    borg_member_config config = {.script = 1, .incarnation = 1, .unit = (uint8_t)(1 + draw_chance(9))};
    config.chunk = any_chunk(&config.bytes);
    config.bidder_count = draw_chance(8) ? draw_within(-1, 4) : 8;
    config.sender_count = draw_chance(8) ? draw_within(-1, 4) : 4;
    of->bidders = draw_state(NULL, 8 * sizeof *of->bidders);
    of->senders = draw_state(NULL, 4 * sizeof *of->senders);
    config.bidders = OR_NULL(of->bidders);
    config.senders = OR_NULL(of->senders);
    return config;
}

static void member_init(void)
{
    places of;
    const borg_member_config config = any_config(&of);
    borg_member *member = OR_NULL(draw_results(sizeof *member));
    const borg_member_config *given = OR_NULL(draw_given(&config, sizeof config));
    CALL(borg_member_init(member, given, 7));
}

static borg_member *any_member(void)
{
    borg_member member;
    borg_member_config config;
    iris_order order;
    places of;
    do {
        config = any_config(&of);
    } while (borg_member_init(&member, &config, 7) != IRIS_OK);
    if (draw_chance(2)) {
        (void)borg_member_start(&member);
    }
    while (draw_chance(2) && borg_member_order_next(&member, &order)) {
    }
    return OR_NULL(draw_state(&member, sizeof member));
}

static void member_start(void)
{
    borg_member *member = any_member();
    CALL(borg_member_start(member));
}

static void member_place(void)
{
    borg_member *member = any_member();
    const int32_t x = draw_int(-BORG_PLACE_MAX_MM, BORG_PLACE_MAX_MM), battery = draw_int(0, 100);
    CALL(borg_member_place(member, x, -7, battery));
}

static iris_status send_away(void *context, const uint8_t *bytes, size_t count)
{
    return context || !bytes || count != BORG_MESSAGE_BYTES ? IRIS_ERR_ARG : IRIS_OK;
}

static int messages_left;
static iris_status receive_any(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    borg_message message = any_message();
    message.from.script = 1;
    *count = 0;
    if (!context && capacity >= BORG_MESSAGE_BYTES && messages_left-- > 0) {
        *count = borg_message_write(bytes, &message) == IRIS_OK ? BORG_MESSAGE_BYTES : 0;
    }
    return IRIS_OK;
}

static void member_step(void)
{
    const borg_transport transport = {send_away, receive_any, NULL};
    borg_member *member = any_member();
    const borg_transport *given = OR_NULL(draw_given(&transport, sizeof transport));
    const uint32_t now_ms = (uint32_t)draw_int(0, 200000);
    messages_left = 5;
    CALL(borg_member_step(member, given, now_ms));
}

static void member_event(void)
{
    borg_member *member = any_member();
    const iris_event event = {(iris_event_kind)draw_below(IRIS_EVENT_KINDS),
                              draw_int(-BORG_PLACE_MAX_MM, BORG_PLACE_MAX_MM), 3};
    const iris_event *given = OR_NULL(draw_given(&event, sizeof event));
    CALL(borg_member_event(member, given));
}

static void bus_init(void)
{
    const int32_t depth = draw_int(1, 4), end_count = draw_int(1, 4);
    borg_bus *bus = OR_NULL(draw_results(sizeof *bus));
    borg_bus_datagram *ring =
        OR_NULL(draw_results(sizeof *ring * (size_t)(depth > 0 && depth < 9 ? depth : 9)));
    borg_bus_end *ends =
        OR_NULL(draw_results(sizeof *ends * (size_t)(end_count > 0 && end_count < 9 ? end_count : 9)));
    if (depth < 9 && end_count < 9) { /* what is there */
        CALL(borg_bus_init(bus, ring, depth, ends, end_count));
    } else {
        CALL(borg_bus_init(NULL, ring, depth, ends, end_count));
    }
}

static void bus_transport(void)
{
    borg_bus *bus = draw_state(NULL, sizeof *bus);
    borg_bus_datagram *ring = draw_state(NULL, sizeof *ring * 4);
    borg_bus_end *ends = draw_state(NULL, sizeof *ends * 4);
    (void)borg_bus_init(bus, ring, 4, ends, 4);
    borg_transport *transport = OR_NULL(draw_results(sizeof *transport));
    const int32_t end = draw_int(0, 3);
    CALL(borg_bus_transport(transport, OR_NULL(bus), end));
}

const random_call calls_borg[] = {
    {"borg_script_read", script_read},           {"borg_script_format", script_format},
    {"borg_script_decompose", script_decompose}, {"borg_chunk_check", chunk_check},
    {"borg_chunk_write_text", chunk_write_text}, {"borg_chunk_read_text", chunk_read_text},
    {"borg_machine_init", machine_init},         {"borg_machine_signal", machine_signal},
    {"borg_machine_vote", machine_vote},         {"borg_machine_step", machine_step},
    {"borg_message_write", message_write},       {"borg_message_read", message_read},
    {"borg_election_init", election_init},       {"borg_post_init", post_init},
    {"borg_member_init", member_init},           {"borg_member_start", member_start},
    {"borg_member_place", member_place},         {"borg_member_step", member_step},
    {"borg_member_event", member_event},         {"borg_bus_init", bus_init},
    {"borg_bus_transport", bus_transport},       {NULL, NULL},
};
