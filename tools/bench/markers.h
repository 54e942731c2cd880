/* The instructions between which icnt.c counts. */
#ifndef IRIS_BENCH_MARKERS_H
#define IRIS_BENCH_MARKERS_H

#if defined(__aarch64__)
#define START() __asm__ volatile("mov x27, x27" ::: "memory")
#define STOP()  __asm__ volatile("mov x28, x28" ::: "memory")
#elif defined(__arm__)
#define START() __asm__ volatile("mov r10, r10" ::: "memory")
#define STOP()  __asm__ volatile("mov r11, r11" ::: "memory")
#else
#define START() __asm__ volatile("xchg %%bx, %%bx" ::: "memory")
#define STOP()  __asm__ volatile("xchg %%cx, %%cx" ::: "memory")
#endif

#endif
