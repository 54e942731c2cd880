/* Startup of a Cortex-M without a C library's help, and its voice: semihosting. */
#include "target.h"

#include <stdint.h>

extern uint32_t link_stack_start[], link_stack_end[], link_data_load[], link_data_start[], link_data_end[],
    link_bss_start[], link_bss_end[];
int main(void);
void target_reset(void);

#define SYS_WRITEC        0x03u
#define SYS_WRITE0        0x04u
#define SYS_EXIT_EXTENDED 0x20u
#define STOPPED_BY_EXIT   0x20026u
#define PAINT             0xA5A5A5A5u

static void semihost(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void target_print(const char *text)
{
    semihost(SYS_WRITE0, text);
}

void target_putc(int c)
{
    char byte = (char)c;
    semihost(SYS_WRITEC, &byte);
}

static void stop(uint32_t code)
{
    const uint32_t block[2] = {STOPPED_BY_EXIT, code};
    semihost(SYS_EXIT_EXTENDED, block);
    for (;;) {
    }
}

uint32_t target_stack_used(void)
{
    const uint32_t *word = link_stack_start;
    while (word < link_stack_end && *word == PAINT) {
        word++;
    }
    return (uint32_t)((const uint8_t *)link_stack_end - (const uint8_t *)word);
}

static void fault(void)
{
    target_print("fault\n");
    stop(99);
}

/* Vector registers are off after reset. */
static void enable_vectors(void)
{
#ifdef __ARM_FP
    volatile uint32_t *access_control = (volatile uint32_t *)0xE000ED88u;
    *access_control |= 0xFu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
}

void target_reset(void)
{
    enable_vectors();
    const uint32_t *from = link_data_load;
    for (uint32_t *to = link_data_start; to < link_data_end; to++) {
        *to = *from++;
    }
    for (uint32_t *to = link_bss_start; to < link_bss_end; to++) {
        *to = 0;
    }
    uint32_t *sp;
    __asm__ volatile("mov %0, sp" : "=r"(sp));
    for (uint32_t *to = link_stack_start; to < sp - 8; to++) {
        *to = PAINT;
    }
    stop((uint32_t)main());
}

/* The first word is the initial stack pointer, the others are what to call. */
typedef union {
    uint32_t *stack;
    void (*call)(void);
} vector;

__attribute__((section(".vectors"), used)) static const vector vectors[16] = {
    {.stack = link_stack_end},
    {.call = target_reset},
    {.call = fault},
    {.call = fault},
    {.call = fault},
    {.call = fault},
    {.call = fault},
    {.call = 0},
    {.call = 0},
    {.call = 0},
    {.call = 0},
    {.call = fault},
    {.call = fault},
    {.call = 0},
    {.call = fault},
    {.call = fault},
};
