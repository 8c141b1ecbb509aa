# All tasks for a checkout. `make demo` and `make test` install what they need in .venv and in the
# user's cache folder; PYTHON names the Python that makes the environment.

PYTHON ?= $(shell command -v python3.11 || command -v python3 || echo python3)
SECONDS ?= 60
SEED ?= $(shell date +%s)
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --quiet --disable-pip-version-check
LOCKED := --require-hashes --only-binary :all:
LOCK := uv pip compile --quiet --universal --generate-hashes --no-annotate --python-version 3.11 \
	--custom-compile-command 'make locks' --upgrade

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo gallery test quick lint bench fuzz tools locks clean

help: ## List everything that make can do
	@sed -n 's/^\([a-z]*\):.*## /make \1\t/p' $(MAKEFILE_LIST) | expand -t 14

demo: $(VENV)/installed ## Compile examples/plastic.burnish for all backends into build/, and draw it
	@$(BIN)/python -m burnish.generate
	@$(BIN)/burnish compile examples/plastic.burnish -o build
	@$(BIN)/burnish render examples/plastic.burnish -o build/plastic.png
	@echo
	@echo 'build/Plastic.vert.*   vertex shaders: hlsl for Direct3D, glsl for Vulkan, wgsl for WebGPU'
	@echo 'build/Plastic.frag.*   fragment shaders, likewise'
	@echo 'build/Plastic.json     the reflection: what a host has to bind where'
	@echo 'build/plastic.png      what it looks like, drawn by the reference: on the CPU, without a driver'
	@echo
	@echo 'Next: . $(BIN)/activate; burnish --help'

gallery: tools ## Make pages that show all examples: pictures, shaders, graphs, verdicts
	@$(BIN)/python -m burnish.generate
	@$(BIN)/burnish gallery examples -o build/gallery
	@echo
	@echo 'build/gallery/index.html   open it in a browser'

test: tools lint ## Install what the tests need, then check style, types and behaviour
	$(BIN)/python -m pytest -n auto --dist loadgroup

quick: lint ## The same, but for the tests that take long: for while you work
	$(BIN)/python -m pytest -n auto --quick

lint: $(VENV)/dev build/mypy/burnish ## Check style and types
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

bench: tools ## Measure; prints tables and writes build/bench.json
	@$(MAKE) --no-print-directory $(VENV)/bench || echo 'the tables say "not run" of what is missing'
	$(BIN)/python -m tests.bench

fuzz: tools ## Try random programs: make fuzz SECONDS=600 SEED=1
	$(BIN)/python -m burnish.tests.fuzz --seconds $(SECONDS) --seed $(SEED)

tools: $(VENV)/dev ## Install the downstream compilers, the drivers and the browser
	$(BIN)/python -m burnish.targets.toolchain.install

locks: ## Choose newer versions of all Python packages; needs uv, and is for who looks after Burnish
	$(LOCK) --extra dev --output-file .ci/dev.txt pyproject.toml
	$(LOCK) --extra bench --constraint .ci/dev.txt --output-file .ci/bench.txt pyproject.toml
	echo 'setuptools>=77' | $(LOCK) --extra render --output-file .ci/render.txt pyproject.toml -
	echo 'pip' | $(LOCK) --output-file .ci/pip.txt -

clean: ## Remove everything that make has created in the checkout
	rm -rf $(VENV) build dist generated targets/web_host/generated *.egg-info .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -prune -exec rm -rf {} +

$(BIN)/python:
	.ci/venv $(PYTHON) $(VENV)

# Downloads have the digests of a lock, and nothing of them is built here.
$(VENV)/installed: .ci/render.txt pyproject.toml setup.py | $(BIN)/python
	$(PIP) install $(LOCKED) --requirement .ci/render.txt
	$(PIP) install --no-deps --no-build-isolation --editable .
	@touch $@

$(VENV)/dev: .ci/dev.txt $(VENV)/installed
	$(PIP) install $(LOCKED) --requirement .ci/dev.txt
	@touch $@

# Other compilers, to be measured beside Burnish.
$(VENV)/bench: .ci/bench.txt $(VENV)/dev
	$(PIP) install $(LOCKED) --requirement .ci/bench.txt
	@touch $@

# The checkout as a package called burnish, whatever its folder is called, for mypy.
build/mypy/burnish:
	mkdir -p build/mypy
	ln -s ../.. $@
