/* schema.h - the JSON Schema (draft-07) of case files, for editors.
 *
 * Made from the same tables that read cases, with the parameter tables of all modules that are
 * loaded: nothing is described twice. */
#ifndef SCHEMA_H
#define SCHEMA_H

/* The schema as JSON text, indented, with a newline at its end; free with mem_free. The
 * modules must have been found (registry_init). */
char *schema_text(void);

#endif
