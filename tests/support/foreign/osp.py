"""OspSystemStructure.xml in short form, and its results in libcosim."""

import numpy as np

HEAD = '<OspSystemStructure xmlns="http://opensimulationplatform.com/MSMI/OSPSystemStructure" version="0.1">'


def structure(simulators, connections, functions=""):
    """Return a document; ``functions`` are lines between simulators and connections."""
    return (
        f"{HEAD}\n<BaseStepSize>0.125</BaseStepSize>\n<Algorithm>fixedStep</Algorithm>\n<Simulators>\n{simulators}\n</Simulators>\n"
        f"{functions}<Connections>\n{connections}\n</Connections>\n</OspSystemStructure>\n"
    )


def simulator(name, fmu, step=None, **values):
    inside = "".join(
        f'<InitialValue variable="{variable}"><Real value="{value}"/></InitialValue>'
        for variable, value in values.items()
    )
    attribute = "" if step is None else f' stepSize="{step}"'
    return f'<Simulator name="{name}" source="{fmu}.fmu"{attribute}><InitialValues>{inside}</InitialValues></Simulator>'


def joined(start, end, kind="Variable"):
    inside = "".join(
        f'<{kind} simulator="{simulator}" name="{name}"/>'
        for simulator, _, name in (p.partition(".") for p in (start, end))
    )
    return f"<{kind}Connection>{inside}</{kind}Connection>"


def groups(**variables):
    """Return an OspModelDescription.xml: the variables of each group, in one word."""
    inside = "".join(
        f'<Generic name="{name}">{"".join(f"""<Variable ref="{each}"/>""" for each in names.split())}</Generic>'
        for name, names in variables.items()
    )
    namespace = "http://opensimulationplatform.com/MSMI/OSPModelDescription"
    return (
        f'<OspModelDescription xmlns="{namespace}" version="1.0">'
        f"<VariableGroups>{inside}</VariableGroups></OspModelDescription>"
    )


def write_osp(folder, tiny_folder, text, fmus="", **others):
    """Write a folder as libcosim takes it: FMUs next to the file, or in its folder ``fmus``; and other XML files."""
    folder.mkdir(parents=True, exist_ok=True)
    fmu_folder = folder / fmus
    fmu_folder.mkdir(parents=True, exist_ok=True)
    for name in ("ramp", "gain", "delay", "cross", "whole"):
        (fmu_folder / f"{name}.fmu").write_bytes((tiny_folder / "native" / f"{name}.fmu").read_bytes())
    (folder / "OspSystemStructure.xml").write_text(text)
    for name, content in others.items():
        (folder / f"{name}.xml").write_text(content)
    return folder


def libcosim(folder, outputs, steps):
    """Simulate by libcosim; return values [steps, outputs] after each base step."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    execution = CosimExecution.from_osp_config_file(str(folder / "OspSystemStructure.xml"))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer)
    actual = []
    for _ in range(steps):
        assert execution.step(1)
        row = []
        for name in outputs:
            owner, _, variable = name.partition(".")
            index = execution.slave_index_from_instance_name(owner)
            references = {item.name.decode(): item.reference for item in execution.slave_variables(index)}
            row += observer.last_real_values(index, [references[variable]])
        actual.append(row)
    return np.array(actual)
