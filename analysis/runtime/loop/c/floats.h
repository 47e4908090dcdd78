/* The floating-point environment of a thread, which the code of an FMU may leave changed.
 *
 * On x86-64 it is two words: MXCSR of SSE (rounding, flush to zero, denormals are zero, exception masks) and the control
 * word of the x87 (Intel 64 and IA-32 Architectures Software Developer's Manual, volume 1, 10.2.3 and 8.1.5); on aarch64
 * it is FPCR (Arm Architecture Reference Manual, C5.2.8). On other processors nothing is done. Flags of past exceptions
 * are ignored. Reading takes a nanosecond; fegetenv and fesetenv of C, which save and load everything, take a hundred.
 */
#ifndef FLOATS_H
#define FLOATS_H

#include <stdint.h>

/* Restore the default environment if it was changed. Words are read with the widths of their stores, 32 and 16 bits: a
 * wider read would have to wait for the store. */
static inline void restore_default_floats(void)
{
#if defined(__x86_64__)
    uint32_t mxcsr;
    uint16_t control;
    __asm__ volatile("stmxcsr %0\n\tfnstcw %1" : "=m"(mxcsr), "=m"(control) : : "memory");
    if ((mxcsr & 0xffc0u) != 0x1f80u || (control & 0x0f3fu) != 0x033fu) {
        mxcsr = 0x1f80u;
        control = 0x037fu;
        __asm__ volatile("ldmxcsr %0\n\tfldcw %1" : : "m"(mxcsr), "m"(control) : "memory");
    }
#elif defined(__aarch64__)
    uint64_t fpcr;
    __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr) : : "memory");
    if (fpcr != 0) __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory");
#endif
}

#endif
