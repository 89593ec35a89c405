/* the_name_test.c - values that are known: a piston at 2 m/s that has come to half of that. Put yours here;
 * `bulla module check` tests the rest. */
#include <bulla/boundary.h>

#include <math.h>
#include <stdio.h>

static const double values_of_test[] = {2.0, 1e-3}; /* in the order of the parameter table */

static int failures;

static void near(const char *what, double got, double want, double relative)
{
    if (fabs(got - want) <= relative * fabs(want)) return;
    printf("%s: %.9g instead of %.9g\n", what, got, want);
    failures++;
}

static void say(const char *text)
{
    puts(text);
}

int main(void)
{
    const struct bulla_host host = {.size = sizeof host, .say = say, .fail = say};
    const struct bulla_boundary *law = bulla_module.table;
    struct bulla_value values[sizeof values_of_test / sizeof *values_of_test] = {{0}};
    for (size_t i = 0; i < sizeof values_of_test / sizeof *values_of_test; i++) values[i].number = values_of_test[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    /* Two faces: gas at rest, and one that comes at 0.3 m/s. What is behind holds what is inside. */
    const double place[] = {0.0, 0.0}, alpha[] = {1.0, 1.0}, rho[] = {1.2, 1.3}, u[] = {0.0, 0.3}, p[] = {1e5, 2e5};
    double alpha_behind[] = {1.0, 1.0}, rho_behind[] = {1.2, 1.3}, u_behind[] = {0.0, 0.3}, p_behind[] = {1e5, 2e5};
    const double Z[] = {410.0, 603.0}, *alphas[] = {alpha}, *rhos[] = {rho}, *us[] = {u};
    double *alphas_behind[] = {alpha_behind}, *rhos_behind[] = {rho_behind}, *us_behind[] = {u_behind};
    const struct bulla_behind faces = {.size = sizeof faces,
                                       .n_material = 1,
                                       .n_velocity = 1,
                                       .n = 2,
                                       .t = 0.5e-3,
                                       .depth = 1e-3,
                                       .x = {place, place, place},
                                       .alpha = alphas,
                                       .rho = rhos,
                                       .u = us,
                                       .p = p,
                                       .Z = Z,
                                       .alpha_behind = alphas_behind,
                                       .rho_behind = rhos_behind,
                                       .u_behind = us_behind,
                                       .p_behind = p_behind};
    law->fill(self, &faces);
    near("velocity behind rest", u_behind[0], -2.0, 1e-12);
    near("velocity behind a stream", u_behind[1], -2.3, 1e-12);
    near("pressure", p_behind[1], 2e5, 1e-12);
    near("density", rho_behind[1], 1.3, 1e-12);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
