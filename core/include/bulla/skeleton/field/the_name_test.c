/* the_name_test.c - values that are known: water that streams at 10 m/s and is stretched. Put yours here;
 * `bulla module check` tests the rest. */
#include <bulla/field.h>

#include <math.h>
#include <stdio.h>

static const double values_of_test[] = {1e5}; /* in the order of the parameter table */

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
    const struct bulla_field *law = bulla_module.table;
    struct bulla_value values[sizeof values_of_test / sizeof *values_of_test] = {{0}};
    for (size_t i = 0; i < sizeof values_of_test / sizeof *values_of_test; i++) values[i].number = values_of_test[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    /* One cell of an axisymmetric scene, at r = 2 mm. */
    const double r = 2e-3, zero = 0.0, alpha = 1.0, rho = 1000.0, u_r = 6.0, u_z = 8.0, p = 2e5, volume = 1e-9;
    const double *alphas[] = {&alpha}, *rhos[] = {&rho}, *us[] = {&u_r, &u_z};
    const double out = 50.0, along = -20.0;
    double head, dilatation, *rows[] = {&head, &dilatation};
    struct bulla_points cell = {.size = sizeof cell,
                                .n_material = 1,
                                .n_velocity = 2,
                                .dim = 2,
                                .beta = 1,
                                .n = 1,
                                .x = {&r, &zero, &zero},
                                .volume = &volume,
                                .alpha = alphas,
                                .rho = rhos,
                                .u = us,
                                .p = &p};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) cell.du[i][j] = &zero;
    cell.du[0][0] = &out;
    cell.du[1][1] = &along;
    law->compute(self, &cell, rows);
    near("head", head, 1e5 + 0.5 * 1000.0 * 100.0, 1e-12);
    near("dilatation", dilatation, 50.0 - 20.0 + 6.0 / 2e-3, 1e-12);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
