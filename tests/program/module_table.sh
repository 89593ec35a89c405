# A law, its table, and the table as a law: a water tube with either gives the same states. What cannot be tabulated is refused.
set -eu
tube() { # NAME EOS
    cat >"$1.yaml" <<END
bulla: 1
title: Water tube
about: Written by a test.
domain: {lower: [0], upper: [3], cells: [200], boundaries: {x-: outflow, x+: outflow}}
materials: {water: {eos: $2}}
initial:
  - {everywhere: true, material: water, temperature: 300, pressure: 100000}
  - {half-space: {normal: [-1], point: [2.0]}, material: water, temperature: 310, pressure: 500 MPa}
scheme: {riemann: hllc, limiter: mc, cfl: 0.4}
run: {until: 0.2 ms}
output:
  history:
    every: 1 step
    columns:
      p: {mean: pressure, where: {box: {lower: [2.13], upper: [2.25]}}}
      T: {mean: temperature, where: {box: {lower: [2.13], upper: [2.25]}}}
      rho: {mean: density, where: {box: {lower: [2.13], upper: [2.25]}}}
      p_max: {max: pressure}
END
    "$BULLA" run "$1.yaml" -o "$1" --quiet
}
near() { # ONE OTHER MOST: the last rows of two histories
    tail -n 1 "$1/history.csv" >one.row
    tail -n 1 "$2/history.csv" >other.row
    paste -d, one.row other.row | awk -F, -v most="$3" -v names="$1 $2" '{
        for (i = 4; i <= 7; i++) { # behind t, dt and the step
            off = $i/$(i + NF/2) - 1
            if (!(off <= most && off >= -most)) { print names ": column " i ": " $i " and " $(i + NF/2); bad = 1 }
        }
    } END { exit bad }'
}
"$BULLA" module table mnasg mnasg.csv --set preset=water --density 900..1300 --temperature 275..500 --states 60x40 2>said
grep -q "60 densities, 40 temperatures" said
"$BULLA" module table iapws95 iapws95.h5 --density "992 kg/m3..1250" --temperature "285 K..420" --states 80x80 2>said
grep -q "80 densities, 80 temperatures" said
tube law-m "{type: mnasg, preset: water}"
tube table-m "{type: table, file: mnasg.csv}"
tube law-i "{type: iapws95}"
tube table-i "{type: table, file: iapws95.h5}"
near law-m table-m 1e-7
near law-i table-i 1e-6
if near law-m law-i 1e-4 >/dev/null; then echo "two laws are told apart by nothing"; exit 1; fi

refused() { # CODE WORDS ARGS...
    code=0
    "$BULLA" module table $3 >said 2>&1 || code=$?
    [ "$code" = "$1" ] && [ "$(grep -c "error.*$2" said)" = 1 ] || { echo "$3: $code"; cat said; exit 1; }
}
refused 2 "there is no eos 'none'" "none x.csv"
refused 2 "a law and a file are wanted" "mnasg"
refused 2 "A..B is wanted" "mnasg x.csv --set preset=water --density 900"
refused 2 "0 < A < B in K is wanted" "mnasg x.csv --set preset=water --temperature 5bar..7bar"
refused 2 "8 to 1500 of each" "mnasg x.csv --set preset=water --states 4x100"
refused 2 "has no such preset" "mnasg x.csv --set preset=wine"
refused 2 "states no range of densities" "ideal-gas x.csv --set preset=air"
refused 3 "cannot be written" "mnasg nowhere/x.csv --set preset=water --states 8x8 --density 900..1200 --temperature 300..400"
refused 2 "no table that can be used: .*state \[0\]\[0\]" "iapws95 x.h5 --density 950..1200 --temperature 285..700"
