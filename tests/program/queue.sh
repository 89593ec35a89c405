# Queues: the shell of a job is no rank, whatever variables it has; launchers are recognised, and what does not fit them is
# refused. The job scripts are those of docs/cluster.md, run with the variables of their queue, a stand-in for what submits
# jobs, and time that passes with the steps (BULLA_STEP_SECONDS).
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
# shellcheck disable=SC2046
unset $(env | sed -n 's/^\(\(SLURM\|PBS\|LSB\|FLUX\|PMI\|PMIX\|OMPI\)_[A-Za-z0-9_]*\|JOB_ID\|link\)=.*/\1/p') BULLA_STEP_SECONDS
page=$BULLA_SOURCE/docs/cluster.md
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
"$BULLA" run bubble.yaml -o whole --quiet
here=$(uname -n)
script="SLURM_JOB_ID=7 SLURM_PROCID=0 SLURM_LOCALID=0 SLURM_NTASKS=2"

# Shells of jobs: -n starts the ranks, as on a laptop, and nothing else starts MPI.
shells=0
while read -r variables; do
    # shellcheck disable=SC2086
    env $variables "$BULLA" run bubble.yaml -o shell -n 2 --quiet --overwrite </dev/null
    cmp whole/history.csv shell/history.csv
    grep -q '"ranks": 2' shell/provenance.json || fail "not two ranks: $variables" shell/provenance.json
    shells=$((shells + 1))
done <<END_OF_SHELLS
$script
$script SLURM_JOBID=7 SLURM_NODELIST=$here SLURM_TASKS_PER_NODE=2
$script SLURM_STEP_ID=4294967290 SLURM_STEP_NUM_TASKS=1 PMIX_RANK=0 PMIX_NAMESPACE=slurm.pmix.7.4294967290
PBS_JOBID=7.server PBS_ENVIRONMENT=PBS_BATCH
LSB_JOBID=7 LSB_JOBINDEX=0
FLUX_URI=local:///nowhere
END_OF_SHELLS
[ $shells = 6 ]

# Launchers: their number is the number of ranks.
refused() { # TEXT COMMAND...
    wanted=$1
    shift
    rm -rf out
    complete "$@" >said 2>&1
    [ "$code" = 2 ] || fail "exit code $code, not 2: $*" said
    grep -q -e "$wanted" said || fail "'$wanted' is not said:" said
    [ ! -e out ] || fail "something was written: $*"
}
launched() { mpirun --oversubscribe --allow-run-as-root --mca mpi_yield_when_idle 1 --bind-to none "$@"; }
# shellcheck disable=SC2086
(
    export $script
    launched -n 2 "$BULLA" run bubble.yaml -o ranks -n 2 --quiet --overwrite
    cmp whole/history.csv ranks/history.csv
    refused "error: -n 3, but Open MPI's mpirun has started 2 ranks" \
        mpirun -n 2 --oversubscribe --allow-run-as-root --bind-to none "$BULLA" run bubble.yaml -n 3 -o out
)
# A step of srun without PMI, or with one that MPI cannot talk to: four runs would write one directory.
# shellcheck disable=SC2086
refused 'error: srun has started 4 processes that cannot find each other: with srun --mpi=pmix they can' \
    env $script SLURM_STEP_ID=0 SLURM_STEP_NUM_TASKS=4 "$BULLA" run bubble.yaml -o out
# shellcheck disable=SC2086
refused 'error: srun has started 4 processes, but MPI makes each of them a run of its own' \
    env $script SLURM_STEP_ID=0 SLURM_STEP_NUM_TASKS=4 PMI2_FD=99 "$BULLA" run bubble.yaml -o out
# A step of one task is one run.
# shellcheck disable=SC2086
env $script SLURM_STEP_ID=0 SLURM_STEP_NUM_TASKS=1 "$BULLA" run bubble.yaml -o step --quiet
cmp whole/history.csv step/history.csv
# shellcheck disable=SC2086
refused 'error: -n 4, but srun has started 1 rank:' \
    env $script SLURM_STEP_ID=0 SLURM_STEP_NUM_TASKS=1 "$BULLA" run bubble.yaml -o out -n 4

# The scripts. A job is submitted by writing its link into a file.
mkdir -p bin
printf '#!/bin/sh\nexec "%s" "$@"\n' "$BULLA" >bin/bulla
# shellcheck disable=SC2016
printf '#!/bin/sh\nset -e\n[ "$1" != -v ] || export "$2"\necho "$link" >submitted\n' >bin/sbatch
cp bin/sbatch bin/qsub
cp bin/sbatch bin/bsub
chmod +x bin/*
PATH=$PWD/bin:$PATH
block() { # NUMBER: the script that is so far down the page
    awk -v n="$1" '/^```/ { inside = !inside && /bash/; if (inside) k++; next } inside && k == n' "$page" >job.sh
    grep -q '^bulla run' job.sh || fail "no script number $1 in $page"
}
job() { # VARIABLES...: one job; $code, and `submitted` if there is another one to come
    rm -f submitted
    complete env "$@" bash job.sh >>said 2>&1
}
chain() { # JOBS VARIABLES...: until none is submitted
    wanted=$1 jobs=1 link=1
    shift
    rm -rf out
    : >said
    job "$@"
    while [ -e submitted ]; do
        [ $code = 0 ] || fail "exit code $code of a job that submitted the next" said
        link=$(cat submitted) jobs=$((jobs + 1))
        [ "$link" = $jobs ] || fail "link $link of job $jobs" said
        job link="$link" "$@"
    done
    [ $code = 0 ] && [ $jobs = "$wanted" ] || fail "exit code $code after $jobs jobs, not $wanted" said
    cmp whole/history.csv out/bubble/history.csv
}
slow=BULLA_STEP_SECONDS=5000 # nine steps of twenty in 11:45 h
block 1
# shellcheck disable=SC2086
chain 3 $slow $script
printf '%s\n' "$here" "$here" >nodes
block 2
chain 3 $slow PBS_JOBID=7.server PBS_O_WORKDIR="$PWD" PBS_NODEFILE="$PWD/nodes"
block 3
chain 3 $slow LSB_JOBID=7 LSB_DJOB_NUMPROC=2

# The chain ends: at its last link, and where a job fails.
block 1
rm -rf out
# shellcheck disable=SC2086
job link=20 $slow $script
[ $code = 4 ] && [ ! -e submitted ] || fail "exit code $code of the last link" said
sed 's/128/-1/' bubble.yaml >broken.yaml
sed 's/bubble.yaml/broken.yaml/' job.sh >other.sh && mv other.sh job.sh
# shellcheck disable=SC2086
job $script
[ $code = 2 ] && [ ! -e submitted ] || fail "exit code $code of a case with a mistake" said

# A signal to the script, or to all processes of the job: the run saves, the next job is submitted and finds a checkpoint.
block 4
sed 's/, max-steps: 20//' bubble.yaml >endless.yaml
sed 's/bubble.yaml/endless.yaml/' job.sh >other.sh && mv other.sh job.sh
begun() { [ "$(cat out/bubble/history.csv 2>/dev/null | wc -l)" -gt 3 ] || ! alive "$run"; }
for whom in script all; do
    rm -rf out submitted
    # shellcheck disable=SC2086
    start env $script bash job.sh >said 2>&1
    await "the first rows" begun
    processes=$run
    [ $whom = script ] || processes=$(members "$run")
    # shellcheck disable=SC2086
    kill -s USR1 $processes 2>/dev/null || true
    ended "$run"
    [ $code = 0 ] && [ "$(cat submitted)" = 2 ] || fail "exit code $code after a signal to the $whom" said
    ls out/bubble/checkpoints/*.chk >/dev/null || fail "no checkpoint" said
done

# The same to all processes of a sweep.
echo 'matrix: {parameters.R0: [10 um, 20 um]}' >>endless.yaml
sweeping() {
    for folder in 10 20; do
        [ "$(cat out/endless-sweep/R0=${folder}um/history.csv 2>/dev/null | wc -l)" -gt 3 ] || return 1
    done
}
either() { sweeping || ! alive "$run"; }
start "$BULLA" sweep endless.yaml -j 2 -n 2 >said 2>&1
await "the first rows of a sweep" either
# shellcheck disable=SC2046
kill -s USR1 $(members "$run") 2>/dev/null || true
ended "$run"
[ $code = 4 ] || fail "exit code $code of a sweep" said
[ "$(ls out/endless-sweep/*/checkpoints/*.chk | wc -l)" = 2 ] || fail "runs of a sweep without checkpoints" said

# An array computes what a sweep would; the sweep adds nothing but the table.
block 5
rm -rf out
echo 'matrix: {parameters.R0: [10 um, 20 um, 40 um]}' >>bubble.yaml
for index in 0 2; do
    # shellcheck disable=SC2086
    job $script SLURM_ARRAY_TASK_ID=$index
    [ $code = 0 ] || fail "exit code $code of element $index" said
done
"$BULLA" sweep bubble.yaml -n 2 >table 2>said
grep -q '3 combinations in out/bubble-sweep, 2 of them finished before' said || fail "the array is not recognised" said
[ "$(wc -l <out/bubble-sweep/table.csv)" = 4 ]
