/* the_name_test.c - values that are known: water at 1000 kg/m3 and 1 bar with the defaults. Put yours here, from the
 * paper that the law comes from; `bulla module check` tests the rest. */
#include <bulla/eos.h>

#include <math.h>
#include <stdio.h>

static const double defaults[] = {4.4, 6e8, 590.0}; /* in the order of the parameter table */

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
    const struct bulla_eos *eos = bulla_module.table;
    struct bulla_value values[sizeof defaults / sizeof *defaults] = {{0}};
    for (size_t i = 0; i < sizeof defaults / sizeof *defaults; i++) values[i].number = defaults[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    double rho = 1000.0, p = 1e5, rho_e, rho_c2, T;
    eos->state(self, 1, &rho, &p, &rho_e, &rho_c2);
    eos->temperature(self, 1, &rho, &p, &T);
    near("sound speed", sqrt(rho_c2 / rho), 1624.9431, 1e-6);
    near("energy per volume", rho_e, 776500000.0, 1e-9);
    near("temperature", T, 299.15254, 1e-6);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
