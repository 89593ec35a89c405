/* the_name_test.c - values that are known, with steepness 1.5. Put yours here, from the paper that the limiter comes
 * from; `bulla module check` tests the rest. */
#include <bulla/limiter.h>

#include <math.h>
#include <stdio.h>

static int failures;

static void say(const char *text)
{
    puts(text);
}

int main(void)
{
    static const double known[][3] = {{1.0, 3.0, 1.5}, {1.0, 1.2, 1.1}, {-2.0, -2.0, -2.0}, {1.0, -1.0, 0.0}};
    const struct bulla_host host = {.size = sizeof host, .say = say, .fail = say};
    const struct bulla_limiter *limiter = bulla_module.table;
    struct bulla_value value = {.number = 1.5};
    void *self;
    if (bulla_module.open(&host, &value, &self) != 0) return 1;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        double slope;
        limiter->slope(self, 1, &known[i][0], &known[i][1], &slope);
        if (fabs(slope - known[i][2]) <= 1e-15) continue;
        printf("slope(%g, %g): %.17g instead of %g\n", known[i][0], known[i][1], slope, known[i][2]);
        failures++;
    }
    bulla_module.close(self);
    puts(failures ? "the-name: FAIL" : "the-name: pass");
    return failures != 0;
}
