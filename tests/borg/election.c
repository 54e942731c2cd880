/* Machines that choose over a network which loses half of all messages; one of them crashes, comes late, or is cut off.
 */
#include "iris/borg/election.h"

#include <stdio.h>

#include "borg/lossy_network.h"
#include "test.h"

/* An emulator or the sanitizers take a while for as many. */
#if defined(__x86_64__) && !defined(_WIN32) && !defined(IRIS_CHECKED)
enum { RUNS = 10000 };
#elif defined(__linux__) || defined(_WIN32)
enum { RUNS = 1000 };
#else
enum { RUNS = 60 };
#endif

enum { UNITS_MAX = 8, STEP_MS = 20, BEGIN_MS = 5000, CRASH_STEPS = 400, LOSSES = 3 };
enum { NEVER = INT32_MAX };

typedef struct {
    borg_election e;
    borg_bidder bidders[UNITS_MAX];
    uint32_t clock;   /* its own, ahead of the world's, */
    int32_t drift;    /* and so many thousandths faster */
    int32_t boots_at; /* when it starts, and starts again */
    int32_t begins_at;
    uint16_t incarnation;
    int is_on, acted;
    int32_t graced_since[UNITS_MAX];
} machine;

static struct {
    lossy_network net;
    machine machines[UNITS_MAX];
    int32_t n, k, now;
    int32_t crash_at, crash_unit; /* below 0: one that acts, or the first of them */
    int32_t part_at, heal_at;
    int links_fail;  /* each for itself, in one direction: there are no parts */
    int32_t forgets; /* a machine that keeps no promise; -1: none */
    int32_t sent, begun;
    int32_t reached_at, sent_until; /* when k acted for the first time */
    const char *wrong;
} world;

static int32_t below(int32_t end)
{
    return (int32_t)net_below(&world.net, (uint32_t)end);
}

static uint32_t clock_of(const machine *m)
{
    return (uint32_t)(world.now + world.now / 1000 * m->drift) + m->clock;
}

static void boot(int32_t i)
{
    machine *m = &world.machines[i];
    const borg_election_config config = {
        {77, 20, ++m->incarnation, (uint8_t)(i + 1)}, 1, (uint8_t)world.n, (uint8_t)world.k};
    assert_int_equal(borg_election_init(&m->e, m->bidders, &config, clock_of(m)), IRIS_OK);
    m->is_on = 1;
    m->acted = 0;
    if (m->begins_at <= world.now && world.now > 0) {
        m->begins_at = world.now + below(1500); /* the signal is repeated to it */
    }
}

static int acts(int32_t i)
{
    return world.machines[i].is_on && borg_election_won(&world.machines[i].e);
}

/* ---- what must hold at every step ---- */

/* Of those that know x to be alive, and are not in grace, at most k act: whatever was lost. */
static void check_promise(void)
{
    for (int32_t x = 0; x < world.n; x++) {
        int32_t count = acts(x);
        for (int32_t i = 0; i < world.n; i++) {
            const borg_election *e = &world.machines[i].e;
            count += i != x && acts(i) && ((e->alive & ~e->graced) >> x & 1);
        }
        if (count > world.k) {
            world.wrong = "more act than one that they know could grant";
        }
    }
}

/* Who has the grant of another one has its promise, unless that one has started anew. */
static void check_leases(void)
{
    for (int32_t i = 0; i < world.n; i++) {
        const machine *m = &world.machines[i];
        for (int32_t x = 0; x < world.n; x++) {
            const machine *other = &world.machines[x];
            const int same = m->bidders[x].incarnation == other->incarnation && m->e.known >> x & 1;
            if (m->is_on && i != x && other->is_on && same && (m->e.granted >> x & 1) &&
                !(other->e.promised >> i & 1)) {
                world.wrong = "a grant is held longer than it is promised";
            }
        }
    }
}

/* Nobody is in grace for longer than GRACE. */
static void check_grace(void)
{
    for (int32_t i = 0; i < world.n; i++) {
        machine *m = &world.machines[i];
        for (int32_t x = 0; x < world.n; x++) {
            if (!m->is_on || !(m->e.graced >> x & 1)) {
                m->graced_since[x] = world.now;
            } else if (world.now - m->graced_since[x] > 2 * BORG_ELECTION_GRACE_MS) {
                world.wrong = "one is in grace for too long";
            }
        }
    }
}

/* Nobody begins to act who has heard of k others that do. */
static void check_beginners(void)
{
    for (int32_t i = 0; i < world.n; i++) {
        machine *m = &world.machines[i];
        int32_t others = 0;
        for (int32_t x = 0; x < world.n; x++) {
            others += x != i && (m->e.alive >> x & 1) && m->bidders[x].kind == BORG_MESSAGE_ACT;
        }
        if (acts(i) && !m->acted && others >= world.k) {
            world.wrong = "one begins beside k that act";
        }
        world.begun += acts(i) && !m->acted;
        m->acted = acts(i);
    }
}

/* In each part that is connected at most k act; those that were apart may need until the end of GRACE. */
static void check_parts(void)
{
    const int32_t healing = world.now - world.heal_at;
    int32_t count[2] = {0, 0};
    for (int32_t i = 0; i < world.n; i++) {
        count[world.net.part[i]] += acts(i);
    }
    const int heals = healing >= 0 && healing <= BORG_ELECTION_GRACE_MS + BORG_ELECTION_ALIVE_MS;
    const int32_t most = heals ? 2 * world.k : world.k;
    if (count[0] > most || count[1] > most) {
        world.wrong = "more than k act";
    }
}

/* ---- a run ---- */

static void turn_of_events(void)
{
    if (world.now == world.crash_at) {
        int32_t who = world.crash_unit;
        for (int32_t i = 0; i < world.n && who < 0; i++) {
            who = acts(i) ? i : who;
        }
        who = who < 0 ? 0 : who;
        world.machines[who].is_on = 0;
        if (below(2)) {
            world.machines[who].boots_at = world.now + STEP_MS * (1 + below(400));
        }
    }
    if (world.now == world.part_at) {
        for (int32_t i = 0; i < world.n; i++) {
            world.net.part[i] = (uint8_t)below(2);
        }
    }
    if (world.now == world.heal_at) {
        memset(world.net.part, 0, sizeof world.net.part);
    }
    if (world.links_fail > 0 && below(40) == 0) {
        world.net.deaf[below(world.n)] ^= (uint16_t)(1u << below(world.n));
    }
}

static void machine_step(int32_t i)
{
    machine *m = &world.machines[i];
    const uint32_t now = clock_of(m);
    borg_message message;
    uint8_t bytes[BORG_MESSAGE_BYTES];
    if (world.now == m->boots_at) {
        boot(i);
    }
    if (!m->is_on) {
        return;
    }
    if (world.now >= m->begins_at && m->begins_at != NEVER && m->e.round == 0) {
        borg_election_begin(&m->e, 1, borg_bid(below(3) ? below(3000) : 500, below(101)), now);
    }
    if (i == world.forgets) {
        m->e.promised = 0;
    }
    if (borg_election_step(&m->e, now, &message)) {
        assert_int_equal(borg_message_write(bytes, &message), IRIS_OK);
        net_send(&world.net, i, bytes, (uint32_t)world.now);
        world.sent++;
    }
}

static int32_t count_acting(void)
{
    int32_t count = 0;
    for (int32_t i = 0; i < world.n; i++) {
        count += acts(i);
    }
    return count;
}

static void world_step(void)
{
    uint8_t bytes[BORG_MESSAGE_BYTES];
    borg_message message;
    int32_t to;
    turn_of_events();
    while (net_receive(&world.net, &to, bytes, (uint32_t)world.now)) {
        machine *m = &world.machines[to];
        if (m->is_on) {
            assert_int_equal(borg_message_read(&message, bytes, sizeof bytes), IRIS_OK);
            borg_election_hear(&m->e, &message, clock_of(m));
        }
    }
    for (int32_t i = 0; i < world.n; i++) {
        machine_step(i);
    }
    check_promise();
    check_leases();
    check_beginners();
    check_grace();
    if (!world.links_fail) {
        check_parts();
    }
    if (world.reached_at == NEVER && world.now >= BEGIN_MS && count_acting() == world.k) {
        world.reached_at = world.now;
        world.sent_until = world.sent;
    }
    world.now += STEP_MS;
}

static void prepare(uint64_t seed, uint32_t loss)
{
    memset(&world, 0, sizeof world);
    world.net.random = seed * 0x2545F4914F6CDD1Du + loss;
    world.net.loss = loss;
    world.net.twice = (uint32_t)below(300);
    world.net.delay_ms = (uint32_t)below(below(2) ? 40 : 300);
    world.n = 2 + below(UNITS_MAX - 2);
    world.k = 1 + below(world.n);
    world.net.ends = world.n;
    world.crash_at = world.part_at = world.heal_at = world.reached_at = NEVER;
    world.forgets = -1;
    for (int32_t i = 0; i < world.n; i++) {
        machine *m = &world.machines[i];
        m->clock = below(2) ? 0xFFFFFFFFu - (uint32_t)below(20000) : (uint32_t)below(1 << 30);
        m->drift = below(21) - 10;
        m->boots_at = 0;
        m->begins_at = BEGIN_MS + (below(2) ? 0 : STEP_MS * below(50));
        m->incarnation = (uint16_t)below(65536);
    }
}

/* Until `end`; then k act, or all that are there. */
static void run_until(int32_t end)
{
    while (world.now < end && !world.wrong) {
        world_step();
    }
    int32_t there = 0;
    for (int32_t i = 0; i < world.n; i++) {
        there += world.machines[i].is_on;
    }
    if (!world.wrong && count_acting() != (there < world.k ? there : world.k)) {
        world.wrong = "not k act in the end";
    }
}

static void must_be_right(int32_t run)
{
    if (world.wrong) {
        fail_msg("run %d, %d of %d, loss %d, at %d ms: %s", (int)run, (int)world.k, (int)world.n,
                 (int)world.net.loss, (int)world.now, world.wrong);
    }
}

/* ---- figures ---- */

static int32_t times[LOSSES][RUNS], messages[LOSSES][RUNS], figures[LOSSES];
static const uint32_t losses[LOSSES] = {0, 250, 500};

static int ascends(const void *a, const void *b)
{
    const int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

static void note(int32_t which)
{
    times[which][figures[which]] = world.reached_at - BEGIN_MS;
    messages[which][figures[which]++] = world.sent_until;
}

static void print_figures(const char *what)
{
    for (int32_t i = 0; i < LOSSES; i++) {
        const int32_t count = figures[i];
        qsort(times[i], (size_t)count, sizeof times[i][0], ascends);
        qsort(messages[i], (size_t)count, sizeof messages[i][0], ascends);
        printf(
            "#: election, %s, %d %% lost: %d runs, k act after %d ms and %d messages (median), %d ms and %d "
            "messages (99 %%)\n",
            what, (int)losses[i] / 10, (int)count, (int)times[i][count / 2], (int)messages[i][count / 2],
            (int)times[i][count * 99 / 100], (int)messages[i][count * 99 / 100]);
        figures[i] = 0;
    }
}

/* ---- tests ---- */

/* All are there, all begin. */
static void k_are_chosen(void **state)
{
    (void)state;
    for (int32_t run = 0; run < RUNS / 5; run++) {
        prepare((uint64_t)run, losses[run % LOSSES]);
        run_until(BEGIN_MS + 8000);
        must_be_right(run);
        note(run % LOSSES);
    }
    print_figures("all alive");
}

/* One crashes, at each step of an election and behind it; half of the times it starts again. */
static void one_crashes_at_every_step(void **state)
{
    (void)state;
    for (int32_t run = 0; run < RUNS * 2 / 5; run++) {
        prepare((uint64_t)run + 1000000, (uint32_t)(run * 7 % 501));
        world.crash_at = BEGIN_MS + STEP_MS * (run % CRASH_STEPS);
        world.crash_unit = below(2) ? -1 : below(world.n);
        run_until(world.crash_at + 24000);
        must_be_right(run);
    }
}

/* A winner crashes; how long until k act again. */
static void a_winner_is_replaced(void **state)
{
    (void)state;
    for (int32_t run = 0; run < RUNS / 10; run++) {
        prepare((uint64_t)run + 2000000, losses[run % LOSSES]);
        world.k = 1 + below(world.n - 1);
        run_until(BEGIN_MS + 8000);
        must_be_right(run);
        int32_t who = 0;
        while (!acts(who)) {
            who++;
        }
        const int32_t crash = world.now;
        world.machines[who].is_on = 0;
        world.sent = 0;
        world.reached_at = NEVER;
        run_until(crash + 15000);
        must_be_right(run);
        world.reached_at -= crash - BEGIN_MS;
        note(run % LOSSES);
    }
    print_figures("a winner dead");
}

/* Some start when others already choose, or act. */
static void some_come_late(void **state)
{
    (void)state;
    for (int32_t run = 0; run < RUNS / 10; run++) {
        prepare((uint64_t)run + 3000000, (uint32_t)(run * 7 % 501));
        for (int32_t i = below(world.n); i < world.n; i++) {
            world.machines[i].boots_at = STEP_MS * below(800);
        }
        run_until(35000);
        must_be_right(run);
    }
}

/* The group falls in two parts, before, while, or after they choose, and is whole again. */
static void parts_choose_for_themselves(void **state)
{
    (void)state;
    int32_t both = 0, surpluses = 0, longest = 0;
    for (int32_t run = 0; run < RUNS / 5; run++) {
        prepare((uint64_t)run + 4000000, (uint32_t)(run * 7 % 501));
        world.part_at = STEP_MS * below(600);
        world.heal_at = world.part_at + 15000 + STEP_MS * below(200);
        int32_t in[2] = {0, 0}, wanted = 0;
        while (world.now < world.heal_at && !world.wrong) {
            world_step();
        }
        if (world.heal_at > BEGIN_MS + 14000) { /* time enough that each part has its k */
            for (int32_t i = 0; i < world.n; i++) {
                in[world.net.part[i]] += world.machines[i].is_on;
            }
            wanted = (in[0] < world.k ? in[0] : world.k) + (in[1] < world.k ? in[1] : world.k);
            if (!world.wrong && count_acting() != wanted) {
                world.wrong = "not k act in each part";
            }
            both += wanted > world.k;
        }
        int32_t surplus = 0;
        while (world.now < world.heal_at + 20000 && !world.wrong) {
            surplus = count_acting() > world.k ? world.now - world.heal_at : surplus;
            world_step();
        }
        run_until(world.now);
        must_be_right(run);
        surpluses += surplus > 0;
        longest = surplus > longest ? surplus : longest;
    }
    assert_true(both > RUNS / 40);
    printf("#: election, parts whole again: %d times more than k acted, %d ms at most\n", (int)surpluses,
           (int)longest);
    assert_true(surpluses > 0 && longest < BORG_ELECTION_GRACE_MS * 3 / 4);
}

/* Links come and go, each for itself and in one direction; one crashes, and starts again at once. What is promised for
 * each machine that others hear holds whatever they hear. */
static void any_links_fail(void **state)
{
    (void)state;
    int32_t begun = 0;
    for (int32_t run = 0; run < RUNS / 10; run++) {
        prepare((uint64_t)run + 6000000, (uint32_t)(run * 7 % 301));
        world.links_fail = 1;
        world.crash_at = BEGIN_MS + STEP_MS * below(1000);
        world.crash_unit = below(world.n);
        while (world.now < 40000 && !world.wrong) {
            world_step();
        }
        must_be_right(run);
        begun += world.begun;
    }
    printf("#: election, links fail one by one: %d runs, %.1f begin to act in each\n", RUNS / 10,
           begun / (RUNS / 10.0));
}

/* Two that do not hear each other ask one between them, which starts anew while one of them has its grant. */
static void a_new_start_grants_nothing_twice(void **state)
{
    (void)state;
    prepare(1, 0);
    world.n = world.net.ends = 3;
    world.k = 1;
    world.links_fail = -1; /* as they are now */
    world.net.deaf[0] = 4;
    world.net.deaf[2] = 1;
    world.machines[1].begins_at = NEVER;
    while (!acts(0) && !acts(2) && world.now < 30000) {
        world_step();
    }
    const int32_t first = acts(0) ? 0 : 2, start = world.now;
    assert_true(acts(first));
    boot(1);
    world.net.deaf[first] = 7;
    while (!acts(2 - first) && world.now < 30000) {
        world_step();
    }
    must_be_right(0);
    assert_in_range(world.now - start, BORG_ELECTION_LEASE_MS, BORG_ELECTION_LEASE_MS + 1000);
}

/* What is noticed here is noticed above: one machine keeps no promise. */
static void a_broken_machine_is_noticed(void **state)
{
    (void)state;
    int32_t noticed = 0;
    for (int32_t run = 0; run < 20; run++) {
        prepare((uint64_t)run + 5000000, 250);
        world.forgets = 0;
        run_until(BEGIN_MS + 8000);
        noticed += world.wrong != NULL;
    }
    assert_true(noticed > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(k_are_chosen),
        cmocka_unit_test(one_crashes_at_every_step),
        cmocka_unit_test(a_winner_is_replaced),
        cmocka_unit_test(some_come_late),
        cmocka_unit_test(parts_choose_for_themselves),
        cmocka_unit_test(any_links_fail),
        cmocka_unit_test(a_new_start_grants_nothing_twice),
        cmocka_unit_test(a_broken_machine_is_noticed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
