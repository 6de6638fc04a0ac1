#!/usr/bin/env bash
# python.sh FOLDER BUILD PYTHON: runs the tests of a folder by pytest, with the Python module of a build folder.
set -euo pipefail
folder=$1 build=$2 python=$3
if [ -z "$python" ] || ! compgen -G "$build/python/hyalite/_hyalite*.so" >/dev/null; then
    echo "python.sh: the Python module was not built: install python3-dev and pybind11-dev, and run CMake again" >&2
    exit 1
fi
if ! "$python" -c "import numpy, pytest" || { [[ $folder == */installed ]] && ! "$python" -c "import matplotlib, nbclient, ipykernel"; }; then
    echo "python.sh: install python3-numpy, python3-pytest, python3-matplotlib, python3-nbclient and python3-ipykernel" >&2
    exit 1
fi
export HYALITE_BUILD=$build HYALITE_SOURCE=$(cd "$(dirname "$0")/.." && pwd) HYALITE_PROGRAM=$build/bin/hyalite
export PYTHONPATH=$build/python PYTHONDONTWRITEBYTECODE=1
export GALLIVM_PERF=nopt LP_NATIVE_VECTOR_WIDTH=128 # lavapipe compiles faster, as in tests/fixtures/test_extent.h
exec "$python" -m pytest -q -p no:cacheprovider "$folder"
