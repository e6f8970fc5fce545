#!/usr/bin/env bash
# Builds a wheel without network and runs the examples in a new environment that has it and Debian's numpy.
# wheel_test.sh SOURCE WORK PYTHON; exits with 77 where there is no scikit-build-core.
set -euo pipefail
source=$1 work=$2 python=$3
unset_path() { env -u PYTHONPATH "$@"; }
if ! "$python" -c 'import scikit_build_core' 2>/dev/null; then
  echo "wheel_test: no scikit-build-core (pip install scikit-build-core); no wheel was built" >&2
  exit 77
fi
rm -rf "$work"
mkdir -p "$work"
"$python" -m pip wheel "$source" --no-build-isolation --no-deps --no-index --wheel-dir "$work/dist"
"$python" -m venv --system-site-packages "$work/venv"
unset_path "$work/venv/bin/pip" install --no-index --no-deps "$work"/dist/berth-*.whl
cd "$work"
unset_path "$work/venv/bin/python" -m berth --version
unset_path "$work/venv/bin/python" -c "import berth; assert berth.__file__.startswith('$work/venv'), berth.__file__"
cat > boxes.urdf <<'URDF'
<robot name="boxes"><link name="base_link"><visual><geometry><box size="0.2 0.2 0.6"/></geometry></visual></link></robot>
URDF
unset_path "$work/venv/bin/python" "$source/examples/python/one_frame.py" boxes.urdf
unset_path "$work/venv/bin/python" "$source/examples/python/look_ahead.py" "$source/data/bundled/scene.yaml"
unset_path "$work/venv/bin/python" "$source/examples/python/calibrate.py" "$source/data/bundled/one_camera.yaml" new.yaml
