# A run that starts from the checkpoint of another: volumes, masses and energy are those of the donor in every pair of
# geometries, on any mesh and any number of ranks, uniform pressure stays uniform, and a collapse goes on as if nothing had
# happened; what does not fit is refused with what is wrong.
set -eu
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

cat >ball.yaml <<'END'
bulla: 1
title: A ball collapses
domain: {geometry: spherical, lower: [0], upper: [1 mm], cells: [160], boundaries: {x-: symmetry, x+: outflow}}
mesh: {tile: 8, levels: 1, refine: [{interface: air}]}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, air: {eos: {type: ideal-gas, preset: air}}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: 100 bar}
  - {sphere: {center: [0], radius: 0.3 mm}, material: air, density: 12, pressure: 10 bar}
run: {until: 1 us}
output:
  directory: ball
  checkpoints: {every: 1 us}
  history: {every: 0.5 us, columns: {V: {volume: air}, m: {mass: air}, w: {mass: water}, E: {total: energy}, p: {max: pressure}, q: {min: pressure}}}
END
cat >on.yaml <<'END'
bulla: 1
title: It goes on
domain: {geometry: axisymmetric, lower: [0, -1.25 mm], upper: [1.25 mm, 1.25 mm], cells: [32, 64], boundaries: {x-: axis, x+: outflow, y-: outflow, y+: outflow}}
mesh: {tile: 8, levels: 1, refine: [{interface: air}]}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, air: {eos: {type: ideal-gas, preset: air}}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: 100 bar}
  - checkpoint: {file: donor.chk, at: [0, 0.1 mm]}
run: {until: 0.5 us, max-steps: 1}
output:
  directory: on
  history: {every: 0.5 us, columns: {V: {volume: air}, m: {mass: air}, w: {mass: water}, E: {total: energy}, p: {max: pressure}, q: {min: pressure}}}
END
donor() { # RUN: its last checkpoint becomes donor.chk
    cp "$(ls "$1"/checkpoints/*.chk | tail -n 1)" donor.chk
}
column() { # FILE LINE NAME
    awk -F, -v line="$2" -v name="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i } NR > 1 { last = $at } NR == line { value = $at } END { print line ? value : last }' "$1"
}
near() { # A B PART: equal to a part of A?
    awk -v a="$1" -v b="$2" -v part="$3" 'BEGIN { d = a > b ? a - b : b - a; if (d > part * (a > 0 ? a : -a)) { print a " is not " b; exit 1 } }'
}
kept() { # DIR VOLUME MASS PART: the start of DIR has them, to a part
    near "$2" "$(column "$1/history.csv" 2 V)" "$4"
    near "$3" "$(column "$1/history.csv" 2 m)" "$4"
}
"$BULLA" run ball.yaml -n 2 --quiet
V=$(column ball/history.csv 0 V) m=$(column ball/history.csv 0 m)
donor ball

# Into axisymmetric and 3D scenes, on 1, 2 and 3 ranks; into a finer spherical one.
for ranks in 1 2 3; do
    "$BULLA" run on.yaml -o on-$ranks -n $ranks --quiet
    cmp on-1/history.csv on-$ranks/history.csv
done
kept on-1 "$V" "$m" 1e-12
three='domain={lower: [-1.25 mm, -1.25 mm, -1.25 mm], upper: [1.25 mm, 1.25 mm, 1.25 mm], cells: [16, 16, 16], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}}'
"$BULLA" run on.yaml -o three --set "$three" --set 'initial[1].checkpoint.at=[0.1 mm, -0.05 mm, 0]' --quiet
kept three "$V" "$m" 1e-6 # what volumes of balls in boxes are good for
"$BULLA" run ball.yaml -o finer --set domain.cells='[400]' --set 'initial=[{checkpoint: {file: donor.chk}}]' --set run.max-steps=1 --quiet
kept finer "$V" "$m" 1e-12
near "$(column ball/history.csv 0 w)" "$(column finer/history.csv 2 w)" 1e-12
near "$(column ball/history.csv 0 E)" "$(column finer/history.csv 2 E)" 1e-12

# It goes on as the spherical run does, until what lies around the donor is heard: its water moves, that around it rests.
"$BULLA" run ball.yaml -o longer --set run.until=1.3us --quiet
"$BULLA" run on.yaml -o longer-2 --set run='{until: 0.3 us}' -n 2 --quiet
near "$(column longer/history.csv 0 V)" "$(column longer-2/history.csv 0 V)" 0.01
near "$(column longer/history.csv 0 V)" 7.6e-11 0.1

# Rest stays rest: uniform pressure in every geometry, and in another domain.
"$BULLA" run ball.yaml -o rest --set 'initial[0].pressure=10 bar' --set run.max-steps=2 --quiet
donor rest
for set in 'run.max-steps=1' "$three"; do
    at='[0, 0.1 mm]'
    [ "$set" = "$three" ] && at='[0.1 mm, 0, 0]'
    "$BULLA" run on.yaml -o still --set "$set" --set "initial[1].checkpoint.at=$at" --set 'initial[0].pressure=10 bar' --overwrite --quiet
    near 1e6 "$(column still/history.csv 2 p)" 1e-10
    near 1e6 "$(column still/history.csv 2 q)" 1e-10
done

# Two axes into two axes: the refined state of a plane onto a coarser, larger, shifted mesh.
plane='domain={lower: [0, 0], upper: [1 mm, 1 mm], cells: [32, 32], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}'
"$BULLA" run ball.yaml -o plane --set "$plane" --set 'initial[1].sphere.center=[0.5 mm, 0.4 mm]' --set run.max-steps=3 --quiet
donor plane
"$BULLA" run on.yaml -o shifted --set 'domain={lower: [0, 0], upper: [3 mm, 2 mm], cells: [48, 32], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}' \
    --set 'initial[1].checkpoint.at=[1.03 mm, 0.61 mm]' --quiet
kept shifted "$(column plane/history.csv 0 V)" "$(column plane/history.csv 0 m)" 1e-12

# Rings into rings.
donor ball
"$BULLA" run on.yaml -o ring --set output.checkpoints='{every: 1 step}' --quiet
donor ring
"$BULLA" run on.yaml -o ring-2 --set 'domain={geometry: axisymmetric, lower: [0, -1.7 mm], upper: [1.5 mm, 1.6 mm], cells: [24, 48], boundaries: {x-: axis, x+: outflow, y-: outflow, y+: outflow}}' \
    --set 'initial[1].checkpoint.at=[0, -0.07 mm]' --quiet
kept ring-2 "$(column ring/history.csv 0 V)" "$(column ring/history.csv 0 m)" 1e-12

# Rings into space, their axis along any of its axes: volumes, masses, what moves along the axis, and towards it.
donor ball
"$BULLA" run on.yaml -o ring-3 --set output.checkpoints='{every: 1 step}' --set 'initial[0].velocity=[0, 3 m/s]' \
    --set output.history.columns.P='{total: momentum_y}' --set output.history.columns.K='{integral: "= velocity_x * x + velocity_y * y"}' --quiet
donor ring-3
space='domain={lower: [-1.6 mm, -1.6 mm, -1.6 mm], upper: [1.6 mm, 1.6 mm, 1.6 mm], cells: [16, 16, 16], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}}'
for axis in x y z; do
    at='[0.05 mm, -0.1 mm, 0.2 mm]'
    "$BULLA" run on.yaml -o "space-$axis" --set "$space" --set "initial[1].checkpoint.at=$at" --set "initial[1].checkpoint.axis=$axis" \
        --set output.history.columns.P="{total: momentum_$axis}" --set output.history.columns.K='{integral: "= velocity_x * (x - 5e-5) + velocity_y * (y + 1e-4) + velocity_z * (z - 2e-4)"}' --quiet
    kept "space-$axis" "$(column ring-3/history.csv 0 V)" "$(column ring-3/history.csv 0 m)" 1e-12
    near "$(column ring-3/history.csv 0 P)" "$(column "space-$axis/history.csv" 2 P)" 1e-12
    near "$(column ring-3/history.csv 0 K)" "$(column "space-$axis/history.csv" 2 K)" 0.02 # cells of a third of the radius
done
"$BULLA" run on.yaml -o space-2 -n 2 --set "$space" --set "initial[1].checkpoint.at=$at" --set output.history.columns.P="{total: momentum_z}" \
    --set output.history.columns.K='{integral: "= velocity_x * (x - 5e-5) + velocity_y * (y + 1e-4) + velocity_z * (z - 2e-4)"}' --quiet # along z if nothing is said
cmp space-z/history.csv space-2/history.csv
"$BULLA" run ball.yaml -o calm --set 'initial[0].pressure=10 bar' --set run.max-steps=2 --quiet
donor calm
"$BULLA" run on.yaml -o calm-ring --set output.checkpoints='{every: 1 step}' --set 'initial[0].pressure=10 bar' --quiet
donor calm-ring
"$BULLA" run on.yaml -o calm-space --set "$space" --set "initial[1].checkpoint.at=$at" --set 'initial[0].pressure=10 bar' --quiet
near 1e6 "$(column calm-space/history.csv 2 p)" 1e-10
near 1e6 "$(column calm-space/history.csv 2 q)" 1e-10
donor plane

refused() { # WORDS SETTINGS...
    words=$1
    shift
    if "$BULLA" check on.yaml "$@" >said 2>&1; then cat said; exit 1; fi
    grep -q -e "$words" said || { cat said; exit 1; }
}
refused 'cannot be painted here'
donor ball
refused 'cannot be read' --set 'initial[1].checkpoint.file=nowhere/donor.chk'
refused "the law of 'water' is" --set materials.water.eos.preset=sg4
refused "there is no material 'air' here" --set 'materials={water: {eos: {type: stiffened-gas, preset: sg44}}, gas: {eos: {type: ideal-gas, preset: air}}}' --set 'mesh.refine=[{interface: gas}]' --set output.history.columns='{}'
refused 'must lie on the axis' --set 'initial[1].checkpoint.at=[0.1 mm, 0]'
refused "'axis' is for a checkpoint of an axisymmetric run" --set 'initial[1].checkpoint.axis=x'
cp donor.chk field.hdf
refused "'field.hdf' is a snapshot, whose numbers are rounded" --set 'initial[1].checkpoint.file=field.hdf'
refused "has no 'pressure' of its own" --set 'initial[1].pressure=1 bar'
cp ball/history.csv other.chk
refused 'other.chk' --set 'initial[1].checkpoint.file=other.chk'
head -c 5000 donor.chk >short.chk
refused 'short.chk' --set 'initial[1].checkpoint.file=short.chk'
