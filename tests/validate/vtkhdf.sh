#!/usr/bin/env bash
# Frames of a run as an independent reader sees them: VTK's own vtkHDFReader, 9.3 or newer, against the program's
# own reading. Usage: vtkhdf.sh [PROGRAM [SCENE [FOLDER]]]; prints the table, exits 1 when a verdict is off.
#
# Debian 12 has VTK 9.1, which cannot read PolyData with Steps. Where python3 here has no newer VTK, a Debian 13
# root with one is made by debootstrap (root and a network needed, about 1.5 GB) and kept in
# SANDGLASS_DEBIAN13 (default: ~/.cache/sandglass/debian13).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
top=$(cd "$here/../.." && pwd)
program=${1:-$top/build/bin/sandglass} scene=${2:-$top/sample_runs/hopper_glass} folder=${3:-$top/build/validate-vtkhdf}
root=${SANDGLASS_DEBIAN13:-$HOME/.cache/sandglass/debian13}
modules="python3-vtk9 python3-h5py python3-numpy"
try='import h5py, numpy; from vtkmodules.vtkCommonCore import vtkVersion as v; import vtkmodules.vtkIOHDF
assert (v.GetVTKMajorVersion(), v.GetVTKMinorVersion()) >= (9, 3)'
mkdir -p "$folder"

skip() {
  printf 'case,quantity,ours,uncertainty,expected,tolerance,source,verdict\nvtkhdf,,,,,,,"skipped: %s"\n' "$1"
  exit 0
}

in_root() { chroot "$root" /usr/bin/env -i PATH=/usr/bin:/bin LANG=C.UTF-8 "$@"; }

make_root() {
  [ "$(id -u)" = 0 ] || skip "no VTK 9.3 here, and making a Debian 13 root needs root"
  command -v debootstrap >/dev/null || skip "no VTK 9.3 here and debootstrap is not installed"
  if ! [ -e "$root/.complete" ]; then
    mkdir -p "$(dirname "$root")"
    if ! [ -e "$root/etc/debian_version" ]; then
      debootstrap --variant=minbase trixie "$root" >"$folder/debootstrap.log" 2>&1 \
        || skip "no VTK 9.3 here and debootstrap failed (see debootstrap.log); is there a network?"
    fi
    cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
    in_root sh -c "apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $modules" \
      >"$folder/install.log" 2>&1 || skip "VTK could not be installed in the Debian 13 root (see install.log)"
    touch "$root/.complete"
  fi
  in_root python3 -c "$try" 2>/dev/null || skip "the VTK in $root does not work; delete that folder and run again"
}

python=
for candidate in python3 /usr/bin/python3; do
  if [ -z "$python" ] && "$candidate" -c "$try" 2>/dev/null; then python=$candidate; fi
done
[ -n "$python" ] || make_root

"$program" run "$scene" --quick -o "$folder/run" --overwrite >"$folder/run.log"
"$program" convert "$folder/run" "$folder/ours.csv" >>"$folder/run.log"
"$program" convert "$folder/run" "$folder/merged.vtkhdf" >>"$folder/run.log"

if [ -n "$python" ]; then
  "$python" "$here/vtkhdf_compare.py" "$folder" "$top/docs/files.md"
else
  inside=/tmp/sandglass-validate.$$
  trap 'rm -rf "$root$inside"' EXIT
  mkdir -p "$root$inside/run"
  cp -r "$folder/run/frames" "$root$inside/run/"
  cp "$folder/ours.csv" "$folder/merged.vtkhdf" "$here/vtkhdf_compare.py" "$top/docs/files.md" "$root$inside/"
  in_root python3 "$inside/vtkhdf_compare.py" "$inside" "$inside/files.md"
fi
