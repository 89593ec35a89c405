/* scene.h - the typed scene: what a case says, as plain structs, all defaults filled in.
 *
 * Everything in SI units. The layers below `case` (mesh, phys, solve, io) see only this; no
 * YAML, no marks, no units. Pointers belong to the scene; scene_free releases all of it.
 *
 * This folder, case: from YAML, Lua and the command line's settings to plain structs in SI. Nothing here knows of
 * meshes or steps. */
#ifndef SCENE_H
#define SCENE_H

#include "bulla/field.h"
#include "case/saturation.h"
#include "case/scene_boundary.h"
#include "case/script.h"
#include "case/shape.h"
#include "plug/instance.h"

#include <stdbool.h>

enum {
    SCENE_AXES = 3,
    SCENE_MATERIALS = 16,
    SCENE_PAIRS = 8,
    SCENE_BRANCHES = 6,
    SCENE_RIGIDS = 16,
    SCENE_NAME = 64,
    SCENE_SETTINGS = 64
};

/* Layers of neighbours that a sweep over a tile may need on each side: fewest and most. */
enum { SCENE_GHOSTS = 2, SCENE_GHOSTS_MOST = 3 };

enum scene_geometry { SCENE_CARTESIAN = 0, SCENE_AXISYMMETRIC = 1, SCENE_SPHERICAL = 2 }; /* value = beta */

/* A number, or a Lua expression evaluated where and when it is needed. */
struct scene_value {
    bool given;
    double number;               /* when `script` is NULL */
    const struct script *script; /* expression or function of x, y, z, r, t */
};

enum scene_pulse {
    SCENE_PULSE_LITHOTRIPTER, /* 2 amplitude exp(-decay t) cos(2 pi frequency t + pi/3), model.md 8 */
    SCENE_PULSE_SINE,         /* amplitude sin(2 pi frequency t), for `cycles` cycles (0: for ever) */
    SCENE_PULSE_GAUSSIAN,     /* amplitude exp(-((t - centre)/width)^2) */
    SCENE_PULSE_SERIES,       /* linear interpolation of (t, p) pairs of a CSV file: gauge pressure */
    SCENE_PULSE_SCRIPT,       /* Lua: gauge pressure of (t, x, y, z) */
};

/* The way of a wave that comes in (beam.h), or of those that leave (scheme/bound_ray.h). */
struct scene_beam {
    enum { SCENE_BEAM_NORMAL, SCENE_BEAM_PLANE, SCENE_BEAM_FOCUS, SCENE_BEAM_ORIGIN } path;
    double way[SCENE_AXES];   /* unit vector of the plane wave, or of the transducer's axis */
    double point[SCENE_AXES]; /* where the pulse is after its delay; or the focus; or where waves come from [m] */
    double radius, cosine;    /* of the transducer [m], of half of its aperture */
    double power, speed;      /* of F/r, or 1/r; of sound [m/s] */
};

struct scene_boundary {
    enum scene_boundary_type type;
    /* non-reflecting, incoming-wave: the far-field pressure that gauge pressures add to. Not
     * given: the initial pressure of the cells at the boundary. */
    struct scene_value pressure;
    /* incoming-wave */
    enum scene_pulse pulse;
    double amplitude, frequency, decay, cycles, centre, width, delay;         /* Pa, Hz, 1/s, 1, s, s, s */
    enum { SCENE_WINDOW_NONE, SCENE_WINDOW_HANN, SCENE_WINDOW_TUKEY } window; /* of a sine of some cycles */
    struct scene_beam beam; /* of non-reflecting ones: that of what leaves */
    double *sum, sum_step; /* [n_sum] integral of the pulse from 0 to i sum_step [Pa s]; NULL: not needed (pulse_sum) */
    unsigned n_sum;
    bool compressive_only;       /* keep only p' > 0 up to the first zero (model.md 8) */
    double *series_t, *series_p; /* n_series pairs, t ascending */
    unsigned n_series;
    const struct script *script;
    /* inflow: a fixed state */
    double *fractions;                       /* [n_material] */
    struct scene_value *density;             /* [n_material] per material */
    struct scene_value velocity[SCENE_AXES]; /* no-slip: of the wall; given if it moves */
    bool moves;                              /* a no-slip wall with a velocity */
    /* walls: their temperature [K], or the heat that they give to what is inside [W/m2]; neither: none passes */
    struct scene_value temperature, heat_flux;
    /* no-slip walls, by pairs of scene.tension: cosine of the angle between wall and surface within `one`; 0 is a right
     * angle, that of all who say nothing */
    double cosine[SCENE_PAIRS];
    struct instance law; /* of a module, and its enum scene_boundary_trait; module NULL: none */
    unsigned traits;
};

struct scene_material {
    char name[SCENE_NAME];
    struct instance eos;
    struct instance constitutive; /* of a solid; module NULL: a fluid */
    struct instance plastic;      /* strength of a solid; module NULL: none */
    struct instance viscosity;    /* module NULL: none */
    struct instance conductivity; /* of heat; module NULL: none (scheme/conduction.h) */
    const char *real;             /* the fluid that the conductivity is of, NULL: not known ... */
    double real_cp;               /* ... and its heat capacity at 25 C and 1 atm [J/(kg K)] */
    unsigned n_branch;            /* Maxwell branches beside its elastic law (scheme/viscoelastic.h) */
    struct scene_branch {
        double modulus, density, time; /* G [Pa] at that density [kg/m3]; of relaxation [s] */
    } branch[SCENE_BRANCHES];
    double drag; /* resistance against motion [kg/m3/s]; 0: none (scheme/drag.h) */
    struct scene_damage {
        struct instance law;      /* how a solid breaks; module NULL: never */
        double time;              /* in which it does at the fastest [s]; 0: at once */
        bool opens;               /* where it breaks in tension, a void opens ... */
        unsigned gas;             /* ... of this material ... */
        double pressure, density; /* ... in this state [Pa, kg/m3] */
    } damage;
};

/* Surface tension between two materials. */
struct scene_tension {
    unsigned one, other;
    double sigma; /* [N/m] */
};

/* A liquid, its vapour and the gases beside it: section `phase-change:`. */
enum { SCENE_PHASES = 4 };
enum scene_phase_rate {
    SCENE_PHASE_EQUILIBRIUM,
    SCENE_PHASE_NONE,
    SCENE_PHASE_RELAXATION,
    SCENE_PHASE_HERTZ_KNUDSEN,
    SCENE_PHASE_LUA
};
enum scene_phase_direction { SCENE_PHASE_BOTH, SCENE_PHASE_EVAPORATION, SCENE_PHASE_CONDENSATION };

struct scene_phase {
    unsigned liquid, vapour, n_gas, gas[SCENE_MATERIALS];
    bool mixing, everywhere;
    enum scene_phase_rate rate;
    enum scene_phase_direction direction;
    double time;                 /* of relaxation [s] */
    double accommodation, area;  /* of hertz-knudsen [1, 1/m] */
    const struct script *script; /* of lua: function(p, T, p_eq, share, alpha); [kg/m3/s] */
    double tension, superheat;   /* what liquid without vapour bears [Pa, K] */
    double onset;   /* liquid evaporates where vapour and gases fill this share of the cell, or beside such */
    double wet;     /* vapour condenses where the liquid fills this share of the cell */
    double over;    /* cells that sound of the mixture crosses while vapour condenses; 0: at once */
    double nucleus; /* vapour that fills no more of a cell than this does not condense */
    bool apart;     /* gases keep the heat they have: they share pressure and moles alone */
    struct saturation_range curve; /* of liquid and vapour */
};

/* Gases that diffuse through each other: section `gas-diffusion:`. */
struct scene_fick {
    unsigned n, gas[SCENE_MATERIALS];
    bool constant;  /* D is the same everywhere; else it goes with T^1.75/p */
    double D, T, p; /* [m2/s], at this temperature and pressure [K, Pa] */
};

/* One layer of paint. Layers are applied in order; a later one covers an earlier one by its
 * sub-cell volume fraction. */
struct scene_layer {
    struct shape *shape;         /* region; NULL: everywhere */
    bool has_material;           /* else an overlay: only the given fields change */
    double *fractions;           /* [n_material], sum 1 */
    struct scene_value *density; /* [n_material]; not given where the fraction is 0 or temperature is given */
    struct scene_value temperature;
    struct scene_value pressure;
    struct scene_value velocity[SCENE_AXES];
    struct scene_value stretch[6]; /* xx, yy, zz, xy, xz, yz; what is not given is that of the identity */
    const struct script *script;   /* `lua:` layer: returns a table of named fields of (x, y, z) */
    char *checkpoint;              /* of another run, whose state it paints; or NULL */
    double at[SCENE_AXES];         /* where the origin of that run lies here */
    int axis;                      /* along which the axis of an axisymmetric one lies in space; -1: not given */
    struct donor *donor;           /* its cells (case/donor.h), once io/start.h has read them */
    double centre[SCENE_AXES];     /* r in expressions is measured from here */
    int line;                      /* in the case file, for messages */
};

/* Volumetric sources, one value after the other: where those of a kind begin. By axis, by material, and of the stretch
 * xx, yy, zz, xy, xz, yz. */
enum scene_source {
    SCENE_SOURCE_ACCELERATION,                                      /* m/s2 */
    SCENE_SOURCE_FORCE = SCENE_SOURCE_ACCELERATION + SCENE_AXES,    /* N/m3 */
    SCENE_SOURCE_HEATING = SCENE_SOURCE_FORCE + SCENE_AXES,         /* W/m3, of all that is there */
    SCENE_SOURCE_HEATING_OF,                                        /* W per m3 of the material */
    SCENE_SOURCE_MASS = SCENE_SOURCE_HEATING_OF + SCENE_MATERIALS,  /* kg/(m3 s) */
    SCENE_SOURCE_FRACTION = SCENE_SOURCE_MASS + SCENE_MATERIALS,    /* 1/s */
    SCENE_SOURCE_STRETCH = SCENE_SOURCE_FRACTION + SCENE_MATERIALS, /* 1/s */
    SCENE_SOURCES = SCENE_SOURCE_STRETCH + 6
};

/* What acts throughout the domain; values of x, y, z, r, t. What is not given is 0. */
struct scene_sources {
    struct scene_value value[SCENE_SOURCES];
    const struct script *script; /* function(x, y, z, t) that returns a table of them, added to the values; or NULL */
};

enum scene_closure { SCENE_KAPILA, SCENE_ALLAIRE };
enum scene_traction { SCENE_TRACTION_AUTO, SCENE_TRACTION_COMMON, SCENE_TRACTION_PRESSURE };
enum scene_exchange { SCENE_EXCHANGE_AUTO, SCENE_EXCHANGE_FAST, SCENE_EXCHANGE_FULL };
enum scene_integrator { SCENE_MIDPOINT, SCENE_SSPRK3, SCENE_HANCOCK }; /* rows of solve/tableau.c */
enum scene_diffusion { SCENE_DIFFUSION_EXPLICIT, SCENE_DIFFUSION_RKL2 };
enum scene_guard { SCENE_GUARD_NORMAL, SCENE_GUARD_STRICT };

/* `every:`: a time, or a number of steps; both 0: never. */
struct scene_every {
    double time;
    long steps;
};

enum scene_measure {
    SCENE_VOLUME,
    SCENE_MASS,
    SCENE_CENTROID,
    SCENE_MIN,
    SCENE_MAX,
    SCENE_MEAN,
    SCENE_INTEGRAL,
    SCENE_PLANE_INTEGRAL,
    SCENE_TOTAL,
    SCENE_PENETRATION,
    SCENE_EQUIVALENT_RADIUS,
    SCENE_JET_SPEED,
    SCENE_ISOSURFACE_MEAN,
    SCENE_ISOSURFACE_MIN,
    SCENE_ISOSURFACE_MAX,
    SCENE_OUTSIDE,
    SCENE_MIN_BETWEEN,
    SCENE_MAX_BETWEEN,
    SCENE_EVAPORATED,
    SCENE_FORCE,
    SCENE_POWER,
    SCENE_BODY_DISPLACEMENT,
    SCENE_BODY_VELOCITY,
    SCENE_BODY_ANGLE,
    SCENE_VALUE,
};

struct scene_column {
    char name[SCENE_NAME]; /* history.csv header; an identifier */
    enum scene_measure measure;
    int rigid;              /* force, power, body-*: the body */
    int material;           /* volume, mass, centroid, penetration, equivalent-radius, ...: the material; else -1 */
    char field[SCENE_NAME]; /* min, max, mean, integrals, isosurface-*: a field; total: mass | momentum_x.. | energy */
    int in;                 /* restrict to a material (weight alpha, threshold 0.5 for min/max), or -1 */
    struct shape *where;    /* restrict to a region, or NULL */
    int along;              /* axis 0..2 for centroid, penetration, jet-speed, force, body-*; -1: not given */
    unsigned of;            /* min-between, max-between: a column further up */
    const struct script *script; /* value: an expression of other columns */
    char (*uses)[SCENE_NAME];    /* value: its arguments, in order: "t" or columns further up */
    unsigned n_use;
};

struct scene_probe {
    char name[SCENE_NAME];
    double at[SCENE_AXES];
    char (*fields)[SCENE_NAME];
    unsigned n_field;
};

/* A field that the case makes itself: an expression of other fields, of x, y, z and t. */
struct scene_formula {
    char name[SCENE_NAME];
    char *text;
    const struct script *script;
    char (*uses)[SCENE_NAME]; /* its arguments, in order: x, y, z, t or fields of one component */
    unsigned n_use;
};

/* The fields that a module makes, one for each of its outputs: section `fields:`. */
struct scene_derived {
    struct instance law;
    char names[BULLA_FIELD_OUTPUTS][SCENE_NAME];
};

/* What is kept of a field over the run, cell by cell: rows of what a cell keeps, or -1 where nobody asks. A row of a
 * time goes with that of its value. */
struct scene_peak {
    char field[SCENE_NAME];
    int most, least, when_most, when_least;
};

/* Fields over time at places in a row. */
struct scene_map {
    char name[SCENE_NAME];
    unsigned n_point;
    int axis;      /* the coordinate that tells places apart, 0..2; -1: the distance from the first */
    double *place; /* [n_point] m, ascending along an axis or not */
    double
        *second; /* [n_point] m: on a rectangle, the distance along its second side, which varies faster; else NULL */
    unsigned n_side[2]; /* of a rectangle: places along its sides */
    double corner[SCENE_AXES], side[2][SCENE_AXES];
    double (*at)[SCENE_AXES]; /* [n_point] points; NULL: of a surface */
    int material;             /* its surface; else -1 */
    double width;             /* of a surface: that part of it counts at a place which lies within half of this */
    struct shape *where;      /* of a surface: restrict to a region, or NULL */
    char (*fields)[SCENE_NAME];
    unsigned n_field;
};

struct scene_expect {
    char *value; /* expression over history and probe columns; NULL for a norm */
    bool has_at_most, has_at_least, has_equals;
    double at_most, at_least, equals, tolerance, relative; /* equals: |v - equals| <= tolerance + relative |equals| */
    /* norm against a reference CSV */
    char *reference;  /* path, resolved against the case file */
    char *norm;       /* "L1", "L2", "Linf" */
    char *field;      /* a field of the final state (profile along x), or a history/probe column */
    char *column;     /* column of the CSV */
    char *coordinate; /* column of the CSV that holds x or t */
    double scale;     /* the norm is divided by it; 1 by default */
    double order;     /* least order of convergence of a norm that `bulla verify` accepts; 0: none */
    char *label;      /* how the report calls it */
    int line;
};

/* What becomes of the difference between coarse and fine fluxes (model.md 7). */
enum scene_reflux {
    SCENE_REFLUX_CORRECTED, /* conserved fields and fractions; the free stream stays */
    SCENE_REFLUX_PLAIN,     /* fractions without the term of div u, put back to sum 1: for comparison */
    SCENE_REFLUX_OFF,       /* nothing: mass is lost; for comparison */
};

/* A rigid body: an entry of `bodies:`. */
struct scene_rigid {
    char name[SCENE_NAME];
    struct shape *shape; /* where it stands at t = 0 without displacement and angle */
    bool moves;
    struct scene_value displacement[SCENE_AXES], angle; /* of t [m, rad]; not given: `velocity` t, none */
    double velocity[SCENE_AXES];
    double pivot[SCENE_AXES]; /* the angle turns it about this point, which moves along; from x to y */
    double reach;             /* farthest that the domain goes from the pivot [m] */
    double brief; /* so little of time that no run follows what changes in it, a power of two [s]: speeds of what a
                     script moves */
};

/* A criterion of refinement. All of them are limited by where, levels and time. */
struct scene_refine {
    enum scene_refine_kind {
        SCENE_REFINE_GRADIENT,  /* of a field: the larger difference to the two neighbours along an axis, over the cell
                                   size, of the steepest axis. Relative: as JUMP */
        SCENE_REFINE_JUMP,      /* largest difference to a face neighbour; relative: over the larger magnitude of the
                                   two cells */
        SCENE_REFINE_VALUE,     /* the field itself */
        SCENE_REFINE_INTERFACE, /* cells where a material and another are, and where its fraction jumps */
        SCENE_REFINE_SCRIPT,    /* a Lua function that is true or above 0 */
        SCENE_REFINE_REGION,    /* all cells of `where` */
        SCENE_REFINE_BODIES     /* cells that rigid bodies cut: not written, always there with bodies */
    } kind;
    char field[SCENE_NAME]; /* of vectors: the largest component of a difference, the magnitude of a value */
    const char *unit;       /* of the field, "1" for pure numbers; NULL without one */
    bool relative;          /* GRADIENT, JUMP */
    bool has_above, has_below;
    double above, below; /* thresholds in the unit of the quantity; below: VALUE only */
    int material;        /* INTERFACE; else -1 */
    const struct script *script;
    char (*uses)[SCENE_NAME]; /* arguments of the script, in order: x, y, z, t or fields of one component */
    unsigned n_use;
    struct shape *where;    /* or NULL; a cell counts if it covers any of it */
    int finest;             /* finest level that this criterion asks for, at most `levels` */
    double t_from, t_until; /* s; both included; infinity: no end */
    int line;               /* in the case file */
};

/* Section `domain:`. */
struct scene_domain {
    int dim;        /* 1, 2, 3 */
    int n_velocity; /* components of the velocity: dim, or more with motion across the axes; around one: r, z, th */
    enum scene_geometry geometry;
    double lower[SCENE_AXES], upper[SCENE_AXES];
    int cells[SCENE_AXES];                         /* 1 beyond dim */
    char *cells_place;                             /* of the key, as file:line:column, for messages */
    struct scene_boundary boundary[SCENE_AXES][2]; /* [axis][0 lower, 1 upper] */
};

/* What the curvature of a ball around the origin is over 1/R. */
static inline int scene_domain_turns(const struct scene_domain *domain)
{
    return domain->dim - 1 + (int)domain->geometry;
}

/* Has matter a velocity around the axis? */
static inline bool scene_domain_swirls(const struct scene_domain *domain)
{
    return domain->geometry == SCENE_AXISYMMETRIC && domain->n_velocity == 3;
}

/* Section `mesh:`. */
struct scene_mesh {
    int levels, tile;         /* levels above the coarsest; tile 0: chosen by the mesh */
    int regrid_every, buffer; /* steps of a level between regrids of the finer ones; cells refined around a tag */
    int patience;             /* regrids in a row that must find a tile unwanted before it goes */
    bool subcycle;            /* finer levels take smaller steps */
    enum scene_reflux reflux;
    double memory_limit; /* bytes of all ranks that blocks of tiles may take (--max-memory); 0: no limit */
    unsigned n_refine;
    struct scene_refine *refines;
};

/* Section `scheme:`. */
struct scene_scheme {
    enum scene_closure closure;
    struct instance riemann, reconstruction, limiter;
    struct instance interface_limiter; /* of the volume fractions */
    bool slanted;                      /* it acts as far as surfaces lie across an axis (scheme/slant.h) */
    struct instance along_limiter;     /* of what is then left to axes along surfaces; no module: `limiter` */
    int ghosts;                        /* layers of neighbours that the reconstruction needs on each side of a tile */
    double cfl, dt_fixed;              /* dt_fixed 0: from cfl */
    double first_step;                 /* part of that step with which a run begins */
    enum scene_traction traction;      /* what the materials of a cell with a solid share */
    bool sheltered;                    /* solids are strained by what comes to the faces (scheme/shelter.h) */
    bool free;                         /* surfaces of solids beside fluids bear no shear (scheme/slip.h) */
    enum scene_exchange exchange;      /* of volume between the materials of a cell */
    enum scene_integrator integrator;
    enum scene_diffusion diffusion; /* how viscosity and conduction are stepped (solve/rkl.h) */
    enum scene_guard guard;
    bool wood;       /* faces of mixtures that expand have Wood's speed (scheme/wood.h) */
    double low_mach; /* least part of a jump of velocity that faces see (scheme/low_mach.h); 1: all of it */
    bool calm;       /* faces beside strong shocks resist shear (scheme/calm.h) */
};

/* Section `run:`. */
struct scene_run {
    double until;    /* s */
    long max_steps;  /* 0: no limit */
    double dt_least; /* s; below 0: the program's choice (solve/pace.h) */
};

/* Section `output:`. */
struct scene_output {
    char *directory; /* resolved against the working directory */
    struct scene_every snapshots, history, probes_every, maps_every, checkpoints;
    bool history_finest;     /* steps of the history are those of the finest level */
    double checkpoints_wall; /* s of wall time between two checkpoints; 0: they do not count */
    int checkpoints_keep;
    int writers; /* of snapshots and checkpoints; 0: one per machine */
    char (*snapshot_fields)[SCENE_NAME];
    unsigned n_snapshot_field;
    bool snapshot_double;   /* float64 instead of float32 */
    double snapshot_memory; /* bytes that a writer may take to write snapshots beside the run */
    unsigned n_column, n_probe, n_map;
    struct scene_column *columns;
    struct scene_probe *probes;
    struct scene_map *maps;
    unsigned n_formula;
    struct scene_formula *formulas;
    unsigned n_peak, n_kept; /* n_kept: rows that all of them keep */
    struct scene_peak *peaks;
    double peaks_from, peaks_until; /* s; both included; infinity: no end */
};

/* A case, one part per section. */
struct scene {
    char *path, *name; /* of the case file; base name without extension */
    char *title, *about, *cite;
    char *resolved; /* the fully resolved case as YAML text */
    struct scene_domain domain;
    struct scene_mesh mesh;
    unsigned n_material;
    struct scene_material material[SCENE_MATERIALS];
    unsigned n_tension;
    struct scene_tension tension[SCENE_PAIRS];
    unsigned n_phase;
    struct scene_phase phases[SCENE_PHASES];
    unsigned n_fick;
    struct scene_fick ficks[SCENE_PHASES];
    unsigned n_rigid;
    struct scene_rigid rigids[SCENE_RIGIDS]; /* `bodies:` */
    unsigned n_layer;
    struct scene_layer *layers;    /* `initial:` */
    struct scene_sources *sources; /* NULL: none */
    struct scene_scheme scheme;
    unsigned n_derived;
    struct scene_derived *derived;
    struct scene_run run;
    struct scene_output output;
    unsigned n_expect;
    struct scene_expect *expects;
    struct script_host *host; /* the Lua state all scripts live in */
    unsigned n_variant, n_setting;
    char **variants; /* names that --variant takes, "quick" among them if the case has it */
    char **settings; /* of `matrix:`, "path=value", one by one; at most SCENE_SETTINGS */
};

/* Value at a point; `t` in s. A script error returns STATUS_CASE with the line of the case file. */
int scene_value_at(const struct scene_value *value, const double x[SCENE_AXES], double r, double t, double *ret);

/* The tile side that the program takes where a case gives none, or 0 if none divides the cells: 16 in 2D and 3D and 64
 * in 1D, or the largest divisor below; with refinement 8 and 16, or the nearest even one, larger if the tiles of the
 * finest level were too many (docs/decisions/tiles.md). */
int scene_mesh_tile(const struct scene *scene);

void scene_free(struct scene *scene);

/* The instances of a scene, one after the other from 0: of materials, scheme, boundaries, fields. Some have no module.
 * NULL after the last. */
struct instance *scene_instance(struct scene *scene, unsigned index);

/* The limiter that fractions have along their surface where `slant` is not 0. */
const struct instance *scene_instance_along(const struct scene_scheme *scheme);

/* The pair whose vapour a material is, or NULL. */
const struct scene_phase *scene_phase_of(const struct scene *scene, unsigned material);

#endif
