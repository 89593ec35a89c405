# A law that gives no number in the middle of a run: the message says at which step, where, in which field and stage; so
# does the dump, which is the same on any number of ranks and gives the same bits when it is replayed.
set -eu
. "$BULLA_SOURCE/tests/lib.sh"
fail() {
    echo "$1"
    cat out
    exit 1
}
has() { # PATTERN
    grep -q -e "$1" out || fail "'$1' is not there"
}

# The law: an ideal gas that gives no number above a pressure, for the energy or for the sound speed, or a sound speed
# beyond all bounds.
mkdir source
cat >source/brittle.c <<'END'
/* An ideal gas that breaks: above a pressure its law gives no number, for the energy or for the sound
 * speed, or a sound speed of 1e12 m/s. For tests of what a run says when a law fails in the middle of it. */
#include <bulla/eos.h>

#include <math.h>
#include <stdlib.h>

struct brittle {
    double gamma, limit, speed;
};

static void brittle_state(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                          double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    const struct brittle *par = self;
    for (size_t i = 0; i < n; i++) {
        double broken = p[i] <= par->limit ? 0.0 : par->speed > 1.0 ? 1e24 * rho[i] : (double)NAN;
        rho_e[i] = p[i] / (par->gamma - 1.0) + (par->speed > 0.0 ? 0.0 : broken);
        rho_c2[i] = par->gamma * p[i] + (par->speed > 0.0 ? broken : 0.0);
    }
}

static void brittle_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                                double *BULLA_RESTRICT de_drho)
{
    const struct brittle *par = self;
    for (size_t i = 0; i < n; i++) {
        de_dp[i] = 1.0 / ((par->gamma - 1.0) * rho[i]);
        de_drho[i] = -p[i] / ((par->gamma - 1.0) * rho[i] * rho[i]);
    }
}

static void brittle_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                                const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    (void)self;
    for (size_t i = 0; i < n; i++) T[i] = p[i] / (287.0 * rho[i]);
}

static void brittle_entropy(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                            const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    const struct brittle *par = self;
    for (size_t i = 0; i < n; i++) s[i] = 717.5 * (log(p[i]) - par->gamma * log(rho[i]));
}

static void brittle_density(const void *self, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                            double *BULLA_RESTRICT rho)
{
    (void)self;
    for (size_t i = 0; i < n; i++) rho[i] = p[i] / (287.0 * T[i]);
}

static void brittle_p_min(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p)
{
    (void)self;
    (void)rho;
    for (size_t i = 0; i < n; i++) p[i] = 0.0;
}

static void brittle_linear(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT a,
                           double *BULLA_RESTRICT b)
{
    const struct brittle *par = self;
    (void)rho;
    for (size_t i = 0; i < n; i++) {
        a[i] = 1.0 / (par->gamma - 1.0);
        b[i] = 0.0;
    }
}

static void brittle_range(const void *self, struct bulla_eos_range *ret_range)
{
    (void)self;
    *ret_range = (struct bulla_eos_range){
        .rho_min = 0.0, .rho_max = 300.0, .p_min = 0.0, .p_max = 3e7, .T_min = 100.0, .T_max = 2000.0};
}

static const struct bulla_eos brittle_table = {.size = sizeof(struct bulla_eos),
                                               .state = brittle_state,
                                               .derivatives = brittle_derivatives,
                                               .temperature = brittle_temperature,
                                               .entropy = brittle_entropy,
                                               .density = brittle_density,
                                               .p_min = brittle_p_min,
                                               .linear = brittle_linear,
                                               .range = brittle_range};

static const struct bulla_param brittle_params[] = {
    {"gamma", "1", 1.0001, 100.0, 1.4, "ratio of specific heats", BULLA_NUMBER, 0},
    {"limit", "Pa", 0.0, 1e12, 1e12, "pressure above which the law breaks", BULLA_NUMBER, 0},
    {"speed", "1", 0.0, 2.0, 0.0, "1: the sound speed breaks; 2: it becomes 1e12 m/s; 0: the energy", BULLA_NUMBER, 0},
    {0},
};

static int brittle_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct brittle *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    *self = (struct brittle){values[0].number, values[1].number, values[2].number};
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "eos",
    .name = "brittle",
    .version = "0.1",
    .doc = "An ideal gas that gives no number above a pressure.",
    .cite = "made for tests",
    .params = brittle_params,
    .open = brittle_open,
    .close = free,
    .table = &brittle_table,
};
END
cat >source/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.20)
project(brittle LANGUAGES C)
find_package(bulla 0.1 REQUIRED)
bulla_add_module(brittle KIND eos NAME brittle SOURCES brittle.c)
END
cmake -G Ninja -S source -B law -Dbulla_DIR="$BULLA_SOURCE/core/include/bulla" >out 2>&1 &&
    cmake --build law >>out 2>&1 || fail "the law cannot be built"
law=$PWD/law/eos-brittle.so

case_file() { # NAME SPEED MESH PRESSURE LIMIT
    cat >"$1.yaml" <<END
bulla: 1
title: A gas that breaks
about: Written by a test.
modules: ["$law"]
domain:
  geometry: cartesian
  lower: [0, 0]
  upper: [1, 0.5]
  cells: [32, 16]
  boundaries:
    x-: {type: inflow, material: air, density: 1.2, pressure: "$4", velocity: [10, 0]}
    x+: outflow
    y-: reflecting
    y+: reflecting
mesh: {tile: 8$3}
materials:
  air: {eos: {type: brittle, limit: $5, speed: $2}}
  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}}
initial:
  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}
  - {sphere: {center: [0.5, 0.25], radius: 0.1}, material: water, density: 1000, pressure: 1e5}
scheme: {riemann: hllc, limiter: mc, cfl: 0.4}
run: {until: 1.5 ms}
output: {directory: $1.out}
END
}

# The gas at the boundary passes the limit at t = 0.5 ms exactly.
rising='= 1e5 * (1 + t/1e-3)'
case_file energy 0 "" "$rising" 1.5e5
code=0
"$BULLA" run energy.yaml --quiet >out 2>&1 || code=$?
[ $code = 3 ] || fail "exit code $code"
has 'step [0-9]* at t = 0.00050[0-9]* s cannot be completed: total_energy = -*nan J/m3'
has 'of level 0 (cell (0, 0, 0) of tile (0, 0, 0)), after stage 1'
dump=$(ls energy.out/dump_*.h5)
[ "$(ls energy.out | grep -c dump)" = 1 ] || fail "more than one file: $(ls energy.out)"
has "$dump"
step=$(sed -n 's/.*step \([0-9]*\) at t = .*cannot be completed.*/\1/p' out)
[ "$dump" = "$(printf 'energy.out/dump_%06d.h5' "$step")" ] || fail "$dump is not of step $step"

"$BULLA" info "$dump" >out 2>&1 || fail "info refuses it"
for pattern in "^step  *$step, from t = 0.0005" '^stage  *stage 1' '^level  *0' '^tile  *(0, 0, 0)' \
    '^cell  *(0, 0, 0) of the tile' '^field  *total_energy = -*nan' 'eos  *brittle  *0.1  *xxh64 [0-9a-f]\{16\}' \
    '^left.energy  *-*nan' '^momentum_x' 'frame_y\[7, 96\]'; do
    has "$pattern"
done
grep -v '^dump' out >one
"$BULLA" info --replay "$dump" >out 2>&1 || fail "the replay gives something else"
has '0 of 32 quantities at the faces of the cell differ, 0 of 64 cells'
has 'to the bit'

# Two ranks: the same file.
"$BULLA" run energy.yaml --quiet -n 2 -o two >out 2>&1 && fail "it finished"
"$BULLA" info two/dump_*.h5 >out 2>&1 || fail "info refuses it"
grep -v '^dump' out | cmp - one || fail "another dump on two ranks"
"$BULLA" info --replay two/dump_*.h5 >out 2>&1 || fail "the replay gives something else"

# On a finer level, by the sound speed, on three ranks.
case_file level 1 ", levels: 1, refine: [{jump: density, above: 0.02}]" "$rising" 1.7e5
"$BULLA" run level.yaml --quiet -n 3 >out 2>&1 && fail "it finished"
has 'rho_c2 = -*nan Pa of material .air.*of level 1 (cell ([0-9]*, [0-9]*, 0) of tile ([0-9]*, [0-9]*, 0)), after stage'
has 'half way through step'
"$BULLA" info --replay level.out/dump_*.h5 >out 2>&1 || fail "the replay gives something else"

# The same where stages go on from each other: a stage after the first has what it went on from in the dump.
"$BULLA" run energy.yaml --set scheme.integrator=ssprk3 --set scheme.guard=strict --quiet -o third >out 2>&1 &&
    fail "it finished"
"$BULLA" info third/dump_*.h5 >out 2>&1 || fail "info refuses it"
has '^stage  *stage 2: u2'
has 'u_stage\['
"$BULLA" info --replay third/dump_*.h5 >out 2>&1 || fail "the replay gives something else"
has 'to the bit'

# A sound speed beyond all bounds, in a gas that is heated everywhere: no step of 1e-20 s after the other, but a stop that
# names the cell, its law and its state, alike on one rank and on two; the checkpoint that it leaves stops where it stopped.
heated() { # NAME MESH
    cat >"$1.yaml" <<END
bulla: 1
title: A gas is heated until its law ends
modules: ["$law"]
domain: {lower: [0, 0], upper: [1, 0.5], cells: [32, 16], boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}
mesh: {tile: 8$2}
materials: {air: {eos: {type: brittle, limit: 1.5e5, speed: 2}}}
initial: [{everywhere: true, material: air, density: 1.2, pressure: 1e5}]
sources: {heating: 0.25e9}
run: {until: 1.5 ms}
output: {directory: $1.out}
END
}
heated slow ""
for ranks in 1 2; do
    code=0
    limited "$BULLA" run slow.yaml --quiet --overwrite -n $ranks >out 2>&1 || code=$?
    [ $code = 3 ] || fail "exit code $code"
    has 'step [0-9]* at t = 0.000[45][0-9]* s: the time step has fallen to [0-9.]*e-1[0-9] s, below 1e-06 of the longest so far; sound speed 1e+12 m/s, velocity 0 m/s, pressure [0-9.e+]* Pa in the cell at (0.015625, 0.015625, 0) m of level 0 (cell (0, 0, 0) of tile (0, 0, 0)); air (brittle) fraction 1, density 1.2 kg/m3, temperature [0-9.]* K, sound speed 1e+12 m/s'
    "$BULLA" info slow.out/dump_*.h5 >info 2>&1 || fail "info refuses it"
    grep -v '^dump' info >slow.$ranks
    "$BULLA" info --replay slow.out/dump_*.h5 >out 2>&1 || fail "the replay gives something else"
    has '0 of 64 cells'
    has 'sound_speed = .*: the same, to the bit'
done
cmp slow.1 slow.2 || fail "another dump on two ranks"
grep -q '^stage  *before a step too short to be taken' slow.1 || fail "the stage is not said"
"$BULLA" run slow.yaml --quiet --restart >out 2>&1 && fail "it finished"
has 'below 1e-06 of the longest so far; sound speed 1e+12 m/s'
"$BULLA" run slow.yaml --quiet --overwrite --set run.smallest-step='1 ns' >out 2>&1 && fail "it finished"
has 'step [0-9]* at t = 0.000[45][0-9]* s: .* below run.smallest-step; sound speed 1e+12'
"$BULLA" run slow.yaml --quiet --overwrite --set run.smallest-step='1 ms' >out 2>&1 && fail "it finished"
has 'step 1 at t = 0 s: .* below run.smallest-step; sound speed 341.6 m/s'

# On a finer level, which holds up the coarser one.
heated below ", levels: 1, refine: [{region: {box: {lower: [0.3, 0.1], upper: [0.5, 0.3]}}}]"
limited "$BULLA" run below.yaml --quiet -n 2 >out 2>&1 && fail "it finished"
has 'the time step has fallen to [0-9.]*e-1[0-9] s, below 1e-06 .* of level [01] (cell ([0-9]*, [0-9]*, 0) of tile'
"$BULLA" info --replay below.out/dump_*.h5 >out 2>&1 || fail "the replay gives something else"

# With another law the replay says so: the module of the dump is another file now.
cp "$law" other.so
printf x >>other.so
sed "s|$law|$PWD/other.so|" energy.yaml >other.yaml
"$BULLA" run other.yaml --quiet -o other >out 2>&1 && fail "it finished"
cp "$law" other.so
"$BULLA" info --replay other/dump_*.h5 >out 2>&1 || fail "the replay gives something else"
has 'brittle .*another file here'

# A boundary whose script gives no number from a time on: step, level, tile, side, value, place and cell, the first
# time that it is asked; the cell beside it is dumped.
case_file script 0 "" '= (t < 5e-4 or y < 0.3) and 1e5 or 0/0' 1e12
for ranks in 1 2; do
    rm -rf script.out
    "$BULLA" run script.yaml --quiet -n $ranks >out 2>&1 && fail "it finished"
    [ "$(grep -c 'not a finite number' out)" = 1 ] || fail "not said once"
    has 'script.yaml:11: the script gives -*nan, not a finite number (called with x,y,z,r,t = 0, 0.328125, 0, 0, 0.0005'
    has 'step [0-9]* at t = 0.00[0-9]* s, level 0, tile (0, 1, 0), boundary x-: pressure at (0, 0.328125, 0) m, beside cell (0, 2, 0)'
    has 'the last good state .* is saved as script.out/checkpoints/'
    "$BULLA" info script.out/dump_*.h5 >out 2>&1 || fail "info refuses it"
    has '^tile  *(0, 1, 0)'
    has '^cell  *(0, 2, 0) of the tile'
    has '^left.pressure  *-*nan'
    "$BULLA" info --replay script.out/dump_*.h5 >out 2>&1 || fail "the replay gives something else"
done

# Other files are not replayed.
"$BULLA" info --replay energy.out/provenance.json >out 2>&1 && fail "a text was replayed"
has 'provenance.json'
"$BULLA" info --replay energy.out/fields/*.hdf >out 2>&1 && fail "a snapshot was replayed"
has 'not a dump of a failed step'
exit 0
