/* table.c - an equation of state from a file: states on a grid of densities and temperatures (table_read.h), one
 * potential between them (table_grid.h), the rules of continuation.h beyond.
 *
 * The file is read, and the grid made, once per machine (`share` of bulla/module.h).
 *
 * For (rho, p) the temperatures of the grid between which p lies are found by bisection, the root by a bracketed Newton
 * iteration in that cell. A point costs some 0.5 us and rows stay scalar: a search is no vector loop. */
#include "bulla/eos.h"
#include "table_grid.h"
#include "table_read.h"

struct table {
    struct table_grid grid;
    struct continuation_ends ends;
};

/* Where a search in temperature ended. */
struct table_root {
    double T, s;
    struct continuation_point at;
};

/* The root of p(rho, T) = p in a cell, or the side of it beyond which it lies; rounded to 29 bits, so that neighbouring
 * pressures share a T: what is left of p goes linearly, and the iteration of a mixture sees no steps. */
static double table_newton(const struct table_line *line, double rho, double p)
{
    double low = line->T, high = line->T + line->h, T = low + 0.5 * line->h, s;
    for (int round = 0; round < 60; round++) {
        struct continuation_point at = table_grid_point(line, rho, T, &s);
        double next = T + (p - at.p) / (at.G * rho * at.cv);
        if (at.p > p) high = T;
        else low = T;
        if (!(next > low && next < high)) next = next > low ? high : low;
        if (!(fabs(next - T) > 1e-14 * T)) break;
        T = next;
    }
    double much = 0x1p24 * T;
    return (T + much) - much;
}

static struct table_root table_find(const struct table *self, double rho, double p)
{
    const struct table_grid *grid = &self->grid;
    double inside = continuation_inside(&self->ends, rho);
    struct table_density density = table_grid_density(grid, inside);
    size_t low = 0, high = grid->n_T - 1;
    while (high - low > 1) {
        size_t mean = (low + high) / 2;
        if (table_grid_node_p(grid, &density, mean) <= p) low = mean;
        else high = mean;
    }
    struct table_line line = table_grid_line(grid, &density, low);
    struct table_root root = {.T = line.T};
    if (p > table_grid_node_p(grid, &density, low)) root.T = table_newton(&line, inside, p);
    if (p >= table_grid_node_p(grid, &density, grid->n_T - 1)) root.T = line.T + line.h;
    root.at = table_grid_point(&line, inside, root.T, &root.s);
    return root;
}

static struct continuation_state table_state_at(const struct table *self, double rho, double p)
{
    struct table_root root = table_find(self, rho, p);
    return continuation_state(&self->ends, root.at, rho, p, root.T);
}

static void table_state(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                        double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2)
{
    for (size_t i = 0; i < n; i++) {
        struct continuation_state state = table_state_at(self, rho[i], p[i]);
        rho_e[i] = rho[i] * state.e;
        rho_c2[i] = rho[i] * state.c2;
    }
}

static void table_derivatives(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                              const double *BULLA_RESTRICT p, double *BULLA_RESTRICT de_dp,
                              double *BULLA_RESTRICT de_drho)
{
    for (size_t i = 0; i < n; i++) {
        struct continuation_state state = table_state_at(self, rho[i], p[i]);
        de_dp[i] = rho[i] * state.e_p;
        de_drho[i] = state.de_drho;
    }
}

static void table_energy(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                         double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT de_dp)
{
    for (size_t i = 0; i < n; i++) {
        struct continuation_state state = table_state_at(self, rho[i], p[i]);
        rho_e[i] = rho[i] * state.e;
        de_dp[i] = rho[i] * state.e_p;
    }
}

static void table_temperature(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                              const double *BULLA_RESTRICT p, double *BULLA_RESTRICT T)
{
    for (size_t i = 0; i < n; i++) T[i] = table_state_at(self, rho[i], p[i]).T;
}

/* That of the potential where it ends, from there with its cv. */
static void table_entropy(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                          const double *BULLA_RESTRICT p, double *BULLA_RESTRICT s)
{
    const struct table *self = instance;
    for (size_t i = 0; i < n; i++) {
        struct table_root root = table_find(self, rho[i], p[i]);
        double T = continuation_state(&self->ends, root.at, rho[i], p[i], root.T).T;
        s[i] = root.s + root.at.cv * log(T / root.T);
    }
}

/* T falls with rho at constant p: Newton with dT/drho = -p_rho/p_T in a bracket. */
static double table_density_at(const struct table *self, double p, double T)
{
    double low = 1e-4 * self->ends.thin.rho, high = 1e2 * self->ends.dense.rho;
    double rho = sqrt(self->ends.thin.rho * self->ends.dense.rho);
    for (int round = 0; round < 200; round++) {
        struct table_root root = table_find(self, rho, p);
        struct continuation_state state = continuation_state(&self->ends, root.at, rho, p, root.T);
        double p_T = root.at.G * rho * root.at.cv, p_rho = state.c2 - root.T * p_T * p_T / (rho * rho * root.at.cv);
        double next = rho + (state.T - T) * p_T / p_rho;
        if (state.T > T) low = rho;
        else high = rho;
        if (!(next > low && next < high)) next = sqrt(low * high);
        if (!(fabs(next - rho) > 1e-15 * rho)) return next;
        rho = next;
    }
    return rho;
}

static void table_density(const void *self, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                          double *BULLA_RESTRICT rho)
{
    for (size_t i = 0; i < n; i++) rho[i] = table_density_at(self, p[i], T[i]);
}

static void table_p_min(const void *instance, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p)
{
    const struct table *self = instance;
    for (size_t i = 0; i < n; i++) {
        double inside = continuation_inside(&self->ends, rho[i]), s;
        struct table_density density = table_grid_density(&self->grid, inside);
        struct table_line line = table_grid_line(&self->grid, &density, 0);
        p[i] = continuation_p_min(&self->ends, table_grid_point(&line, inside, line.T, &s), rho[i]);
    }
}

/* Beyond the grid. */
static size_t table_count_outside(const void *instance, size_t n, const double *BULLA_RESTRICT rho,
                                  const double *BULLA_RESTRICT p)
{
    const struct table *self = instance;
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        double inside = continuation_inside(&self->ends, rho[i]);
        struct table_density density = table_grid_density(&self->grid, inside);
        int within = rho[i] == inside && p[i] >= table_grid_node_p(&self->grid, &density, 0) &&
                     p[i] <= table_grid_node_p(&self->grid, &density, self->grid.n_T - 1);
        count += !within;
    }
    return count;
}

/* A little less than the grid. */
static void table_range(const void *instance, struct bulla_eos_range *ret_range)
{
    const struct table *self = instance;
    const struct table_grid *grid = &self->grid;
    double T_low = grid->T[0], span = grid->T[grid->n_T - 1] - T_low, least;
    double thin = self->ends.thin.rho * (1.0 + 1e-4), dense = self->ends.dense.rho * (1.0 - 1e-4);
    struct table_density first = table_grid_density(grid, thin), last = table_grid_density(grid, dense);
    double low = table_grid_node_p(grid, &first, 0), high = table_grid_node_p(grid, &last, grid->n_T - 1);
    table_p_min(self, 1, &dense, &least);
    *ret_range = (struct bulla_eos_range){.rho_min = thin,
                                          .rho_max = dense,
                                          .p_min = low > least ? low : least,
                                          .p_max = high,
                                          .T_min = T_low + 0.03 * span,
                                          .T_max = T_low + 0.95 * span};
}

static const struct bulla_eos table_functions = {.size = sizeof(struct bulla_eos),
                                                 .state = table_state,
                                                 .derivatives = table_derivatives,
                                                 .temperature = table_temperature,
                                                 .entropy = table_entropy,
                                                 .density = table_density,
                                                 .p_min = table_p_min,
                                                 .range = table_range,
                                                 .energy = table_energy,
                                                 .count_outside = table_count_outside};

static const struct bulla_param table_params[] = {
    {"file", "1", 0.0, 0.0, 0.0,
     "the file, relative to this one: CSV with columns rho[kg/m3], T[K], p[Pa], e[J/kg], c[m/s], s[J/kg/K], or HDF5 "
     "arrays",
     BULLA_FILE, NULL},
    {0},
};

/* The point at node (i, j), moved by parts of the spacing. */
static struct continuation_point table_near(const struct table_grid *grid, size_t i, size_t j, double part_rho,
                                            double part_T)
{
    size_t ci = i + 1 < grid->n_rho ? i : i - 1, cj = j + 1 < grid->n_T ? j : j - 1;
    double rho = grid->rho[i] + part_rho * (grid->rho[ci + 1] - grid->rho[ci]), s;
    double T = grid->T[j] + part_T * (grid->T[cj + 1] - grid->T[cj]);
    struct table_density density = table_grid_density(grid, rho);
    struct table_line line = table_grid_line(grid, &density, cj);
    return table_grid_point(&line, rho, T, &s);
}

/* Derivative of a column along T or rho at node (i, j), by differences. */
static double table_slope(const struct table_file *file, const struct table_grid *grid, const size_t at[2], int column,
                          int along_T)
{
    double weight[5], sum = 0.0;
    size_t first;
    if (along_T) table_grid_difference(grid->T, grid->n_T, at[1], &first, weight);
    else table_grid_difference(grid->rho, grid->n_rho, at[0], &first, weight);
    for (size_t k = 0; k < 5; k++) {
        size_t r = along_T ? at[0] * grid->n_T + first + k : (first + k) * grid->n_T + at[1];
        sum += weight[k] * file->row[r][column];
    }
    return sum;
}

/* p, e and s must be those of one substance: de/dT = T ds/dT, ds/drho = -p_T/rho^2, de/drho = (p - T p_T)/rho^2. */
static int table_agrees(const struct bulla_host *host, const char *path, const struct table_file *file,
                        const struct table_grid *grid)
{
    for (size_t r = 0; r < file->n_row; r++) {
        const size_t at[2] = {r / grid->n_T, r % grid->n_T};
        double rho = grid->rho[at[0]], T = grid->T[at[1]], p = file->row[r][TABLE_P], square = rho * rho;
        double e_T = table_slope(file, grid, at, TABLE_E, 1), s_T = table_slope(file, grid, at, TABLE_S, 1);
        double p_T = table_slope(file, grid, at, TABLE_P, 1), s_r = table_slope(file, grid, at, TABLE_S, 0);
        double e_r = table_slope(file, grid, at, TABLE_E, 0), size = 0.1 * (fabs(p) + T * fabs(p_T)) / square;
        const char *what = fabs(e_T - T * s_T) > 0.1 * e_T             ? "de/dT is not T ds/dT"
                           : fabs(s_r + p_T / square) * T > size       ? "ds/drho is not -(dp/dT)/rho^2"
                           : fabs(e_r - (p - T * p_T) / square) > size ? "de/drho is not (p - T dp/dT)/rho^2"
                                                                       : NULL;
        if (what)
            return table_file_fail_at(host, path, file, r,
                                      "%s around here: wrong units, unsteady numbers or too coarse a grid", what);
    }
    return 0;
}

/* c at the nodes must be what p, e and s say; the largest difference is returned. */
static int table_fits(const struct bulla_host *host, const char *path, const struct table_file *file,
                      const struct table_grid *grid, double *ret_worst)
{
    *ret_worst = 0.0;
    for (size_t r = 0; r < file->n_row; r++) {
        struct continuation_point at = table_near(grid, r / grid->n_T, r % grid->n_T, 0.0, 0.0);
        double given = file->row[r][TABLE_C], c = at.c2 > 0.0 ? sqrt(at.c2) : 0.0, off = fabs(c / given - 1.0);
        if (!(off < 0.1) || !(at.cv > 0.0) || !(at.G > 0.0))
            return table_file_fail_at(
                host, path, file, r,
                "p, e and s around here say c = %.5g, cv = %.4g, Grueneisen coefficient %.3g, the file "
                "says c = %.5g: wrong units, unsteady numbers or too coarse a grid",
                c, at.cv, at.G, given);
        *ret_worst = off > *ret_worst ? off : *ret_worst;
    }
    return 0;
}

/* Between the nodes too the law must be well-posed. */
static int table_holds(const struct bulla_host *host, const char *path, const struct table_file *file,
                       const struct table_grid *grid)
{
    for (size_t i = 0; i + 1 < grid->n_rho; i++)
        for (size_t j = 0; j + 1 < grid->n_T; j++)
            for (int k = 1; k < 9; k++) {
                struct continuation_point at = table_near(grid, i, j, 0.5 * (k % 3), 0.5 * (k / 3));
                if (at.cv > 0.0 && at.G > 0.0 && at.c2 > 0.0) continue;
                return table_file_fail_at(
                    host, path, file, i * grid->n_T + j,
                    "between this state and the next the law is ill-posed: cv %.3g, Grueneisen "
                    "coefficient %.3g, c^2 %.3g; give more states, or none beyond a phase boundary",
                    at.cv, at.G, at.c2);
            }
    return 0;
}

static void table_set_ends(struct table *self)
{
    const struct table_grid *grid = &self->grid;
    size_t i = grid->n_rho - 1, j = grid->n_T - 1;
    struct continuation_point thin = table_near(grid, 0, j, 0.0, 0.0), dense = table_near(grid, i, 0, 0.0, 0.0);
    double most = 0.0;
    for (size_t k = 0; k < grid->n_T; k++) {
        double G = table_near(grid, i, k, 0.0, 0.0).G;
        most = G > most ? G : most;
    }
    self->ends.thin = continuation_end(thin, grid->rho[0], 1.0 / thin.G, 1e5);
    self->ends.dense = continuation_end(dense, grid->rho[i], 0.9 / most, 1e5);
}

/* What the rank that reads the file tells the others. */
struct table_head {
    size_t n_rho, n_T;
    double zeros[2]; /* of e and s */
};

/* A table while it is made: the file is held by the rank that has read it. */
struct table_making {
    const struct bulla_host *host;
    const char *path;
    struct table_file file;
    const struct table_head *head;
};

static int table_make_head(void *context, void *block, unsigned phase, unsigned part, unsigned parts)
{
    struct table_making *making = context;
    struct table_head *head = block;
    (void)phase;
    (void)parts;
    if (part) return 0;
    if (table_read(making->host, making->path, &making->file)) return 1;
    const struct table_file *file = &making->file;
    const double *middle = file->row[file->n_rho / 2 * file->n_T + file->n_T / 2];
    *head = (struct table_head){file->n_rho, file->n_T, {middle[TABLE_E], middle[TABLE_S]}};
    return 0;
}

enum { TABLE_CHECKS = 4, TABLE_PHASES };

static int table_make_grid(void *context, void *block, unsigned phase, unsigned part, unsigned parts)
{
    struct table_making *making = context;
    const struct table_file *file = &making->file;
    const struct table_head *head = making->head;
    struct table_grid grid = table_grid_in(block, head->n_rho, head->n_T, head->zeros);
    if (phase > 0 && phase < TABLE_CHECKS) table_grid_slopes(&grid, phase, part, parts);
    if (part) return 0;
    if (phase == 0) table_grid_states(file, &grid);
    if (phase < TABLE_CHECKS) return 0;
    return table_agrees(making->host, making->path, file, &grid) ||
           table_fits(making->host, making->path, file, &grid, grid.misses) ||
           table_holds(making->host, making->path, file, &grid);
}

/* The grid of the file, made or found. NULL after host->fail. */
static double *table_share(struct table_making *making)
{
    const struct bulla_host *host = making->host;
    if (!BULLA_HOST_HAS(host, share)) {
        host->fail("this table needs a bulla that shares memory between ranks");
        return NULL;
    }
    making->head = host->share("head", sizeof *making->head, 1, table_make_head, making);
    if (!making->head) return NULL;
    size_t bytes = table_grid_bytes(making->head->n_rho, making->head->n_T);
    return (double *)host->share("grid", bytes, TABLE_PHASES, table_make_grid, making);
}

static int table_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct table_making making = {.host = host, .path = values[0].text};
    struct table *self = calloc(1, sizeof *self);
    char text[1024];
    double *block = table_share(&making);
    table_file_free(&making.file);
    if (!block || !self) {
        if (!self) host->fail("out of memory");
        free(self);
        return 1;
    }
    self->grid = table_grid_in(block, making.head->n_rho, making.head->n_T, making.head->zeros);
    table_set_ends(self);
    snprintf(
        text, sizeof text,
        "table: %.600s: %zu densities, %zu temperatures; p, e, s are those of the file at its states, sound speeds "
        "within %.1e",
        making.path, self->grid.n_rho, self->grid.n_T, *self->grid.misses);
    host->say(text);
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof bulla_module,
    .kind = "eos",
    .name = "table",
    .version = "1.0",
    .doc =
        "States from a file, on a grid of densities and temperatures. For materials whose law you have as a program or "
        "as data; consistent whatever the numbers, and continued beyond them.",
    .cite = "Swesty, J. Comput. Phys. 127 (1996) 118-127 (biquintic interpolation of the Helmholtz energy)",
    .params = table_params,
    .open = table_open,
    .close = free,
    .table = &table_functions,
};
