/* the_name_test.c - values that are known: one gas, equal sides, whose flux is rho u, rho u^2 + p, u (rho E + p). Put
 * yours here, from the paper that the solver comes from; `bulla module check` tests the rest. */
#include <bulla/riemann.h>

#include <math.h>
#include <stdio.h>

static int failures;

static void near(const char *what, double got, double want)
{
    if (fabs(got - want) <= 1e-14 * fabs(want)) return;
    printf("%s: %.17g instead of %.17g\n", what, got, want);
    failures++;
}

int main(void)
{
    const double rho = 1.2, p = 1e5, rho_E = 2.5e5 + 0.5 * 1.2 * 100.0, c = 341.6, normal = 10.0;
    const double *u[] = {&normal}, *m[] = {&rho};
    double mass, momentum, energy, u_star, work[4];
    double *out_m[] = {&mass}, *out_momentum[] = {&momentum};
    const struct bulla_side side = {.rho = &rho, .p = &p, .rho_E = &rho_E, .c = &c, .u = u, .m = m};
    const struct bulla_faces faces = {
        .n = 1,
        .n_material = 1,
        .n_velocity = 1,
        .left = side,
        .right = side,
        .flux = {.m = out_m, .momentum = out_momentum, .rho_E = &energy, .u = &u_star},
        .work = {&work[0], &work[1], &work[2], &work[3]},
    };
    const struct bulla_riemann *riemann = bulla_module.table;
    riemann->solve(NULL, &faces);
    near("u*", u_star, 10.0);
    near("mass", mass, 12.0);
    near("momentum", momentum, 100120.0);
    near("energy", energy, 10.0 * (rho_E + p));
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
