# Parameters that nothing uses are reported where they stand: in the case, the file it extends, variants and matrix;
# those that an overlay alone uses are not.
set -eu
cat >base.yaml <<'END'
bulla: 1
title: A tube
parameters:
  p_1: 1 bar
  spare: 3
  side: 1
  by_matrix: 2
  by_quick: 1 ms
  by_variant: 2
  by_other: 3
domain: {lower: [0], upper: [= side], cells: [32], boundaries: {x-: outflow, x+: reflecting}}
materials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}
initial: [{everywhere: true, material: air, density: 1, pressure: = p_1}]
run: {until: 0.5 ms}
matrix:
  parameters.p_l: [1 bar, 2 bar]
  domain.upper: [["= by_matrix * side"]]
quick:
  run: {until: = by_quick}
  parameters: {p_one: 3, needed: 4}
variants:
  long:
    run: {until: = 1e-3 * by_variant * needed * by_other}
    parameters: {needed: 1, lost: 2}
END
cat >child.yaml <<'END'
extends: base.yaml
title: A child
parameters: {side: 2, p1: 4}
END
warned() { # FILE EXPECTED ARGS...: the warnings, without what follows a place
    file=$1 expected=$2
    shift 2
    "$BULLA" check "$file" "$@" >said 2>&1
    sed -n 's/: warning: /: /p' said >got
    printf '%s\n' "$expected" >wanted
    diff wanted got || { cat said; exit 1; }
}
warned base.yaml "base.yaml:5:3: parameter 'spare' is not used
base.yaml:16:3: matrix: the case has no parameter 'p_l'
base.yaml:20:16: parameter 'p_one' is not used
base.yaml:24:29: parameter 'lost' is not used"
grep -q "did you mean 'p_1'" said
warned child.yaml "base.yaml:5:3: parameter 'spare' is not used
base.yaml:16:3: matrix: the case has no parameter 'p_l'
base.yaml:20:16: parameter 'p_one' is not used
base.yaml:24:29: parameter 'lost' is not used
child.yaml:3:23: parameter 'p1' is not used"
warned base.yaml "base.yaml:5:3: parameter 'spare' is not used
base.yaml:16:3: matrix: the case has no parameter 'p_l'
base.yaml:20:16: parameter 'p_one' is not used
base.yaml:24:29: parameter 'lost' is not used" --variant long
warned base.yaml "--set parameters.more=4: parameter 'more' is not used
base.yaml:5:3: parameter 'spare' is not used
base.yaml:16:3: matrix: the case has no parameter 'p_l'
base.yaml:20:16: parameter 'p_one' is not used
base.yaml:24:29: parameter 'lost' is not used" --set parameters.more=4
