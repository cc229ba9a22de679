#!/usr/bin/env bash
# A sweep as a job array on a real Slurm: a single node of Debian's packages (slurmctld, slurmd, munge), started here and
# stopped again, against the same sweep without it. Usage: slurm.sh [PROGRAM]; prints the table, exits 1 when it is off.
# Needs root, and that no other Slurm runs here.
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
program=${1:-$top/build/bin/sandglass}
header=case,quantity,ours,uncertainty,expected,tolerance,source,verdict

skip() {
  printf '%s\nslurm,,,,,,,"skipped: %s"\n' $header "$1"
  exit 0
}

for tool in munged slurmctld slurmd sbatch; do
  command -v "$tool" >/dev/null || [ -x "/usr/sbin/$tool" ] || skip "$tool is not installed (packages munge, slurmctld, slurmd, slurm-client)"
done
[ "$(id -u)" = 0 ] || skip "starting a Slurm node needs root"
! pgrep -x slurmctld >/dev/null || skip "a slurmctld runs here already"
PATH=$PATH:/usr/sbin

folder=$(mktemp -d)
mkdir "$folder/state" "$folder/spool"
host=$(hostname -s)
export SLURM_CONF=$folder/slurm.conf
cat >"$SLURM_CONF" <<C
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
CryptoType=crypto/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
ReturnToService=2
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmdSpoolDir=$folder/spool
StateSaveLocation=$folder/state
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
SlurmUser=root
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
C

munge_pid=
finish() {
  for pid in "$folder/slurmd.pid" "$folder/slurmctld.pid"; do
    [ -f "$pid" ] && kill "$(cat "$pid")" 2>/dev/null || true
  done
  [ -n "$munge_pid" ] && kill "$munge_pid" 2>/dev/null || true
  rm -rf "$folder"
}
trap finish EXIT
if ! munge -n >/dev/null 2>&1; then
  runuser -u munge -- munged --foreground >"$folder/munged.log" 2>&1 &
  munge_pid=$!
fi
for _ in $(seq 20); do munge -n >/dev/null 2>&1 && break; sleep 0.5; done
munge -n >/dev/null 2>&1 || skip "munged does not start"
slurmctld -f "$SLURM_CONF" >/dev/null 2>&1 && slurmd -f "$SLURM_CONF" >/dev/null 2>&1 || skip "slurmctld or slurmd does not start"
for _ in $(seq 40); do [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && break; sleep 0.5; done
[ "$(sinfo -h -o %t 2>/dev/null)" = idle ] || skip "the node does not come up"

cat >"$folder/SWEEP.toml" <<S
scene = "$top/sample_runs/vortex_tank"
set = ["stage.stir.until.duration=\"0.2 s\"", "fill.1.number=40"]
seeds = 2
sample_interval = "1 ms"
[[axis]]
name = "omega"
key = "field.rotation.angular_velocity"
unit = "rad/s"
from = 20
to = 100
count = 5
S
"$program" sweep "$folder/SWEEP.toml" -o "$folder/one" >/dev/null
"$program" sweep "$folder/SWEEP.toml" -o "$folder/many" --slurm 4 >/dev/null
bash "$folder/many/slurm/submit.sh" >/dev/null
for _ in $(seq 240); do [ -z "$(squeue -h)" ] && break; sleep 0.5; done
done=$(grep -c ',done,' "$folder/many/sweep.csv" || true)
cmp -s "$folder/one/sweep.csv" "$folder/many/sweep.csv" && differ=0 verdict=ok || differ=1 verdict=off
source="Slurm $(slurmd -V | awk '{ print $2 }'), one node, an array of 4 jobs, the gathering after them"
printf '%s\n' $header "slurm,runs done,$done,0,10,,\"$source\",$([ "$done" = 10 ] && echo ok || echo off)" \
  "slurm,tables that differ from that of one machine,$differ,0,0,,\"$source\",$verdict"
[ "$verdict" = ok ] && [ "$done" = 10 ]
