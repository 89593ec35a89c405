/* the_name_test.c - values that are known: a body of 100 kPa stretched to twice its length, with the defaults. Put
 * yours here, from the paper that the law comes from; `bulla module check` tests the rest. */
#include <bulla/constitutive.h>

#include <math.h>
#include <stdio.h>

static const double defaults[] = {1e5, 1000.0, 0.1}; /* in the order of the parameter table */

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
    const struct bulla_constitutive *law = bulla_module.table;
    struct bulla_value values[sizeof defaults / sizeof *defaults] = {{0}};
    for (size_t i = 0; i < sizeof defaults / sizeof *defaults; i++) values[i].number = defaults[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    /* Principal stretches 2, 1/sqrt(2), 1/sqrt(2): I1 = 4 + 1/2 + 1/2, I2 = 1/4 + 2 + 2. */
    double I1 = 5.0, I2 = 4.25, e, e_1, e_2;
    law->energy(self, 1, &I1, &I2, &e, &e_1, &e_2);
    near("energy", e, 140.0, 1e-12);
    /* The stress that pulls, per initial area: 2 rho0 (l - 1/l^2) (e_1 + e_2/l). */
    near("pull", 2.0 * 1000.0 * (2.0 - 0.25) * (e_1 + e_2 / 2.0), 385000.0, 1e-12);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
