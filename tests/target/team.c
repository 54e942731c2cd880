/* The board of examples/firmware_machine.c, as far as an emulator is one: 80 seconds, in which one message comes that the
 * object is seen, and the robot reaches it. Prints the orders, as iris_order_verb. */
#include "iris/borg/member.h"
#include "target.h"

/* The hooks. */
int board_wait(uint32_t *now_ms, uint32_t for_ms);
uint16_t board_starts(void);
iris_status radio_send(void *context, const uint8_t *bytes, size_t count);
iris_status radio_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count);
void robot_obey(const iris_order *order);
void robot_place(int32_t *x_mm, int32_t *y_mm, int32_t *battery_percent);
iris_event robot_event(void);

static uint32_t clock_ms;

int board_wait(uint32_t *now_ms, uint32_t for_ms)
{
    clock_ms += for_ms;
    *now_ms = clock_ms;
    return clock_ms <= 80000;
}

uint16_t board_starts(void)
{
    return 1;
}

iris_status radio_send(void *context, const uint8_t *bytes, size_t count)
{
    (void)context;
    (void)bytes;
    (void)count;
    return IRIS_OK;
}

/* Once: SIGNAL OBJ_DETECT_TRUE of line 10, unit 1, at (1200, -300). */
iris_status radio_receive(void *context, uint8_t *bytes, size_t capacity, size_t *count)
{
    static const uint8_t seen[BORG_MESSAGE_BYTES] = {
        66,  77,  1,   1, 7, 162, 122, 241, 10, 0, 1, 1, 0, 1, 0, 1, 1, 10, 0, 176, 4,   0,  0,   212,
        254, 255, 255, 0, 0, 0,   0,   0,   0,  0, 0, 0, 0, 0, 0, 0, 0, 0,  0, 0,   161, 17, 168, 204};
    static uint8_t has_come;
    (void)context;
    *count = 0;
    if (clock_ms >= 10000 && !has_come && capacity >= sizeof seen) {
        has_come = 1;
        for (; *count < sizeof seen; ++*count) {
            bytes[*count] = seen[*count];
        }
    }
    return IRIS_OK;
}

void robot_obey(const iris_order *order)
{
    char text[] = "order 00\n";
    text[6] = (char)('0' + order->verb / 10);
    text[7] = (char)('0' + order->verb % 10);
    target_print(text);
}

void robot_place(int32_t *x_mm, int32_t *y_mm, int32_t *battery_percent)
{
    *x_mm = *y_mm = 0;
    *battery_percent = 80;
}

iris_event robot_event(void)
{
    static uint8_t has_reached;
    iris_event event = {IRIS_EVENT_NONE, 0, 0};
    if (clock_ms >= 30000 && !has_reached) {
        has_reached = 1;
        event = (iris_event){IRIS_EVENT_REACHED, 1200, -300};
    }
    return event;
}
