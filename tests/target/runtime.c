/* What the compiler calls on a processor without instructions for it: small rather than fast, in place of libgcc's
 * unrolled division and the C library's copying. The linker keeps what is used. */
#include <stddef.h>
#include <stdint.h>

void *memcpy(void *restrict to, const void *restrict from, size_t bytes);
void *memset(void *to, int value, size_t bytes);
uint64_t __aeabi_uidivmod(uint32_t a, uint32_t b);
uint32_t __aeabi_uidiv(uint32_t a, uint32_t b);
int32_t __aeabi_idiv(int32_t a, int32_t b);
uint64_t __aeabi_idivmod(int32_t a, int32_t b);
int __clzsi2(uint32_t a);
void __aeabi_uldivmod(void);
void __aeabi_ldivmod(void);
uint64_t target_divide(uint64_t a, uint64_t b, uint64_t *rest);
int64_t target_divide_signed(int64_t a, int64_t b, int64_t *rest);

typedef uint32_t __attribute__((may_alias)) word;

/* By words where both sides are aligned, and then by bytes. */
void *memcpy(void *restrict to, const void *restrict from, size_t bytes)
{
    uint8_t *at = to;
    const uint8_t *next = from;
    if ((((uintptr_t)to | (uintptr_t)from) & 3) == 0) {
        for (; bytes >= 4; bytes -= 4, at += 4, next += 4) {
            *(word *)(void *)at = *(const word *)(const void *)next;
        }
    }
    while (bytes-- > 0) {
        *at++ = *next++;
    }
    return to;
}

void *memset(void *to, int value, size_t bytes)
{
    uint8_t *at = to;
    while (bytes-- > 0) {
        *at++ = (uint8_t)value;
    }
    return to;
}

/* Quotient in the low word, remainder in the high one: one bit of the quotient per round, from the first that can be 1.
 * What is divided by 0 is its own remainder. */
uint64_t __aeabi_uidivmod(uint32_t a, uint32_t b)
{
    uint32_t quotient = 0, bit = b != 0;
    while (b < a && b << 1 >> 1 == b && bit != 0) {
        b <<= 1;
        bit <<= 1;
    }
    for (; bit != 0; bit >>= 1, b >>= 1) {
        if (a >= b) {
            a -= b;
            quotient += bit;
        }
    }
    return (uint64_t)a << 32 | quotient;
}

uint32_t __aeabi_uidiv(uint32_t a, uint32_t b)
{
    return (uint32_t)__aeabi_uidivmod(a, b);
}

int32_t __aeabi_idiv(int32_t a, int32_t b)
{
    uint32_t quotient =
        __aeabi_uidiv(a < 0 ? 0u - (uint32_t)a : (uint32_t)a, b < 0 ? 0u - (uint32_t)b : (uint32_t)b);
    return (int32_t)((a ^ b) < 0 ? 0u - quotient : quotient);
}

uint64_t __aeabi_idivmod(int32_t a, int32_t b)
{
    int32_t quotient = __aeabi_idiv(a, b);
    return (uint64_t)((uint32_t)a - (uint32_t)quotient * (uint32_t)b) << 32 | (uint32_t)quotient;
}

/* Zero bits above the highest 1. */
int __clzsi2(uint32_t a)
{
    int zeros = 32;
    for (; a != 0; a >>= 1) {
        zeros--;
    }
    return zeros;
}

/* Division of 64 bits. */
uint64_t target_divide(uint64_t a, uint64_t b, uint64_t *rest)
{
    uint64_t quotient = 0, bit = b != 0;
    while (b < a && (int64_t)b >= 0 && bit != 0) {
        b <<= 1;
        bit <<= 1;
    }
    for (; bit != 0; bit >>= 1, b >>= 1) {
        if (a >= b) {
            a -= b;
            quotient += bit;
        }
    }
    *rest = a;
    return quotient;
}

int64_t target_divide_signed(int64_t a, int64_t b, int64_t *rest)
{
    uint64_t left;
    uint64_t quotient =
        target_divide(a < 0 ? 0u - (uint64_t)a : (uint64_t)a, b < 0 ? 0u - (uint64_t)b : (uint64_t)b, &left);
    *rest = (int64_t)(a < 0 ? 0u - left : left);
    return (int64_t)((a ^ b) < 0 ? 0u - quotient : quotient);
}

/* The compiler wants the quotient in r0 and r1, the rest in r2 and r3: C has no words for that. The third argument, the
 * address of the rest, is given on the stack. */
#define DIVIDE(by)                                                                                           \
    __asm__("push {r4, lr}\n\tsub sp, #16\n\tadd r4, sp, #8\n\tstr r4, [sp]\n\tbl " by                       \
            "\n\tldr r2, [sp, #8]\n\tldr r3, [sp, #12]\n\tadd sp, #16\n\tpop {r4, pc}")

__attribute__((naked)) void __aeabi_uldivmod(void)
{
    DIVIDE("target_divide");
}

__attribute__((naked)) void __aeabi_ldivmod(void)
{
    DIVIDE("target_divide_signed");
}
