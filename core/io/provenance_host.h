/* provenance_host.h - the surroundings of a run, for provenance.json: environment, processor, compilation. */
#ifndef PROVENANCE_HOST_H
#define PROVENANCE_HOST_H

#include <jansson.h>

/* Variables that can change what runs or how fast: those of bulla, OpenMP, Open MPI, SLURM, the loader, the locale.
 * What the launcher of Open MPI tells its own processes is left out. */
json_t *provenance_host_environment(void);

/* {model, processors}: of the machine of rank 0. */
json_t *provenance_host_cpu(void);

/* How the program was compiled: "optimised, without assertions: -O3 -DNDEBUG ...". */
json_t *provenance_host_flags(void);

#endif
