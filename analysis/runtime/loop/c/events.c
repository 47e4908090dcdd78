/* Steps and event mode of FMUs of FMI 3.0. */

#define MOST_ROUNDS 1000 /* event iterations, and successive steps that do not advance */
#define OF_A_STEP 1e-9
#define OF_A_TIME 8.881784197001252e-16 /* 2^-50 */

/* Return the tolerance (s) within which a time counts as inside a step, or as its end; FMUs accumulate rounding errors
 * of times differently. */
EXPORT double perilune_time_allowance(double begin, double end)
{
    const double largest = fabs(begin) < fabs(end) ? fabs(end) : fabs(begin);
    return OF_A_STEP * (end - begin) + OF_A_TIME * largest;
}

/* Change from event mode to step mode once the discrete states have settled; return the fmi3Status.
 * The outcome reports an FMU that ends the simulation or does not settle. */
static int settle(const Run *run, const uint64_t *functions, uint64_t instance)
{
    const StoredValues *const stored = &run->fmi3.stored;
    int64_t *const outcome = run->buffers.outcome;
    int status = 0;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        outcome[FUNCTION_CALLED] = UPDATE_DISCRETE_STATES;
        status = update_discrete_states(functions[UPDATE_DISCRETE_STATES], instance, stored->flags, stored->time);
        if (!is_well(status)) return status;
        if (stored->flags[1]) {
            outcome[ENDING] = ENDED;
            return status;
        }
        if (!stored->flags[0]) {
            outcome[FUNCTION_CALLED] = ENTER_STEP_MODE;
            return change_mode(functions[ENTER_STEP_MODE], instance);
        }
    }
    outcome[ENDING] = STUCK;
    return status;
}

/* Step to the end; continue after early returns, and handle events when they occur. Return the fmi3Status.
 * The outcome reports an early return at a time outside the step, with the start of the step. */
static int step_to(
    const Run *run, const uint64_t *functions, uint64_t instance, double begin, double step, double end, bool uses_events)
{
    const StoredValues *const stored = &run->fmi3.stored;
    int64_t *const outcome = run->buffers.outcome;
    const double allowed = perilune_time_allowance(begin, end);
    double time = begin;
    for (int rounds = 0;;) {
        outcome[FUNCTION_CALLED] = DO_STEP;
        int status = do_step_to_event(functions[DO_STEP], instance, time, step, stored->flags, stored->time);
        if (!is_well(status)) return status;
        const double last = stored->time[0];
        if (stored->flags[2] && !(time - allowed <= last && last <= end + allowed)) { /* also true for NaN */
            outcome[ENDING] = OUTSIDE_STEP;
            stored->time[1] = time;
            return status;
        }
        const bool is_early = stored->flags[2] && end - last > allowed;
        const double now = is_early ? last : end;
        if (stored->flags[1]) {
            outcome[ENDING] = ENDED;
            stored->time[1] = now;
            return status;
        }
        if (stored->flags[0] && uses_events) {
            outcome[FUNCTION_CALLED] = ENTER_EVENT_MODE;
            status = change_mode(functions[ENTER_EVENT_MODE], instance);
            if (is_well(status)) status = settle(run, functions, instance);
            if (outcome[ENDING] != 0 || !is_well(status)) {
                stored->time[1] = now;
                return status;
            }
        }
        if (!is_early) return status;
        rounds = last <= time ? rounds + 1 : 0;
        if (rounds > MOST_ROUNDS) {
            outcome[ENDING] = STUCK;
            return status;
        }
        time = last;
        step = end - last;
    }
}
