/* the_name_test.c - values that are known: 0.6 W/m/K at 298.15 K, 2 % more at 308.15 K. Put yours here, from the paper
 * that the law comes from; `bulla module check` tests the rest. */
#include <bulla/conductivity.h>

#include <math.h>
#include <stdio.h>

static const double values_of_test[] = {0.6, 0.002, 298.15}; /* in the order of the parameter table */

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
    const struct bulla_conductivity *law = bulla_module.table;
    struct bulla_value values[sizeof values_of_test / sizeof *values_of_test] = {{0}};
    for (size_t i = 0; i < sizeof values_of_test / sizeof *values_of_test; i++) values[i].number = values_of_test[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    const double T[] = {298.15, 308.15, 1000.0};
    double k[3];
    law->k.value(self, 3, NULL, T, NULL, NULL, k);
    near("conductivity at T0", k[0], 0.6, 1e-12);
    near("conductivity when warmer", k[1], 0.612, 1e-12);
    near("conductivity beyond the fit", k[2], 0.66, 1e-12);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
