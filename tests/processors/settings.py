"""Another processor, as the libraries that choose their code by its features see it."""

from __future__ import annotations

from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

# The C library without the variants for AVX2 and fused operations; names of glibc before and after 2.33.
C_LIBRARY = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4"}
NUMPY = {"NPY_DISABLE_CPU_FEATURES": " ".join(name for name in __cpu_dispatch__ if __cpu_features__[name])}

PROCESSORS: dict[str, dict[str, str]] = {
    "old": {**C_LIBRARY, **NUMPY, "OPENBLAS_CORETYPE": "Prescott"},
    "Haswell": {"OPENBLAS_CORETYPE": "Haswell"},
}
