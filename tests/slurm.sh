#!/bin/bash
# slurm.sh [PROGRAM] - a queue of its own on this machine (Debian's Slurm: munge, slurmctld, slurmd; eight processors are
# pretended), and in it the job scripts of docs/cluster.md: chains by `-n` and by srun with PMIx, SIGUSR1 to a script and to
# a step, an array with the sweep that waits for it, the shell of salloc, srun without PMIx. Histories must be those of an
# ordinary run, bit by bit. Processor time passes with the steps (BULLA_STEP_SECONDS), so that 11:45 h are seconds.
# For root, with the packages slurmctld, slurmd, slurm-client and munge, else it ends with 77. Nightly.
set -euo pipefail
for word in munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin command -v $word >/dev/null || { echo "there is no $word"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "needs root"; exit 77; }
PATH=$PATH:/usr/sbin
root=$(cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/lib.sh"
program=$(realpath "${1:-${BULLA:-$root/build/bin/bulla}}")
place=$(mktemp -d)
chmod 755 "$place"
removed() { rm -rf "$1" 2>/dev/null; }
finish() {
    for name in slurmd slurmctld munged; do
        [ ! -s "$place/$name.pid" ] || kill "$(cat "$place/$name.pid")" 2>/dev/null || true
    done
    cd /
    await "the end of the queue" removed "$place"
}
at_end=finish

# The queue.
mkdir -p "$place/state" "$place/spool" "$place/work/bin"
noise 1024 >"$place/key"
chmod 400 "$place/key"
munged --force --socket "$place/munge" --key-file "$place/key" --pid-file "$place/munged.pid" \
    --log-file "$place/munge.log" --seed-file "$place/seed" 2>/dev/null
name=$(uname -n)
port=$((20000 + $$ % 10000 * 2))
cat >"$place/slurm.conf" <<END_OF_CONFIGURATION
ClusterName=test
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$place/munge
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmUser=root
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd.log
SlurmdParameters=config_overrides
NodeName=$name NodeAddr=127.0.0.1 CPUs=8
PartitionName=main Nodes=$name Default=YES MaxTime=INFINITE State=UP
END_OF_CONFIGURATION
export SLURM_CONF=$place/slurm.conf
slurmctld
slurmd
idle() { sinfo -h -o %T 2>/dev/null | grep -q idle; }
await "an idle queue" idle

# The work.
cd "$place/work"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
printf '#!/bin/sh\nexec "%s" "$@"\n' "$program" >bin/bulla
chmod +x bin/bulla
PATH=$place/work/bin:$PATH
cat >bubble.yaml <<'END_OF_CASE'
bulla: 1
title: A tube
parameters: {R0: 20 um}
domain: {lower: [0], upper: [1], cells: [128], boundaries: {x-: outflow, x+: reflecting}}
mesh: {tile: 64}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: air, density: 1, pressure: 1 bar}
  - {half-space: {point: [= 2e4 * R0], normal: [1]}, material: air, density: 0.125, pressure: 0.1 bar}
run: {until: 1e3, max-steps: 20}
output: {history: {columns: {m: {total: mass}, p: {max: pressure}}}}
END_OF_CASE
bulla run bubble.yaml -o whole --quiet
block() { # NUMBER: the script that is so far down the page, for two tasks, saying what it does into `said`
    awk -v n="$1" '/^```/ { inside = !inside && /bash/; if (inside) k++; next } inside && k == n' "$root/docs/cluster.md" |
        sed -e 's/--ntasks=[0-9]*/--ntasks=2/' -e '/--output/d' -e '2i #SBATCH --output=said --open-mode=append' >job.sh
    grep -q '^#SBATCH --ntasks=2' job.sh || fail "no script of Slurm number $1 in docs/cluster.md" job.sh
}
stepwise() { # the same script, with srun instead of -n
    sed -i 's/^bulla run \(.*\) -n "$SLURM_NTASKS"/srun --mpi=pmix bulla run \1/' job.sh
    grep -q '^srun --mpi=pmix bulla run' job.sh || fail "no run to put into a step" job.sh
}
drained() { [ -z "$(squeue -h)" ]; }
alike() { cmp whole/history.csv "$1/history.csv" || fail "another history in $1" said; }
code() { scontrol show job "$1" | sed -n 's/.*ExitCode=\([0-9]*\):.*/\1/p' | head -1; }

# Chains: the script of the page, and the same with srun. Three jobs each.
block 1
for how in ranks srun; do
    rm -rf out said
    [ $how = ranks ] || stepwise
    BULLA_STEP_SECONDS=5000 sbatch -Q job.sh
    await "the end of all jobs" drained
    [ "$(grep -c 'interrupted by walltime' said)" = 2 ] || fail "not a chain of three jobs ($how)" said
    alike out/bubble
done

# A signal to the script, with ranks that it has started; to a step of srun.
block 4
sed 's/, max-steps: 20//' bubble.yaml >endless.yaml
sed -i 's/bubble.yaml/endless.yaml/; s/-lt 20/-lt 1/' job.sh
rows() { [ "$(cat out/bubble/history.csv 2>/dev/null | wc -l)" -gt 3 ]; }
for how in --batch ''; do
    rm -rf out said
    [ -n "$how" ] || { stepwise && sed -i '/^trap/d' job.sh; }
    job=$(sbatch --parsable job.sh)
    await "the first rows" rows
    scancel $how --signal=USR1 "$job"
    await "the end of all jobs" drained
    [ "$(code "$job")" = 4 ] || fail "exit code $(code "$job") after a signal, not 4" said
    ls out/bubble/checkpoints/*.chk >/dev/null || fail "no checkpoint after a signal" said
done

# An array, and the sweep that makes its table.
block 5
rm -rf out said
echo 'matrix: {parameters.R0: [10 um, 20 um, 40 um]}' >>bubble.yaml
job=$(sbatch --parsable job.sh)
sbatch -Q --dependency=afterany:"$job" --ntasks=2 --output=table --wrap 'bulla sweep bubble.yaml -n 2'
await "the end of all jobs" drained
grep -q '3 combinations in out/bubble-sweep, 3 of them finished before' table || fail "no table of the array" table

# The shell of salloc starts ranks by itself and by srun; without PMIx that is refused, before MPI can abort.
sed -i '/^matrix/d' bubble.yaml
salloc -Q -n 2 bulla run bubble.yaml -n 2 -o shell --quiet
alike shell
salloc -Q -n 2 srun --mpi=pmix bulla run bubble.yaml -o step --quiet
alike step
! srun -Q -n 2 --mpi=none bulla run bubble.yaml -o none >said 2>&1 || fail "srun without PMIx is taken" said
grep -q 'srun has started 2 processes that cannot find each other' said || fail "no message without PMIx" said
! srun -Q -n 2 --mpi=pmix bulla run bubble.yaml -n 3 -o three >said 2>&1 || fail "another number of ranks is taken" said
grep -q -e '-n 3, but srun has started 2 ranks' said || fail "no message for another number of ranks" said
[ ! -e none ] && [ ! -e three ] || fail "something was written"
echo "Slurm $(sbatch --version | cut -d' ' -f2): chains, signals, an array and refusals are as docs/cluster.md says"
