/* Values with which a block starts: Reals are finite, and parameters lie between their declared bounds, those of tunable
 * parameters between steps, too.
 *
 * fmus_src/start_values.py does the same with the same words.
 */
#ifndef START_VALUES_H
#define START_VALUES_H

#include "instance.h"

/* Say that an element's value is outside its range, an Integer's without a decimal point; `where` begins the message. */
static COLD Status refuse_value(
    const Component *component, const char *where, uint32_t element, double value, const Range *range)
{
    const bool is_below = value < range->minimum;
    const double bound = is_below ? range->minimum : range->maximum;
    const char *side = is_below ? "below its minimum" : "above its maximum";
    char name[NAME_SIZE];
    char value_text[REPR_SIZE];
    char bound_text[REPR_SIZE];
    name_element(element, name);
    if ((ELEMENTS[element].traits & KIND_INTEGER) != 0) {
        return fail(component, "%s: %s = %" PRId64 " is %s %" PRId64, where, name, (int64_t)value, side, (int64_t)bound);
    }
    python_repr(value, value_text);
    if (!isfinite(value)) return fail(component, "%s: %s = %s is not finite", where, name, value_text);
    return fail(component, "%s: %s = %s is %s %s", where, name, value_text, side, python_repr(bound, bound_text));
}

/* STATUS_OK where all elements without one of the traits `except` lie in their ranges. */
static Status check_ranges(const Component *component, const char *where, uint32_t except)
{
    const Block *block = &component->now.block;
    for (const Range *range = RANGES; range->count > 0; range++) {
        const Element *element = &ELEMENTS[range->first];
        if ((element->traits & except) != 0) continue;
        const void *place = (const char *)block + element->offset;
        const bool is_real = (element->traits & KIND_REAL) != 0;
        for (uint32_t i = 0; i < range->count; i++) {
            const double value = is_real ? ((const double *)place)[i] : (double)((const int64_t *)place)[i];
            if (value >= range->minimum && value <= range->maximum) continue;
            if (!is_used(block, element->offset)) continue;
            return refuse_value(component, where, range->first + i, value, range);
        }
    }
    return STATUS_OK;
}

/* STATUS_OK where all parameters and inputs are such that the block may start. */
static Status check_start_values(Component *component)
{
    const Status status = check_ranges(component, "StartError", 0);
    if (status != STATUS_OK) component->now.mode = MODE_ERROR;
    return status;
}

/* After tunable parameters were set between steps: pass them on to those that follow from them, and compare all with
 * their ranges; what is refused leaves the block as it was `before`. */
static COLD Status accept_tuned(Component *component, const char *function, const Block *before)
{
    Fault fault = NO_FAULT;
    pass_parameters(&component->now.block, &fault);
    const Status status = fault.what != NULL
        ? fail(component, "%s: %s: %s", function, fault.subject == NULL ? "parameter" : fault.subject, fault.what)
        : check_ranges(component, function, SET_BETWEEN_STEPS);
    if (status != STATUS_OK) component->now.block = *before;
    return status;
}

#endif
