/* scene_draft.h - what the scene_*.c files share while a tree becomes a scene.
 *
 * Every section has one file with its table (what may be written) and its function (what it
 * means). The functions record mistakes and go on: all of a case's errors come in one pass. */
#ifndef SCENE_DRAFT_H
#define SCENE_DRAFT_H

#include "case/keys.h"
#include "case/scene.h"

struct draft {
    struct keys keys;
    struct scene *scene;
    const struct keys_map *root;
};

extern const struct keys_section scene_root_keys;
extern const struct keys_section scene_domain_keys, scene_mesh_keys, scene_refine_keys, scene_boundary_keys;
extern const struct keys_section scene_material_keys, scene_scheme_keys, scene_phase_keys, scene_fick_keys,
    scene_rigid_keys;
extern const struct keys_section scene_shape_keys, scene_initial_keys, scene_stretch_keys, scene_source_keys;
extern const struct key scene_state_rows[]; /* material, density, pressure ...: of layers and inflows */
extern const struct keys_section scene_pulse_units;
extern const struct keys_section *const scene_boundary_pulse_cases[]; /* ends with NULL */
extern const struct keys_section scene_output_keys, scene_history_column_keys, scene_map_list_keys, scene_cloud_keys,
    scene_expect_keys, scene_peak_keys, scene_derived_keys;

/* In the order in which they are called; each reads its section of draft->root. */
void scene_domain(struct draft *draft);
void scene_material(struct draft *draft);
void scene_scheme(struct draft *draft);
void scene_heat(struct draft *draft);
void scene_mesh(struct draft *draft);
void scene_derived(struct draft *draft);
void scene_refine(struct draft *draft);
void scene_boundary(struct draft *draft);
void scene_tension(struct draft *draft);
void scene_contact(struct draft *draft);
void scene_phase(struct draft *draft);

/* Does a stiff elastic solid that shares its traction meet a gas, on a surface that lies as it likes? */
bool scene_meet_hard(struct draft *draft);
/* Have fluids, and there is no solid, surface tension on surfaces that lie as they like? */
bool scene_meet_drawn(struct draft *draft);
/* What `surface-shear`, `surface-strain` and `interface-along` say: see the fields of struct scene_scheme. */
bool scene_meet_free(struct draft *draft, const struct keys_map *scheme);
bool scene_meet_sheltered(struct draft *draft, const struct keys_map *scheme);
bool scene_meet_slanted(struct draft *draft, const struct keys_map *scheme); /* limiters are open */
/* Warns of keys that say how solids meet fluids, in a scene that has no solid. */
void scene_meet_idle(struct draft *draft, const struct keys_map *scheme);

/* scene_phase_surface.c: keys of a pair that say in which cells of a surface it changes phase, read from its map when
 * its rate, places and gases are known. Not given: 0.99 as onset, 0.9 as condense-from where scene_phase_surface_fed.
 */
void scene_phase_surface(struct draft *draft, const struct keys_map *map, struct scene_phase *pair);

/* Does heat that the liquid conducts decide what evaporates and condenses at the surface of a pair? */
bool scene_phase_surface_fed(const struct scene *scene, const struct scene_phase *pair);

/* Is the scene one of boiling mixtures: nothing but liquids and their vapours, whose surfaces are not resolved? */
bool scene_phase_surface_boils(const struct scene *scene);

/* Does a layer of the initial state hold more than a trace of both, as bubbly mixtures do? */
bool scene_phase_surface_mixed(const struct scene_phase *pair, const struct scene_layer *layer);

/* What `condense-over` is where it is not given, for which the initial state has to be known: 8 where mixtures are
 * painted and no surfaces are meant (neither `onset` nor `condense-from`). */
void scene_phase_surface_late(struct draft *draft);

/* Gas constant of the law of a material [J/(kg K)]; 0: it becomes no ideal gas, or does not say. */
double scene_phase_gas(const struct scene *scene, unsigned material);

void scene_fick(struct draft *draft);
void scene_initial(struct draft *draft);
void scene_rigid(struct draft *draft);
void scene_diffusion(struct draft *draft);

/* Index of a body, or -1 after a recorded error with a suggestion. */
int scene_rigid_index(struct draft *draft, const struct keys_value *value);

void scene_source(struct draft *draft);
void scene_hancock(struct draft *draft);
void scene_swirl(struct draft *draft);
void scene_output(struct draft *draft);
void scene_peak(struct draft *draft);
void scene_history(struct draft *draft);
void scene_map(struct draft *draft);
void scene_expect(struct draft *draft);

/* "one+other", the name of a pair, into two materials, neither the same nor unknown; false after a recorded error. */
bool scene_tension_split(struct draft *draft, const struct keys_value *pair, unsigned *ret_one, unsigned *ret_other);

/* Index of the pair that has a surface tension, in whatever order; n_tension: none. */
unsigned scene_tension_find(const struct scene *scene, unsigned one, unsigned other);

/* `balance: tension` of layer `index`: the pressure inside is made the given one and what surface tension adds. */
void scene_tension_balance(struct draft *draft, const struct keys_value *balance, unsigned index);

/* What is wrong about the velocity of the wall at a face of the domain, if it is one. */
void scene_wall(struct draft *draft, int axis, int side, const struct keys_map *map);

/* The table of times and pressures of a measured pulse. */
void scene_pulse(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map);

/* Is it a key of a pulse, which goes when the pulse changes? Those of all incoming waves are not. */
bool scene_pulse_owns(const char *key);

/* Of space-time maps: how many places there are if there could be `fine`, one per cell of the finest level; whether a
 * point, a list of numbers, is in the domain, else an error is recorded. */
enum { SCENE_MAP_MOST = 100000 }; /* places */
unsigned scene_map_count(const struct keys_value *points, double fine);
bool scene_map_inside(struct draft *draft, const struct keys_value *value, const double *x);

/* The places of a map along a circle, or straight pieces; none after a recorded error. `rows`: of the map. */
extern const struct keys_section scene_curve_circle_keys, scene_curve_polyline_keys;
void scene_curve_read_circle(struct draft *draft, struct scene_map *map, const struct keys_map *rows);
void scene_curve_read_polyline(struct draft *draft, struct scene_map *map, const struct keys_map *rows);

/* Of curves and rectangles: has the domain two axes, or else an error? The axis along which a place lies outside of the
 * domain, or -1, after round-off beyond a face is taken away. Room for n places. */
bool scene_curve_has_axes(struct draft *draft, const struct keys_value *value);
int scene_curve_outside(const struct scene *scene, double x[SCENE_AXES]);
void scene_curve_room(struct scene_map *map, unsigned n_point);

/* The places of a map on a rectangle; none after a recorded error. */
extern const struct keys_section scene_plane_keys;
void scene_plane_read(struct draft *draft, struct scene_map *map, const struct keys_map *rows);

/* One point of a list of points: its numbers, not given after a recorded error. */
const struct keys_value *scene_shape_vertex(struct draft *draft, struct node *node, const char *path);

/* Releases the maps of a scene. */
void scene_map_done(struct scene *scene);

/* Warns about parameters that nothing uses, those of overlays that are not applied included. */
void scene_spare(struct draft *draft, const struct node *root);

/* Warns about what a right scene asks for and never gets (materials that are nowhere, outputs after the end, regions
 * outside), and about what its cells are too coarse for (waves, bubbles). */
void scene_idle(struct draft *draft, const struct node *root);
void scene_coarse(struct draft *draft);
void scene_boil(struct draft *draft);
void scene_condense(struct draft *draft);

/* The pressure and temperature of material l of an initial layer as numbers; false: scripts give them, or there are
 * none. */
bool scene_boil_state(const struct scene *scene, const struct scene_layer *layer, unsigned l, double *ret_p,
                      double *ret_T);

/* Width of the cells of the finest level along an axis [m]. */
double scene_domain_width(const struct scene *scene, int axis);

/* Axis 0..2 that an `along:` names, or -1, perhaps after a recorded error. */
int scene_domain_axis(struct draft *draft, const struct keys_value *along);

/* A list of `dim` numbers into ret[3] (rest 0); false after a recorded error. */
bool scene_domain_vector(struct draft *draft, const struct keys_value *value, double ret[SCENE_AXES]);

/* The same, of length 1; a vector without a length is an error. */
bool scene_domain_direction(struct draft *draft, const struct keys_value *value, double ret[SCENE_AXES]);

/* Index of a material, or -1 after a recorded error with a suggestion. */
int scene_matter_index(struct draft *draft, const struct keys_value *value);

/* Has a material a constitutive law, be it right or wrong? The name of the first one that has, or NULL. */
bool scene_matter_is_solid(const struct draft *draft, unsigned material);
const char *scene_matter_solid(const struct draft *draft);

/* 0: no material has a strength; 1: some has; 2: and it knows its plastic strain. */
unsigned scene_matter_strength(const struct draft *draft);

/* Refuses what looks at temperatures (`what`, at `asking`) of a material of whose specific heat nothing is said. */
void scene_matter_warm(struct draft *draft, const struct keys_value *asking, const struct scene_material *material,
                       const char *what);

/* Can any material break? */
bool scene_matter_breaks(const struct draft *draft);

/* How the material that `entry` describes breaks, whose other laws are open; its keys. */
void scene_damage(struct draft *draft, const struct keys_map *entry, struct scene_material *material);
extern const struct keys_section scene_damage_keys;

/* What fills the voids of solids, once all materials are known; how fast they may break, once the mesh is. */
void scene_damage_voids(struct draft *draft);
void scene_damage_times(struct draft *draft);

/* Has any material a Maxwell branch? */
bool scene_matter_branched(const struct draft *draft);

/* Has any material a conductivity of heat? */
bool scene_matter_conducts(const struct draft *draft);
bool scene_matter_viscous(const struct draft *draft);

/* The Maxwell branches of the material that `entry` describes, whose elastic law is open; keys of one branch. */
void scene_branch(struct draft *draft, const struct keys_map *entry, struct scene_material *material);
extern const struct keys_section scene_branch_keys;

/* Refuses branches that relax within a step of the finest level, warns of those of the coarsest one: once mesh and
 * scheme are known. */
void scene_branch_times(struct draft *draft);

/* Opens the module that a section names; nothing happens if the section is wrong. */
void scene_matter_open(struct draft *draft, const struct keys_value *value, struct instance *ret_instance);

/* A file name as seen from the file it stands in: absolute if that exists; in the forest. */
const char *scene_file_beside(struct forest *forest, const struct source *source, const char *name);

/* Path of a file that the case names, relative to the file the name stands in; in the forest.
 * The node is rewritten to the absolute path. */
const char *scene_file(struct draft *draft, const struct keys_value *value);

/* Lua given as a file name (ends in .lua) or as a block; NULL after a recorded error. A file's
 * text takes the place of its name in the tree. */
const struct script *scene_file_lua(struct draft *draft, const struct keys_value *value);

/* Number or script of a value; not given if it is absent. */
struct scene_value scene_state_value(const struct keys_value *value);

/* material/fractions of a state -> volume fractions by material, NULL if neither is given or
 * one is wrong (recorded). */
double *scene_state_fractions(struct draft *draft, const struct keys_map *map);

/* density: of a state, by material (never NULL); `fractions` NULL: of an overlay. */
struct scene_value *scene_state_density(struct draft *draft, const struct keys_map *map, const double *fractions);

/* Records an error if the state, as far as it is constant, is none that the materials' laws know. */
void scene_state_check(struct draft *draft, const struct keys_map *map, const double *fractions,
                       const struct scene_value *density);

/* Warns if a state of one material is far from all that its law is stated for. `temperature`: the given one, or 0;
 * `value`: what says the density, for the place. */
void scene_far(struct draft *draft, unsigned material, double rho, double p, double temperature,
               const struct keys_value *value);

/* A list of as many values as velocities have components; nothing after a recorded error. */
void scene_state_vector(struct draft *draft, const struct keys_value *value, struct scene_value ret[SCENE_AXES]);

/* Velocity components that component `c` of a stretch (xx, yy, zz, xy, xz, yz) needs. */
int scene_stretch_needs(unsigned component);

/* stretch: of a layer whose fractions are known. */
void scene_stretch(struct draft *draft, struct scene_layer *layer, const struct keys_value *value);

/* Shapes from files and turned ones, read into a zeroed shape; false after a recorded error. `part`, which must be a
 * shape, becomes part of it, or is freed. */
extern const struct keys_section scene_body_surface_keys, scene_body_image_keys, scene_body_array_keys,
    scene_body_turned_keys, scene_body_prism_keys;
bool scene_body_surface(struct draft *draft, struct shape *shape, const struct keys_map *map);
bool scene_body_raster(struct draft *draft, struct shape *shape, const struct keys_map *map, bool image);
bool scene_body_turned(struct draft *draft, struct shape *shape, struct shape *part, const struct keys_map *map);
bool scene_body_prism(struct draft *draft, struct shape *shape, struct shape *part, const struct keys_map *map);

/* The way of a wave at the face across `axis` on this side; nothing if the case names none. */
extern const struct keys_section scene_beam_plane_keys, scene_beam_focus_keys;
void scene_beam(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map, int axis, int side);

/* Where the waves come from that leave through a non-reflecting face: its `origin`; the centre of a ball. */
void scene_beam_origin(struct draft *draft, struct scene_boundary *boundary, const struct keys_map *map, int axis,
                       int side);

/* Its speed of sound, if the case does not say: that at the face at the start [m/s]; NaN, not known, is an error. */
void scene_beam_speed(struct draft *draft, struct scene_boundary *boundary, const struct keys_value *value,
                      double sound);

/* The shape that a map names by its key (`ret_value`); NULL if it names none (an error if one is
 * wanted), or after a recorded error. */
struct shape *scene_shape(struct draft *draft, const struct keys_map *map, bool wanted,
                          const struct keys_value **ret_value);

/* Puts the layers that `repeat:` stands for into the list of layers, before it is read. */
void scene_repeat(struct draft *draft, struct node *layers);

/* The layers, in a list of the forest, that a layer with `cloud:` stands for; none after a recorded error. */
struct node *scene_cloud(struct draft *draft, const struct keys_value *value, const struct node *layer);

/* What a field is, for those who compare its values with a number. */
struct scene_field {
    const char *name, *unit;
    unsigned is; /* SCENE_FIELD_... */
};
enum {
    SCENE_FIELD_VECTOR = 1,
    SCENE_FIELD_POSITIVE = 2,  /* everywhere above 0 */
    SCENE_FIELD_VANISHING = 4, /* 0 in fluid at rest, or where a material is absent */
    SCENE_FIELD_FRACTION = 8,  /* from 0 to 1 */
    SCENE_FIELD_SIGNED = 16,   /* VANISHING, with either sign */
};

/* All fields of the scene, ended by a NULL name; one of them, or NULL. In the forest. */
const struct scene_field *scene_field_all(struct draft *draft);
const struct scene_field *scene_field_find(struct draft *draft, const char *name);

/* Has a field three components, each with a column of its own? */
bool scene_field_is_vector(const char *name);

/* For the schema: the fields of every case and of those with a solid, and what with _MATERIAL is one. NULL-terminated,
 * in the forest. */
const char *const *scene_field_always(struct forest *forest);
const char *const *scene_field_each(struct forest *forest);

/* Why a field has one value in all cells of a level: "0 everywhere: ..."; NULL: it varies. */
const char *scene_field_constant(struct draft *draft, const char *name);

/* Of `max_pressure`: notes that it is to be kept, and what kind of field it is; false if the name is none of a peak, or
 * of none of the fields that the scene has by itself (`names`). */
bool scene_peak_find(struct draft *draft, const char *name, const char *const *names);

/* May a name be one of a peak? */
bool scene_peak_is(const char *name);

/* Appends the peaks that are kept to a list of fields with room for four times as many; returns how many. */
unsigned scene_peak_list(struct draft *draft, const struct scene_field *fields, struct scene_field *list);

/* Compiles an expression of x, y, z, t and fields of one component; `uses` has room for SCRIPT_ARGUMENTS. False after a
 * recorded error. */
bool scene_formula_compile(struct draft *draft, const struct keys_value *value, const struct node *node,
                           char (*uses)[SCENE_NAME], unsigned *ret_n_use, const struct script **ret_script);

/* Notes an argument of a script; false after a recorded error. May it be one? The list of those that may, as help. */
bool scene_formula_use(struct draft *draft, const struct keys_value *value, const char *name, char (*uses)[SCENE_NAME],
                       unsigned *n_use);
bool scene_formula_argument(struct draft *draft, const char *name);
void scene_formula_help(struct draft *draft);

/* Is the value an expression? Then a field of the case is made of it. `name`: of one that has none; NULL: it needs
 * one. */
bool scene_formula_is(const struct keys_value *value);
bool scene_formula(struct draft *draft, const struct keys_value *value, const char *name, char ret_name[SCENE_NAME]);

/* Records why a field that other scenes have is none of this one; false: no scene has it. */
bool scene_field_miss(struct draft *draft, const struct keys_value *value);

/* Checks a field name and copies it; false after a recorded error. */
bool scene_field_name(struct draft *draft, const struct keys_value *value, char ret_name[SCENE_NAME]);
bool scene_field_name_list(struct draft *draft, const struct keys_value *list, char (**ret_names)[SCENE_NAME],
                           unsigned *ret_count);

#endif
