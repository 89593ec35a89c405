/* the_name_test.c - values that are known: the strength at no strain, at eps0 and far out, with the defaults. Put yours
 * here, from the paper that the law comes from; `bulla module check` tests the rest. */
#include <bulla/inelastic.h>

#include <math.h>
#include <stdio.h>

static const double defaults[] = {100e6, 200e6, 0.1}; /* in the order of the parameter table */

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
    const struct bulla_inelastic *law = bulla_module.table;
    struct bulla_value values[sizeof defaults / sizeof *defaults] = {{0}};
    for (size_t i = 0; i < sizeof defaults / sizeof *defaults; i++) values[i].number = defaults[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    const double eps[] = {0.0, 0.1, 10.0}, none[3] = {0};
    double Y[3];
    law->strength(self, 3, eps, none, none, none, none, Y);
    near("strength of the unstrained solid", Y[0], 100e6, 1e-15);
    near("strength at eps0", Y[1], 163.212055883e6, 1e-11);
    near("saturation", Y[2], 200e6, 1e-15);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
