# Space-time maps: tables and arrays do not depend on the ranks while tiles come and go, go on after a restart without a
# row twice or missing, also in another directory, and hold what the fields are.
set -eu
cat >map.yaml <<'END'
bulla: 1
title: A pulse meets a bubble above a wall
domain:
  geometry: axisymmetric
  lower: [0, 0]
  upper: [0.4 mm, 0.8 mm]
  cells: [16, 32]
  boundaries: {x-: axis, x+: outflow, y-: reflecting, y+: {type: incoming-wave, pulse: lithotripter, amplitude: 30 MPa}}
mesh: {levels: 1, tile: 8, refine: [{interface: air}]}
materials:
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
  air: {eos: {type: ideal-gas, gamma: 1.4}}
initial:
  - {everywhere: true, material: water, density: 998, pressure: = 1e5 + 1e9 * x}
  - {sphere: {center: [0, 0.3 mm], radius: 0.1 mm}, material: air, density: 1.2, pressure: 1e5}
run: {until: 0.6 us}
output:
  maps:
    every: 20 ns
    wall: {boundary: y-, fields: [pressure, temperature]}
    axis: {line: {from: [0, 0], to: [0, 0.8 mm]}, points: 65, fields: [pressure, velocity, alpha_air]}
    slant: {line: {from: [0, 0], to: [0.3 mm, 0.4 mm]}, points: 26, fields: [alpha_air]}
    skin: {isosurface: air, along: axis, from: 0.15 mm, to: 0.45 mm, points: 30, fields: [temperature_air]}
    arc: {circle: {center: [0, 0.3 mm], radius: 0.2 mm, from: -90 deg, to: 90 deg}, points: 37, fields: [pressure, velocity]}
    chain: {polyline: {vertices: [[0.1 mm, 0.6 mm], [0.3 mm, 0.6 mm], [0.3 mm, 0.2 mm]]}, points: 61, fields: [pressure]}
    plane: {rectangle: {corner: [0.05 mm, 0.1 mm], first: [0.3 mm, 0], second: [0, 0.4 mm], points: [13, 17]}, fields: [pressure, velocity]}
  checkpoints: {every: 30 steps, keep: 100}
END
go() # DIRECTORY OPTIONS...
{
    out=$1
    shift
    ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0" "$BULLA" run map.yaml -o "$out" --quiet "$@"
}
same() # DIRECTORY: its tables are those of `alone`
{
    for map in wall axis slant skin arc chain plane; do
        cmp "alone/maps/$map.csv" "$1/maps/$map.csv" || { echo "$1: maps/$map.csv is another"; exit 1; }
        [ -s "$1/maps/$map.hdf" ] || { echo "$1: there is no maps/$map.hdf"; exit 1; }
    done
}
go alone
go two -n 2
same two
go three -n 3 --max-steps 70
go three --restart -n 2
same three
first=$(ls alone/checkpoints/*.chk | head -n 1)
go elsewhere --restart "$first"
same elsewhere
# With other places a table begins anew, and what was there is kept.
go moved --max-steps 70
go moved --restart --set output.maps.slant.points=20
[ -s moved/maps/slant.csv.before ] && cmp moved/maps/arc.csv alone/maps/arc.csv
awk -F, 'NR == 2 { t = $1 } END { if (t <= 0 || (NR - 1) % 20) { print "slant: begins at " t ", " NR " lines"; exit 1 } }' moved/maps/slant.csv

# 31 times: the start, each multiple of 20 ns (at the first step after it), of which the end is one. The wall at the start: 1e5 + 1e9 r,
# but for the metric of cell averages (h^2/12r) and the ends, where values stay constant.
awk -F, 'NR > 1 && $1 != t { n++; t = $1 }
         NR > 1 && $1 == 0 && $2 > 0.03e-3 && $2 < 0.38e-3 { d = $3 - 1e5 - 1e9 * $2; if (d * d > 4e6 || $4 < 100) bad = 1 }
         NR == 1 && $0 != "t,x,pressure,temperature" { bad = 1 }
         END { if (n != 31 || (NR - 1) % 31 || bad) { print "wall: " n " times, " NR " lines"; exit 1 } }' t=-1 alone/maps/wall.csv
# The axis is in the bubble from 0.2 to 0.4 mm; the surface has its places there and only there, at the gas's temperature.
awk -F, 'NR > 1 && $1 == 0 { inside = $2 > 0.2e-3 + 20e-6 && $2 < 0.4e-3 - 20e-6; if (inside && $7 < 0.99) bad = 1
                             outside = $2 < 0.2e-3 - 20e-6 || $2 > 0.4e-3 + 20e-6; if (outside && $7 > 0.01) bad = 1 }
         END { if (bad) { print "axis: the bubble is elsewhere"; exit 1 } }' alone/maps/axis.csv
awk -F, 'NR > 1 && $1 == 0 && $3 != "nan" { n++; if ($2 < 0.19e-3 || $2 > 0.41e-3 || $3 < 280 || $3 > 320) bad = 1 }
         END { if (n < 20 || n > 24 || bad) { print "skin: " n " places"; exit 1 } }' alone/maps/skin.csv
head -n 1 alone/maps/slant.csv | grep -qx 't,s,alpha_air'
# Around the bubble, from its lower pole to its upper one: r = R sin(s / R). Then right and down: r = 0.1 mm + s as far as 0.3 mm.
awk -F, 'NR == 1 && $0 !~ /^t,s,pressure,velocity_x,velocity_y/ { bad = 1 }
         NR > 1 && $1 == 0 { n++; s = $2; r = 0.2e-3 * sin(s / 0.2e-3); d = $3 - 1e5 - 1e9 * r; if (r > 0.03e-3 && d * d > 4e6) bad = 1 }
         END { if (bad || n != 37 || (NR - 1) % 37 || s < 6.2831e-4 || s > 6.2832e-4) { print "arc: " n " places"; exit 1 } }' alone/maps/arc.csv
awk -F, 'NR > 1 && $1 == 0 { n++; s = $2; r = s < 0.2e-3 ? 0.1e-3 + s : 0.3e-3; d = $3 - 1e5 - 1e9 * r; if (d * d > 4e6) bad = 1 }
         END { if (bad || n != 61 || s < 5.9999e-4 || s > 6.0001e-4) { print "chain: " n " places"; exit 1 } }' alone/maps/chain.csv
# On a rectangle the second distance varies faster.
awk -F, 'NR == 1 && $0 !~ /^t,s1,s2,pressure,velocity_x,velocity_y/ { bad = 1 }
         NR > 1 && $1 == 0 { r = 0.05e-3 + $2; z = 0.1e-3 + $3; e = $2 - int(n / 17) * 0.025e-3; f = $3 - n % 17 * 0.025e-3
                             if (e * e > 1e-24 || f * f > 1e-24) bad = 1
                             d = $4 - 1e5 - 1e9 * r; if (r^2 + (z - 0.3e-3)^2 > (0.15e-3)^2 && d * d > 4e6) bad = 1; n++ }
         END { if (bad || n != 221 || (NR - 1) % 221) { print "plane: " n " places"; exit 1 } }' alone/maps/plane.csv

# In space a linear field is what it is, around each axis and along a chain; a whole circle ends where it began.
cat >space.yaml <<'END'
bulla: 1
domain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [8, 8, 8], boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow}}
mesh: {tile: 8}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial: [{everywhere: true, material: air, density: 1.2, pressure: = 1e5 + 1e3 * x + 2e3 * y + 4e3 * z}]
run: {until: 1 us}
output:
  maps:
    every: 1 us
    x: {circle: {center: [0.5, 0.5, 0.5], radius: 0.3, axis: x, from: 0, to: -90 deg}, points: 10, fields: [pressure]}
    y: {circle: {center: [0.5, 0.5, 0.5], radius: 0.3, axis: y, from: 30 deg}, fields: [pressure]}
    z: {circle: {center: [0.5, 0.5, 0.5], radius: 0.3}, points: 9, fields: [pressure]}
    chain: {polyline: {vertices: [[0.2, 0.2, 0.2], [0.2, 0.8, 0.2], [0.2, 0.8, 0.8], [0.8, 0.8, 0.8]]}, fields: [pressure]}
    plane: {rectangle: {corner: [0.2, 0.8, 0.2], first: [0.6, 0, 0], second: [0, -0.3, 0.4], points: [4, 6]}, fields: [pressure]}
    wide: {rectangle: {corner: [0, 0, 0.5], first: [1, 0, 0], second: [0, 1, 0]}, fields: [pressure]}
END
"$BULLA" run space.yaml -o space --quiet
linear() # MAP PLACES EXPRESSION of s and a = s / 0.3: the pressure beyond 1e5 Pa
{
    awk -F, -v map="$1" 'NR > 1 && $1 == 0 { n++; s = $2; a = s / 0.3; d = $3 - 1e5 - ('"$3"'); if (n == 1) first = $3; last = $3
                                             if (d * d > 1e-10) { print map ": " $3 " at s = " s; bad = 1 } }
             END { if (bad || n != '"$2"' || (map ~ /[yz]/ && first != last)) {
                       print map ": " n " places, from " first " to " last; exit 1 } }' "space/maps/$1.csv"
}
linear x 10 '3500 + 300 * (2 * cos(a) - 4 * sin(a))'
linear y 16 '3500 + 300 * (4 * cos(a + 0.523598775598298873) + sin(a + 0.523598775598298873))'
linear z 9 '3500 + 300 * (cos(a) + 2 * sin(a))'
linear chain 15 's < 0.6 ? 1400 + 2000 * s : s < 1.2 ? 2600 + 4000 * (s - 0.6) : 5000 + 1000 * (s - 1.2)'
[ "$(grep -c '^0,' space/maps/wide.csv)" = 81 ] # one per cell, and the edges
awk -F, 'NR > 1 && $1 == 0 { n++; d = $4 - 1e5 - 1e3 * (0.2 + $2) - 2e3 * (0.8 - 0.6 * $3) - 4e3 * (0.2 + 0.8 * $3); if (d * d > 1e-16) bad = 1 }
         END { if (bad || n != 24) { print "plane: " n " places"; exit 1 } }' space/maps/plane.csv
if /usr/bin/python3 -c 'import numpy, h5py' 2>/dev/null; then
    PYTHONPATH="$BULLA_SOURCE/packaging/python" PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c '
import bulla, numpy as np
plane = bulla.Run("space").maps["plane"]
assert plane.axis == "s1,s2" and [len(s) for s in plane.place] == [4, 6] and plane["pressure"].shape == (2, 4, 6)
assert np.allclose(plane.points()[3, 5], [0.8, 0.5, 0.6], atol=1e-15) and np.allclose(plane.place[1][-1], 0.5, atol=1e-15)
assert np.allclose(plane["pressure"][0], 1e5 + plane.points() @ [1e3, 2e3, 4e3], atol=1e-8)'
fi

# What cannot be, at its place.
refused() { # LINE:COLUMN WORDS MAP: a map of the plane case; the line is that of `wall`
    sed "s|^    wall: .*|    wall: {$3, fields: [pressure]}|" map.yaml >wrong.yaml
    code=0
    "$BULLA" check wrong.yaml >/dev/null 2>said || code=$?
    if [ "$code" -ne 2 ] || ! grep -F "wrong.yaml:$1: error: " said | grep -qF -- "$2"; then
        echo "$3: exit $code, not '$2' at $1"
        cat said
        exit 1
    fi
}
refused 20:50 'at 180 deg the circle is at x = -0.0001 m, outside of the domain, 0 to 0.0004 m' \
    'circle: {center: [0, 0.3 mm], radius: 0.1 mm, from: 180 deg, to: 90 deg}'
refused 20:76 'the arc has no length' 'circle: {center: [0, 0.3 mm], radius: 0.1 mm, from: 90 deg, to: 90 deg}'
refused 20:62 '1.5 turns' 'circle: {center: [0, 0.3 mm], radius: 0.1 mm, to: 540 deg}'
refused 20:64 'only in three dimensions' 'circle: {center: [0, 0.3 mm], radius: 0.1 mm, axis: z}'
refused 20:29 '2 numbers are needed' 'circle: {center: [0.3 mm], radius: 0.1 mm}'
refused 20:43 '0.0005 m is outside of the domain, 0 to 0.0004 m' 'polyline: {vertices: [[0, 0], [0.5 mm, 0]]}'
refused 20:42 'this point is the one before it' 'polyline: {vertices: [[0, 0], [0, 0]]}'
refused 20:33 'at least two points, [x, y], is needed' 'polyline: {vertices: [[0, 0]]}'
refused 20:63 "only for a 'boundary' or an 'isosurface': the polyline has its own ends" \
    'polyline: {vertices: [[0, 0], [0.1 mm, 0]]}, from: 0'
refused 20:11 'one too many is given' 'boundary: y-, circle: {center: [0, 0], radius: 1 mm}'
refused 20:68 'it is 45 deg from the first side: a rectangle has right angles' 'rectangle: {corner: [0, 0], first: [0.1 mm, 0], second: [0.1 mm, 0.1 mm]}'
refused 20:47 'the end of this side is at x = 0.0005 m, outside of the domain, 0 to 0.0004 m' \
    'rectangle: {corner: [0, 0], first: [0.5 mm, 0], second: [0, 0.1 mm]}'
refused 20:68 'this side has no length' 'rectangle: {corner: [0, 0], first: [0.1 mm, 0], second: [0, 0]}'
refused 20:89 '400 x 300 places are more than 100000' \
    'rectangle: {corner: [0, 0], first: [0.1 mm, 0], second: [0, 0.1 mm], points: [400, 300]}'
refused 20:86 "'points: [.., ..]' of its own" 'rectangle: {corner: [0, 0], first: [1 um, 0], second: [0, 1 um]}, points: 7'

# Overwriting takes away the maps that were there, and what is the user's own stays.
mkdir -p other/fields other/maps
cp two/case.yaml other
touch other/fields/own.csv other/maps/own.txt other/maps/old.csv other/maps/old.hdf
go other --overwrite --max-steps 1
[ -e other/fields/own.csv ] && [ -e other/maps/own.txt ] && [ -s other/maps/wall.csv ]
if [ -e other/maps/old.csv ] || [ -e other/maps/old.hdf ]; then echo "old maps are still there"; exit 1; fi

# Pictures of them.
"$BULLA" plot alone map axis pressure >said
[ -s "$(cat said)" ] && grep -q 'plots/map_axis_pressure.png' said
"$BULLA" plot alone map arc pressure >said
[ -s "$(cat said)" ]
"$BULLA" plot alone map skin temperature_air -o skin.png --range 250,400 --width 400 >said
[ -s skin.png ]
"$BULLA" plot alone map plane pressure,velocity_y >said # when they are largest
grep -q plots/map_plane_pressure.png said && [ -s alone/plots/map_plane_velocity_y.png ]
"$BULLA" plot alone map plane pressure --time 0.3us -o then.png >said
"$BULLA" plot alone map plane pressure --time 0.302us -o near.png >said
cmp then.png near.png
! cmp -s then.png alone/plots/map_plane_pressure.png

# Profiles: at the hottest moment, at chosen times, of two runs. Of two equal runs the second line hides the first.
"$BULLA" plot alone profile wall pressure >said
[ "$(cat said)" = alone/plots/profile_wall_pressure.png ] && [ -s alone/plots/profile_wall_pressure.png ]
"$BULLA" plot alone two profile axis pressure,velocity_y --time 0.2us --time 0.5us --xlim 0,0.4mm -o both.png >said
[ -s both.png ]
"$BULLA" plot alone profile wall pressure --time 0.3us -o early.png >said
"$BULLA" plot alone profile wall pressure --time 0.301us -o near.png >said # the same row of the map
"$BULLA" plot alone profile wall pressure --time 0.55us -o late.png >said
cmp early.png near.png
height() { od -An -tu1 -j20 -N4 "$1" | awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4 }'; }
"$BULLA" plot alone two profile wall pressure --time 0.3us -o pair.png >said
"$BULLA" plot alone two profile wall pressure --time 0.1us --time 0.2us --time 0.3us --time 0.4us -o many.png >said
[ "$(height many.png)" -gt "$(height pair.png)" ] # eight names want more than a line above the panel
! cmp -s early.png late.png
! cmp -s early.png alone/plots/profile_wall_pressure.png
for wrong in 'map' 'map side pressure' 'map wall density' 'profile' 'profile wall' 'profile wall density' 'profile side pressure' 'profile plane pressure' \
    'map wall pressure --time 1ns' 'map plane pressure --time 1ns --time 2ns' 'map plane s2' \
    'alone_is_no_run profile wall pressure' 'pressure --time 1ns --time 2ns'; do
    code=0
    # shellcheck disable=SC2086
    "$BULLA" plot alone $wrong >/dev/null 2>said || code=$?
    [ "$code" -eq 2 ] && [ -s said ] || { echo "plot $wrong: exit $code"; exit 1; }
done
