/* Runs any bytes that pass as a chunk: bytes as they come with their check made right, or chunks of the report with some
 * bytes changed; with signals, votes, events, messages, and times from the input. Neither a machine nor a member of a
 * team leaves its memory, gives what nobody knows, or goes on for ever.
 */
#include <stdlib.h>
#include <string.h>

#include "iris/borg/chunk_text.h"
#include "iris/borg/member.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

static const char *const known[] = {
    "010 UNITS=1 [ Signal(START): ResetTime,LineFollow,ObjDetect;"
    "Signal(OBJ_DETECT_TRUE,010): ResetTime,Multicast(OBJ_DETECT_TRUE,010); Signal(TIME_OUT): Stop; ]",
    "020 UNITS=4 TIMEOUT=1 [ Signal(START): ResetTime,AutoExplore,MapBuild; Signal(OBJ_DETECT_TRUE,010): "
    "UNITS=2"
    "[ Signal(VOTE_WIN): ResetTime,Go(OBJ_DETECT_TRUE.Target,010(1)); Signal(REACHED): Stop; ]; "
    "Signal(TIME_OUT): Stop; ]",
    "020 UNITS=3 [ WHILE Signal(BUMPED,20(2)) AND NOT Signal(REACHED) OR Signal(OBJ_DETECT_TRUE,30): UNITS=1"
    "[ WHILE Signal(VOTE_WIN): Turn(9),Multicast(REACHED,20); Signal(VOTE_LOST): UNITS(2).Stop; ]"
    "WHILE NOT Signal(OBJ_DETECT_TRUE,20(3)): Go(OBJ_DETECT_TRUE.Target,20(2)),Go(5,-6),ResetTime;"
    "WHILE Signal(START): UNITS=3 [ Signal(VOTE_WIN): LineFollow(9); ] WHILE Signal(STOPPED): Stop; ]",
};
enum { KNOWN = sizeof known / sizeof known[0], UNITS = BORG_ELECTION_UNITS_MAX, TURNS_MAX = 20000 };

typedef struct {
    const uint8_t *at, *end;
} source;

static uint8_t next(source *s)
{
    return (uint8_t)(s->at < s->end ? *s->at++ : 0);
}

static void expect(int good)
{
    if (!good) {
        abort();
    }
}

static void repair(uint8_t *chunk, size_t bytes)
{
    uint32_t sum = 2166136261u;
    memcpy(chunk, "BC\1", 3);
    chunk[8] = (uint8_t)bytes;
    chunk[9] = (uint8_t)(bytes >> 8);
    chunk[11] = 0;
    for (size_t i = 0; i < bytes; i++) {
        sum = i >= 12 && i < 16 ? sum : (sum ^ chunk[i]) * 16777619u;
    }
    for (int i = 0; i < 4; i++) {
        chunk[12 + i] = (uint8_t)(sum >> 8 * i);
    }
}

/* How long it is; 0: none. */
static size_t make_chunk(uint8_t chunk[BORG_CHUNK_BYTES_MAX], source *s)
{
    const uint8_t which = next(s);
    size_t length = 0, position = 0;
    if (which % (KNOWN + 1) == KNOWN) {
        length = next(s) * 2u;
        for (size_t i = 0; i < length; i++) {
            chunk[i] = next(s);
        }
    } else {
        borg_problem problem;
        const char *const text = known[which % (KNOWN + 1)];
        const borg_text of = {text, strlen(text)};
        expect(borg_chunk_read_text(chunk, BORG_CHUNK_BYTES_MAX, &length, &position, &problem, &of) ==
               IRIS_OK);
        for (int changes = next(s) % 8; changes > 0; changes--) {
            const size_t at = next(s);
            chunk[at < length ? at : 3] = next(s);
        }
    }
    if (length >= BORG_CHUNK_HEADER_BYTES) {
        repair(chunk, length);
    }
    return borg_chunk_check(chunk, length) == IRIS_OK ? length : 0;
}

static borg_signal any_signal(source *s)
{
    static const uint16_t refs[] = {0, 10, 20, 30, 65535};
    const borg_signal signal = {(uint8_t)(next(s) % (BORG_SIGNAL_KINDS + 1)), (uint8_t)(next(s) % 6),
                                refs[next(s) % 5], (int8_t)next(s) * 100000, (int8_t)next(s)};
    return signal;
}

static void run_machine(const uint8_t *chunk, size_t length, source s)
{
    borg_machine m;
    uint32_t now_ms = 0;
    if (borg_machine_init(&m, chunk, length, 1 + next(&s) % 4) != IRIS_OK) {
        return;
    }
    while (s.at < s.end) {
        const uint8_t what = next(&s);
        borg_signal signal = any_signal(&s);
        borg_output out;
        int turns = 0;
        signal.kind = what % 16 == 0 ? BORG_START : signal.kind;
        (void)borg_machine_signal(&m, &signal);
        if (what % 3 == 0) {
            (void)borg_machine_vote(&m, signal.unit, what & 1);
        }
        now_ms += 1u << what % 32;
        do {
            expect(borg_machine_step(&out, &m, now_ms) == IRIS_OK && ++turns < TURNS_MAX);
            expect(out.what <= BORG_DO_ELECT && m.seen_count <= BORG_SEEN_MAX &&
                   m.waiting_count <= BORG_WAITING_MAX);
            expect(out.what != BORG_DO_ACTION ||
                   (out.action.verb < BORG_MULTICAST && out.action.verb != BORG_GO_TARGET));
            expect(out.what != BORG_DO_MULTICAST || out.signal.kind < BORG_SIGNAL_KINDS);
            expect(out.what != BORG_DO_ELECT || (out.winners > 0 && borg_machine_is_open(&m, out.election)));
        } while (out.what != BORG_DO_NOTHING && what % 5);
    }
}

static iris_status nowhere(void *context, const uint8_t *bytes, size_t count)
{
    borg_message message;
    expect(context && borg_message_read(&message, bytes, count) == IRIS_OK);
    return IRIS_OK;
}

/* Messages of the team, right but for what they say. */
static iris_status anything(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    source *const s = context;
    const uint8_t what = next(s);
    borg_message m = {.kind = (uint8_t)(what % 8 + 1), .sequence = next(s)};
    *count = 0;
    if (s->at >= s->end || what >= 128 || capacity < BORG_MESSAGE_BYTES) {
        return what == 255 ? IRIS_ERR_IO : IRIS_OK;
    }
    m.from = (borg_address){5, next(s) % 2 ? 10 : 20, next(s) % 3, (uint8_t)(1 + next(s) % 4)};
    if (m.kind == BORG_MESSAGE_SIGNAL) {
        m.is.signal = any_signal(s);
    } else {
        for (size_t i = 0; i < 16; i++) {
            ((uint8_t *)&m.is)[i] = next(s);
        }
    }
    *count = borg_message_write(bytes, &m) == IRIS_OK ? BORG_MESSAGE_BYTES : 0;
    return IRIS_OK;
}

static void run_member(const uint8_t *chunk, size_t length, source s)
{
    borg_bidder bidders[2 * UNITS];
    borg_sender senders[3];
    borg_member member;
    uint32_t now_ms = 0;
    const borg_transport transport = {nowhere, anything, &s};
    const borg_member_config config = {chunk,   length,    5,       1, (uint8_t)(1 + next(&s) % 4),
                                       bidders, 2 * UNITS, senders, 3};
    if (borg_member_init(&member, &config, now_ms) != IRIS_OK) {
        return;
    }
    while (s.at < s.end) {
        const uint8_t what = next(&s);
        const iris_event event = {(iris_event_kind)(next(&s) % IRIS_EVENT_KINDS), (int8_t)next(&s) * 100000,
                                  next(&s)};
        iris_order order;
        int turns = 0;
        if (what % 16 == 0) {
            (void)borg_member_start(&member);
        }
        (void)borg_member_event(&member, &event);
        (void)borg_member_place(&member, event.x, event.y, what % 128);
        now_ms += 1u << what % 20;
        (void)borg_member_step(&member, &transport, now_ms);
        while (borg_member_order_next(&member, &order)) {
            expect(iris_order_check(&order) == IRIS_OK && ++turns < TURNS_MAX);
        }
        expect(borg_member_state(&member) != NULL);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    uint8_t room[BORG_CHUNK_BYTES_MAX];
    source s = {data, data + bytes};
    const size_t length = make_chunk(room, &s);
    if (length > 0) {
        uint8_t *const chunk = malloc(length);
        memcpy(chunk, room, length);
        run_machine(chunk, length, s);
        run_member(chunk, length, s);
        free(chunk);
    }
    return 0;
}
