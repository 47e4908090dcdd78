# make demo | test | quick | check ROOM=... | long | coverage | long-campaigns | build | web | docs | wheel | release | notebooks | explore | gains | checks | figures | screenshots | bench | sizes | bench-basilisk | crosscheck | basilisk | sanitize | fuzz | lowest | newest | elementary | processors | browser | browser-firefox | emulator | windows | lint | clean; each sets up .venv by itself.
PYTHON ?= python3
BIN := .venv/bin
# Basilisk: an environment of its own for cross-checks, and a folder next to ours for a plant.
CROSSCHECK := build/crosscheck
BASILISK := $(CURDIR)/build/basilisk
IMPORTERS := $(CURDIR)/build/importers
# On a terminal pip shows what it does, in a log nothing.
QUIET := $(shell [ -t 2 ] || echo --quiet)

# The tests start hundreds of processes, each quicker with the bytecode kept; and two workers leave no processor over
# for a second thread of BLAS, which would spin.
unexport PYTHONDONTWRITEBYTECODE
test quick long long-campaigns explore: export OPENBLAS_NUM_THREADS = 1

demo: .venv/demo
	$(BIN)/python build_web.py
	$(BIN)/python -m docs.figures.demo

test: WEB := --tools
test: .venv/ready lint build web
	-@[ "$$(id -u)" != 0 ] || ! command -v apt-get >/dev/null || $(MAKE) --no-print-directory browser emulator
	MAKEFLAGS= $(BIN)/python -m pytest -n 2 --dist loadfile

# What is proved without built FMUs: the mathematics, the language, expressions, laws, the arrows between rooms.
QUICK := tests/campaigns/definition tests/campaigns/compare tests/export/judge tests/design/laws tests/mathlib tests/documents/common tests/test_architecture.py tests/common/test_errors.py

quick: .venv/ready
	$(BIN)/ruff check .
	$(BIN)/python -m pytest -n 2 --dist loadfile -m 'not flies' $(QUICK)

# The tests for a change of one room in two minutes: make check ROOM=analysis/campaigns/draws.
check: build
	$(BIN)/python -m tests.times.check $(ROOM)

# The checks that take their whole size: every published start, system and noise, of which `make test` takes a part.
long: build
	PERILUNE_LONG=1 $(BIN)/python -m pytest -n 2 $$(grep -rlE 'support.lengths|mark.slow|tiny[,)]' tests --include='test_*.py')

# Lines and branches of the product that the suite executes, children too: half an hour to an hour. A failure changes
# little of the figures, which are printed all the same.
coverage: export COVERAGE_FILE = $(CURDIR)/build/coverage/data
coverage: build
	rm -rf build/coverage && mkdir build/coverage
	-$(BIN)/python -m coverage run -m pytest -n 2 --dist loadfile
	$(BIN)/python -m coverage combine --quiet
	$(BIN)/python -m coverage json --quiet -o build/coverage/report.json
	$(BIN)/python -m tests.times.covered build/coverage/report.json

# The same of campaigns alone: rare failures, worst cases beside a hundred thousand random trials, what drives metrics,
# verdicts, campaigns that end early and go on; a quarter of an hour to an hour on two cores.
CAMPAIGNS := tests/campaigns tests/studies

long-campaigns: build
	PERILUNE_LONG=1 $(BIN)/python -m pytest -n 2 $(CAMPAIGNS)

build: .venv/ready web
	$(BIN)/python build_fmus.py

# The scripts of report pages, bundled from web/ with packages of the npm registry; without it pages are static.
web: .venv/ready
	$(BIN)/python build_web.py $(WEB)

# The documentation as a site, build/site/index.html: it needs no server and no network. Broken links fail.
docs: build
	$(BIN)/python build_docs.py

# What one installs elsewhere with pip: build/wheel/perilune-VERSION-py3-none-any.whl, native FMUs of all platforms inside.
wheel: .venv/ready
	$(BIN)/python -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir build/wheel .

# Wheel and source distribution, each built twice and compared, then the changelog's head, a commit and a tag (CONTRIBUTING.md).
release: .venv/ready
	$(BIN)/python -m release

# The notebooks of docs/notebooks as pages with their results: build/notebooks/NAME.html.
notebooks: build
	mkdir -p build/notebooks/run
	cp docs/notebooks/*.ipynb build/notebooks/run
	cd build/notebooks/run && ../../../$(BIN)/python -m jupyter nbconvert --to html --execute --output-dir .. *.ipynb

# The property tests with examples drawn anew; what it finds goes into a test as an @example.
explore: build
	PERILUNE_EXPLORE=1 $(BIN)/python -m pytest -n 2 $$(grep -rl 'from hypothesis' tests --include='test_*.py')

# Gains that follow from the capsule's aerodynamic table, into the parameter sets of entry_attitude; and the norm of the
# gain of the whole model, which no regulator has.
gains: .venv/ready
	$(BIN)/python -m docs.figures.entry_gains

# The checks of blocks, from truths that share no line with them: fmus_src/KIND/checks/NAME.csv and NAME.toml.
checks: .venv/ready
	$(BIN)/python -m tests.support.checks

# The pictures of docs/images, each below 100 kB; those of modal synthesis take two minutes.
FIGURES := concept system_figures readme_figure rendezvous_figures modal_comparison papers.fomichev_li papers.huang laws.descent

figures: build
	for name in $(FIGURES); do $(BIN)/python -m docs.figures.$$name || exit 1; done

# The pictures of pages in docs/images/pages, each below 100 kB, taken in Chromium.
screenshots: build browser
	$(BIN)/python -m docs.figures.screenshots

# How wide characters of figures are, from the font that matplotlib has: analysis/documents/font/advances.json.
font: .venv/ready
	$(BIN)/python -m release.font

bench: build
	$(BIN)/python -m benchmarks.importers

# What `pip install perilune` takes on disk, alone and with each extra: the table of README.md; five minutes.
sizes: wheel
	$(BIN)/python -m release.sizes

# Instructions, counted by callgrind (Debian's valgrind), and time of a plan and of a cycle of each descent law.
guidance-cost: build
	@command -v valgrind >/dev/null || { apt-get update -qq && apt-get install -y -qq valgrind >/dev/null; }
	$(BIN)/python -m benchmarks.guidance_cost

# Trials a second of a landing here and in Basilisk's Monte Carlo controller, on the same draws: five minutes.
bench-basilisk: build $(CROSSCHECK)/ready $(BASILISK)/ready
	PYTHONPATH=$(CURDIR):$(BASILISK) $(BIN)/python -m benchmarks.basilisk $(CURDIR)/$(CROSSCHECK)/bin/python

# How time and memory grow with the size of a system, to 10 000 components and 100 000 connections.
large: build
	$(BIN)/python -m benchmarks.large_systems

# Every exported FMU in the importers of the package index: the table of docs/guides/importers.md; a quarter of an hour.
importers: build $(IMPORTERS)/ready
	PYTHONPATH=$(CURDIR):$$(echo $(IMPORTERS)/lib/python3*/site-packages) LD_LIBRARY_PATH=$(IMPORTERS)/lib \
		$(BIN)/python -m tests.importers

$(IMPORTERS)/ready: .venv/ready
	$(BIN)/pip install $(QUIET) --disable-pip-version-check --no-deps --ignore-installed --prefix $(IMPORTERS) ecospy==0.7.2 tbb==2023.2.0 tcmlib==1.6.0
	touch $@

# The same flights and models here and in Basilisk, which has an environment of its own: the tables and figures of docs/concepts/crosscheck.md.
crosscheck: build $(CROSSCHECK)/ready
	$(BIN)/python -m crosscheck $(CROSSCHECK)/bin/python

$(CROSSCHECK)/ready: crosscheck/requirements.txt
	$(PYTHON) -m venv $(CROSSCHECK)
	$(CROSSCHECK)/bin/pip install $(QUIET) --disable-pip-version-check -r crosscheck/requirements.txt
	touch $@

# A plant that Basilisk simulates (docs/guides/basilisk.md), with Basilisk next to the packages of .venv.
basilisk: build $(BASILISK)/ready
	PYTHONPATH=$(BASILISK) $(BIN)/python -m pytest tests/examples

$(BASILISK)/ready: .venv/ready
	$(BIN)/pip install $(QUIET) --disable-pip-version-check --no-deps --upgrade --target $(BASILISK) bsk==2.12.1 colorama tqdm
	touch $@

# The C of every block under the address and undefined-behaviour sanitizers, 10000 steps each, fused steps of all
# systems, and their FMUs, in threads.
sanitize: build
	PERILUNE_LONG=1 PERILUNE_TEST_SAMPLES=50 $(BIN)/python -m pytest -n 2 tests/export/test_sanitizers.py tests/export/fmi3/test_sanitizers.py tests/runtime/fused/test_sanitizers.py tests/runtime/loop/test_sanitizers.py tests/export/system_fmu/test_sanitizers.py

# What others may hand in, changed at random under atheris and libFuzzer (Debian's clang, installed as root): manifests,
# shards, documents, tables, archives, and calls of native FMUs. It takes hours; FUZZ="--runs N" takes N of each,
# FUZZ="shards" one target.
ATHERIS := atheris==3.0.0
FUZZ ?=

fuzz: build
	@command -v clang >/dev/null || { apt-get update -qq && apt-get install -y -qq clang >/dev/null; }
	$(BIN)/python -m pip install $(QUIET) --disable-pip-version-check --target build/fuzz/site --upgrade $(ATHERIS)
	PYTHONPATH=build/fuzz/site $(BIN)/python -m tests.fuzz $(FUZZ)

# The suite with the oldest and with the newest packages that pyproject.toml permits, each in an environment of its own;
# before it a noisy flight of each system, which has the lock's bits. PYTHON=python3.13 has newer ones than 3.11.
ENDS := build/ends

lowest: CONSTRAINTS = --constraint $(ENDS)/floors.txt
lowest newest: build
	mkdir -p $(ENDS)
	$(BIN)/python -m tests.package.floors > $(ENDS)/floors.txt
	$(PYTHON) -m venv $(ENDS)/$@
	$(ENDS)/$@/bin/pip install $(QUIET) --disable-pip-version-check 'setuptools>=77'
	$(ENDS)/$@/bin/pip install $(QUIET) --disable-pip-version-check --upgrade --upgrade-strategy eager --no-build-isolation \
		$(CONSTRAINTS) --editable '.[dev]'
	$(BIN)/python -m tests.package.flights > $(ENDS)/lock.flights
	$(ENDS)/$@/bin/python -m tests.package.flights > $(ENDS)/$@.flights
	diff $(ENDS)/lock.flights $(ENDS)/$@.flights
	$(ENDS)/$@/bin/python -m pytest -n 2 --dist loadfile

# The elementary functions: errors of a million arguments each against mpmath, and the coefficients of their polynomials.
elementary: .venv/ready
	PERILUNE_ELEMENTARY_SAMPLES=1000000 $(BIN)/python -m pytest -n 2 -rP tests/kernel
	$(BIN)/python -m tests.kernel.coefficients

# The same bits everywhere: whole campaigns with less of the processor, the C of every block by every compiler, and the
# shipped Windows libraries and the loop under Wine.
processors: build emulator windows
	PERILUNE_LONG=1 $(BIN)/python -m pytest -n 2 tests/processors tests/runtime/loop/test_platforms.py

# What the tests of the C on aarch64 need, from Debian's packages (as root), its C library among them; without it they
# are left out.
emulator:
	@command -v qemu-aarch64-static >/dev/null && [ -d /usr/aarch64-linux-gnu/lib ] || \
		{ apt-get update -qq && apt-get install -y -qq --no-install-recommends qemu-user-static libc6-arm64-cross >/dev/null; }

# What runs the Windows libraries, from Debian's packages (as root).
windows:
	@command -v wine >/dev/null || { apt-get update -qq && apt-get install -y -qq --no-install-recommends wine wine64 >/dev/null; }

# What the tests of the HTML pages need, from Debian's packages (as root). `make test` tries it where it can; without a
# browser these tests are left out, which the last lines say.
browser:
	@command -v chromium >/dev/null && command -v chromedriver >/dev/null || \
		{ apt-get update -qq && apt-get install -y -qq chromium chromium-driver >/dev/null; }

# The pages in Firefox, too (Debian's, installed as root).
browser-firefox: WEB := --tools
browser-firefox: build
	@command -v firefox-esr >/dev/null || { apt-get update -qq && apt-get install -y -qq --no-install-recommends firefox-esr >/dev/null; }
	PERILUNE_REQUIRE_FIREFOX=1 $(BIN)/python -m pytest tests/documents/interactive/test_firefox.py

lint: .venv/ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/mypy --warn-unused-ignores --follow-imports=silent tests/verbs/wrong_calls.py

# The first thing that any target does: with another Python than pyproject.toml's it says so and makes nothing.
.venv/python: pyproject.toml constraints.txt setup.py
	@$(PYTHON) -c "import re, sys; \
		low, high = map(int, re.findall(r'3\.(\d+)', re.search('requires-python.*', open('pyproject.toml').read()).group())); \
		sys.exit(0 if (3, low) <= sys.version_info < (3, high) else 'Perilune needs Python 3.%d to 3.%d, and $(PYTHON) is %s; ' \
		'give another one: make PYTHON=python3.%d' % (low, high - 1, sys.version.split()[0], high - 1))"
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install $(QUIET) --disable-pip-version-check 'setuptools>=77'
	touch $@

INSTALL = $(BIN)/python -m pip install $(QUIET) --disable-pip-version-check --no-build-isolation --constraint constraints.txt --editable

.venv/ready: .venv/python
	@echo 'Installing Perilune with its packages and tools into .venv; it takes about a minute ...'
	$(INSTALL) '.[dev]'
	touch $@

# Without the tools of tests and documentation, unless they are there.
.venv/demo: .venv/python
	@echo 'Installing Perilune with its packages into .venv ...'
	[ -e .venv/ready ] || $(INSTALL) '.[build]'
	touch $@

clean:
	rm -rf build .venv

.PHONY: demo test quick check coverage long long-campaigns build web docs wheel release notebooks explore gains checks figures screenshots bench font sizes guidance-cost bench-basilisk large importers crosscheck basilisk sanitize fuzz lowest newest processors emulator windows browser browser-firefox lint clean
