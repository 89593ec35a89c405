/* vet_try.c - see vet_try.h. */
#include "plug/vet_try.h"

#include "bulla/boundary.h"
#include "bulla/coefficient.h"
#include "bulla/constitutive.h"
#include "bulla/damage.h"
#include "bulla/field.h"
#include "bulla/inelastic.h"
#include "bulla/reconstruction.h"
#include "bulla/riemann.h"
#include "plug/vet.h"

#include <math.h>
#include <string.h>

/* Slopes of a straight line, of nothing, of an extremum; or edges of such cells. */
bool vet_try_limiter(const void *table, const void *self)
{
    const struct bulla_limiter *limiter = table;
    enum { CELLS = 3 };
    const double minus[] = {1.0, 0.0, 1.0}, plus[] = {1.0, 0.0, -1.0};
    const double rows[3][CELLS] = {{0.0, 1.0, 0.0}, {1.0, 1.0, 1.0}, {2.0, 1.0, 0.0}}; /* one below the other */
    double slope[CELLS] = {(double)NAN, (double)NAN, (double)NAN}, lower[CELLS], upper[CELLS];
    if (vet_two_sided(limiter)) {
        memcpy(lower, slope, sizeof slope);
        memcpy(upper, slope, sizeof slope);
        limiter->edges(self, CELLS, CELLS, rows[1], lower, upper);
        for (int i = 0; i < CELLS; i++) slope[i] = lower[i] + upper[i];
    } else limiter->slope(self, CELLS, minus, plus, slope);
    return isfinite(slope[0]) && isfinite(slope[1]) && isfinite(slope[2]);
}

/* No slopes: what a scheme may ask for while it is tried. */
static void vet_try_flat(const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                         double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    (void)limited;
    (void)step;
    memcpy(lower, w, n * sizeof *w);
    memcpy(upper, w, n * sizeof *w);
}

/* Edges of a gas that moves and whose density rises, in a row of as many cells as one needs. */
bool vet_try_reconstruction(const void *table, const void *self)
{
    const struct bulla_reconstruction *scheme = table;
    enum { ROWS = 3, CELLS = 5 };
    static const struct bulla_limited flat = {.size = sizeof flat, .edges = vet_try_flat};
    const double gas[ROWS][CELLS] = {{1, 2, 3, 4, 5}, {10, 10, 10, 10, 10}, {1e5, 1e5, 1e5, 1e5, 1e5}};
    double edges[2][ROWS] = {{(double)NAN, (double)NAN, (double)NAN}, {(double)NAN, (double)NAN, (double)NAN}};
    const double *w[ROWS] = {gas[0] + 2, gas[1] + 2, gas[2] + 2};
    double *lower[ROWS] = {&edges[0][0], &edges[0][1], &edges[0][2]};
    double *upper[ROWS] = {&edges[1][0], &edges[1][1], &edges[1][2]}, sum = 0.0;
    const struct bulla_limited *limited[ROWS] = {&flat, &flat, &flat};
    const struct bulla_cells cells = {.size = sizeof cells,
                                      .n = 1,
                                      .step = 1,
                                      .n_row = ROWS,
                                      .n_rho = 1,
                                      .n_u = 1,
                                      .i_u = 1,
                                      .i_p = 2,
                                      .i_stretch = ROWS,
                                      .w = w,
                                      .lower = lower,
                                      .upper = upper,
                                      .limited = limited};
    if (scheme->all) scheme->all(self, &cells);
    for (int q = 0; q < ROWS && !scheme->all; q++) scheme->edges(self, &flat, 1, 1, w[q], lower[q], upper[q]);
    for (int q = 0; q < ROWS; q++) sum += *lower[q] + *upper[q];
    return isfinite(sum);
}

/* A gas that moves through a face, the same on both sides. */
bool vet_try_riemann(const void *table, const void *self)
{
    const struct bulla_riemann *riemann = table;
    double rho = 1.2, p = 1e5, rho_E = 2.5e5 + 60.0, c = 341.6, u = 10.0, work[4];
    double mass = (double)NAN, momentum = (double)NAN, energy = (double)NAN, speed = (double)NAN;
    const struct bulla_side side = {&rho, &p, &rho_E, &c, (const double *[]){&u}, (const double *[]){&rho}, NULL};
    const struct bulla_faces faces = {.n = 1,
                                      .n_material = 1,
                                      .n_velocity = 1,
                                      .left = side,
                                      .right = side,
                                      .flux = {(double *[]){&mass}, (double *[]){&momentum}, &energy, &speed, NULL},
                                      .work = {&work[0], &work[1], &work[2], &work[3]}};
    riemann->solve(self, &faces);
    return isfinite(mass) && isfinite(momentum) && isfinite(energy) && isfinite(speed);
}

/* A solid at rest, and stretched to twice and to four times its length. */
bool vet_try_constitutive(const void *table, const void *self)
{
    const struct bulla_constitutive *law = table;
    enum { N = 3 };
    const double I1[N] = {3.0, 5.0, 16.5}, I2[N] = {3.0, 4.25, 8.0625}, nan = (double)NAN;
    double e[N] = {nan, nan, nan}, e_1[N] = {nan, nan, nan}, e_2[N] = {nan, nan, nan}, sum = 0.0;
    law->energy(self, N, I1, I2, e, e_1, e_2);
    for (int i = 0; i < N; i++) sum += e[i] + e_1[i] + e_2[i];
    bool good = isfinite(sum), none = true;
    for (int i = 0; i < N; i++) none &= e[i] == 0.0 && e_1[i] == 0.0 && e_2[i] == 0.0;
    for (int i = 0; i < N; i++) good &= none || e_1[i] + e_2[i] > 0.0; /* a Maxwell fluid bears nothing at rest */
    if (!law->second) return good;
    double e_11[N] = {nan, nan, nan}, e_12[N] = {nan, nan, nan}, e_22[N] = {nan, nan, nan};
    law->second(self, N, I1, I2, e_11, e_12, e_22);
    for (int i = 0; i < N; i++) sum += e_11[i] + e_12[i] + e_22[i];
    return good && isfinite(sum);
}

/* Strength of a body at rest, of one that has flowed far and fast, and of a hot one. */
bool vet_try_inelastic(const void *table, const void *self)
{
    const struct bulla_inelastic *law = table;
    enum { N = 3 };
    const double eps[N] = {0.0, 1.0, 0.1}, rate[N] = {0.0, 1e6, 1.0}, p[N] = {1e5, 1e9, 0.0},
                 T[N] = {300.0, 600.0, 1e4};
    const double rho[N] = {1e3, 1e4, 1e3};
    double Y[N] = {(double)NAN, (double)NAN, (double)NAN};
    if (law->needs(self) & ~(uint32_t)BULLA_INELASTIC_ALL) return false;
    law->strength(self, N, eps, rate, p, T, rho, Y);
    return isfinite(Y[0] + Y[1] + Y[2]) && Y[0] >= 0.0 && Y[1] >= 0.0 && Y[2] >= 0.0;
}

/* Damage of a body at rest, of one that is pulled, and of one that is broken. */
bool vet_try_damage(const void *table, const void *self)
{
    const struct bulla_damage *law = table;
    enum { N = 3 };
    const double damage[N] = {0.0, 0.1, 1.0}, stress[N] = {-1e5, 1e9, 0.0}, stretch[N] = {1.0, 2.0, 1.0};
    const double rows[N] = {0.0, 1e6, 0.0}, strain[N] = {0.0, 1.0, 2.0}, T[N] = {300.0, 600.0, 300.0};
    const struct bulla_damage_state state = {sizeof state, damage, stress, stress, stretch,
                                             rows,         rows,   strain, rows,   T};
    double aim[N] = {(double)NAN, (double)NAN, (double)NAN}, rate[N] = {(double)NAN, (double)NAN, (double)NAN};
    bool good = true;
    if (law->needs(self) & ~(uint32_t)BULLA_DAMAGE_ALL) return false;
    law->grow(self, N, &state, aim, rate);
    for (int i = 0; i < N; i++) good &= aim[i] >= 0.0 && aim[i] <= 1.0 && rate[i] >= 0.0;
    return good;
}

/* A liquid that is sheared at 300 K: what comes out may stand in a flux, and what bounds it in a time step. */
bool vet_try_coefficient(const void *table, const void *self)
{
    const struct bulla_coefficient *law = table;
    const double rate = 100.0, T = 300.0, p = 1e5, rho = 1000.0;
    double value = (double)NAN;
    law->value(self, 1, law->needs & BULLA_NEEDS_RATE ? &rate : NULL, law->needs & BULLA_NEEDS_TEMPERATURE ? &T : NULL,
               law->needs & BULLA_NEEDS_PRESSURE ? &p : NULL, law->needs & BULLA_NEEDS_DENSITY ? &rho : NULL, &value);
    bool bounded = !(law->needs & BULLA_NEEDS_RATE) || (isfinite(law->most(self)) && law->most(self) >= value);
    return isfinite(value) && value >= 0.0 && bounded;
}

/* Air at rest before a wall, and rushing at it. */
bool vet_try_boundary(const void *table, const void *self)
{
    enum { N = 2 };
    const struct bulla_boundary *law = table;
    const double zero[N] = {0}, one[N] = {1.0, 1.0}, gas[N] = {1.2, 1.2}, speed[N] = {0.0, 10.0}, p[N] = {1e5, 1.1e5};
    const double Z[N] = {410.0, 430.0}, p_start[N] = {1e5, 1e5};
    double alpha[N] = {1.0, 1.0}, rho[N] = {1.2, 1.2}, u[N] = {0.0, 10.0}, behind[N] = {1e5, 1.1e5}, sum = 0.0;
    bool refers = law->traits & BULLA_BEHIND_REFERS;
    law->fill(self, &(struct bulla_behind){.size = sizeof(struct bulla_behind),
                                           .n_material = 1,
                                           .n_velocity = 1,
                                           .side = 1,
                                           .n = N,
                                           .depth = 1e-3,
                                           .x = {one, zero, zero},
                                           .alpha = (const double *[]){one},
                                           .rho = (const double *[]){gas},
                                           .u = (const double *[]){speed},
                                           .p = p,
                                           .Z = Z,
                                           .p_start = refers ? p_start : NULL,
                                           .u_start = refers ? zero : NULL,
                                           .alpha_behind = (double *[]){alpha},
                                           .rho_behind = (double *[]){rho},
                                           .u_behind = (double *[]){u},
                                           .p_behind = behind});
    for (int i = 0; i < N; i++) sum += alpha[i] + rho[i] + u[i] + behind[i];
    return isfinite(sum);
}

/* Air that streams and is sheared. */
bool vet_try_field(const void *table, const void *self)
{
    const struct bulla_field *law = table;
    const double zero = 0.0, one = 1.0, rho = 1.2, u = 10.0, p = 1e5, c = 341.6, T = 290.0, E = 2.5e5;
    const bool flows = law->needs & BULLA_FIELD_VELOCITY_SLOPES, pushes = law->needs & BULLA_FIELD_PRESSURE_SLOPES;
    double values[BULLA_FIELD_OUTPUTS], *rows[BULLA_FIELD_OUTPUTS], sum = 0.0;
    struct bulla_points cell = {.size = sizeof cell,
                                .n_material = 1,
                                .n_velocity = 1,
                                .dim = 1,
                                .n = 1,
                                .h = {1e-3, 0.0, 0.0},
                                .x = {&one, &zero, &zero},
                                .volume = &one,
                                .alpha = (const double *[]){&one},
                                .rho = (const double *[]){&rho},
                                .u = (const double *[]){&u},
                                .p = &p,
                                .c = law->needs & BULLA_FIELD_SOUND ? &c : NULL,
                                .T = law->needs & BULLA_FIELD_TEMPERATURES ? (const double *[]){&T} : NULL,
                                .rho_E = law->needs & BULLA_FIELD_ENERGY ? &E : NULL};
    for (int i = 0; i < 9 && flows; i++) cell.du[i / 3][i % 3] = i ? &zero : &one;
    for (int d = 0; d < 3 && pushes; d++) cell.dp[d] = d ? &zero : &one;
    for (int d = 0; d < 3 && law->needs & BULLA_FIELD_DENSITY_SLOPES; d++) cell.drho[d] = d ? &zero : &one;
    for (int k = 0; k < BULLA_FIELD_OUTPUTS; k++) values[k] = 0.0, rows[k] = &values[k];
    law->compute(self, &cell, rows);
    for (int k = 0; k < BULLA_FIELD_OUTPUTS; k++) sum += values[k];
    return isfinite(sum);
}
