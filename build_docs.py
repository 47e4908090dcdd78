"""Builder of the documentation site in build/site, from the pages under docs/ and pages derived from sources."""

from docs.reference.build import main

if __name__ == "__main__":
    raise SystemExit(main())
