# All the set-up there is: `make lab` to learn, `make test` to check. Both make a virtual
# environment in .venv on the first call and leave the system's Python alone. They need Python 3.11
# or newer and nothing else. The pip lines they stand for are in the README.

.DEFAULT_GOAL := help
SHELL := /bin/sh

# Another interpreter or place: make lab PYTHON=python3.12 VENV=/tmp/venv
PYTHON ?=
VENV ?= .venv
DIR ?= my-lessons
WORKERS ?= 2

CANDIDATES = $(PYTHON) $(if $(PYTHON),,python3 python3.14 python3.13 python3.12 python3.11 python)
BIN = $(VENV)/bin
RUN = $(BIN)/python
PIP = $(RUN) -m pip --disable-pip-version-check install --quiet
NEW_ENOUGH = import sys; sys.exit(sys.version_info < (3, 11))

# A stamp is as new as the last installation; a changed pyproject.toml asks for another one.
LAB_READY = $(VENV)/.ready-lab
DEV_READY = $(VENV)/.ready-dev

.PHONY: help lab check lessons test test-quick test-browser lint format types bench wheel clean distclean

help: ## this list
	@echo "make TARGET, where TARGET is one of"
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  \1|\2/p' $(MAKEFILE_LIST) | awk -F'|' '{printf "%-16s%s\n", $$1, $$2}'

lab: $(LAB_READY) ## open JupyterLab on your copy of the lessons (DIR=my-lessons)
	@exec $(RUN) -m ruledlab lab "$(DIR)"

check: $(LAB_READY) ## say for each part of the set-up whether it is ready
	@$(RUN) -m ruledlab check

lessons: $(LAB_READY) ## copy the lessons to DIR without opening them
	@$(RUN) -m ruledlab lessons "$(DIR)"

test: lint types ## every check and every test; browser tests skip without Chromium
	$(RUN) -m pytest -n $(WORKERS) -m "not browser"
	$(RUN) -m pytest -m browser

test-quick: $(DEV_READY) ## the tests that need neither a browser nor a notebook
	$(RUN) -m pytest -n $(WORKERS) -m "not browser" --ignore=tests/lessons

test-browser: $(DEV_READY) ## the tests in a real browser
	$(RUN) -m pytest -m browser

lint: $(DEV_READY) ## ruff, for rules and form
	$(RUN) -m ruff check .
	$(RUN) -m ruff format --check .

format: $(DEV_READY) ## let ruff put the form right
	$(RUN) -m ruff check --fix .
	$(RUN) -m ruff format .

types: $(DEV_READY) ## mypy, strict on what computes
	$(RUN) -m mypy

bench: $(DEV_READY) ## the benchmarks: one table, ratios in one run
	$(RUN) -m benchmarks

wheel: $(DEV_READY) ## build dist/ruledlab-….whl with the lessons inside
	$(RUN) -m build --wheel

clean: ## remove what tests and builds leave behind
	rm -rf build dist artifacts .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -path ./.venv -prune -o -name __pycache__ -type d -exec rm -rf {} +

distclean: clean ## … and the virtual environment (your lessons stay)
	rm -rf "$(VENV)"

$(LAB_READY): pyproject.toml | $(RUN)
	@echo "Installing ruledlab and JupyterLab into $(VENV) (once; a few minutes) …"
	@$(PIP) --editable ".[lab]"
	@touch $@

$(DEV_READY): pyproject.toml | $(RUN)
	@echo "Installing ruledlab with its tests and tools into $(VENV) (once; a few minutes) …"
	@$(PIP) --editable ".[dev]"
	@touch $@ $(LAB_READY)

# Not a target that depends on anything: an environment is made once and then updated.
$(RUN):
	@for python in $(CANDIDATES); do \
	  if command -v "$$python" >/dev/null 2>&1 && "$$python" -c '$(NEW_ENOUGH)' 2>/dev/null; then \
	    if ! "$$python" -c 'import ensurepip, venv' 2>/dev/null; then \
	      echo "$$python cannot make virtual environments: its venv module is missing." >&2; \
	      echo "On Debian and Ubuntu: sudo apt install python3-venv; then run make again." >&2; \
	      exit 1; \
	    fi; \
	    echo "Making a virtual environment in $(VENV) with $$("$$python" --version) …"; \
	    "$$python" -m venv "$(VENV)" && exit 0; \
	    rm -rf "$(VENV)"; exit 1; \
	  fi; \
	done; \
	echo "No Python 3.11 or newer found (looked for: $(strip $(CANDIDATES)))." >&2; \
	echo "Install one from python.org or your package manager, or name one:" >&2; \
	echo "  make $(firstword $(MAKECMDGOALS)) PYTHON=/path/to/python3.12" >&2; \
	exit 1
