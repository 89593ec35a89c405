/* phase.c - liquids and vapours in the cells of a tile (phys/phase.h): what is kept and what is not touched, that a
 * second call changes no bit, entropy, rates against the reference (finite_rate.csv), thresholds and directions; and
 * runs in closed boxes. */
#include "phase_box.h"

enum { CELLS = 256 };

/* What one call leaves alone: masses of others, momentum, energy; the sum of liquid and vapour. */
static void check_kept(const struct model *model, const double *before, const double *u, size_t i)
{
    for (unsigned q = model->i_m; q < model->n_field; q++)
        if (q > model->i_m + 1) assert_true(u[q * CELLS + i] == before[q * CELLS + i]);
    double all = u[model->i_m * CELLS + i] + u[(model->i_m + 1) * CELLS + i],
           held = before[model->i_m * CELLS + i] + before[(model->i_m + 1) * CELLS + i];
    assert_true(fabs(all / held - 1.0) <= 4.5e-16);
    assert_true(u[model->i_m * CELLS + i] >= 0.0 && u[(model->i_m + 1) * CELLS + i] >= 0.0);
}

struct checked {
    double p; /* worst difference between the pressure of the equilibrium and that of the closure */
    int moved;
};

/* One call on cells anywhere, and a second one. */
static void check_call(struct flow *flow, struct checked *checked)
{
    const struct model *model = flow->state->model;
    size_t size = model->n_field * CELLS * sizeof(double);
    double *u = flow_level(flow)->u_old[0], *w = flow_level(flow)->w[0];
    double *before = mem_new(3 * model->n_field * CELLS, sizeof *before), *after = before + model->n_field * CELLS,
           *w_before = after + model->n_field * CELLS;
    struct equilibrium_effort effort = {0};
    memcpy(before, u, size);
    memcpy(w_before, w, size);
    phase_act(model, 0, CELLS, CELLS, 1e-6, 0.0, NULL, w, u, &effort);
    double *p = mem_new(CELLS, sizeof *p);
    memcpy(p, w + model->i_E * CELLS, CELLS * sizeof *p);
    mix_primitives(model, CELLS, CELLS, u, w);
    for (size_t i = 0; i < CELLS; i++) {
        bool moved = u[model->i_m * CELLS + i] != before[model->i_m * CELLS + i];
        checked->moved += moved;
        check_kept(model, before, u, i);
        if (!moved) continue;
        double off = fabs(w[model->i_E * CELLS + i] - p[i]) / (fabs(p[i]) + 1e4);
        checked->p = off > checked->p ? off : checked->p;
        double gain =
            phase_box_entropy(model, CELLS, u + i, w + i) - phase_box_entropy(model, CELLS, before + i, w_before + i);
        assert_true(gain >= -1e-12 * fabs(phase_box_entropy(model, CELLS, u + i, w + i)));
    }
    memcpy(after, u, size);
    phase_act(model, 0, CELLS, CELLS, 1e-6, 0.0, NULL, w, u, &effort);
    for (size_t i = 0; i < CELLS; i++)
        for (unsigned q = 0; q < model->n_field; q++)
            if (after[q * CELLS + i] != u[q * CELLS + i])
                fail_msg("cell %zu, field %u: %.17g becomes %.17g; p %.17g, m_v %.17g, alpha %g %g %g", i, q,
                         after[q * CELLS + i], u[q * CELLS + i], w[model->i_E * CELLS + i],
                         after[(model->i_m + 1) * CELLS + i], after[i], after[CELLS + i], after[2 * CELLS + i]);
    assert_int_equal(effort.refused, 0);
    mem_free(p);
    mem_free(before);
}

static void test_call(void **state)
{
    (void)state;
    static const struct {
        const char *materials, *phase;
    } cases[] = {
        {PHASE_BOX_NASG, "{liquid: water, vapour: steam}"},
        {PHASE_BOX_SG PHASE_BOX_AIR, "{liquid: water, vapour: steam, gases: [air]}"},
        {PHASE_BOX_NASG PHASE_BOX_AIR PHASE_BOX_STONE, "{liquid: water, vapour: steam, gases: [air]}"},
        {PHASE_BOX_NASG PHASE_BOX_AIR, "{liquid: water, vapour: steam, gases: [air], mixing: none}"},
        {PHASE_BOX_NASG PHASE_BOX_AIR, "{liquid: water, vapour: steam, gases: [air], where: everywhere}"},
        {PHASE_BOX_NASG, "{liquid: water, vapour: steam, nucleus: 1e-3}"},
        {PHASE_BOX_NASG PHASE_BOX_AIR, "{liquid: water, vapour: steam, gases: [air], direction: evaporation}"},
        {PHASE_BOX_NASG PHASE_BOX_AIR, "{liquid: water, vapour: steam, gases: [air], direction: condensation}"},
        {PHASE_BOX_NASG PHASE_BOX_AIR PHASE_BOX_STONE,
         "{liquid: water, vapour: steam, gases: [air], gas-temperature: own}"},
        {PHASE_BOX_NASG PHASE_BOX_GEL, "{liquid: water, vapour: steam}"},
        {PHASE_BOX_NASG PHASE_BOX_AIR PHASE_BOX_GEL, "{liquid: water, vapour: steam, gases: [air], where: everywhere}"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct flow flow;
        struct checked checked = {0};
        phase_box_seed = 17;
        phase_box_open(&flow, cases[i].materials, cases[i].phase, CELLS,
                       strstr(cases[i].materials, "gel") ? "traction: common" : "");
        flow_set(&flow, phase_box_scatter);
        check_call(&flow, &checked);
        print_message("%s: %d of %d changed, p off by %.2g\n", cases[i].phase, checked.moved, CELLS, checked.p);
        assert_true(checked.moved > CELLS / 8 && checked.p < 1e-9);
        flow_stop(&flow);
    }
}

/* The direction is kept. */
static void test_direction(void **state)
{
    (void)state;
    static const char *const ways[] = {"evaporation", "condensation"};
    for (int way = 0; way < 2; way++) {
        struct flow flow;
        char phase[128];
        snprintf(phase, sizeof phase, "{liquid: water, vapour: steam, direction: %s}", ways[way]);
        phase_box_open(&flow, PHASE_BOX_NASG, phase, CELLS, "");
        phase_box_seed = 23;
        flow_set(&flow, phase_box_scatter);
        const struct model *model = flow.state->model;
        double *u = flow_level(&flow)->u_old[0], before[CELLS];
        memcpy(before, u + (model->i_m + 1) * CELLS, sizeof before);
        phase_act(model, 0, CELLS, CELLS, 1e-6, 0.0, NULL, flow_level(&flow)->w[0], u, &(struct equilibrium_effort){0});
        for (size_t i = 0; i < CELLS; i++) {
            double change = u[(model->i_m + 1) * CELLS + i] - before[i];
            assert_true(way ? change <= 0.0 : change >= 0.0);
        }
        flow_stop(&flow);
    }
}

/* Rows of one case of finite_rate.csv. */
struct series {
    char pair[32];
    double s, A, m_l, m_v, m_a, energy, t, m_end;
};

static struct series read_series(const char *name)
{
    struct series last = {.t = -1.0};
    char line[512];
    FILE *file = fopen("tests/data/phase/finite_rate.csv", "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        struct series row;
        if (line[0] != name[0] || line[1] != ',') continue;
        assert_int_equal(sscanf(line + 2, "%31[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", row.pair, &row.s, &row.A, &row.m_l,
                                &row.m_v, &row.m_a, &row.energy, &row.t, &row.m_end),
                         9);
        if (row.t <= 5e-1 * last.t) break;
        last = row;
    }
    fclose(file);
    return last;
}

/* m_v after n steps to the time `t`, from the cell of a series. */
static double relax(const struct series *series, double t, int n)
{
    struct flow flow;
    char phase[256];
    snprintf(phase, sizeof phase,
             "{liquid: water, vapour: steam%s, rate: {type: hertz-knudsen, accommodation: %.17g, area: %.17g}}",
             series->m_a > 0.0 ? ", gases: [air]" : "", series->s, series->A);
    phase_box_open(&flow,
                   strncmp(series->pair, "nasg", 4) == 0
                       ? series->m_a > 0.0 ? PHASE_BOX_NASG PHASE_BOX_AIR : PHASE_BOX_NASG
                   : series->m_a > 0.0 ? PHASE_BOX_SG PHASE_BOX_AIR
                                       : PHASE_BOX_SG,
                   phase, 8, "");
    const struct model *model = flow.state->model;
    double u[FLOW_FIELDS] = {0}, w[FLOW_FIELDS] = {0};
    struct equilibrium_family family = {.n = series->m_a > 0.0 ? 3 : 2};
    struct equilibrium_cells cells = {.n = 1,
                                      .m = {{series->m_l}, {series->m_v}, {series->m_a}},
                                      .energy = {series->energy},
                                      .p = {1e5},
                                      .T = {400.0}};
    for (unsigned k = 0; k < family.n; k++) family.eos[k] = model->eos[k];
    equilibrium_solve(&family, &cells, &(struct equilibrium_effort){0});
    for (unsigned k = 0; k < family.n; k++) {
        u[model->i_alpha + k] = cells.m[k][0] * cells.v[k][0];
        u[model->i_m + k] = cells.m[k][0];
    }
    u[model->i_E] = series->energy;
    w[model->i_E] = cells.p[0];
    for (int i = 0; i < n; i++) phase_act(model, 0, 1, 1, t / n, 0.0, NULL, w, u, &(struct equilibrium_effort){0});
    double vapour = u[model->i_m + 1];
    flow_stop(&flow);
    return vapour;
}

/* First order in dt, against the reference at a time on the way; equilibrium at its end, whatever the steps. */
static void test_rate(void **state)
{
    (void)state;
    for (const char *name = "abcd"; *name; name++) {
        struct series series = read_series(name), early = series;
        double end = relax(&series, 1e3 * series.t, 3), coarse, fine;
        char line[512];
        FILE *file = fopen("tests/data/phase/finite_rate.csv", "r");
        while (fgets(line, sizeof line, file)) /* the row nearest to halfway in mass */
            if (line[0] == *name && line[1] == ',') {
                struct series row;
                sscanf(line + 2, "%31[^,],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", row.pair, &row.s, &row.A, &row.m_l,
                       &row.m_v, &row.m_a, &row.energy, &row.t, &row.m_end);
                if (fabs(row.m_end - row.m_v) < 0.5 * fabs(end - row.m_v)) early = row;
            }
        fclose(file);
        coarse = relax(&early, early.t, 50) / early.m_end - 1.0;
        fine = relax(&early, early.t, 100) / early.m_end - 1.0;
        print_message("%s %c: end %.2g, halfway %.3g and %.3g\n", series.pair, *name, end / series.m_end - 1.0, coarse,
                      fine);
        assert_true(fabs(end / series.m_end - 1.0) < 1e-6);
        assert_true(fabs(fine) < 0.02 && fabs(coarse / fine - 2.0) < 0.2);
    }
}

/* Mass of vapour that one call makes of a cell of size h, at the shore or not. */
static double vapour_in(const char *phase, double T, double p, double alpha, const unsigned char *shore, double h)
{
    struct flow flow;
    phase_box_open(&flow, PHASE_BOX_NASG, phase, 8, "");
    const struct model *model = flow.state->model;
    double u[FLOW_FIELDS] = {0}, w[FLOW_FIELDS] = {0};
    for (unsigned l = 0; l < 2; l++) {
        w[model->i_alpha + l] = l ? alpha : 1.0 - alpha;
        model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
        if (l && !(p > 0.0)) w[model->i_m + l] = 1.0;
    }
    w[model->i_E] = p;
    mix_conserved(model, 1, 1, w, u);
    double before = u[model->i_m + 1];
    phase_act(model, 0, 1, 1, 1e-6, h, shore, w, u, &(struct equilibrium_effort){0});
    double after = u[model->i_m + 1];
    flow_stop(&flow);
    return after - before;
}

static double vapour_made(const char *phase, double T, double p, double alpha, const unsigned char *shore)
{
    return vapour_in(phase, T, p, alpha, shore, 0.0);
}

static double vapour_after(const char *phase, double T, double p, double alpha)
{
    return vapour_made(phase, T, p, alpha, NULL);
}

/* Liquid waits for its `onset` but at the shore, where it evaporates as without one. What is stretched and what
 * condenses does not wait. */
static void test_onset(void **state)
{
    (void)state;
    static const char onset[] = "{liquid: water, vapour: steam, onset: 0.9}", free[] = "{liquid: water, vapour: steam}";
    static const unsigned char shore = 1, sea = 0;
    static const double alpha[] = {0.1, 0.49, 0.51, 0.89}; /* before the front, behind it */
    for (int i = 0; i < 4; i++) {
        double all = vapour_after(free, 376.0, 1e5, alpha[i]);
        assert_true(all > 0.0 && vapour_made(onset, 376.0, 1e5, alpha[i], &shore) == all);
        assert_true(vapour_made(onset, 376.0, 1e5, alpha[i], &sea) == 0.0);
        assert_true(vapour_after(onset, 376.0, 1e5, alpha[i]) == 0.0);
    }
    assert_true(vapour_made(onset, 376.0, 1e5, 0.91, &sea) == vapour_after(free, 376.0, 1e5, 0.91));
    assert_true(vapour_after(onset, 360.0, 1e5, 0.1) < 0.0);
    assert_true(vapour_after(onset, 320.0, 2000.0, 0.1) == 0.0); /* saturation: 10.5 kPa */
    assert_true(vapour_after(onset, 320.0, 500.0, 0.1) > 0.0);
}

/* Liquid that waits shares a temperature with what vapour there is, before the front and behind it. */
static void test_onset_heat(void **state)
{
    (void)state;
    for (int behind = 0; behind < 2; behind++) {
        struct flow flow;
        phase_box_open(&flow, PHASE_BOX_NASG, "{liquid: water, vapour: steam, onset: 0.9}", 8, "");
        const struct model *model = flow.state->model;
        const double part[] = {behind ? 0.3 : 0.7, behind ? 0.7 : 0.3}, T[] = {376.0, 420.0};
        double u[FLOW_FIELDS] = {0}, w[FLOW_FIELDS] = {0}, p = 1e5, now[2];
        for (unsigned l = 0; l < 2; l++) {
            w[model->i_alpha + l] = part[l];
            model->eos[l].law->density(model->eos[l].self, 1, &p, &T[l], &w[model->i_m + l]);
        }
        w[model->i_E] = p;
        mix_conserved(model, 1, 1, w, u);
        double vapour = u[model->i_m + 1];
        phase_act(model, 0, 1, 1, 1e-6, 0.0, NULL, w, u, &(struct equilibrium_effort){0});
        mix_primitives(model, 1, 1, u, w);
        for (unsigned l = 0; l < 2; l++)
            model->eos[l].law->temperature(model->eos[l].self, 1, &w[model->i_m + l], &w[model->i_E], &now[l]);
        assert_true(u[model->i_m + 1] == vapour);
        assert_true(fabs(now[1] - now[0]) < 1e-6);
        flow_stop(&flow);
    }
}

/* Wood's speed in water with bubbles of its vapour. */
static double wood(double T, double p, double alpha)
{
    struct flow flow;
    phase_box_open(&flow, PHASE_BOX_NASG, "{liquid: water, vapour: steam}", 8, "");
    double rho_all = 0.0, give = 0.0;
    for (unsigned l = 0; l < 2; l++) {
        const struct model_eos *eos = &flow.state->model->eos[l];
        double part = l ? alpha : 1.0 - alpha, rho, rho_e, rho_c2;
        eos->law->density(eos->self, 1, &p, &T, &rho);
        eos->law->state(eos->self, 1, &rho, &p, &rho_e, &rho_c2);
        rho_all += part * rho;
        give += part / rho_c2;
    }
    flow_stop(&flow);
    return 1.0 / sqrt(rho_all * give);
}

/* Vapour over water of 360 K condenses while sound crosses 10 cells of 1 mm; evaporation takes no time. */
static void test_over(void **state)
{
    (void)state;
    static const char at_once[] = "{liquid: water, vapour: steam}",
                      over[] = "{liquid: water, vapour: steam, condense-over: 10}";
    double h = 1e-3, alpha = 0.2, part = -expm1(-1e-6 * wood(360.0, 1e5, alpha) / (10.0 * h));
    double all = vapour_in(at_once, 360.0, 1e5, alpha, NULL, h), some = vapour_in(over, 360.0, 1e5, alpha, NULL, h);
    print_message("of what condenses %.10g, by the speed of sound %.10g\n", some / all, part);
    assert_true(all < 0.0 && fabs(some / all / part - 1.0) < 1e-9);
    assert_true(vapour_in(over, 400.0, 1e5, alpha, NULL, h) == vapour_in(at_once, 400.0, 1e5, alpha, NULL, h));
}

/* What is missing falls to 1/e in the given time; `none` shares temperatures alone; liquid bears its tension and no
 * more. */
static void test_kinds(void **state)
{
    (void)state;
    double all = vapour_after("{liquid: water, vapour: steam}", 400.0, 1e5, 0.1);
    double part = vapour_after("{liquid: water, vapour: steam, rate: {type: relaxation, time: 1 us}}", 400.0, 1e5, 0.1);
    assert_true(all > 0.0 && fabs(part / all - (1.0 - exp(-1.0))) < 1e-9);
    assert_true(vapour_after("{liquid: water, vapour: steam, rate: none}", 400.0, 1e5, 0.1) == 0.0);
    assert_true(vapour_after("{liquid: water, vapour: steam}", 300.0, -1e6, 0.0) == 0.0);
    assert_true(vapour_after("{liquid: water, vapour: steam, where: everywhere}", 300.0, -1e6, 0.0) > 0.0);
    static const char wet[] = "{liquid: water, vapour: steam, condense-from: 0.9}";
    assert_true(vapour_after(wet, 360.0, 1e5, 0.11) == 0.0);
    assert_true(vapour_after(wet, 360.0, 1e5, 0.09) < 0.0);
    assert_true(vapour_after(wet, 400.0, 1e5, 0.5) > 0.0);
    static const char nucleus[] = "{liquid: water, vapour: steam, nucleus: 1e-3}";
    assert_true(vapour_after(nucleus, 360.0, 1e5, 0.9e-3) == 0.0);
    double all_gone = vapour_after("{liquid: water, vapour: steam}", 360.0, 1e7, 3e-3);
    double gone = vapour_after(nucleus, 360.0, 1e7, 3e-3) / all_gone;
    print_message("of vapour at 10 MPa a nucleus leaves %.3g\n", 1.0 - gone);
    assert_true(gone > 0.8 && gone < 0.95);
    assert_true(vapour_after(nucleus, 400.0, 1e5, 0.9e-3) > 0.0);
    static const char tense[] = "{liquid: water, vapour: steam, where: everywhere, nucleation: {tension: 2 MPa}}";
    assert_true(vapour_after(tense, 300.0, -1.9e6, 0.0) == 0.0);
    assert_true(vapour_after(tense, 300.0, -2.1e6, 0.0) > 0.0);
    static const char hot[] = "{liquid: water, vapour: steam, where: everywhere, nucleation: {superheat: 10 K}}";
    assert_true(vapour_after(hot, 380.0, 101325.0, 0.0) == 0.0);
    assert_true(vapour_after(hot, 385.0, 101325.0, 0.0) > 0.0);
}

/* Hot air, steam and water of `T` in a cell nine tenths of which are water, brought to equilibrium: the air's
 * temperature and the partial pressure of the vapour over that of saturation. */
static void mixed(const char *phase, double T_air, double *ret_T, double *ret_share)
{
    struct flow flow;
    phase_box_open(&flow, PHASE_BOX_NASG PHASE_BOX_AIR, phase, 8, "");
    const struct model *model = flow.state->model;
    const double part[] = {0.9, 0.04, 0.06}, T[] = {340.0, 340.0, T_air};
    double u[FLOW_FIELDS] = {0}, w[FLOW_FIELDS] = {0}, p = 1e5, T_now[3];
    for (unsigned l = 0; l < 3; l++) {
        w[model->i_alpha + l] = part[l];
        model->eos[l].law->density(model->eos[l].self, 1, &p, &T[l], &w[model->i_m + l]);
    }
    w[model->i_E] = p;
    mix_conserved(model, 1, 1, w, u);
    phase_act(model, 0, 1, 1, 1e-6, 0.0, NULL, w, u, &(struct equilibrium_effort){0});
    mix_primitives(model, 1, 1, u, w);
    double moles[3] = {0};
    for (unsigned l = 0; l < 3; l++) {
        const struct model_eos *eos = &model->eos[l];
        eos->law->temperature(eos->self, 1, &w[model->i_m + l], &w[model->i_E], &T_now[l]);
        if (l) moles[l] = u[model->i_m + l] * eos->law->gas_constant(eos->self);
    }
    const struct saturation pair = {{model->eos[0].law, model->eos[1].law},
                                    {model->eos[0].self, model->eos[1].self},
                                    {w[model->i_m], w[model->i_m + 1]},
                                    0.0};
    double drive = saturation_at(&pair, w[model->i_E], T_now[0]).drive, R = moles[1] / u[model->i_m + 1];
    *ret_T = T_now[2] / T_now[0];
    *ret_share = moles[1] / (moles[1] + moles[2]) * exp(drive / (R * T_now[0]));
    flow_stop(&flow);
}

/* Gases with a temperature of their own keep it but for the work that the change of pressure does on them, and the
 * vapour is in equilibrium among them all the same. */
static void test_apart(void **state)
{
    (void)state;
    double T, share;
    mixed("{liquid: water, vapour: steam, gases: [air]}", 3000.0, &T, &share);
    assert_true(fabs(T - 1.0) < 1e-9 && fabs(share - 1.0) < 1e-8);
    mixed("{liquid: water, vapour: steam, gases: [air], gas-temperature: own}", 3000.0, &T, &share);
    assert_true(T > 6.0 && T < 9.0 && fabs(share - 1.0) < 1e-8);
}

/* More vapour has gone than there was (two stages): the liquid pays for it, and nothing is made. */
static void test_owed(void **state)
{
    (void)state;
    struct flow flow;
    phase_box_open(&flow, PHASE_BOX_NASG, "{liquid: water, vapour: steam}", 8, "");
    const struct model *model = flow.state->model;
    for (unsigned owes = 0; owes < 2; owes++) {
        double u[FLOW_FIELDS] = {0}, w[FLOW_FIELDS] = {0}, p = 1e5, T = 400.0;
        for (unsigned l = 0; l < 2; l++) {
            w[model->i_alpha + l] = l == owes ? 1e-3 : 0.999;
            model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
        }
        w[model->i_E] = p;
        mix_conserved(model, 1, 1, w, u);
        u[model->i_m + owes] *= -1e-3;
        double all = u[model->i_m] + u[model->i_m + 1];
        phase_act(model, 0, 1, 1, 1e-6, 0.0, NULL, w, u, &(struct equilibrium_effort){0});
        assert_true(u[model->i_m] >= 0.0 && u[model->i_m + 1] >= 0.0);
        assert_true(fabs((u[model->i_m] + u[model->i_m + 1]) / all - 1.0) < 1e-15);
    }
    flow_stop(&flow);
}

/* Volume that vapour has left is the liquid's, which then has the pressure that its mass means, and bears it. */
static void test_left(void **state)
{
    (void)state;
    struct flow flow;
    phase_box_open(&flow, PHASE_BOX_NASG,
                   "{liquid: water, vapour: steam, where: everywhere, nucleation: {tension: 8 MPa}}", 8, "");
    const struct model *model = flow.state->model;
    double u[FLOW_FIELDS] = {0}, w[FLOW_FIELDS] = {0}, p = -1e6, T = 300.0, mass;
    w[model->i_alpha] = 1.0;
    model->eos[0].law->density(model->eos[0].self, 1, &p, &T, &w[model->i_m]);
    w[model->i_E] = p;
    mix_conserved(model, 1, 1, w, u);
    mass = u[model->i_m];
    u[model->i_alpha] = 1.0 - 1e-4;
    u[model->i_alpha + 1] = 1e-4;
    u[model->i_m + 1] = -1e-9;
    mix_primitives(model, 1, 1, u, w);
    phase_act(model, 0, 1, 1, 1e-6, 0.0, NULL, w, u, &(struct equilibrium_effort){0});
    assert_true(u[model->i_alpha + 1] == 0.0 && fabs(u[model->i_alpha] - 1.0) < 1e-15);
    assert_true(u[model->i_m + 1] == 0.0 && fabs(u[model->i_m] - (mass - 1e-9)) < 1e-12);
    assert_true(fabs(w[model->i_E] / p - 1.0) < 1e-3);
    flow_stop(&flow);
}

/* A wave through a mixture in a closed box: masses, momentum and energy to round-off; entropy does not fall. */
static void wave(const struct model *model, const double x[3], double *w)
{
    double p = 1e5, T = 372.0;
    w[model->i_alpha] = 0.7;
    w[model->i_alpha + 1] = 0.2;
    w[model->i_alpha + 2] = 0.1;
    for (unsigned l = 0; l < 3; l++) model->eos[l].law->density(model->eos[l].self, 1, &p, &T, &w[model->i_m + l]);
    w[model->i_u] = 20.0 * sin(2.0 * M_PI * x[0]);
    w[model->i_E] = p;
}

static void test_box(void **state)
{
    (void)state;
    struct flow flow;
    double size, water, energy, air, vapour;
    phase_box_open(&flow, PHASE_BOX_NASG PHASE_BOX_AIR, "{liquid: water, vapour: steam, gases: [air]}", 64, "cfl: 0.4");
    flow_set(&flow, wave);
    const struct model *model = flow.state->model;
    water = (double)(flow_total(&flow, model->i_m, &size) + flow_total(&flow, model->i_m + 1, &size));
    vapour = (double)flow_total(&flow, model->i_m + 1, &size);
    air = (double)flow_total(&flow, model->i_m + 2, &size);
    energy = (double)flow_total(&flow, model->i_E, &size);
    flow_steps(&flow, 400);
    assert_true(fabs((double)(flow_total(&flow, model->i_m, &size) + flow_total(&flow, model->i_m + 1, &size)) / water -
                     1.0) < 1e-13);
    assert_true(fabs((double)flow_total(&flow, model->i_m + 2, &size) / air - 1.0) < 1e-13);
    assert_true(fabs((double)flow_total(&flow, model->i_E, &size) / energy - 1.0) < 1e-13);
    assert_true(fabs((double)flow_total(&flow, model->i_u, &size)) < 1e-9 * water);
    assert_true(fabs((double)flow_total(&flow, model->i_m + 1, &size) / vapour - 1.0) > 1e-4);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_call),  cmocka_unit_test(test_direction), cmocka_unit_test(test_rate),
        cmocka_unit_test(test_kinds), cmocka_unit_test(test_onset),     cmocka_unit_test(test_onset_heat),
        cmocka_unit_test(test_apart), cmocka_unit_test(test_owed),      cmocka_unit_test(test_left),
        cmocka_unit_test(test_over),  cmocka_unit_test(test_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
