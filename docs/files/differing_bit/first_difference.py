"""Print when two runs first differ, and in which signals: python first_difference.py FIRST SECOND."""

import sys

import pandas

here, there = (pandas.read_parquet(name) for name in sys.argv[1:3])
differs = (here != there) & ~(here.isna() & there.isna())
rows = differs.any(axis=1)
if rows.any():
    first = rows.idxmax()
    print(f"t = {here['time'][first]:g} s:", ", ".join(differs.columns[differs.loc[first]]))
else:
    print("no difference")
