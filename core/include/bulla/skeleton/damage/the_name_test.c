/* the_name_test.c - values that are known: below the stretch and beyond it, with the defaults. Put yours here, from the
 * paper that the criterion comes from; `bulla module check` tests the rest. */
#include <bulla/damage.h>

#include <math.h>
#include <stdio.h>

static const double defaults[] = {1.2, 5e-6}; /* in the order of the parameter table */

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
    const struct bulla_damage *law = bulla_module.table;
    struct bulla_value values[sizeof defaults / sizeof *defaults] = {{0}};
    for (size_t i = 0; i < sizeof defaults / sizeof *defaults; i++) values[i].number = defaults[i];
    void *self;
    if (bulla_module.open(&host, values, &self) != 0) return 1;

    const double stretch[] = {1.0, 1.19, 1.3}, none[3] = {0};
    const struct bulla_damage_state state = {sizeof state, none, none, none, stretch, none, none, none, none, none};
    double aim[3], rate[3];
    law->grow(self, 3, &state, aim, rate);
    near("aim at rest", aim[0], 0.0, 0.0);
    near("aim below the stretch", aim[1], 0.0, 0.0);
    near("aim beyond it", aim[2], 1.0, 0.0);
    near("rate", rate[2], 2e5, 1e-14);

    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
