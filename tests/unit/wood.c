/* Speeds of mixtures that expand (scheme/wood.h): Wood's law where cells move apart, the frozen speed elsewhere and in
 * pure fluids, to the bit; mirror images. */
#include "flow.h"

#include "scheme/wood.h"

enum { FACES = 64, STEP = 3 };

static uint64_t seed = 11;

/* Edges of faces between cells of water and air. */
struct edges_of {
    double alpha[2][2 * FACES], rho_c2[2][2 * FACES], rho[2 * FACES], c[2 * FACES], give[2 * FACES], u[FACES + STEP];
};

static void fill(struct edges_of *row)
{
    for (int i = 0; i < 2 * FACES; i++) {
        double alpha = i % 4 == 0 ? 0.0 : i % 4 == 1 ? 1.0 : flow_random(&seed);
        row->alpha[0][i] = 1.0 - alpha;
        row->alpha[1][i] = alpha;
        row->rho_c2[0][i] = 2.6e9 * (1.0 + flow_random(&seed));
        row->rho_c2[1][i] = 1.4e5;
        row->rho[i] = 1000.0 * (1.0 - alpha) + alpha;
        row->c[i] = sqrt((row->rho_c2[0][i] * (1.0 - alpha) + 1.4e5 * alpha) / row->rho[i]);
    }
    for (int i = 0; i < FACES + STEP; i++) row->u[i] = flow_random(&seed) - 0.5;
    for (unsigned l = 0; l < 2; l++) wood_give(2 * FACES, l, row->alpha[l], row->rho_c2[l], row->give);
}

static void test_speed(void **state)
{
    (void)state;
    struct edges_of row;
    double frozen[2 * FACES];
    int slow = 0;
    fill(&row);
    memcpy(frozen, row.c, sizeof frozen);
    wood_slow(&(struct wood){FACES, FACES, STEP, row.u, row.rho, row.give}, row.c);
    for (int i = 0; i < 2 * FACES; i++) {
        int face = i % FACES;
        double alpha = row.alpha[1][i];
        double wood = sqrt(1.0 / (row.rho[i] * ((1.0 - alpha) / row.rho_c2[0][i] + alpha / 1.4e5)));
        if (row.u[face + STEP] > row.u[face] && wood < 0.9 * frozen[i]) {
            assert_true(fabs(row.c[i] / wood - 1.0) < 1e-14);
            slow++;
        } else assert_true(row.c[i] == frozen[i]);
        if (i % 4 < 2) assert_true(row.c[i] == frozen[i]);
    }
    assert_true(slow > FACES / 4);
}

/* The faces in reverse order, left and right exchanged, velocities turned round. */
static void test_mirror(void **state)
{
    (void)state;
    struct edges_of row, back;
    fill(&row);
    for (int i = 0; i < 2 * FACES; i++) {
        back.rho[i] = row.rho[2 * FACES - 1 - i];
        back.c[i] = row.c[2 * FACES - 1 - i];
        back.give[i] = row.give[2 * FACES - 1 - i];
    }
    for (int i = 0; i < FACES + STEP; i++) back.u[i] = -row.u[FACES + STEP - 1 - i];
    wood_slow(&(struct wood){FACES, FACES, STEP, row.u, row.rho, row.give}, row.c);
    wood_slow(&(struct wood){FACES, FACES, STEP, back.u, back.rho, back.give}, back.c);
    for (int i = 0; i < 2 * FACES; i++) assert_true(back.c[i] == row.c[2 * FACES - 1 - i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_speed),
        cmocka_unit_test(test_mirror),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
