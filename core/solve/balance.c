/* balance.c - see balance.h. */
#include "solve/balance.h"

#include "base/comm.h"
#include "base/mem.h"
#include "solve/regrid.h"
#include "solve/stage.h"

void balance_note(struct balance *balance, const struct stage *stage, double seconds)
{
    struct balance_level *level = &balance->level[stage->l];
    for (unsigned t = 0; t < stage->level->n_local; t++) level->predicted += regrid_cost(stage, t);
    level->seen += seconds;
}

void balance_take(const struct balance *balance, struct balance_level ret_share[MESH_LEVELS])
{
    enum { COUNT = 2 * MESH_LEVELS };
    double own[COUNT], *all = mem_new((size_t)comm_size() * COUNT, sizeof *all);
    for (int i = 0; i < COUNT; i++) own[i] = i % 2 ? balance->level[i / 2].seen : balance->level[i / 2].predicted;
    comm_join(own, COUNT, all);
    for (int i = 0; i < COUNT; i++) {
        double sum = 0.0, most = 0.0;
        for (int rank = 0; rank < comm_size(); rank++) {
            double value = all[rank * COUNT + i];
            sum += value;
            most = value > most ? value : most;
        }
        *(i % 2 ? &ret_share[i / 2].seen : &ret_share[i / 2].predicted) = sum / comm_size() / most;
    }
    mem_free(all);
}
