/* rigid.c - see rigid.h. Where bodies rest, the parts around a tile are made once and kept; where one moves, they are
 * made for each stage. Both are functions of the place and the times alone, so that ranks and restarts change
 * nothing. */
#include "mesh/rigid.h"

#include "base/mem.h"
#include "base/status.h"
#include "mesh/rigid_part.h"

#include <math.h>
#include <string.h>

enum { RIGID_ROWS = 13, RIGID_SLOTS = 64 };

/* A way through a face that is shorter than this, in cells, leaves it as it is in the middle of it. */
#define RIGID_STILL 1e-3

/* What round-off covers of a cell is nothing. */
#define RIGID_FULL 1e-12

struct rigid_entry {
    int l, at[3];
    struct rigid_times times;
    struct rigid_cells cells;
    double *rows; /* [RIGID_ROWS][count]; NULL where no body is near */
};

struct rigid {
    const struct scene *scene;
    bool moves;
    struct slots slots; /* entries by level and place, where all bodies rest */
    struct rigid_entry **entries;
    unsigned n, room;
    struct pose *poses;      /* [4][n_rigid]: at from, to, now, and in the middle */
    struct pose_rate *rates; /* [n_rigid]: at a single time */
    int status;
    char *message;
};

/* What an entry is made from. */
struct rigid_make {
    struct rigid *rigid;
    const struct mesh *mesh;
    const struct level *level;
    const struct tile *tile;
    struct rigid_entry *entry;
    struct rigid_part from, to, now, middle;
    double *part, *now_theta, *was, *open[3], *wall[3], *speed[3], *plane, *body;
};

struct rigid *rigid_new(const struct scene *scene)
{
    if (!scene->n_rigid) return NULL;
    struct rigid *rigid = mem_new(1, sizeof *rigid);
    rigid->scene = scene;
    for (unsigned k = 0; k < scene->n_rigid; k++) rigid->moves = rigid->moves || scene->rigids[k].moves;
    rigid->poses = mem_new((size_t)4 * scene->n_rigid, sizeof *rigid->poses);
    rigid->rates = mem_new(scene->n_rigid, sizeof *rigid->rates);
    slots_start(&rigid->slots, RIGID_SLOTS);
    return rigid;
}

void rigid_free(struct rigid *rigid)
{
    if (!rigid) return;
    for (unsigned i = 0; i < rigid->n; i++) {
        mem_free(rigid->entries[i]->rows);
        mem_free(rigid->entries[i]);
    }
    mem_free(rigid->entries);
    mem_free(rigid->poses);
    mem_free(rigid->rates);
    mem_free(rigid->message);
    slots_done(&rigid->slots);
    mem_free(rigid);
}

int rigid_failure(const struct rigid *rigid, const char **ret_message)
{
    *ret_message = rigid ? rigid->message : NULL;
    return rigid ? rigid->status : STATUS_OK;
}

/* Keeps the first failure of a body's script. */
static void rigid_note(struct rigid *rigid, unsigned body, int status)
{
    if (!status || rigid->status) return;
    rigid->status = status;
    rigid->message = mem_print("body '%s': %s", rigid->scene->rigids[body].name, status_text());
}

/* All bodies at a time into a row of poses; NaN after a failure, which is kept. */
static struct rigid_part rigid_pose(struct rigid *rigid, unsigned row, double t)
{
    unsigned n = rigid->scene->n_rigid;
    for (unsigned k = 0; k < n; k++)
        rigid_note(rigid, k, pose_at(&rigid->scene->rigids[k], t, &rigid->poses[row * n + k]));
    return (struct rigid_part){rigid->scene, rigid->poses + row * n};
}

/* How fast all bodies go at a time. */
static void rigid_rates(struct rigid *rigid, double t)
{
    for (unsigned k = 0; k < rigid->scene->n_rigid; k++)
        rigid_note(rigid, k, pose_rate_at(&rigid->scene->rigids[k], t, &rigid->rates[k]));
}

/* --- the places of cells --- */

/* Number of a cell of the level along an axis; wrapped on periodic axes, -1 outside of the domain. */
static int rigid_cell(const struct rigid_make *make, int d, int at)
{
    int all = make->level->extent[d] * make->mesh->n[d], cell = make->tile->at[d] * make->mesh->n[d] + at;
    if (make->mesh->periodic[d]) return (cell + all) % all;
    return cell < 0 || cell >= all ? -1 : cell;
}

/* Lower end of a cell: mirrored to the bit in a domain that is symmetric about 0. */
static double rigid_end(const struct rigid_make *make, int d, int cell)
{
    double all = (double)make->level->extent[d] * make->mesh->n[d], at = cell;
    return (make->mesh->lower[d] * (all - at) + make->mesh->upper[d] * at) / all;
}

/* The box of a cell counted from the tile; false: outside of the domain. */
static bool rigid_box(const struct rigid_make *make, const int at[3], struct rigid_part_box *ret)
{
    *ret = (struct rigid_part_box){{0.0}, {0.0}};
    for (int d = 0; d < make->mesh->dim; d++) {
        int cell = rigid_cell(make, d, at[d]);
        if (cell < 0) return false;
        ret->lower[d] = rigid_end(make, d, cell);
        ret->upper[d] = rigid_end(make, d, cell + 1);
    }
    return true;
}

/* Is a body near the tile and its layers between the two times? */
static bool rigid_near(const struct rigid_make *make)
{
    struct rigid_part_box box = {{0.0}, {0.0}};
    int pad = make->entry->cells.pad;
    for (int d = 0; d < make->mesh->dim; d++) {
        int first = make->tile->at[d] * make->mesh->n[d], all = make->level->extent[d] * make->mesh->n[d];
        if (make->mesh->periodic[d] && (first < pad || first + make->mesh->n[d] + pad > all)) return true;
        box.lower[d] = rigid_end(make, d, first - pad);
        box.upper[d] = rigid_end(make, d, first + make->mesh->n[d] + pad);
    }
    return rigid_part_reaches(&make->from, &box) || rigid_part_reaches(&make->to, &box) ||
           rigid_part_reaches(&make->now, &box);
}

/* Goes over all cells of the block that are in the domain. */
static void rigid_each(struct rigid_make *make, void (*visit)(struct rigid_make *make, const int at[3], size_t i,
                                                              const struct rigid_part_box *cell))
{
    const struct rigid_cells *cells = &make->entry->cells;
    int first[3], end[3], at[3];
    for (int d = 0; d < 3; d++) {
        first[d] = d < make->mesh->dim ? -cells->pad : 0;
        end[d] = first[d] + (int)cells->size[d];
    }
    for (at[2] = first[2]; at[2] < end[2]; at[2]++)
        for (at[1] = first[1]; at[1] < end[1]; at[1]++)
            for (at[0] = first[0]; at[0] < end[0]; at[0]++) {
                struct rigid_part_box cell;
                if (rigid_box(make, at, &cell)) visit(make, at, rigid_offset(cells, at), &cell);
            }
}

/* --- cells --- */

static double rigid_left(const struct rigid_part *part, const struct rigid_part_box *box, int beta)
{
    double covered = 0.0;
    for (unsigned k = 0; k < part->scene->n_rigid; k++) covered += rigid_part_body(part, k, box, beta);
    return covered < 1.0 ? 1.0 - covered : 0.0;
}

/* The same of a cell, without slivers of either kind. */
static double rigid_fluid(const struct rigid_part *part, const struct rigid_part_box *cell, int beta)
{
    double fluid = rigid_left(part, cell, beta);
    return fluid < RIGID_LEAST ? 0.0 : fluid > 1.0 - RIGID_FULL ? 1.0 : fluid;
}

/* The body that covers most of a cell at the times. */
static unsigned rigid_which(const struct rigid_make *make, const struct rigid_part_box *cell)
{
    unsigned which = 0;
    double most = -1.0;
    for (unsigned k = 0; k < make->rigid->scene->n_rigid; k++) {
        double covers = rigid_part_body(&make->from, k, cell, 0) + rigid_part_body(&make->to, k, cell, 0) +
                        rigid_part_body(&make->now, k, cell, 0);
        if (covers > most) which = k;
        most = covers > most ? covers : most;
    }
    return which;
}

static void rigid_see(struct rigid_make *make, const int at[3], size_t i, const struct rigid_part_box *cell)
{
    int beta = make->mesh->beta;
    bool moves = make->rigid->moves;
    (void)at;
    double a = rigid_fluid(&make->from, cell, beta), b = moves ? rigid_fluid(&make->to, cell, beta) : a;
    make->part[i] = 0.5 * (a + b);
    make->was[i] = a;
    make->now_theta[i] = moves ? rigid_fluid(&make->now, cell, beta) : a;
    if (beta) make->plane[i] = rigid_fluid(&make->middle, cell, beta - 1);
    if (make->part[i] < RIGID_LEAST) make->part[i] = 0.0;
    if (make->part[i] == 1.0 && make->now_theta[i] == 1.0) return;
    make->entry->cells.any = true;
    make->body[i] = rigid_which(make, cell);
}

/* --- faces --- */

/* How far the bodies move across a face between the two times [m]: that of the body beside it. */
static double rigid_way(const struct rigid_make *make, unsigned body, const struct rigid_part_box *cell, double ret[3])
{
    double x[3], most = 0.0;
    for (int d = 0; d < 3; d++) x[d] = 0.5 * (cell->lower[d] + cell->upper[d]);
    pose_way(&make->from.poses[body], &make->to.poses[body], x, ret);
    for (int d = 0; d < 3; d++) most = fabs(ret[d]) > most ? fabs(ret[d]) : most;
    return most;
}

/* The open part of a face that bodies move across: of the box that the face goes through as the body in the middle of
 * its way sees it. */
static double rigid_swept(const struct rigid_make *make, int d, const struct rigid_part_box *face, double way)
{
    struct rigid_part_box box = *face;
    box.lower[d] = face->lower[d] - 0.5 * fabs(way);
    box.upper[d] = face->lower[d] + 0.5 * fabs(way);
    return rigid_left(&make->middle, &box, make->mesh->beta);
}

/* The part of a face between two cells of the block, at `place` along d. */
static double rigid_face(const struct rigid_make *make, int d, size_t i, size_t below, double place,
                         const struct rigid_part_box *cell)
{
    struct rigid_part_box face = *cell;
    double h = make->level->h[d], way[3] = {0.0};
    const double *part = make->part;
    face.lower[d] = face.upper[d] = place;
    if (part[i] == 0.0 || part[below] == 0.0) return 0.0;
    if (part[i] == 1.0 && part[below] == 1.0) return 1.0;
    if (make->rigid->moves) rigid_way(make, (unsigned)make->body[part[i] < part[below] ? i : below], &face, way);
    if (fabs(way[d]) > RIGID_STILL * h) return rigid_swept(make, d, &face, way[d]);
    return rigid_part_open(&make->middle, d, &face, h, d == 0 ? 0 : make->mesh->beta);
}

static void rigid_open(struct rigid_make *make, const int at[3], size_t i, const struct rigid_part_box *cell)
{
    const struct rigid_cells *cells = &make->entry->cells;
    size_t step = 1;
    for (int d = 0; d < make->mesh->dim; step *= cells->size[d], d++) {
        bool last = at[d] + 1 < make->mesh->n[d] + cells->pad && rigid_cell(make, d, at[d] + 1) < 0;
        if (at[d] > -cells->pad) make->open[d][i] = rigid_face(make, d, i, i - step, cell->lower[d], cell);
        if (last) make->open[d][i + step] = rigid_face(make, d, i, i + step, cell->upper[d], cell);
    }
}

/* --- walls --- */

/* A vector of areas along axis 0 of a curved geometry over the cell's volume. */
static double rigid_round(const struct rigid_make *make, size_t i, const struct rigid_part_box *cell)
{
    double a = cell->lower[0], b = cell->upper[0], low = make->open[0][i], high = make->open[0][i + 1];
    double plane = make->plane[i];
    if (low == 1.0 && high == 1.0 && plane == 1.0) return 0.0;
    if (make->mesh->beta == 1) return (a * low - b * high + plane * (b - a)) / (0.5 * (b * b - a * a));
    return (a * a * low - b * b * high + plane * (b * b - a * a)) / ((b * b * b - a * a * a) / 3.0);
}

static bool rigid_has_wall(const struct rigid_make *make, size_t i)
{
    bool any = false;
    for (int d = 0; d < make->mesh->dim; d++) any = any || make->wall[d][i] != 0.0;
    return any;
}

/* Velocity of a wall in a cell: its way over the step, or at a single time. */
static void rigid_speed(const struct rigid_make *make, unsigned body, const struct rigid_part_box *cell, double ret[3])
{
    double x[3], duration = make->entry->times.to - make->entry->times.from;
    if (duration == 0.0) {
        for (int d = 0; d < 3; d++) x[d] = 0.5 * (cell->lower[d] + cell->upper[d]);
        pose_rate_way(&make->rigid->scene->rigids[body], &make->rigid->rates[body], x, ret);
        return;
    }
    rigid_way(make, body, cell, ret);
    for (int d = 0; d < 3; d++) ret[d] /= duration;
}

static void rigid_wall(struct rigid_make *make, const int at[3], size_t i, const struct rigid_part_box *cell)
{
    const struct rigid_cells *cells = &make->entry->cells;
    size_t step = 1;
    double u[3];
    for (int d = 0; d < make->mesh->dim; d++)
        if (at[d] == -cells->pad || at[d] + 1 == make->mesh->n[d] + cells->pad) return;
    for (int d = 0; d < make->mesh->dim; step *= cells->size[d], d++) {
        make->wall[d][i] = make->mesh->beta && d == 0
                               ? rigid_round(make, i, cell)
                               : (make->open[d][i] - make->open[d][i + step]) / make->level->h[d];
        if (make->part[i] < 1.0 || make->wall[d][i] == 0.0) continue;
        make->body[i] = make->body[make->wall[d][i] > 0.0 ? i + step : i - step]; /* a wall in the face */
    }
    if (!make->rigid->moves || (make->part[i] == 1.0 && !rigid_has_wall(make, i))) return;
    rigid_speed(make, (unsigned)make->body[i], cell, u);
    for (int d = 0; d < make->mesh->dim; d++) make->speed[d][i] = u[d];
}

/* --- entries --- */

static void rigid_rows(struct rigid_make *make)
{
    struct rigid_entry *entry = make->entry;
    struct rigid_cells *cells = &entry->cells;
    if (!entry->rows) entry->rows = mem_new(RIGID_ROWS * cells->count, sizeof *entry->rows);
    double *row = entry->rows;
    memset(row, 0, RIGID_ROWS * cells->count * sizeof *row);
    for (size_t i = 0; i < 6 * cells->count; i++) row[i] = 1.0; /* parts and faces */
    cells->part = make->part = row;
    cells->now = make->now_theta = row + cells->count;
    cells->was = make->was = row + 5 * cells->count;
    cells->body = make->body = row + 6 * cells->count;
    for (size_t d = 0; d < 3; d++) {
        cells->open[d] = make->open[d] = row + (2 + d) * cells->count;
        cells->wall[d] = make->wall[d] = row + (7 + d) * cells->count;
        make->speed[d] = row + (10 + d) * cells->count;
        cells->speed[d] = make->rigid->moves ? make->speed[d] : NULL;
    }
    make->plane = make->mesh->beta ? make->speed[2] : NULL; /* around an axis nothing moves along a third one */
    cells->plane = make->plane;
}

static void rigid_make(struct rigid_make *make)
{
    struct rigid *rigid = make->rigid;
    const struct rigid_times *times = &make->entry->times;
    make->entry->cells.any = false;
    make->from = rigid_pose(rigid, 0, times->from);
    make->to = rigid_pose(rigid, 1, times->to);
    make->now = rigid_pose(rigid, 2, times->now);
    make->middle = rigid_pose(rigid, 3, 0.5 * (times->from + times->to));
    if (rigid->moves && times->to == times->from) rigid_rates(rigid, times->now);
    if (!rigid_near(make)) return;
    rigid_rows(make);
    rigid_each(make, rigid_see);
    if (!make->entry->cells.any) return;
    rigid_each(make, rigid_open);
    rigid_each(make, rigid_wall);
}

static bool rigid_same(const void *list, unsigned index, const void *key)
{
    const struct rigid_entry *one = ((struct rigid_entry *const *)list)[index], *other = key;
    return one->l == other->l && !memcmp(one->at, other->at, sizeof one->at);
}

static uint64_t rigid_hash(const struct rigid_entry *entry)
{
    uint64_t hash = slots_hash(0, (uint64_t)entry->l);
    for (int d = 0; d < 3; d++) hash = slots_hash(hash, (uint64_t)entry->at[d]);
    return hash;
}

/* Room for one more entry. */
static void rigid_grow(struct rigid *rigid)
{
    if (rigid->n < rigid->room) return;
    unsigned room = rigid->room ? 2 * rigid->room : RIGID_SLOTS;
    rigid->entries = mem_grow(rigid->entries, rigid->room, room, sizeof *rigid->entries);
    rigid->room = room;
    slots_start(&rigid->slots, room);
    for (unsigned i = 0; i < rigid->n; i++)
        *slots_find(&rigid->slots, rigid_hash(rigid->entries[i]), rigid_same, rigid->entries, rigid->entries[i]) =
            i + 1;
}

/* The entry of a key: found, or new with nothing in it. */
static struct rigid_entry *rigid_entry(struct rigid *rigid, const struct rigid_entry *key, bool *ret_new)
{
    unsigned *slot;
    *ret_new = true;
    if (rigid->moves && rigid->n) {
        *ret_new = !rigid_same(rigid->entries, 0, key) ||
                   memcmp(&rigid->entries[0]->times, &key->times, sizeof key->times) != 0;
        double *rows = rigid->entries[0]->rows;
        if (*ret_new) *rigid->entries[0] = *key;
        rigid->entries[0]->rows = rows;
        return rigid->entries[0];
    }
    rigid_grow(rigid);
    slot = slots_find(&rigid->slots, rigid_hash(key), rigid_same, rigid->entries, key);
    *ret_new = *slot == 0;
    if (!*ret_new) return rigid->entries[*slot - 1];
    struct rigid_entry *entry = mem_new(1, sizeof *entry);
    *entry = *key;
    rigid->entries[rigid->n++] = entry;
    *slot = rigid->n;
    return entry;
}

const struct rigid_cells *rigid_at(const struct mesh *mesh, const struct level *level, const struct tile *tile,
                                   struct rigid_times times)
{
    struct rigid *rigid = mesh->rigid;
    if (!rigid) return NULL;
    struct rigid_entry key = {.l = (int)(level - mesh->levels), .at = {tile->at[0], tile->at[1], tile->at[2]}};
    key.times = times;
    key.cells.pad = mesh->ghosts + 1; /* frames know what lies behind what they see */
    key.cells.count = 1;
    for (int d = 0; d < 3; d++) {
        key.cells.size[d] = d < mesh->dim ? (size_t)(mesh->n[d] + 2 * key.cells.pad) : 1;
        key.cells.count *= key.cells.size[d];
    }
    bool made;
    struct rigid_entry *entry = rigid_entry(rigid, &key, &made);
    struct rigid_make make = {.rigid = rigid, .mesh = mesh, .level = level, .tile = tile, .entry = entry};
    if (made) rigid_make(&make);
    return entry->cells.any ? &entry->cells : NULL;
}

double rigid_pace(const struct mesh *mesh, const struct level *level, double t)
{
    struct rigid *rigid = mesh->rigid;
    double most = 0.0, sum = 0.0;
    if (!rigid || !rigid->moves) return 0.0;
    rigid_rates(rigid, t);
    for (unsigned k = 0; k < rigid->scene->n_rigid; k++) {
        double speed = pose_rate_most(&rigid->scene->rigids[k], &rigid->rates[k]);
        most = speed > most ? speed : most;
    }
    for (int d = 0; d < mesh->dim; d++) sum += most / level->h[d];
    return sum;
}

bool rigid_is_wall(const struct rigid_cells *cells, const struct mesh *mesh, size_t i)
{
    int at[3];
    for (int d = 0; d < 3; d++) {
        at[d] = (int)(i % (size_t)mesh->n[d]);
        i /= (size_t)mesh->n[d];
    }
    size_t offset = rigid_offset(cells, at);
    bool wall = cells->now[offset] > 0.0 && cells->now[offset] < 1.0;
    for (int d = 0; d < mesh->dim; d++) wall = wall || cells->wall[d][offset] != 0.0;
    return wall;
}

void rigid_weigh(const struct mesh *mesh, const struct level *level, const struct tile *tile, double t, double *value)
{
    const struct rigid_cells *cells = rigid_at(mesh, level, tile, (struct rigid_times){t, t, t});
    size_t i = 0;
    int at[3];
    for (at[2] = 0; cells && at[2] < mesh->n[2]; at[2]++)
        for (at[1] = 0; at[1] < mesh->n[1]; at[1]++)
            for (at[0] = 0; at[0] < mesh->n[0]; at[0]++) value[i++] *= cells->now[rigid_offset(cells, at)];
}
