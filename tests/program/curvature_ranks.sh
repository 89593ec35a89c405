# The curvature of a bubble, which looks across edges and corners of tiles, of ranks and of levels, has the same bits on 1, 2,
# 3 and 4 ranks: in snapshots and histories of a plane with levels that move and of an axisymmetric scene; and it is
# 1/R and 2/R.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"

materials='materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}'
output='output:
  snapshots: {every: 10 steps, fields: [curvature_air, curvature_water, level], precision: double}
  history:
    columns: {kappa: {isosurface-mean: curvature_air, in: air}, least: {min: curvature_water}}'

# a front of two cells, as a run would make it
front() { # R X Y U
    cat <<END2
  - lua: |
      function(x, y, z)
        local air = 0.5 * (1 - math.tanh((math.sqrt((x - $2)^2 + (y - $3)^2) - $1) / 0.01))
        return {alpha = {air = air, water = 1 - air}, density = {air = 1.2, water = 1000}, pressure = 1e5,
                velocity = {$4, 20}}
      end
END2
}
cat >plane.yaml <<END2
bulla: 1
title: A bubble in the plane
domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: outflow, x+: non-reflecting, y-: no-slip, y+: reflecting}}
mesh: {levels: 1, tile: 8, regrid-every: 3, refine: [{jump: alpha_air, above: 0.05}]}
$materials
initial:
$(front 0.25 0.51 0.49 50)
run: {until: 1, max-steps: 10}
$output
END2
cat >round.yaml <<END2
bulla: 1
title: A bubble on the axis
domain: {geometry: axisymmetric, lower: [0, 0], upper: [1, 1], cells: [64, 64], boundaries: {x-: axis, x+: outflow, y-: periodic, y+: periodic}}
mesh: {tile: 8}
$materials
initial:
$(front 0.25 0 0.49 0)
run: {until: 1, max-steps: 10}
$output
END2

while read -r name kappa; do
    ranked "$name" 1 2 3 4
    awk -F , -v wanted=$kappa '!/^#/ && $0 !~ /kappa/ {
        rows++
        for (i = 1; i <= NF; i++) if (names[i] == "kappa" && ($i < 0.98 * wanted || $i > 1.02 * wanted)) bad = 1
        for (i = 1; i <= NF; i++) if (names[i] == "least" && $i > -0.9 * wanted) bad = 1
    }
    /kappa/ { for (i = 1; i <= NF; i++) names[i] = $i }
    END { exit bad || rows < 2 }' $name-1/out/history.csv || { echo "$name: not $kappa"; cat $name-1/out/history.csv; exit 1; }
done <<END2
plane 4
round 8
END2
