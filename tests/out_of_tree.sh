#!/bin/bash
# tests/out_of_tree.sh BUILD_FOLDER
# What somebody does who writes a plugin of their own: from an installed Mesogen, in a folder outside this tree, a new
# plugin of each kind is written, built, tested, found and used in a run; the examples too. Then the installation is
# moved elsewhere and still finds its plugins.
set -euo pipefail
build=$(realpath -- "$1")
source=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset MESOGEN_PLUGIN_PATH
export CMAKE_GENERATOR=Ninja
cd "$work"

# Only what failed is worth reading.
quietly() {
  if ! "$@" >"$work/log" 2>&1; then
    echo "failed: $*" >&2
    cat "$work/log" >&2
    exit 1
  fi
}

# build_and_test FOLDER [PREFIX]: with nothing but what a user types.
build_and_test() {
  quietly cmake -S "$1" -B "$1/build" -DCMAKE_PREFIX_PATH="${2:-$prefix}"
  quietly cmake --build "$1/build"
  quietly ctest --test-dir "$1/build" --output-on-failure --no-tests=error
}

prefix=$work/mesogen
quietly cmake --install "$build" --prefix "$prefix"
mesogen=$prefix/bin/mesogen
# A path may be short, such as /mesogen: only where a path begins is it meant.
if grep -rlP "((?<=-[IL])|(?<![\w.}/-]))(\Q$build\E|\Q$source\E)(?=[/\";\s]|$)" "$prefix/lib/cmake"; then
  echo "failed: these installed files name folders of the build" >&2
  exit 1
fi

for kind in kernel boundary shape initial physics observer; do
  quietly "$mesogen" plugin new $kind my_$kind "own/my_$kind"
  build_and_test "own/my_$kind"
  "$mesogen" plugin list --plugin-path "own/my_$kind/build/plugins" >list
  grep -q "my_$kind " list || { echo "failed: my_$kind is not listed" >&2; exit 1; }
done

cat >case.toml <<'CASE'
[domain]
size = [1.0, 1.0]
boundary = "my_boundary"
[particles]
spacing = 0.0625
[kernel]
type = "my_kernel"
[my_initial]
speed = 0.0
[physics.flow]
type = "wcsph"
density = 2.0
viscosity = 0.1
[physics.force]
type = "my_physics"
force = 0.6
[observers.speed]
type = "my_observer"
every = 10
[time]
end = 0.1
CASE
export MESOGEN_PLUGIN_PATH=$work/own/my_kernel/build/plugins:$work/own/my_boundary/build/plugins
MESOGEN_PLUGIN_PATH+=:$work/own/my_initial/build/plugins:$work/own/my_physics/build/plugins:$work/own/my_observer/build/plugins
quietly "$mesogen" run case.toml --output results
# From rest the force F drives a channel of height H between the walls of my_boundary; mean speed:
# sum over odd n of 8 F H^2 / (mu (n pi)^4) (1 - exp(-nu (n pi / H)^2 t)).
/usr/bin/python3 - <<'CHECK'
import math
import h5py
with h5py.File("results/results.h5") as file:
    speed = file["observables/speed/mean_speed/value"][-1]
exact = sum(8 * 0.6 / (0.1 * (n * math.pi) ** 4) * (1 - math.exp(-0.05 * (n * math.pi) ** 2 * 0.1)) for n in range(1, 60, 2))
assert abs(speed / exact - 1) < 0.04, (speed, exact)
CHECK
unset MESOGEN_PLUGIN_PATH

cat >solids.toml <<'CASE'
[domain]
size = [1.0, 1.0]
boundary = "periodic_wrap"
[solids.ring]
shape = "my_shape"
fluid = "inside"
width = 0.36
[particles]
spacing = 0.02
[kernel]
type = "quintic"
[physics.flow]
type = "wcsph"
density = 1.0
viscosity = 0.1
[time]
end = 0.01
CASE
MESOGEN_PLUGIN_PATH=$work/own/my_shape/build/plugins quietly "$mesogen" run solids.toml --output ring

# Installed without further words, a plugin lies where Mesogen finds it.
quietly cmake --install own/my_physics/build
"$mesogen" plugin info my_physics | grep -q "$prefix/lib/mesogen/plugins/my_physics.so" ||
  { echo "failed: my_physics was installed, but is not found" >&2; exit 1; }
# It then is there twice; its tests are about the one that was built.
quietly ctest --test-dir own/my_physics/build --output-on-failure --no-tests=error
# Mesogen leaves the prefix of the project that finds it alone, and installs beneath it only when it is told to.
grep -q "CMAKE_INSTALL_PREFIX:PATH=/usr/local" own/my_physics/build/CMakeCache.txt ||
  { echo "failed: find_package(Mesogen) changed the prefix" >&2; exit 1; }
quietly cmake -S own/my_kernel -B own/my_kernel/build -DMESOGEN_PLUGIN_FOLDER=plugins
quietly cmake --install own/my_kernel/build --prefix "$work/prefix"
[ -e "$work/prefix/plugins/my_kernel.so" ] || { echo "failed: my_kernel is not beneath the prefix" >&2; exit 1; }

for file in "$source"/examples/*/CMakeLists.txt; do
  [ -e "$file" ] || continue
  name=$(basename "$(dirname "$file")")
  cp -r "$(dirname "$file")" "own/$name"
  build_and_test "own/$name"
done

# Without an installation, the build folder does.
rm -rf own/my_observer/build
build_and_test own/my_observer "$build"

mv "$prefix" "$work/elsewhere"
"$work/elsewhere/bin/mesogen" plugin list >list
grep -q "wcsph " list || { echo "failed: moved elsewhere, Mesogen finds no plugins" >&2; exit 1; }
# Its code for CUDA goes with it, and finds the CUDA runtime where the compiler found it.
if [ -e "$work/elsewhere/lib/libmesogen_cuda.so" ]; then
  MESOGEN_CUDA_ON_HOST=1 "$work/elsewhere/bin/mesogen" plugin check friction >list
  grep -q "ok      CUDA agrees with the CPU" list || { echo "failed: moved elsewhere, there is no code for CUDA" >&2; exit 1; }
  for library in libmesogen_cuda.so mesogen/plugins/cuda/wcsph.so; do
    readelf -d "$work/elsewhere/lib/$library" | grep -q 'RUNPATH.*[$]ORIGIN.*:/.*lib' ||
      { echo "failed: $library does not know where the CUDA runtime is" >&2; exit 1; }
  done
fi

echo "a new force is $(grep -cvE '^[[:space:]]*(//.*)?$' own/my_physics/my_physics.cpp) lines of source without comments," \
  "with its test and CMakeLists.txt $(cat own/my_physics/*.cpp own/my_physics/CMakeLists.txt | grep -cvE '^[[:space:]]*(//.*)?$')"
