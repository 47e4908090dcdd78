/* How the statements of fused steps do what needs more than a line, and how they end a flight.
 *
 * They stand in `perilune_fly`, whose variables they use. A failure leaves in `outcome` what the compiled loop leaves
 * there: code; component, slot or text; function; fmi2Status; communication point; instruction.
 */
#define END(code, subject, number) \
    do { \
        outcome[0] = code; \
        outcome[1] = subject; \
        outcome[5] = number; \
        return rows; \
    } while (0)

/* An fmi2Status graver than a warning, or none of FMI's. */
#define CHECK(status, component, function, number) \
    do { \
        if (status > FMI_WARNING || status < 0) { \
            outcome[2] = function; \
            outcome[3] = status; \
            END(FAILED, component, number); \
        } \
    } while (0)

/* The first of some slots whose value is not finite. */
#define CHECK_FINITE(first, count, number) \
    do { \
        for (int64_t slot = first; slot < first + count; slot++) { \
            if (!(fabs(values[slot]) < INFINITY)) END(NONFINITE, slot, number); \
        } \
    } while (0)

/* A number for an Integer or a Boolean, which 32 bits have to hold. */
#define WHOLE(slot, number) \
    do { \
        if (!(values[slot] >= INT32_MIN && values[slot] <= INT32_MAX)) END(NONFINITE, slot, number); \
        whole[slot] = (int32_t)values[slot]; \
    } while (0)

/* A String that an FMU has given, copied into its row. */
#define TAKE_TEXT(text, number) \
    do { \
        if (text_given[text] == NULL) \
            text_address[text][0] = '\0'; \
        else \
            strncpy(text_address[text], text_given[text], (size_t)text_size); \
        if (text_address[text][text_size - 1] != '\0') END(TOO_LONG, text, number); \
    } while (0)

/* The default floating-point environment, where an FMU has left another one: MXCSR and the x87 control word, or FPCR,
 * as compiled/floats.py has them. */
#if defined(__x86_64__)
#define RESTORE_FLOATS() \
    do { \
        uint32_t mxcsr; \
        uint16_t control; \
        __asm__ volatile("stmxcsr %0\n\tfnstcw %1" : "=m"(mxcsr), "=m"(control) : : "memory"); \
        if ((mxcsr & 0xffc0u) != 0x1f80u || (control & 0x0f3fu) != 0x033fu) { \
            mxcsr = 0x1f80u; \
            control = 0x037fu; \
            __asm__ volatile("ldmxcsr %0\n\tfldcw %1" : : "m"(mxcsr), "m"(control) : "memory"); \
        } \
    } while (0)
#elif defined(__aarch64__)
#define RESTORE_FLOATS() \
    do { \
        uint64_t fpcr; \
        __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr) : : "memory"); \
        if (fpcr != 0) __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory"); \
    } while (0)
#else
#define RESTORE_FLOATS() (void)0
#endif

/* Faults on slots, each in its window [from, until) s. */
#define DURING(fault, statement) \
    if (fault_window[2 * (fault)] <= after && after < fault_window[2 * (fault) + 1]) statement
#define INJECT_OVERRIDE(fault, slot) DURING(fault, values[slot] = fault_value[fault])
#define INJECT_BIAS(fault, slot) DURING(fault, values[slot] += fault_value[fault])
#define INJECT_FREEZE(fault, slot) \
    DURING(fault, { \
        if (isnan(frozen[fault])) frozen[fault] = values[slot]; \
        values[slot] = frozen[fault]; \
    })
#define INJECT_EXCITE(fault, slot) \
    DURING(fault, if (point - first_point < excitation_rows) values[slot] += \
        excitation[(point - first_point) * excitation_columns + (int64_t)fault_value[fault]])
