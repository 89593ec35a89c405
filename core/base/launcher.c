/* launcher.c - see launcher.h. Sources: sbatch(1), srun(1) and slurm.h of Slurm, flux-environment(7),
 * pbs_job_environment, the LSF reference, the simple PMI of MPICH, mpirun(1) of Open MPI, the PMIx standard. */
#include "base/launcher.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

extern char **environ;

/* Slurm keeps the numbers above this one for what is no step of srun: the batch script, the shell of salloc. */
#define LAUNCHER_LAST_STEP 0xfffffff0ull

enum launcher_value { LAUNCHER_ANY, LAUNCHER_STEP };

/* The first row decides whose `mark` is set to a value of this kind. Inner launchers come before outer ones: mpirun in
 * a step of srun, a Flux in a job of Slurm. The shell that salloc opens may carry PMIX_RANK, so PMIx comes after
 * Slurm. */
static const struct launcher_row {
    const char *name;
    const char *mark;
    enum launcher_value value;
    const char *size; /* the variable that has the number of ranks; NULL: none has */
    bool is_rank;
} launcher_rows[] = {
    {"Open MPI's mpirun", "OMPI_COMM_WORLD_RANK", LAUNCHER_ANY, "OMPI_COMM_WORLD_SIZE", true},
    {"Open MPI's mpirun", "OMPI_COMM_WORLD_SIZE", LAUNCHER_ANY, "OMPI_COMM_WORLD_SIZE", true},
    {"a launcher with PMI", "PMI_RANK", LAUNCHER_ANY, "PMI_SIZE", true}, /* Hydra of MPICH, srun --mpi=pmi2 */
    {"flux run", "FLUX_TASK_RANK", LAUNCHER_ANY, "FLUX_JOB_SIZE", true},
    {"Flux", "FLUX_URI", LAUNCHER_ANY, NULL, false},
    {"srun", "SLURM_STEP_ID", LAUNCHER_STEP, "SLURM_STEP_NUM_TASKS", true},
    {"Slurm", "SLURM_STEP_ID", LAUNCHER_ANY, NULL, false},
    {"srun", "SLURM_STEPID", LAUNCHER_STEP, "SLURM_STEP_NUM_TASKS", true},
    {"Slurm", "SLURM_STEPID", LAUNCHER_ANY, NULL, false},
    {"a launcher with PMIx", "PMIX_RANK", LAUNCHER_ANY, NULL, true},
    {"Slurm", "SLURM_JOB_ID", LAUNCHER_ANY, NULL, false},
    {"Slurm", "SLURM_JOBID", LAUNCHER_ANY, NULL, false},
    {"PBS", "PBS_JOBID", LAUNCHER_ANY, NULL, false},
    {"LSF", "LSB_JOBID", LAUNCHER_ANY, NULL, false},
    {"Grid Engine", "JOB_ID", LAUNCHER_ANY, NULL, false},
};

/* NULL where it is not set, or empty. */
static const char *launcher_value(char *const *environment, const char *name)
{
    size_t length = strlen(name);
    for (; *environment; environment++)
        if (!strncmp(*environment, name, length) && (*environment)[length] == '=')
            return (*environment)[length + 1] ? *environment + length + 1 : NULL;
    return NULL;
}

/* A whole number; -1 for anything else. */
static long long launcher_number(const char *text)
{
    char *end = NULL;
    long long number = text && *text >= '0' && *text <= '9' ? strtoll(text, &end, 10) : -1;
    return end && !*end ? number : -1;
}

/* Does a process manager speak to this process? All of them (PMI, PMI2, PMIx) set variables that begin so. */
static bool launcher_speaks(char *const *environment)
{
    for (; *environment; environment++)
        if (!strncmp(*environment, "PMI", 3)) return true;
    return false;
}

static bool launcher_fits(const struct launcher_row *row, const char *value)
{
    if (!value || row->value == LAUNCHER_ANY) return value != NULL;
    long long number = launcher_number(value);
    return number >= 0 && (unsigned long long)number <= LAUNCHER_LAST_STEP;
}

struct launcher launcher_find(char *const *environment)
{
    for (size_t i = 0; i < sizeof launcher_rows / sizeof *launcher_rows; i++) {
        const struct launcher_row *row = &launcher_rows[i];
        if (!launcher_fits(row, launcher_value(environment, row->mark))) continue;
        long long size = row->size ? launcher_number(launcher_value(environment, row->size)) : 0;
        bool is_mute = size > 0 && row->value == LAUNCHER_STEP && !launcher_speaks(environment);
        return (struct launcher){row->name, row->is_rank, size > 0 ? (long)size : 0, is_mute};
    }
    return (struct launcher){0};
}

struct launcher launcher_here(void)
{
    return launcher_find(environ);
}
