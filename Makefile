# make demo       set everything up, calibrate a simulated 7-joint arm, write its report to demo-result/
# make test       set everything up, then ctest, pytest, ruff and mypy
# make install    only the set-up: .venv/bin/circlepoint
# make reproduce  every number and figure of the paper with ours, in reproduction/
# Each target does its own set-up on a bare Debian 12 and is quick when there is nothing to do.
.DEFAULT_GOAL := help
SHELL := /bin/bash
PYTHON ?= python3
BIN := .venv/bin
PACKAGES := g++ cmake ninja-build make python3-venv python3-dev ccache libeigen3-dev libceres-dev liborocos-kdl-dev \
            libgtest-dev libgmock-dev libbenchmark-dev
SOURCES := CMakeLists.txt pyproject.toml README.md LICENSE $(shell find cmake cpp python -type f -not -path '*/__pycache__/*')
export CMAKE_CXX_COMPILER_LAUNCHER := ccache
# One name for the compiler in every build: the cache tells c++ and g++ apart.
export CXX
export CCACHE_BASEDIR := $(CURDIR)
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(shell nproc)

.PHONY: help demo reproduce test whole-arm-accuracy install system ctest pytest lint stub bench bench-growth accuracy clean

help:
	@sed -n 's/^# //p' Makefile | head -5

# Debian packages, only when one is missing.
system:
	@missing=""; for package in $(PACKAGES); do \
	  dpkg-query -W -f='$${Status}' $$package 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$package"; done; \
	if [ -n "$$missing" ]; then \
	  echo "installing Debian packages:$$missing"; \
	  as_root=""; [ "$$(id -u)" = 0 ] || as_root=sudo; \
	  $$as_root apt-get update -qq && \
	  DEBIAN_FRONTEND=noninteractive $$as_root apt-get install -y -qq --no-install-recommends $$missing >/dev/null; fi

$(BIN)/python: | system
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --upgrade 'pip>=25.1'

# The build's own tools live in the venv: with pip's throw-away build environments every install would compile anew.
.venv/build.stamp: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet 'scikit-build-core>=0.10' 'pybind11~=3.1.0'
	@touch $@

.venv/dev.stamp: pyproject.toml | .venv/build.stamp
	$(BIN)/python -m pip install --quiet --group dev
	@touch $@

.venv/install.stamp: $(SOURCES) | .venv/build.stamp
	$(BIN)/python -m pip install --quiet --no-build-isolation --config-settings=cmake.define.CIRCLEPOINT_WERROR=ON .
	@touch $@

install: .venv/install.stamp

demo: install
	$(BIN)/circlepoint demo --out demo-result

reproduce: install
	$(BIN)/circlepoint reproduce --out reproduction

ctest: system
	cmake --preset release >/dev/null
	cmake --build --preset release
	ctest --preset release

pytest: install .venv/dev.stamp
	$(BIN)/python -m pytest -n $(CMAKE_BUILD_PARALLEL_LEVEL)

lint: install .venv/dev.stamp
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

# Errors under the paper's noise model, 100 seeds a figure; fails where a figure exceeds its limit.
accuracy: install
	$(BIN)/python bench/python/paper_noise.py

# The whole-arm estimate: efficiency against the Cramer-Rao bound and honesty, SEEDS a case (200: some 25 minutes), then what it
# makes of the recordings in the folder CIRCLEPOINT_SHARED_DATA, where there is one, and its time by samples.
SEEDS ?= 200
whole-arm-accuracy: install
	$(BIN)/python bench/python/whole_arm_accuracy.py $(SEEDS)
	$(BIN)/python bench/python/whole_arm_recordings.py $(CIRCLEPOINT_SHARED_DATA)

.venv/bench.stamp: pyproject.toml | .venv/dev.stamp
	$(BIN)/python -m pip install --quiet --group bench
	@touch $@

# Ratios to SciPy, NumPy and Numba and the distance to the machine's limits, each set in one process (some 25 minutes, 4 GB);
# then the time of each stage, beside Ceres and KDL. Kept in bench/results.
bench: install .venv/bench.stamp
	$(BIN)/python bench/python/bench_kernels.py --out bench/results
	$(BIN)/python bench/python/bench_calibration.py --out bench/results
	cmake --workflow --preset bench
	build/bench/bench/circlepoint_bench --benchmark_context=commit=$$(git rev-parse --short HEAD) \
	  --benchmark_out=bench/results/stages.json --benchmark_out_format=json

# Cost and memory against samples, joints, tests and threads (some 10 minutes, 6 GB).
bench-growth: install .venv/bench.stamp
	$(BIN)/python bench/python/bench_growth.py --out bench/results

# The type stub of the compiled core; after every change of the bindings.
stub: install .venv/dev.stamp
	$(BIN)/python tests/python/core_stub.py python/circlepoint/_core.pyi

test: install ctest pytest lint

clean:
	rm -rf build .venv demo-result reproduction
