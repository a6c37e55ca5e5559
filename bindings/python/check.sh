#!/bin/sh
# Builds the Python package in a virtual environment of its own and runs its checks: golden values,
# pytest, mypy, stubtest. Skipped in one line where Python 3.10 or newer is missing.
set -eu
cd "$(dirname "$0")"
python=${PYTHON:-python3}
if ! "$python" -c 'import sys, venv; sys.exit(sys.version_info < (3, 10))' 2>/dev/null; then
    echo "skipped: the Python package needs Python 3.10 or newer with venv"
    exit 0
fi
venv=target/venv
"$python" -m venv "$venv"
"$venv/bin/pip" install --quiet --disable-pip-version-check '.[test]'
cargo test --quiet --locked --release --workspace
"$venv/bin/python" -m pytest --quiet tests
"$venv/bin/python" -m mypy --strict python examples
"$venv/bin/python" -m mypy.stubtest asperity --mypy-config-file pyproject.toml
