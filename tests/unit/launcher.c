/* launcher.c - ranks are told from shells of batch jobs, environment by environment. */
#include "base/launcher.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

static const struct {
    const char *what, *name; /* name: "" where there is no launcher */
    bool is_rank;
    long size;
    const char *environment[8];
} table[] = {
    {"a laptop", "", false, 0, {"HOME=/root", "PATH=/bin"}},
    {"nothing", "", false, 0, {NULL}},
    {"an sbatch script", "Slurm", false, 0, {"SLURM_JOB_ID=7", "SLURM_PROCID=0", "SLURM_NTASKS=64", "SLURM_LOCALID=0"}},
    {"an old sbatch script", "Slurm", false, 0, {"SLURM_JOBID=7", "SLURM_PROCID=0"}},
    {"a batch step by name", "Slurm", false, 0, {"SLURM_JOB_ID=7", "SLURM_STEP_ID=batch", "SLURM_PROCID=0"}},
    {"a batch step by number", "Slurm", false, 0, {"SLURM_JOB_ID=7", "SLURM_STEPID=4294967291"}},
    {"a shell of salloc",
     "Slurm",
     false,
     0,
     {"SLURM_STEP_ID=4294967290", "SLURM_STEP_NUM_TASKS=1", "PMIX_RANK=0", "PMIX_NAMESPACE=slurm.pmix.7.4294967290"}},
    {"the last step", "srun", true, 2, {"SLURM_STEP_ID=4294967280", "SLURM_STEP_NUM_TASKS=2"}},
    {"behind the last step", "Slurm", false, 0, {"SLURM_STEP_ID=4294967281", "SLURM_STEP_NUM_TASKS=2"}},
    {"srun, the first step", "srun", true, 64, {"SLURM_JOB_ID=7", "SLURM_STEP_ID=0", "SLURM_STEP_NUM_TASKS=64"}},
    {"srun with PMIx",
     "srun",
     true,
     64,
     {"SLURM_STEPID=3", "PMIX_RANK=5", "PMIX_NAMESPACE=slurm.pmix.7.3", "SLURM_STEP_NUM_TASKS=64"}},
    {"srun with pmi2", "a launcher with PMI", true, 8, {"SLURM_STEP_ID=0", "PMI_RANK=3", "PMI_SIZE=8"}},
    {"srun that hides its size", "srun", true, 0, {"SLURM_STEP_ID=0"}},
    {"a step that is no number", "Slurm", false, 0, {"SLURM_STEP_ID=0x", "SLURM_STEP_NUM_TASKS=2"}},
    {"mpirun", "Open MPI's mpirun", true, 4, {"OMPI_COMM_WORLD_RANK=3", "OMPI_COMM_WORLD_SIZE=4", "PMIX_RANK=3"}},
    {"mpirun in an sbatch script",
     "Open MPI's mpirun",
     true,
     2,
     {"SLURM_JOB_ID=7", "SLURM_PROCID=0", "OMPI_COMM_WORLD_RANK=0", "OMPI_COMM_WORLD_SIZE=2"}},
    {"mpirun in a step of one",
     "Open MPI's mpirun",
     true,
     4,
     {"SLURM_STEP_ID=0", "SLURM_STEP_NUM_TASKS=1", "OMPI_COMM_WORLD_RANK=0", "OMPI_COMM_WORLD_SIZE=4"}},
    {"Hydra", "a launcher with PMI", true, 16, {"PMI_RANK=0", "PMI_SIZE=16", "PMI_FD=7"}},
    {"Hydra in PBS", "a launcher with PMI", true, 16, {"PBS_JOBID=7.server", "PMI_RANK=0", "PMI_SIZE=16"}},
    {"PMIx alone", "a launcher with PMIx", true, 0, {"PMIX_RANK=0", "PMIX_NAMESPACE=prterun-1"}},
    {"PMIx in LSF", "a launcher with PMIx", true, 0, {"LSB_JOBID=7", "PMIX_RANK=0"}},
    {"flux run", "flux run", true, 4, {"FLUX_URI=local:///x", "FLUX_TASK_RANK=1", "FLUX_JOB_SIZE=4"}},
    {"flux batch", "Flux", false, 0, {"FLUX_URI=local:///x"}},
    {"flux batch in Slurm", "Flux", false, 0, {"FLUX_URI=local:///x", "SLURM_STEP_ID=0", "SLURM_STEP_NUM_TASKS=2"}},
    {"a PBS script", "PBS", false, 0, {"PBS_JOBID=7.server", "PBS_NODEFILE=/x", "PBS_ENVIRONMENT=PBS_BATCH"}},
    {"an LSF script", "LSF", false, 0, {"LSB_JOBID=7", "LSB_JOBINDEX=0"}},
    {"a Grid Engine script", "Grid Engine", false, 0, {"JOB_ID=7"}},
    {"a name that only begins so", "", false, 0, {"PMI_RANKS=3", "SLURM_JOB_ID_X=1"}},
    {"empty values", "", false, 0, {"PMI_RANK=", "SLURM_JOB_ID="}},
    {"a size that is no number", "a launcher with PMI", true, 0, {"PMI_RANK=0", "PMI_SIZE=two"}},
};

static void environments_say_who_started_the_process(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        struct launcher found = launcher_find((char *const *)(uintptr_t)table[i].environment);
        const char *name = found.name ? found.name : "";
        if (strcmp(name, table[i].name) || found.is_rank != table[i].is_rank || found.size != table[i].size)
            fail_msg("%s: '%s', rank %d of %ld", table[i].what, name, found.is_rank, found.size);
    }
}

static void a_step_without_pmi_is_mute(void **state)
{
    (void)state;
    static const struct {
        bool is_mute;
        const char *environment[6];
    } steps[] = {
        {true, {"SLURM_STEP_ID=0", "SLURM_STEP_NUM_TASKS=4", "SLURM_MPI_TYPE=none"}},
        {true, {"SLURM_STEPID=2", "SLURM_STEP_NUM_TASKS=1"}},
        {false, {"SLURM_STEP_ID=0", "SLURM_STEP_NUM_TASKS=4", "PMIX_RANK=1"}},
        {false, {"SLURM_STEP_ID=0", "SLURM_STEP_NUM_TASKS=4", "PMI2_FD=5"}},
        {false, {"SLURM_STEP_ID=0"}}, /* how many is not known: MPI must say */
        {false, {"SLURM_STEP_ID=batch", "SLURM_STEP_NUM_TASKS=4"}},
        {false, {"OMPI_COMM_WORLD_RANK=0", "OMPI_COMM_WORLD_SIZE=2"}},
    };
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        assert_int_equal(launcher_find((char *const *)(uintptr_t)steps[i].environment).is_mute, steps[i].is_mute);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(environments_say_who_started_the_process),
        cmocka_unit_test(a_step_without_pmi_is_mute),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
