"""The C of a kind of component: its block's, and the initialisation and the steps that FMI's wrapper gives it alone."""

from __future__ import annotations

from .component_source import ComponentSource

FILE = """\
/* The block {name} as a component of a system: translated, as the file says below, with a prefix before its names. */
#ifndef {guard}
#define {guard}

{text}
typedef struct {type} {{
    {block} block;
    int64_t tick; /* samples taken since the start */
}} {type};

/* From parameters and inputs to states and outputs. */
static void {prefix}initialize({type} *self, Fault *fault, double start_time)
{{
{given}
    self->tick = 0;
    {prefix}model_set_start_time(&self->block, start_time);
    {prefix}model_initialize(&self->block, fault);
}}

/* Advance from t to t + h; a sampled block steps at its sample instants only. */
static void {prefix}advance({type} *self, Fault *fault, double start_time, double t, double h)
{{
    const double period = {prefix}model_sample_period(&self->block);
    switch (count_samples(&self->tick, start_time, period, t + h)) {{
        case NO_SAMPLE: return;
        case ONE_SAMPLE: break;
        case SEVERAL_SAMPLES:
            fault->what = "StepError: the step holds more than one sample of its sample_period; use a longer period";
            return;
    }}
    if (h > STEP_LIMIT * {prefix}model_integration_step(&self->block)) {{
        fault->what = "StepError: the step holds more than a million integration steps; use a longer internal_step";
        return;
    }}
    {prefix}model_step(&self->block, fault, t, h);
}}

#endif
"""


def write_kind(source: ComponentSource) -> str:
    """The file of a kind of component, which the system's file includes."""
    name = source.prefix.removesuffix("_")
    return FILE.format(
        name=name,
        guard=f"{name.upper()}_H",
        text=source.text.rstrip("\n") + "\n",
        type=source.type_name,
        block=source.block,
        prefix=source.prefix,
        given="\n".join(f"    {line}" for line in _begin(source)),
    )


def _begin(source: ComponentSource) -> list[str]:
    """From the starts, but for parameters and inputs."""
    retained = [_retain(member, is_array) for member, is_array in source.given.items()]
    begin = f"self->block = {source.prefix}STARTS;"
    return [f"const {source.block} given = self->block;", begin, *retained] if retained else [begin]


def _retain(member: str, is_array: bool) -> str:
    if is_array:
        return f"memcpy(self->block.{member}, given.{member}, sizeof given.{member});"
    return f"self->block.{member} = given.{member};"


def file_name(source: ComponentSource) -> str:
    """Its name among the sources."""
    return f"{source.prefix.removesuffix('_')}.h"
