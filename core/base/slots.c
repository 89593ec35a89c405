/* slots.c - see slots.h. */
#include "base/slots.h"

#include "base/mem.h"

void slots_start(struct slots *slots, size_t n)
{
    mem_free(slots->taken);
    for (slots->bits = 1; n >> (slots->bits - 1) > 0;) slots->bits++;
    slots->taken = mem_new((size_t)1 << slots->bits, sizeof *slots->taken);
}

void slots_done(struct slots *slots)
{
    mem_free(slots->taken);
    *slots = (struct slots){0};
}
