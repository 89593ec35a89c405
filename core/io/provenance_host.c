/* provenance_host.c - see provenance_host.h. */
#include "io/provenance_host.h"

#include "base/system.h"
#include "base/version.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

extern char **environ;

static bool provenance_host_begins(const char *variable, const char *const *heads)
{
    for (; *heads; heads++)
        if (!strncmp(variable, *heads, strlen(*heads))) return true;
    return false;
}

json_t *provenance_host_environment(void)
{
    static const char *const wanted[] = {"BULLA_",
                                         "OMP_",
                                         "GOMP_",
                                         "OMPI_MCA_",
                                         "OMPI_COMM_WORLD_SIZE=",
                                         "OMPI_COMM_WORLD_LOCAL_SIZE=",
                                         "HWLOC_",
                                         "SLURM_JOB_ID=",
                                         "SLURM_NTASKS=",
                                         "LD_PRELOAD=",
                                         "LD_LIBRARY_PATH=",
                                         "GLIBC_TUNABLES=",
                                         "MALLOC_",
                                         "LANG=",
                                         "LC_",
                                         "TZ=",
                                         NULL};
    static const char *const launcher[] = {"OMPI_MCA_orte_",        "OMPI_MCA_ess",           "OMPI_MCA_pmix",
                                           "OMPI_MCA_initial_wdir", "OMPI_MCA_shmem_RUNTIME", NULL};
    json_t *environment = json_object();
    for (char **variable = environ; *variable; variable++) {
        const char *equals = strchr(*variable, '=');
        if (!equals || !provenance_host_begins(*variable, wanted) || provenance_host_begins(*variable, launcher))
            continue;
        char name[128];
        snprintf(name, sizeof name, "%.*s", (int)(equals - *variable), *variable);
        json_t *value = json_string(equals + 1); /* NULL where the text is no UTF-8 */
        json_object_set_new(environment, name, value ? value : json_null());
    }
    return environment;
}

json_t *provenance_host_cpu(void)
{
    char model[256];
    system_processor(sizeof model, model);
    return json_pack("{s:s, s:I}", "model", model, "processors", (json_int_t)sysconf(_SC_NPROCESSORS_ONLN));
}

/* What the compiler says of itself. */
#ifdef __OPTIMIZE__
#define PROVENANCE_HOST_OPTIMISED "optimised"
#else
#define PROVENANCE_HOST_OPTIMISED "not optimised"
#endif
#ifdef NDEBUG
#define PROVENANCE_HOST_ASSERT ", without assertions"
#else
#define PROVENANCE_HOST_ASSERT ", with assertions"
#endif
#ifdef __SANITIZE_ADDRESS__
#define PROVENANCE_HOST_SANITIZED ", with AddressSanitizer"
#else
#define PROVENANCE_HOST_SANITIZED ""
#endif
#ifdef __AVX512F__
#define PROVENANCE_HOST_TARGET ", for AVX-512"
#elif defined __AVX2__
#define PROVENANCE_HOST_TARGET ", for AVX2"
#else
#define PROVENANCE_HOST_TARGET ""
#endif
#ifdef __FAST_MATH__
#error "results would depend on the optimiser: -ffast-math is not allowed"
#endif

json_t *provenance_host_flags(void)
{
    return json_sprintf(PROVENANCE_HOST_OPTIMISED PROVENANCE_HOST_ASSERT PROVENANCE_HOST_SANITIZED
                            PROVENANCE_HOST_TARGET ": %s",
                        version_flags());
}
