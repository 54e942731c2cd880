/* Signals over a network that loses up to half of all messages: each arrives everywhere, once. */
#include "iris/borg/post.h"

#include <stdio.h>

#include "borg/lossy_network.h"
#include "test.h"

enum { MACHINES = 5, SIGNALS = 12, STEP_MS = 20 };
#if defined(__x86_64__)
enum { RUNS = 400 };
#elif defined(__linux__)
enum { RUNS = 60 };
#else
enum { RUNS = 20 };
#endif

static struct {
    lossy_network net;
    borg_post posts[MACHINES];
    borg_sender senders[MACHINES][MACHINES - 1];
    uint32_t clocks[MACHINES];
    int8_t got[MACHINES][MACHINES][SIGNALS]; /* by whom, from whom, which */
    int32_t sent;
} world;

static void start(int32_t i, uint16_t incarnation)
{
    const borg_address me = {77, (uint16_t)(10 + i / 3), incarnation, (uint8_t)(1 + i % 3)};
    assert_int_equal(borg_post_init(&world.posts[i], world.senders[i], MACHINES - 1, &me), IRIS_OK);
}

static void prepare(uint64_t seed, uint32_t loss)
{
    memset(&world, 0, sizeof world);
    world.net.random = seed;
    world.net.loss = loss;
    world.net.twice = 200;
    world.net.delay_ms = 100;
    world.net.ends = MACHINES;
    for (int32_t i = 0; i < MACHINES; i++) {
        world.clocks[i] = i % 2 ? 0xFFFFFFFFu - net_below(&world.net, 5000) : net_below(&world.net, 1 << 30);
        start(i, (uint16_t)net_below(&world.net, 65536));
    }
}

static void post(int32_t i, int32_t which, uint32_t now)
{
    const borg_signal signal = {BORG_OBJ_DETECT_TRUE, world.posts[i].me.unit, world.posts[i].me.ref, which,
                                i};
    borg_post_send(&world.posts[i], &signal, now + world.clocks[i]);
}

static void step(uint32_t now)
{
    uint8_t bytes[BORG_MESSAGE_BYTES];
    borg_message message;
    borg_signal signal;
    int32_t to;
    while (net_receive(&world.net, &to, bytes, now)) {
        assert_int_equal(borg_message_read(&message, bytes, sizeof bytes), IRIS_OK);
        if (borg_post_hear(&world.posts[to], &message, now + world.clocks[to], &signal)) {
            world.got[to][signal.y][signal.x]++;
        }
    }
    for (int32_t i = 0; i < MACHINES; i++) {
        while (borg_post_next(&world.posts[i], now + world.clocks[i], &message)) {
            assert_int_equal(borg_message_write(bytes, &message), IRIS_OK);
            net_send(&world.net, i, bytes, now);
            world.sent++;
        }
    }
}

/* All send, sometimes several at once. */
static void each_signal_arrives_once(void **state)
{
    (void)state;
    static const uint32_t losses[] = {0, 250, 500};
    for (int32_t run = 0; run < RUNS; run++) {
        const uint32_t loss = losses[run % 3];
        prepare((uint64_t)run, loss);
        for (uint32_t now = 0; now < 25000; now += STEP_MS) {
            for (int32_t i = 0; i < MACHINES; i++) {
                const int32_t at = (int32_t)now / STEP_MS - 7 * i;
                if (at >= 0 && at % 100 < 2 && at / 100 < SIGNALS / 2) {
                    post(i, at / 100 * 2 + at % 100, now);
                }
            }
            step(now);
        }
        for (int32_t to = 0; to < MACHINES; to++) {
            for (int32_t of = 0; of < MACHINES; of++) {
                for (int32_t which = 0; which < SIGNALS; which++) {
                    assert_int_equal(world.got[to][of][which], to != of);
                }
            }
        }
        if (run >= RUNS - 3) {
            printf(
                "#: post, %d %% lost: %.1f messages for a signal to %d others, acknowledgments with them\n",
                (int)loss / 10, world.sent / (double)(MACHINES * SIGNALS), MACHINES - 1);
        }
    }
}

/* How long until no more is sent, after one signal. */
static int32_t silence_after(uint32_t dead, int death_is_told)
{
    int32_t last = 0;
    for (uint32_t now = 0; now < 15000; now += STEP_MS) {
        const int32_t before = world.sent;
        if (now == 1000) {
            for (uint32_t i = 0; i < MACHINES; i++) {
                post((int32_t)i, 0, now);
            }
        }
        if (now == 4000) {
            for (uint32_t i = 0; i < dead; i++) {
                world.net.part[i] = 1;
                borg_message death = {.kind = BORG_MESSAGE_DEATH, .from = world.posts[i].me};
                borg_signal none;
                for (int32_t to = (int32_t)dead; to < MACHINES && death_is_told; to++) {
                    (void)borg_post_hear(&world.posts[to], &death, now + world.clocks[to], &none);
                }
            }
            post(MACHINES - 1, 1, now);
        }
        step(now);
        last = now > 4000 && world.sent != before ? (int32_t)now - 4000 : last;
    }
    return last;
}

static void repeats_end(void **state)
{
    (void)state;
    prepare(1, 0);
    const int32_t all = silence_after(0, 0);
    assert_in_range(all, BORG_POST_LEAST_MS - BORG_POST_SELDOM_MS, BORG_POST_LEAST_MS + 200);
    prepare(1, 0);
    assert_in_range(silence_after(2, 0), BORG_POST_MOST_MS - 3000, BORG_POST_MOST_MS + 200);
    prepare(1, 0);
    assert_in_range(silence_after(2, 1), BORG_POST_LEAST_MS - BORG_POST_SELDOM_MS, BORG_POST_LEAST_MS + 1200);
}

static borg_message from(uint8_t unit, uint16_t incarnation, uint16_t sequence)
{
    borg_message m = {.kind = BORG_MESSAGE_SIGNAL, .sequence = sequence, .from = {77, 30, incarnation, unit}};
    m.is.signal = (borg_signal){BORG_REACHED, unit, 30, 0, 0};
    return m;
}

static int hears(uint8_t unit, uint16_t incarnation, uint16_t sequence, uint32_t now)
{
    borg_signal signal;
    const borg_message m = from(unit, incarnation, sequence);
    return borg_post_hear(&world.posts[0], &m, now, &signal);
}

static void duplicates_are_known_in_any_order(void **state)
{
    (void)state;
    prepare(3, 0);
    assert_true(hears(1, 5, 65530, 0));
    assert_true(hears(1, 5, 65528, 0));
    assert_false(hears(1, 5, 65528, 0));
    assert_false(hears(1, 5, 65530, 0));
    assert_true(hears(1, 5, 4, 0)); /* wraps: 10 later */
    assert_false(hears(1, 5, 65530, 0));
    assert_false(hears(1, 5, 65528, 0));
    assert_true(hears(1, 5, 65529, 0));
    assert_false(hears(1, 5, 65529, 0));
    assert_true(hears(1, 5, 65524, 0));  /* 16 before the last */
    assert_false(hears(1, 5, 65523, 0)); /* too long ago to be sure */
    assert_true(hears(1, 5, 100, 0));
    assert_false(hears(1, 5, 4, 0));
    assert_true(hears(1, 5, 99, 0));
    assert_false(hears(1, 4, 101, 0)); /* before its last start */
    assert_true(hears(1, 6, 100, 0));  /* it started anew */
    assert_false(hears(1, 5, 102, 0));
    /* After long silence anything may be true. */
    assert_true(hears(1, 2, 102, 20000));
}

static void memory_is_bounded(void **state)
{
    (void)state;
    prepare(3, 0);
    for (int32_t unit = 1; unit < MACHINES; unit++) {
        assert_true(hears((uint8_t)unit, 1, 1, 0));
    }
    assert_false(hears(MACHINES, 1, 1, 5000)); /* no place for it */
    assert_false(hears(1, 1, 1, 5000));
    assert_true(hears(MACHINES, 1, 1, 5000 + BORG_POST_MOST_MS)); /* in the place of one that is silent */
    assert_false(hears(MACHINES, 1, 1, 5000 + BORG_POST_MOST_MS));
    assert_false(hears(1, 1, 1, 5000 + BORG_POST_MOST_MS));
    assert_true(hears(1, 1, 2, 5000 + BORG_POST_MOST_MS));
    /* Of six signals at once the last four are sent. */
    int32_t count = 0;
    borg_message m;
    for (int32_t which = 0; which < 6; which++) {
        post(1, which, 0);
    }
    assert_int_equal(world.posts[1].dropped, 2);
    while (borg_post_next(&world.posts[1], world.clocks[1], &m)) {
        assert_true(m.is.signal.x >= 2);
        count++;
    }
    assert_int_equal(count, 4);
}

static void wrong_calls_do_nothing(void **state)
{
    (void)state;
    prepare(3, 0);
    borg_post *post = &world.posts[0];
    borg_sender *senders = world.senders[0];
    const borg_address me = post->me, no_line = {77, 0, 1, 1}, no_unit = {77, 1, 1, 0};
    borg_message m = from(1, 1, 1);
    borg_signal signal = {0};
    assert_int_equal(borg_post_init(NULL, senders, 4, &me), IRIS_ERR_ARG);
    assert_int_equal(borg_post_init(post, NULL, 4, &me), IRIS_ERR_ARG);
    assert_int_equal(borg_post_init(post, senders, 0, &me), IRIS_ERR_ARG);
    assert_int_equal(borg_post_init(post, senders, BORG_POST_SENDERS_MAX + 1, &me), IRIS_ERR_ARG);
    assert_int_equal(borg_post_init(post, senders, 4, NULL), IRIS_ERR_ARG);
    assert_int_equal(borg_post_init(post, senders, 4, &no_line), IRIS_ERR_ARG);
    assert_int_equal(borg_post_init(post, senders, 4, &no_unit), IRIS_ERR_ARG);
    assert_false(borg_post_hear(NULL, &m, 0, &signal));
    assert_false(borg_post_hear(post, NULL, 0, &signal));
    assert_false(borg_post_hear(post, &m, 0, NULL));
    m.from.script = 78;
    assert_false(borg_post_hear(post, &m, 0, &signal));
    m.from = me;
    assert_false(borg_post_hear(post, &m, 0, &signal));
    borg_post_send(NULL, &signal, 0);
    borg_post_send(post, NULL, 0);
    borg_post_send(post, &signal, 0); /* of no group */
    assert_false(borg_post_next(post, 0, &m));
    assert_false(borg_post_next(NULL, 0, &m));
    assert_false(borg_post_next(post, 0, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_signal_arrives_once),
        cmocka_unit_test(repeats_end),
        cmocka_unit_test(duplicates_are_known_in_any_order),
        cmocka_unit_test(memory_is_bounded),
        cmocka_unit_test(wrong_calls_do_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
