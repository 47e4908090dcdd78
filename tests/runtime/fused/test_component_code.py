"""C of several FMUs within one translation unit: names, texts, headers.

Truth: the C compiler, for two components that use the same names with different meanings; texts by hand.
"""

import ctypes

from perilune.analysis.runtime.fused.component_code import component_code
from perilune.analysis.runtime.fused.unit import EXPORT
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.libraries import library_files

TYPES = (
    "typedef struct Component { struct { int block; } now; } Component;\ntypedef struct { unsigned offset; } Element;\n"
)
MODEL = """
/* A comment with "a text" in it, and a name: value */
#include <stdint.h>
#include <stddef.h>
#include "shared.h"
#define TWICE(x) (2.0 * (x))
#define SCALE(n) double scale_##n(double x) {{ return {factor} * x; }}
SCALE(3)
static const Element ELEMENTS[] = {{{{0}}}};
_UNIT_EXPORT double compute(double x) {{ return TWICE(scale_3(x)) + 1.5e1 + 0x1.8p1; }}
_UNIT_EXPORT const char *say(void) {{ return "compute TWICE {factor} /* as it is */"; }}
#include "fmi2_wrapper.h"
"""


def test_names_of_two_components_do_not_meet(tmp_path):
    shared = {
        "shared.h": "#ifndef SHARED_H\n#define SHARED_H\n" + TYPES + "#endif\n",
        "fmi2_types.h": "",
        "life_cycle.h": "",
    }
    codes = [
        component_code({**shared, "m.c": MODEL.format(factor=factor)}, "m", prefix, "m.fmu")
        for prefix, factor in (("a_", 3.0), ("b_", 5.0))
    ]
    headers = "".join(f"#include {header}\n" for header in sorted(codes[0].headers))
    text = headers + EXPORT + "".join(code.text for code in codes)
    (file,) = library_files({"unit.c": text.encode()}, "unit.c", local_platform(), tmp_path)
    library = ctypes.CDLL(str(file))
    for prefix, factor in (("a_", 3.0), ("b_", 5.0)):
        compute, say = getattr(library, f"{prefix}compute"), getattr(library, f"{prefix}say")
        compute.restype, compute.argtypes, say.restype = ctypes.c_double, [ctypes.c_double], ctypes.c_char_p
        assert compute(1.25) == 2.0 * factor * 1.25 + 15.0 + 3.0
        assert say().decode() == f"compute TWICE {factor} /* as it is */"
