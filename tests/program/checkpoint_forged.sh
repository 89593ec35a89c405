# Checkpoints with changed lists, sealed again as a forger would or not, of one writer and of two: what a restart says of
# each of some hundred is the same on 1 and 3 ranks (at night, BULLA_WHOLE, on 2, too), and all of them end. Of each kind
# the program itself says that in one line, with exit code 2, and writes nothing.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_rmaps_base_oversubscribe=1
drifting 32 16 | sed 's/buffer: 2/buffer: 3/' >moving.yaml
echo 'output: {checkpoints: {every: 4 steps, keep: 9}}' >>moving.yaml
forged=out/checkpoints/forged.chk
count=${BULLA_FORGED:-200}
all="1 ${BULLA_WHOLE:+2} 3"
take() { # RANKS FROM END: what came of these copies, into said
    limited mpirun -n "$1" --bind-to none "$BULLA_BUILD/tests/test-unit-forged" moving.yaml "$good" $forged "$2" "$3" \
        >said 2>err || fail "$1 ranks, $writers writers" said err
}
refused_alike() { # PATTERN: the program on the first copy of which this is said
    line=$(grep -m 1 -- "$1" said.all) || fail "nothing is refused with: $1" said.all
    seed=${line%% *}
    take 1 "$seed" $((seed + 1))
    for ranks in $all; do
        code=0
        limited "$BULLA" run moving.yaml -o out --restart $forged -n $ranks >out.txt 2>err || code=$?
        [ "$code" = 2 ] || fail "exit code $code on $ranks ranks, copy $seed" err
        [ "$(cat err)" = "error: ${line#* * * }" ] || fail "$ranks ranks, copy $seed: not '$line'" err
    done
}
for writers in 1 2; do
    rm -rf out
    limited "$BULLA" run moving.yaml -o out --quiet --max-steps 4 -n 3 --writers $writers
    good=$(ls out/checkpoints/*_000004.chk)
    sums=$(cksum out/*.* "$good"*)
    for ranks in $all; do
        take $ranks 0 "$count"
        [ "$(wc -l <said)" = "$count" ] || fail "not a line for each" said
        [ $ranks != 1 ] || cp said said.all
        cmp said.all said || fail "$(diff said.all said)"
    done
    refused_alike "/tiles.*: tiles are not in order"
    refused_alike "/tiles.*: a tile has been unwanted too often"
    refused_alike "/tiles.* needs tile .*, which does not exist"
    refused_alike "/notes.*of another case"
    [ $writers = 1 ] || for said in "/runs.*: tiles in a part that there is not" "/runs.*: parts that have not all tiles" \
        "/parts.*is not its own" "/runs.*damaged: "; do
        refused_alike "$said"
    done
    [ "$(cksum out/*.* "$good"*)" = "$sums" ] || fail "something was written"
done
