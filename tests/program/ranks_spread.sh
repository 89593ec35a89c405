# More ranks than a stretch of owners has, and than coarse levels have tiles: on 32 ranks, whose 16 tiles of the coarsest level
# are spread over two stretches, levels come, move and go and three ranks write, with the bits of one rank; from their
# checkpoint the run goes on with 20 ranks, still more than tiles, with 5 and then with one. (program/ranks_topology.sh has
# fewer ranks and one writer.)
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
drifting 16 8 >spread.yaml
cat >>spread.yaml <<'END'
output:
  writers: 3
  snapshots: {every: 8 steps, fields: [density, pressure, alpha_air, level], precision: double}
  history: {columns: {m: {mass: air}, E: {total: energy}, pmax: {max: pressure}}}
  checkpoints: {every: 4 steps, keep: 9}
END
ranked spread 1 32
grep -q '"regrids": *[1-9][0-9]' spread-1/refinement || fail "levels do not move" spread-1/refinement
[ "$(find spread-32/out/checkpoints spread-32/out/fields -name '*.a[123]' | wc -l)" = 12 ] || fail "not three parts of each file"
for file in spread-1/out/checkpoints/*.chk; do
    "$BULLA_BUILD/tests/test-unit-checkpoint" "$file" "spread-32/out/checkpoints/${file##*/}"
done

# The coarsest level is on ranks of both stretches, one tile on each.
if /usr/bin/python3 -c 'import h5py' 2>/dev/null; then
    /usr/bin/python3 - spread-32/out/fields/spread_000008.hdf <<'END'
import sys

import h5py

with h5py.File(sys.argv[1]) as file:
    owners = [row[4] for row in file["/bulla/blocks"][()] if row[0] == 0]
assert len(owners) == len(set(owners)) == 16, owners
assert sum(owner < 16 for owner in owners) == 8, owners
END
fi

cp -r spread-32 chain
ran chain spread -n 20 --max-steps 5 --restart=out/checkpoints/spread_000004.chk
ran chain spread -n 5 --max-steps 6 --restart
ran chain spread --restart
cmp spread-1/out/history.csv chain/out/history.csv
"$BULLA_BUILD/tests/test-unit-snapshot" spread-1/out/fields/spread_000008.hdf chain/out/fields/spread_000008.hdf
