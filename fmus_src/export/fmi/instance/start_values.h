/* Values with which a block starts: Reals are finite, and parameters lie between their declared bounds.
 *
 * fmus_src/start_values.py does the same with the same words.
 */
#ifndef START_VALUES_H
#define START_VALUES_H

#include "instance.h"

static COLD Status refuse_real(Component *component, uint32_t element, double value, const Range *range)
{
    char name[NAME_SIZE];
    char value_text[REPR_SIZE];
    char bound_text[REPR_SIZE];
    name_element(element, name);
    python_repr(value, value_text);
    component->now.mode = MODE_ERROR;
    if (!isfinite(value)) return fail(component, "StartError: %s = %s is not finite", name, value_text);
    const bool is_below = value < range->minimum;
    return fail(component, "StartError: %s = %s is %s %s", name, value_text,
        is_below ? "below its minimum" : "above its maximum",
        python_repr(is_below ? range->minimum : range->maximum, bound_text));
}

static COLD Status refuse_integer(Component *component, uint32_t element, int64_t value, const Range *range)
{
    char name[NAME_SIZE];
    name_element(element, name);
    component->now.mode = MODE_ERROR;
    const bool is_below = (double)value < range->minimum;
    return fail(component, "StartError: %s = %" PRId64 " is %s %" PRId64, name, value,
        is_below ? "below its minimum" : "above its maximum",
        (int64_t)(is_below ? range->minimum : range->maximum));
}

/* STATUS_OK where all parameters and inputs are such that the block may start. */
static Status check_start_values(Component *component)
{
    const Block *block = &component->now.block;
    for (const Range *range = RANGES; range->count > 0; range++) {
        const Element *element = &ELEMENTS[range->first];
        const void *place = (const char *)block + element->offset;
        const bool is_real = (element->traits & KIND_REAL) != 0;
        for (uint32_t i = 0; i < range->count; i++) {
            const double value = is_real ? ((const double *)place)[i] : (double)((const int64_t *)place)[i];
            if (value >= range->minimum && value <= range->maximum) continue;
            if (!is_used(block, element->offset)) continue;
            return is_real ? refuse_real(component, range->first + i, value, range)
                           : refuse_integer(component, range->first + i, ((const int64_t *)place)[i], range);
        }
    }
    return STATUS_OK;
}

#endif
