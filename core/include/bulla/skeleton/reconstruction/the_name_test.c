/* the_name_test.c - values that are known, with `most` = 1. Put yours here, from the paper that the scheme comes from;
 * `bulla module check` tests the rest. */
#include <bulla/reconstruction.h>

#include <math.h>
#include <stdio.h>

static int failures;

static void say(const char *text)
{
    puts(text);
}

int main(void)
{
    /* three cells, the lower and the upper edge of the middle one */
    static const double known[][5] = {{0.0, 1.0, 2.0, 0.5, 1.5},
                                      {0.0, 3.0, 9.0, 1.0, 5.5},
                                      {0.0, 1.0, 9.0, 0.0, 2.0},
                                      {1.0, 2.0, 1.0, 2.0, 2.0}};
    const struct bulla_host host = {.size = sizeof host, .say = say, .fail = say};
    const struct bulla_reconstruction *scheme = bulla_module.table;
    struct bulla_value value = {.number = 1.0};
    void *self;
    if (bulla_module.open(&host, &value, &self) != 0) return 1;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        double lower, upper;
        scheme->edges(self, NULL, 1, 1, &known[i][1], &lower, &upper);
        if (fabs(lower - known[i][3]) <= 1e-15 && fabs(upper - known[i][4]) <= 1e-15) continue;
        printf("cells %g %g %g: edges %.17g, %.17g instead of %g, %g\n", known[i][0], known[i][1], known[i][2], lower,
               upper, known[i][3], known[i][4]);
        failures++;
    }
    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
