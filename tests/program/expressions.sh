# Expressions in the place of fields: integrals that a case could write otherwise come out the same, to the bit and on any
# number of ranks; what fields of an expression need (global values, where a material is) is there; mistakes are found with
# the case.
set -eu
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

cat >flow.yaml <<'END'
bulla: 1
title: A helium bubble in a wind
parameters: {p0: 1e5, k: 2}
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: reflecting, x+: outflow, y-: reflecting, y+: outflow}}
mesh: {tile: 8, levels: 1, refine: [{interface: helium}]}
materials:
  air: {eos: {type: ideal-gas, gamma: 1.4}}
  helium: {eos: {type: ideal-gas, gamma: 1.67}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: = p0, velocity: [3, 4]}
  - {sphere: {center: [0.3, 0.4], radius: 0.15}, material: helium, density: 3, pressure: = p0}
run: {until: 1 ms, max-steps: 4}
output:
  directory: out
  snapshots: {every: 1 ms, fields: [pressure, {power: = (pressure - p0) * velocity_x}, {mine: "= k * x + t"}]}
  probes:
    a: {at: [0.3, 0.2], fields: [schlieren, {s: = schlieren}, temperature_air, {T: = 0 + temperature_air}, {mine: "= k * x + t"}]}
  history:
    columns:
      a: {integral: = density * velocity_x}
      b: {total: momentum_x}
      c: {mean: "= 2 * x", in: helium}
      d: {centroid: helium, along: x}
      e: {max: "= math.sqrt(velocity_x^2 + velocity_y^2)"}
      f: {max: velocity}
      g: {max: "= math.sqrt(-1 - x)"}
      h: {integral: "= k"}
END
for ranks in 1 2 3; do
    "$BULLA" run flow.yaml -o ranks-$ranks -n $ranks --quiet
    cmp ranks-1/history.csv ranks-$ranks/history.csv
    cmp ranks-1/probes.csv ranks-$ranks/probes.csv
done
awk -F, 'function off(a, b) { return a > b ? a - b : b - a }
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    off($at["a"], $at["b"]) > 1e-13 * $at["b"] || off($at["c"], 2 * $at["d"]) > 1e-12 || off($at["e"], $at["f"]) > 1e-12 ||
    $at["g"] != "nan" || off($at["h"], 2) > 1e-14 { print; bad = 1 }
    END { exit bad || NR < 5 }' ranks-1/history.csv
awk -F, 'NR > 1 && ($2 != $3 || $4 != $5 || $4 < 250 || $6 - 0.6 - $1 > 1e-12 || $6 - 0.6 - $1 < -1e-12) { print; bad = 1 } END { exit bad || NR < 5 }' \
    ranks-1/probes.csv
"$BULLA" info ranks-1/fields/flow_000000.hdf >first
grep -q '^mine  *0.015625 *1.96875$' first || { cat first; exit 1; }
grep -q '^power ' first || { cat first; exit 1; }

refused() { # SETTING WORDS: is refused with these words
    if "$BULLA" check flow.yaml --set "$1" >said 2>&1; then cat said; exit 1; fi
    grep -q "$2" said || { cat said; exit 1; }
}
refused 'output.history.columns={a: {max: "= presure * 2"}}' "'presure' is neither a parameter nor known"
refused 'output.history.columns={a: {max: "= pressure *"}}' 'unexpected symbol'
refused 'output.history.columns={a: {max: "= pressure > 2"}}' 'a number is needed here, but the script gives a boolean'
refused 'output.history.columns={a: {max: "= velocity * 2"}}' "it may use: x, y, z, t, density"
refused 'output.snapshots.fields=[= pressure]' 'an expression in a list needs a name'
refused 'output.snapshots.fields=[{pressure: = 2}]' "'pressure' is a field already"
refused 'output.snapshots.fields=[{q: = pressure}, {q: = density}]' "'q' is another expression already"
refused 'output.snapshots.fields=[{a b: = pressure}]' 'is an identifier'
refused 'mesh={levels: 1, refine: [{value: = pressure, above: 1}]}' 'refines by an expression'
