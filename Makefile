# Each target runs tools/setup first, which does nothing if the environment is complete.
GUDGEON := .venv/bin/gudgeon
ARGS ?=
# tests of a file share derived equations: one worker runs them all; tests/conftest.py sets their order
PYTEST := bin/pytest -n 2 --dist loadfile --no-loadscope-reorder -q
MYPY := .venv/bin/mypy -p gudgeon && .venv/bin/mypy tests
# Python's compiled modules are stored: otherwise each start would compile numpy and sympy again
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help run study study-jansen checks quick test test-all lint types fuzz docs links sanitize packages mutate coverage bench race map stress peers generated deviations tables setup setup-test clean
.NOTPARALLEL:

help:  ## this list
	@sed -n 's/^\([a-z-]*\):.*## /  make \1	/p' Makefile | expand -t 20

run: setup  ## the nine-bar press in three scenes: a table, and a picture under out/
	@$(GUDGEON) run nine_bar_press $(ARGS)

study: setup  ## Chen, Gao and Wang's paper (studies/chen_2022.yaml): its runs, values and trends, under out/
	@$(GUDGEON) study studies/chen_2022.yaml --out out/chen_2022.study $(ARGS)
	@$(GUDGEON) study report out/chen_2022.study

study-jansen: setup  ## trends of a paper on a Jansen leg with play (studies/jansen_wear.yaml): forces, wear, under out/
	@$(GUDGEON) study studies/jansen_wear.yaml --out out/jansen_wear.study $(ARGS)
	@$(GUDGEON) study report out/jansen_wear.study

checks: setup-test  ## measure and write the table of checks (docs/checks.md)
	@.venv/bin/python -m tests.checks

quick: setup-test  ## quick tests: an example test of each folder, invalid files, house rules; ARGS="tests/FOLDER" for more
	@.venv/bin/ruff check .
	@.venv/$(PYTEST) tests/*/test_example.py tests/reader/test_mistakes.py tests/test_house.py $(ARGS)

test: lint  ## ruff, mypy and the tests; mypy runs at the same time on one core, with its messages at the end
	@types=$$(mktemp); trap 'rm -f "$$types"' EXIT; \
	($(MYPY)) >"$$types" 2>&1 & typing=$$!; \
	.venv/$(PYTEST) $(ARGS); tested=$$?; \
	wait $$typing; typed=$$?; cat "$$types"; \
	[ $$typed -eq 0 ] && [ $$tested -eq 0 ]

test-all: lint types  ## the slow tests too, and the others under every later Python that is installed
	@.venv/$(PYTEST) -m "slow or not slow" $(ARGS)
	@for python in python3.12 python3.13 python3.14; do \
		if $$python -c "" 2>/dev/null; then \
			VENV=.venv-$$python PYTHON=$$python sh tools/setup all,test && .venv-$$python/$(PYTEST) $(ARGS) \
			|| exit 1; \
		fi; \
	done

lint: setup-test
	@.venv/bin/ruff check .
	@.venv/bin/ruff format --check -q .
	@.venv/bin/lint-imports
	@.venv/bin/python tools/prose.py
	@.venv/bin/codespell *.md docs engine generator runtime templates tools mechanisms studies benchmarks

types: setup-test
	@$(MYPY)

fuzz: setup-test  ## mutated expressions and files; ARGS="--count 1000000"; guided by coverage where atheris is installed
	@.venv/bin/python -m tests.fuzz expression $(ARGS)
	@.venv/bin/python -m tests.fuzz reader $(ARGS)
	@.venv/bin/python -m tests.fuzz compile $(if $(ARGS),$(ARGS),--count 300)

docs:  ## the documentation as a site under build/site: references from docstrings, the gallery's linkages running
	@sh tools/setup all,web,site
	@.venv/bin/python -m sphinx -W --keep-going -q -b html docs build/site && echo "wrote build/site/index.html"

links:  ## check all external links of the documentation; make docs checks the internal ones
	@sh tools/setup all,web,site
	@.venv/bin/python -m sphinx -q -b linkcheck -t text docs build/links && echo "every link leads somewhere"

sanitize: setup-test  ## the C of every shipped scene under gcc's sanitizers, random scenes under valgrind. An hour and more
	@.venv/bin/python -m tests.sanitize $(ARGS)
	@.venv/bin/python -m tests.sanitize --threads $(ARGS)
	@.venv/bin/python -m tests.memcheck

packages: setup-test  ## the wheel and the sdist, installed and run outside this folder under every Python that there is
	@.venv/bin/python -m tests.packages $(ARGS)

mutate: setup-test  ## mutants of equations, laws, reduction and methods: do their tests notice? ARGS="--count 40"
	@.venv/bin/python -m tests.mutate $(ARGS)

coverage:  ## lines that the default tests run, child processes included. Takes 1.5 times as long as make test
	@sh tools/setup all,test,cover
	@.venv/$(PYTEST) --cov --cov-report=term:skip-covered $(ARGS)

bench: setup  ## run time against error; one right-hand side compared with hand-written C
	@$(GUDGEON) bench nine_bar_press --mark-step 0.1ms $(ARGS)
	@.venv/bin/python -m benchmarks.rhs

race:  ## time to reach an error, gudgeon and other programs; writes docs/race.md. about 40 minutes, on an idle machine. ARGS="--work dry"
	@sh tools/setup all,bench
	@for package in mujoco pin drake casadi diffrax; do \
		.venv/bin/python -m pip --disable-pip-version-check install --quiet --constraint constraints.txt $$package || \
		echo "$$package: not installed"; done
	@.venv/bin/python -m benchmarks.race --write $(ARGS)

map: setup  ## step of rk4 × clearance: stable, inaccurate, diverged; without --method: tolerance × clearance
	@$(GUDGEON) map nine_bar_press --method rk4 --mark-step 0.1ms $(ARGS)

stress: map

peers: setup  ## scikit-sundae, for the methods sundials:*; the next `bench` includes them
	@.venv/bin/python -m pip --disable-pip-version-check install --quiet --constraint constraints.txt scikit-sundae

generated: setup  ## derive and write generated/ for every shipped mechanism; declarations of calls.h for Python
	@.venv/bin/python tools/declared.py
	@.venv/bin/python tools/regenerate.py

deviations: setup  ## docs/film_deviation.png and its table: each film law compared with the solver of Reynolds' equation
	@.venv/bin/python tools/deviations.py

tables: setup  ## from declarations: tables of docs/format.md, docs/laws.md, docs/map.md, engine/scene/function_table.h
	@.venv/bin/python tools/tables.py

setup:
	@sh tools/setup all

setup-test:
	@sh tools/setup all,test

clean:  ## remove the environment and everything built; the cache folder stays
	rm -rf .venv .venv-* build dist out src/*.egg-info .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
