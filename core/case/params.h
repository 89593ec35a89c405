/* params.h - the case's parameters, and every expression that uses them.
 *
 * A scalar that begins with "=" is a Lua expression. A parameter may use parameters above or
 * below it. Inside expressions all parameters are plain numbers in SI. */
#ifndef PARAMS_H
#define PARAMS_H

#include "case/script.h"
#include "case/tree.h"

#define PARAMS_FIELD "x,y,z,r,t" /* what an expression for a field may use */

enum { PARAMS_WORD = 64 };

struct params;

struct params *params_new(struct forest *forest, struct diag *diag, struct script_host *host);
void params_free(struct params *params);

/* Reads the `parameters:` map (NULL is fine), evaluates all, and makes them known to scripts.
 * The scalars of the map become plain numbers. */
void params_read(struct params *params, struct node *map);

/* Is it a scalar that begins with "=" ? */
bool params_is_expression(const struct node *node);

/* The next free name in a Lua text (no field of a table, no string); false at the end. `at` moves on. */
bool params_next(const char **at, char ret_name[static PARAMS_WORD]);

/* Does a Lua text mention one of the names "x,y,z" as a free name? */
bool params_mentions(const char *text, const char *names);

/* The value of an expression that uses parameters only. `path`: what messages call the place.
 * False after a recorded error. */
bool params_evaluate(struct params *params, const struct node *node, const char *path, double *ret_value);

/* An expression of `arguments`, kept as a script. A leading "=" is not needed. */
bool params_compile(struct params *params, const struct node *node, const char *path, const char *arguments,
                    const struct script **ret_script);

/* A Lua chunk that returns a function. `where`: the source and line in which `text` begins. */
bool params_compile_chunk(struct params *params, const struct mark *where, const char *path, const char *text,
                          const struct script **ret_script);

/* Notes the parameters that a text evaluated elsewhere uses. */
void params_keep(struct params *params, const char *text);

/* Is it the name of a parameter? */
bool params_has(const struct params *params, const char *name);

/* Notes the parameters that any scalar below a node mentions: overlays that are not applied now. */
void params_spare(struct params *params, const struct node *node);

/* Warns about parameters that nothing used. */
void params_warn_unused(struct params *params);

/* Takes those out of the map that no remaining script uses: their values have been put in. */
void params_prune(struct params *params, struct node *map);

#endif
