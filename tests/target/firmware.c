/* The board of examples/firmware_follow.c, as far as an emulator is one: ten frames, a line that wanders to the right. */
#include "course.h"
#include "target.h"

static int32_t frame;

#ifdef TELL_STACK
static void tell_stack(void)
{
    char text[] = "stack 0000\n";
    uint32_t bytes = target_stack_used();
    for (char *digit = &text[9]; *digit != ' '; digit--, bytes /= 10) {
        *digit = (char)('0' + bytes % 10);
    }
    target_print(text);
}
#else
static void tell_stack(void)
{
}
#endif

int sensor_frame(void)
{
    course_set(20 + 10 * frame, 0);
    if (frame == 10) {
        tell_stack();
    }
    return frame++ < 10;
}

uint32_t board_milliseconds(void)
{
    return (uint32_t)frame * 33;
}

void uart_send(const char *bytes, size_t count)
{
    (void)count;
    target_print(bytes);
}
