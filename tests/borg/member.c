#include "iris/borg/member.h"

#include "iris/borg/in_process.h"
#include "iris/borg/script.h"
#include "test.h"

enum { TEAM = 5, STEP_MS = 48, DEPTH = 64 };

/* One robot: it is where it was put, reaches what it goes to after 10 s, and keeps what it was told. */
typedef struct {
    borg_member member;
    borg_bidder bidders[4];
    borg_sender senders[TEAM - 1];
    borg_transport bus, lossy;
    int32_t x, y;
    uint32_t go_ms;
    int alive, goes, gos, stops, explores, follows, attends;
    iris_order last;
} robot;

static robot team[TEAM];
static uint8_t chunks[2][BORG_CHUNK_BYTES_MAX];
static size_t lengths[2];
static borg_bus bus;
static borg_bus_datagram ring[DEPTH];
static borg_bus_end ends[TEAM];
static uint32_t now_ms, noise, loss_percent;
static int most_at_once, takes_way, network_is_away;

static uint32_t draw(uint32_t end)
{
    noise = noise * 1664525u + 1013904223u;
    return (noise >> 8) % end;
}

static iris_status lossy_send(void *context, const uint8_t *bytes, size_t count)
{
    robot *r = context;
    iris_status status = network_is_away ? IRIS_ERR_IO : IRIS_OK;
    for (int copies = network_is_away || draw(100) < loss_percent ? 0
                      : draw(100) < loss_percent                  ? 2
                                                                  : 1;
         copies > 0; copies--) {
        status = r->bus.send(r->bus.context, bytes, count);
    }
    return status;
}

/* At each end again: not all hear what one sends. */
static iris_status lossy_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    robot *r = context;
    iris_status status;
    if (network_is_away) {
        *count = 0;
        return IRIS_ERR_IO;
    }
    do {
        status = r->bus.receive(r->bus.context, bytes, capacity, count);
    } while (status == IRIS_OK && *count > 0 && draw(100) < loss_percent / 4);
    return status;
}

static const char example[] =
    "000 START\n010 UNITS=1: LineFollow,ObjDetect;\n020 UNITS=4: AutoExplore, MapBuild;\n"
    "030 IF (REF(10):UNITS(1).ObjDetect==TRUE)\n040 [\n"
    "050  REF(20):UNITS(2 OF 4).Go(REF(10):UNITS(1).Target);\n060 ]\n"
    "070 IF (REF(10):UNITS(1).TimeOut==TRUE)\n080 [\n090  REF(10):UNITS(1).Stop\n"
    "100  REF(20):UNITS(4 OF 4).Stop\n110 ]\n120 END\n";

static borg_member_config config_of(int i)
{
    const int group = i > 0;
    return (borg_member_config){.chunk = chunks[group],
                                .bytes = lengths[group],
                                .script = 77,
                                .incarnation = 9,
                                .unit = (uint8_t)(group ? i : 1),
                                .bidders = team[i].bidders,
                                .bidder_count = 4,
                                .senders = team[i].senders,
                                .sender_count = TEAM - 1};
}

static void gather(uint32_t seed, uint32_t loss)
{
    static borg_script script;
    static const int32_t places[TEAM][2] = {{0, 0}, {9000, 0}, {2000, 1000}, {-7000, 2000}, {3000, -500}};
    borg_problem problem;
    const borg_text of = {example, sizeof example - 1};
    noise = seed;
    loss_percent = loss;
    most_at_once = 0;
    takes_way = 10000;
    now_ms = 0u - 30000; /* the clock wraps within the mission */
    assert_int_equal(borg_script_read(&script, &problem, &of), IRIS_OK);
    assert_int_equal(borg_bus_init(&bus, ring, DEPTH, ends, TEAM), IRIS_OK);
    for (int g = 0; g < 2; g++) {
        assert_int_equal(borg_script_decompose(chunks[g], sizeof chunks[g], &lengths[g], &script, g),
                         IRIS_OK);
    }
    memset(team, 0, sizeof team);
    for (int i = 0; i < TEAM; i++) {
        robot *r = &team[i];
        const borg_member_config config = config_of(i);
        assert_int_equal(borg_bus_transport(&r->bus, &bus, i), IRIS_OK);
        r->lossy = (borg_transport){lossy_send, lossy_receive, r};
        r->x = places[i][0];
        r->y = places[i][1];
        r->alive = 1;
        assert_int_equal(borg_member_init(&r->member, &config, now_ms), IRIS_OK);
        assert_string_equal(borg_member_state(&r->member), "waiting");
    }
}

static void obey(robot *r, const iris_order *order)
{
    assert_int_equal(iris_order_check(order), IRIS_OK);
    r->last = *order;
    switch (order->verb) {
    case IRIS_ORDER_GO_TO:
        r->goes = 1;
        r->gos++;
        r->go_ms = now_ms;
        break;
    case IRIS_ORDER_STOP:
        r->stops++;
        break;
    case IRIS_ORDER_EXPLORE:
        r->explores++;
        break;
    case IRIS_ORDER_FOLLOW_LINE:
        r->follows++;
        break;
    default:
        r->attends += iris_order_attends(order->verb);
        break;
    }
    r->goes &= order->verb != IRIS_ORDER_STOP;
}

/* Until so many milliseconds have passed. */
static void go_on(uint32_t for_ms)
{
    for (uint32_t passed = 0; passed < for_ms; passed += STEP_MS, now_ms += STEP_MS) {
        int at_once = 0;
        for (int i = 0; i < TEAM; i++) {
            robot *r = &team[i];
            iris_order order;
            if (!r->alive) {
                continue;
            }
            assert_int_equal(borg_member_place(&r->member, r->x, r->y, 100 - i), IRIS_OK);
            assert_int_equal(borg_member_step(&r->member, &r->lossy, now_ms),
                             network_is_away ? IRIS_ERR_IO : IRIS_OK);
            while (borg_member_order_next(&r->member, &order)) {
                obey(r, &order);
            }
            if (r->goes && r->last.verb == IRIS_ORDER_GO_TO && now_ms - r->go_ms >= (uint32_t)takes_way) {
                const iris_event reached = {IRIS_EVENT_REACHED, r->last.a, r->last.b};
                r->last.verb = IRIS_ORDER_NONE;
                assert_int_equal(borg_member_event(&r->member, &reached), IRIS_OK);
            }
            at_once += r->goes;
        }
        most_at_once = at_once > most_at_once ? at_once : most_at_once;
    }
}

static void start_all(void)
{
    for (int i = 0; i < TEAM; i++) {
        assert_int_equal(borg_member_start(&team[i].member), IRIS_OK);
    }
}

static void tell(int i, iris_event_kind kind, int32_t x, int32_t y)
{
    const iris_event event = {kind, x, y};
    assert_int_equal(borg_member_event(&team[i].member, &event), IRIS_OK);
}

static void states_are(const char *const words[TEAM])
{
    for (int i = 0; i < TEAM; i++) {
        assert_string_equal(borg_member_state(&team[i].member), words[i]);
    }
}

/* The object is at (3000, 1000): of the explorers, the second and the fourth are the nearest. */
static void mission(uint32_t seed, uint32_t loss)
{
    static const char *const begun[] = {"following", "exploring", "exploring", "exploring", "exploring"};
    static const char *const going[] = {"following", "exploring", "going", "exploring", "going"};
    static const char *const there[] = {"following", "exploring", "reached", "exploring", "reached"};
    static const char *const ended[] = {"stopped", "stopped", "reached", "stopped", "reached"};
    gather(seed, loss);
    go_on(2000);
    start_all();
    go_on(20000);
    states_are(begun);
    tell(0, IRIS_EVENT_OBJECT_DETECTED, 3000, 1000);
    go_on(6000);
    states_are(going);
    assert_int_equal(team[2].last.a, 3000);
    assert_int_equal(team[2].last.b, 1000);
    go_on(12000);
    states_are(there);
    for (int i = 0; i < TEAM; i++) {
        assert_int_equal(borg_member_clock_runs(&team[i].member), 1);
    }
    go_on(62000);
    states_are(ended);
    for (int i = 0; i < TEAM; i++) {
        assert_int_equal(borg_member_clock_runs(&team[i].member), 0);
    }
    for (int i = 0; i < TEAM; i++) {
        assert_int_equal(team[i].gos, i == 2 || i == 4);
        assert_int_equal(team[i].follows, i == 0);
        assert_int_equal(team[i].explores, i > 0);
        assert_true(team[i].stops > 0);
    }
    assert_int_equal(most_at_once, 2);
}

static void without_loss(void **state)
{
    (void)state;
    mission(1, 0);
}

static void with_loss_and_duplicates(void **state)
{
    (void)state;
    mission(1, 20);
    mission(2, 20);
    mission(3, 40);
}

/* A winner whose way fails is replaced; one that is silent, too. */
static void winners_are_replaced(void **state)
{
    (void)state;
    gather(5, 10);
    takes_way = 100000;
    go_on(6000);
    start_all();
    go_on(1000);
    tell(0, IRIS_EVENT_OBJECT_DETECTED, 3000, 1000);
    go_on(6000);
    assert_string_equal(borg_member_state(&team[2].member), "going");
    tell(2, IRIS_EVENT_FAILED, IRIS_ORDER_GO_TO, IRIS_ERR_IO);
    go_on(4000);
    assert_string_equal(borg_member_state(&team[2].member), "stopped");
    assert_string_equal(borg_member_state(&team[1].member), "going");
    assert_int_equal(most_at_once, 2);
    team[4].alive = team[4].goes = 0;
    go_on(9000);
    assert_string_equal(borg_member_state(&team[3].member), "going");
    assert_int_equal(most_at_once, 2);
    start_all(); /* anew: nobody is a winner any longer */
    go_on(500);
    assert_string_equal(borg_member_state(&team[1].member), "exploring");
    assert_string_equal(borg_member_state(&team[3].member), "exploring");
    tell(0, IRIS_EVENT_OBJECT_DETECTED, 9000, 0);
    go_on(9000);
    assert_int_equal(team[1].last.a, 9000);
    assert_int_equal(team[2].last.a, 9000);
    assert_int_equal(team[3].gos, 1);
}

/* What is seen while there is no network is told when there is one again, after however long. */
static void a_network_comes_back(void **state)
{
    (void)state;
    gather(6, 10);
    go_on(6000);
    start_all();
    go_on(1000);
    network_is_away = 1;
    go_on(1000);
    tell(0, IRIS_EVENT_OBJECT_DETECTED, 3000, 1000);
    go_on(30000);
    assert_int_equal(most_at_once, 0);
    network_is_away = 0;
    go_on(6000);
    assert_string_equal(borg_member_state(&team[2].member), "going");
    assert_string_equal(borg_member_state(&team[4].member), "going");
    assert_int_equal(most_at_once, 2);
}

/* What another script's machines say, and noise, is of no interest; a machine with the same number is noticed. */
static void others_are_not_heard(void **state)
{
    (void)state;
    gather(1, 0);
    borg_member_config config = config_of(0);
    config.script = 78;
    assert_int_equal(borg_member_init(&team[0].member, &config, now_ms), IRIS_OK);
    go_on(6000);
    start_all();
    tell(0, IRIS_EVENT_OBJECT_DETECTED, 1, 2);
    uint8_t bytes[BORG_DATAGRAM_BYTES_MAX];
    for (int i = 0; i < 50; i++) {
        for (size_t j = 0; j < sizeof bytes; j++) {
            bytes[j] = (uint8_t)draw(256);
        }
        assert_int_equal(team[0].bus.send(team[0].bus.context, bytes, 1 + draw(sizeof bytes)), IRIS_OK);
    }
    go_on(8000);
    for (int i = 1; i < TEAM; i++) {
        assert_string_equal(borg_member_state(&team[i].member), "exploring");
        assert_int_equal(team[i].member.elsewhere, 0);
    }
    borg_message twin = {.kind = BORG_MESSAGE_DEATH, .from = team[1].member.me};
    twin.from.incarnation++;
    assert_int_equal(borg_message_write(bytes, &twin), IRIS_OK);
    assert_int_equal(team[0].bus.send(team[0].bus.context, bytes, sizeof bytes), IRIS_OK);
    go_on(100);
    assert_int_equal(team[1].member.elsewhere, 1);
}

/* START: this action alone, by hand. */
static size_t chunk_of(uint8_t verb, int32_t a, int32_t b)
{
    static const uint8_t head[] = {'B', 'C', 1, 1, 10, 0, 60, 0, 0, 0, 1, 0, 0,
                                   0,   0,   0, 0, 0,  4, 0,  0, 0, 0, 0, 1};
    static const uint8_t lengths_of[] = {2, 0, 2, 0, 8, 4, 2, 0, 0};
    const size_t n = lengths_of[verb], bytes = sizeof head + 2 + n;
    uint8_t *c = chunks[0];
    uint32_t sum = 2166136261u;
    memcpy(c, head, sizeof head);
    c[8] = (uint8_t)bytes;
    c[16 + 3] = (uint8_t)(2 + n);
    c[25] = verb;
    c[26] = 0;
    for (size_t j = 0; j < n; j++) {
        c[27 + j] = (uint8_t)((uint32_t)(j >= 4 ? b : a) >> 8 * (j % 4));
    }
    for (size_t j = 0; j < bytes; j++) {
        sum = j >= 12 && j < 16 ? sum : (sum ^ c[j]) * 16777619u;
    }
    for (int j = 0; j < 4; j++) {
        c[12 + j] = (uint8_t)(sum >> 8 * j);
    }
    return bytes;
}

static void events_and_states(void **state)
{
    (void)state;
    static const struct {
        uint8_t verb;
        int32_t a, b;
        iris_order_verb order;
        int32_t order_a, order_b;
        const char *word;
    } all[] = {{BORG_OBJ_DETECT, 0, 0, IRIS_ORDER_DETECT, 0, 0, "detecting"},
               {BORG_MAP_BUILD, 0, 0, IRIS_ORDER_MAP, 0, 0, "mapping"},
               {BORG_LINE_FOLLOW, 65535, 0, IRIS_ORDER_FOLLOW_LINE, 16000, 0, "following"},
               {BORG_OBJ_DETECT, 0, 0, IRIS_ORDER_DETECT, 0, 0, "following"},
               {BORG_AUTO_EXPLORE, 250, 0, IRIS_ORDER_EXPLORE, 250, 0, "exploring"},
               {BORG_MAP_BUILD, 0, 0, IRIS_ORDER_MAP, 0, 0, "exploring"},
               {BORG_TURN, 90, 0, IRIS_ORDER_TURN, 16384, 0, "turning"},
               {BORG_TURN, -1, 0, IRIS_ORDER_TURN, -182, 0, "turning"},
               {BORG_TURN, 1, 0, IRIS_ORDER_TURN, 182, 0, "turning"},
               {BORG_TURN, -32768, 0, IRIS_ORDER_TURN, -5965232, 0, "turning"},
               {BORG_TURN, 32767, 0, IRIS_ORDER_TURN, 5965050, 0, "turning"},
               {BORG_GO, -5, 10000000, IRIS_ORDER_GO_TO, -5, 10000000, "going"},
               {BORG_RESET_TIME, 0, 0, IRIS_ORDER_RESET_TIME, 0, 0, "going"},
               {BORG_STOP, 0, 0, IRIS_ORDER_STOP, 0, 0, "stopped"}};
    gather(1, 0);
    borg_member *m = &team[0].member;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const size_t bytes = chunk_of(all[i].verb, all[i].a, all[i].b);
        borg_member_config config = config_of(0);
        config.bytes = bytes;
        const uint8_t was = m->state;
        iris_order order;
        assert_int_equal(borg_member_init(m, &config, now_ms), IRIS_OK);
        m->state = was;
        assert_int_equal(borg_member_start(m), IRIS_OK);
        assert_int_equal(borg_member_order_next(m, &order), 1);
        assert_int_equal(order.verb, all[i].order);
        assert_int_equal(order.a, all[i].order_a);
        assert_int_equal(order.b, all[i].order_b);
        assert_int_equal(iris_order_check(&order), IRIS_OK);
        assert_int_equal(borg_member_order_next(m, &order), 0);
        assert_string_equal(borg_member_state(m), all[i].word);
    }
}

static void wrong_calls(void **state)
{
    (void)state;
    iris_order order;
    const iris_event far = {IRIS_EVENT_OBJECT_DETECTED, BORG_PLACE_MAX_MM + 1, 0};
    gather(1, 0);
    borg_member *m = &team[1].member;
    borg_member_config config = config_of(1);
    assert_int_equal(borg_member_init(NULL, &config, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_member_init(m, NULL, 0), IRIS_ERR_ARG);
    config.bidder_count = 3;
    assert_int_equal(borg_member_init(m, &config, 0), IRIS_ERR_RANGE);
    config.bidder_count = 4;
    config.bidders = NULL;
    assert_int_equal(borg_member_init(m, &config, 0), IRIS_ERR_ARG);
    config.bidders = team[1].bidders;
    config.unit = 5;
    assert_int_equal(borg_member_init(m, &config, 0), IRIS_ERR_RANGE);
    config.unit = 1;
    config.sender_count = 0;
    assert_int_equal(borg_member_init(m, &config, 0), IRIS_ERR_ARG);
    config.sender_count = BORG_POST_SENDERS_MAX + 1;
    assert_int_equal(borg_member_init(m, &config, 0), IRIS_ERR_RANGE);
    config.sender_count = 4;
    config.bytes--;
    assert_int_equal(borg_member_init(m, &config, 0), IRIS_ERR_TRUNCATED);
    assert_int_equal(borg_member_start(NULL), IRIS_ERR_ARG);
    assert_int_equal(borg_member_place(NULL, 0, 0, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_member_place(m, 0, BORG_PLACE_MAX_MM + 1, 0), IRIS_ERR_RANGE);
    assert_int_equal(borg_member_place(m, INT32_MIN, 0, 0), IRIS_ERR_RANGE);
    assert_int_equal(borg_member_place(m, 0, 0, 101), IRIS_ERR_RANGE);
    assert_int_equal(borg_member_step(NULL, &team[1].bus, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_member_step(m, NULL, 0), IRIS_ERR_ARG);
    assert_int_equal(borg_member_order_next(NULL, &order), 0);
    assert_int_equal(borg_member_order_next(m, NULL), 0);
    assert_int_equal(borg_member_event(NULL, &far), IRIS_ERR_ARG);
    assert_int_equal(borg_member_event(m, NULL), IRIS_ERR_ARG);
    assert_int_equal(borg_member_event(m, &far), IRIS_ERR_RANGE);
    assert_string_equal(borg_member_state(NULL), "waiting");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_loss),         cmocka_unit_test(with_loss_and_duplicates),
        cmocka_unit_test(winners_are_replaced), cmocka_unit_test(others_are_not_heard),
        cmocka_unit_test(events_and_states),    cmocka_unit_test(wrong_calls),
        cmocka_unit_test(a_network_comes_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
