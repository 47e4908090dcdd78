/* Callback of FMUs of FMI 3.0 during their steps: exchanges nothing and requests no early return. */
EXPORT void perilune_ignore_update(
    void *environment,
    double time,
    bool set_requested,
    bool get_allowed,
    bool step_finished,
    bool can_return_early,
    bool *early_return_requested,
    double *early_return_time)
{
    (void)environment, (void)time, (void)set_requested, (void)get_allowed, (void)step_finished;
    (void)can_return_early, (void)early_return_time;
    *early_return_requested = false;
}
