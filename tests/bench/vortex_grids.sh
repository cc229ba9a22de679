#!/usr/bin/env bash
# Times grids of classified runs on all cores: tests/bench/vortex_grids.sh [GRID]..., by default all vortex_grid_*.toml of
# this folder. Writes docs/bench_vortex_grids.csv (a row a grid; others' rows stay) and docs/images/GRID.png, the phase
# diagram; tables of the sweeps go to out/bench. Times need a machine with nothing else to do.
set -euo pipefail
cd "$(dirname "$0")/../.."
program=build/bin/sandglass table=docs/bench_vortex_grids.csv
header=grid,runs,failed,cores,wall_s,cpu_s,cpu_s_per_run,commit,date,machine
[ -x $program ] || { echo "vortex_grids: $program is missing; run ./bootstrap build first" >&2; exit 2; }
[ $# -gt 0 ] || set -- vortex_grid_81 vortex_grid_81_rice2012 vortex_grid_1681
[ -f $table ] || echo $header >$table
commit=$(git rev-parse --short HEAD 2>/dev/null || echo unknown)
machine=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1 | tr , ' ')
for grid in "$@"; do
  plan=tests/bench/$grid.toml folder=out/bench/$grid
  [ -f "$plan" ] || { echo "vortex_grids: there is no $plan" >&2; exit 2; }
  rm -rf "$folder"
  mkdir -p out/bench docs/images
  TIMEFORMAT='%R %U %S'
  took=$({ time $program sweep "$plan" -o "$folder" >"out/bench/$grid.log"; } 2>&1 | tail -n 1)
  read -r wall user system <<<"$took"
  runs=$(grep -oE '[0-9]+ runs' "out/bench/$grid.log" | tail -n 1 | cut -d ' ' -f 1)
  failed=$(grep -oE '[0-9]+ failed' "out/bench/$grid.log" | tail -n 1 | cut -d ' ' -f 1)
  row=$(awk -v g="$grid" -v n="$runs" -v f="$failed" -v c="$(nproc)" -v w="$wall" -v u="$user" -v s="$system" \
    -v k="$commit" -v d="$(date +%F)" -v m="$machine" \
    'BEGIN { printf "%s,%d,%d,%d,%.1f,%.1f,%.3f,%s,%s,%s", g, n, f, c, w, u + s, (u + s) / n, k, d, m }')
  { grep -v "^$grid," $table; echo "$row"; } >$table.new
  mv $table.new $table
  $program sweep "$folder" --plot x=r y=omega colour=state -o "docs/images/$grid.png" >/dev/null
  rm -f "docs/images/$grid.csv"
  echo "$row"
done
