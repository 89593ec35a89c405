/* the_name_test.c - values that are known: 10 mPa s at 298.15 K, half of it at a rate of 1000 1/s. Put yours here, from
 * the paper that the law comes from; `bulla module check` tests the rest. */
#include <bulla/viscosity.h>

#include <math.h>
#include <stdio.h>

static const double values_of_test[] = {0.01, 0.02, 298.15, 1e3, 0.03}; /* in the order of the parameter table */

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
    const struct bulla_viscosity *law = bulla_module.table;
    struct bulla_value values[sizeof values_of_test / sizeof *values_of_test] = {{0}};
    for (size_t i = 0; i < sizeof values_of_test / sizeof *values_of_test; i++) values[i].number = values_of_test[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    const double rate[] = {0.0, 1e3, 1e3}, T[] = {298.15, 298.15, 308.15};
    double mu[3], zeta[3];
    law->mu.value(self, 3, rate, T, NULL, NULL, mu);
    law->zeta(self, 3, T, NULL, NULL, zeta);
    near("viscosity at rest", mu[0], 0.01, 1e-12);
    near("viscosity in shear", mu[1], 0.005, 1e-12);
    near("viscosity when warm", mu[2], 0.005 * 0.818730753077982, 1e-12);
    near("bulk viscosity", zeta[0], 0.03, 1e-12);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
