/* One robot of a team, for a microcontroller: the second chunk of examples/scripts/explore.borg, whose robots explore until
 * another one sees the object; then two of four go to it. All memory is static: what `make size` prints for it.
 *
 * To start from: write the hooks for your board, put your chunk and your script's number here, and give each robot its own
 * unit. `iris borg decompose --bytecode` has the chunk's bytes, `iris borg check --json` the number. On a computer the hooks
 * are those at the end, and print what a robot would be told: nobody else is there, and so it is the one that goes. */
#include "iris/borg/member.h"

enum { UNIT = 3, UNITS = 4, OTHERS = 4 };

static const uint8_t chunk[] = {66, 67, 1, 4, 20, 0, 60, 0, 81, 0, 3, 0, 63, 31, 245, 233, 0, 0, 4,  8, 0,
                                0,  0,  0, 1, 8,  0, 2,  0, 0,  0, 3, 0, 0,  2,  4,   28,  0, 1, 10, 0, 1,
                                0,  0,  4, 8, 0,  5, 0,  0, 1,  8, 0, 5, 0,  1,  10,  0,   1, 0, 0,  4, 2,
                                0,  4,  0, 0, 1,  7, 0,  0, 0,  4, 2, 0, 3,  0,  0,   1,   7, 0};

/* --- hooks: what the board knows --- */

/* Waits until so many milliseconds have passed, and says what time it is; any clock that wraps. 0: ends main. */
int board_wait(uint32_t *now_ms, uint32_t for_ms);

/* More at each start: a count in flash, or the seconds of a clock that goes on. */
uint16_t board_starts(void);

/* Datagrams of 48 bytes to and from all others; neither waits (iris/borg/transport.h). */
iris_status radio_send(void *context, const uint8_t *bytes, size_t count);
iris_status radio_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count);

/* Tells the robot what to do; its place; and the next thing that it tells, with kind IRIS_EVENT_NONE for nothing. */
void robot_obey(const iris_order *order);
void robot_place(int32_t *x_mm, int32_t *y_mm, int32_t *battery_percent);
iris_event robot_event(void);

/* --- the machine --- */

static borg_member member;
static borg_bidder bidders[1 * UNITS]; /* of one election */
static borg_sender senders[OTHERS];

static void turn(const borg_transport *radio, uint32_t now_ms)
{
    int32_t x_mm, y_mm, battery_percent;
    iris_order order;
    robot_place(&x_mm, &y_mm, &battery_percent);
    (void)borg_member_place(&member, x_mm, y_mm, battery_percent);
    (void)borg_member_step(&member, radio, now_ms);
    while (borg_member_order_next(&member, &order)) {
        robot_obey(&order);
    }
    for (iris_event event = robot_event(); event.kind != IRIS_EVENT_NONE; event = robot_event()) {
        (void)borg_member_event(&member, &event);
    }
}

int main(void)
{
    const borg_transport radio = {radio_send, radio_receive, NULL};
    const borg_member_config config = {chunk,   sizeof chunk, 4051345927u, board_starts(), UNIT,
                                       bidders, 1 * UNITS,    senders,     OTHERS};
    uint32_t now_ms = 0;
    if (borg_member_init(&member, &config, now_ms) != IRIS_OK || borg_member_start(&member) != IRIS_OK) {
        return 1;
    }
    while (board_wait(&now_ms, 40)) {
        turn(&radio, now_ms);
    }
    return 0;
}

/* --- on a computer: the object is seen after 10 seconds, and reached after 30 --- */
#if defined(__unix__) || defined(_WIN32) || defined(__APPLE__)
#include <stdio.h>

static uint32_t clock_ms;

int board_wait(uint32_t *now_ms, uint32_t for_ms)
{
    *now_ms = clock_ms += for_ms;
    return clock_ms <= 80000;
}

uint16_t board_starts(void)
{
    return 1;
}

iris_status radio_send(void *context, const uint8_t *bytes, size_t count)
{
    return context || !bytes || count == 0 ? IRIS_ERR_ARG : IRIS_OK;
}

iris_status radio_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    static int times;
    const borg_message seen = {.kind = BORG_MESSAGE_SIGNAL,
                               .sequence = 1,
                               .from = {4051345927u, 10, 1, 1},
                               .is = {.signal = {BORG_OBJ_DETECT_TRUE, 1, 10, 1200, -300}}};
    *count = clock_ms >= 10000 && times++ == 0 && capacity >= BORG_MESSAGE_BYTES ? BORG_MESSAGE_BYTES : 0;
    return context ? IRIS_ERR_ARG : *count ? borg_message_write(bytes, &seen) : IRIS_OK;
}

void robot_obey(const iris_order *order)
{
    printf("%5.2f s  %-11s %d, %d: %s\n", clock_ms / 1000.0, iris_order_name(order->verb), (int)order->a,
           (int)order->b, borg_member_state(&member));
}

void robot_place(int32_t *x_mm, int32_t *y_mm, int32_t *battery_percent)
{
    *x_mm = *y_mm = 0;
    *battery_percent = 80;
}

iris_event robot_event(void)
{
    static int times;
    return (iris_event){clock_ms >= 30000 && times++ == 0 ? IRIS_EVENT_REACHED : IRIS_EVENT_NONE, 1200, -300};
}
#endif
