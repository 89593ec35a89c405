# shock-fronts: calm: the same bits on 1, 2, 3 ranks, with tiles of any size, after a restart and mirrored; what it does not
# concern keeps its bits; masses, momentum and energy stay; a failed step replays to the bit.
. "$BULLA_SOURCE/tests/lib.sh"
set -eu

cat >front.yaml <<'END2'
bulla: 1
title: A strong shock meets a bubble of a heavy gas
domain: {lower: [0, -1], upper: [2, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: reflecting, y-: periodic, y+: periodic}}
mesh: {tile: 8, levels: 1, refine: [{interface: heavy, where: {box: {lower: [0, -1], upper: [1, 1]}}}]}
materials: {gas: {eos: {type: ideal-gas, gamma: 1.4}}, heavy: {eos: {type: ideal-gas, gamma: 1.1}}}
initial:
  - {everywhere: true, material: gas, density: 1, pressure: 1}
  - {half-space: {point: [0.4, 0], normal: [-1, 0]}, material: gas, density: 5.26829, pressure: 41.8333, velocity: [5.75174, 0]}
  - {sphere: {center: [0.9, 0], radius: 0.4}, material: heavy, density: 4, pressure: 1}
scheme: {shock-fronts: calm, cfl: 0.4}
run: {until: 1, max-steps: 24}
output:
  directory: out
  checkpoints: {every: 8 steps}
  snapshots: {every: 24 steps, fields: [density, velocity, pressure], precision: double}
  history: {columns: {m: {mass: gas}, M: {mass: heavy}, E: {total: energy}, Q: {total: momentum_y}, u: {max: velocity_y}, p: {max: pressure}}}
expect:
  - {value: "max(abs(m/first(m) - 1))", at-most: 1e-13}
  - {value: "max(abs(M/first(M) - 1))", at-most: 1e-13}
  - {value: "max(abs(E/first(E) - 1))", at-most: 1e-13}
  - {value: "max(abs(Q))", at-most: 1e-12}
  - {norm: Linf, field: density, reference: mirror-y, at-most: 0}
  - {norm: Linf, field: velocity_y, reference: mirror-y, at-most: 0}
END2
ranked front 1 2 3
resumed front 8 front-1
"$BULLA" run front.yaml -o plain --quiet --set scheme.shock-fronts=plain
! cmp -s plain/history.csv front-1/out/history.csv || fail "it does nothing"
"$BULLA" plan front.yaml >plan
grep -q '^  shock fronts .*core/scheme/calm.c' plan || fail "not in the plan" plan
for tile in 4 8 16; do # sums go tile by tile, and differ in their last bits; the largest values do not
    "$BULLA" run front.yaml -o "tile-$tile" --quiet --set mesh.levels=0 --set "mesh.tile=$tile" --set expect=null
    cut -d, -f1-3,8-9 "tile-$tile/history.csv" >"tile-$tile.csv"
    cmp "tile-$tile.csv" tile-4.csv || fail "tiles of $tile show" "tile-$tile.csv"
done

# Contacts, shear and weak waves keep their bits.
cat >shear.yaml <<'END2'
bulla: 1
title: A disc in a shear flow, and a weak wave
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic}}
materials: {water: {eos: {type: stiffened-gas, preset: sg44}}, air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial:
  - {everywhere: true, material: water, density: 1000, pressure: "= 1e5 * (1 + 0.05 * math.sin(2 * math.pi * x))", velocity: ["= y > 0.5 and 10 or -10", 0]}
  - {sphere: {center: [0.5, 0.5], radius: 0.2}, material: air, density: 1.2, pressure: 1e5}
scheme: {cfl: 0.4}
run: {until: 1, max-steps: 20}
output: {history: {columns: {u: {max: velocity_x}, v: {max: velocity_y}, p: {max: pressure}, V: {volume: air}}}}
END2
for fronts in plain calm; do "$BULLA" run shear.yaml -o "shear-$fronts" --quiet --set "scheme.shock-fronts=$fronts"; done
cmp shear-plain/history.csv shear-calm/history.csv

# What it is for: noise that does not grow (80-fold without).
"$BULLA" run "$BULLA_SOURCE/cases/hard/h7.yaml" --variant quick -o h7 --quiet || fail "noise grows at the front" h7/expect.json

# Solids bear shear themselves: where there is gel in water the faces at a shock are as they were; in water alone they are not.
cat >gel.yaml <<'END_GEL'
bulla: 1
title: A shock in water with gel
domain: {lower: [0, 0], upper: [1, 1], cells: [48, 24], boundaries: {x-: reflecting, x+: reflecting, y-: periodic, y+: periodic}}
mesh: {tile: 8}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean, shear-modulus: 50 kPa, reference-density: 1000}}
initial:
  - {everywhere: true, fractions: {gel: 0.3, water: 0.7}, density: {gel: 1000, water: 1000}, pressure: 1e5, velocity: [-1500, "= 5 * math.sin(40 * y)"]}
run: {until: 1, max-steps: 40}
output: {history: {columns: {u: {max: velocity_x}, v: {max: velocity_y}, p: {max: pressure}}}}
END_GEL
sed 's/gel: 0.3, water: 0.7/gel: 0, water: 1/' gel.yaml >water.yaml
for name in gel water; do
    for fronts in calm plain; do ran $name-$fronts $name --set scheme.shock-fronts=$fronts; done
done
cmp gel-calm/out/history.csv gel-plain/out/history.csv || fail "a shock in gel is calmed"
! cmp -s water-calm/out/history.csv water-plain/out/history.csv || fail "a shock in water is not calmed"
