/* watch_life.c - see watch_life.h. */
#include "watch/watch_life.h"

#include "base/status.h"

enum watch_life watch_life_of(const struct watch_life_signs *signs)
{
    if (!signs->known) return signs->locked == 1 ? WATCH_LIFE_RUNNING : WATCH_LIFE_NONE;
    if (signs->ended && signs->exit_code == STATUS_OK) return WATCH_LIFE_FINISHED;
    if (signs->ended && signs->exit_code == STATUS_EXPECT) return WATCH_LIFE_MISSED;
    if (signs->ended) return signs->exit_code == STATUS_STOPPED ? WATCH_LIFE_STOPPED : WATCH_LIFE_FAILED;
    if (signs->locked == 0 && signs->here) return WATCH_LIFE_KILLED;
    return signs->silent_s > WATCH_LIFE_LONG ? WATCH_LIFE_QUIET : WATCH_LIFE_RUNNING;
}

const char *watch_life_word(enum watch_life life)
{
    static const char *const words[] = {
        [WATCH_LIFE_NONE] = "waiting",      [WATCH_LIFE_RUNNING] = "running", [WATCH_LIFE_QUIET] = "quiet",
        [WATCH_LIFE_FINISHED] = "finished", [WATCH_LIFE_MISSED] = "missed",   [WATCH_LIFE_FAILED] = "failed",
        [WATCH_LIFE_STOPPED] = "stopped",   [WATCH_LIFE_KILLED] = "killed"};
    return words[life];
}

const char *watch_life_sentence(enum watch_life life, const struct watch_life_signs *signs)
{
    static const char *const sentences[] = {[WATCH_LIFE_NONE] = "No run has said anything here yet.",
                                            [WATCH_LIFE_RUNNING] = "The run is at work.",
                                            [WATCH_LIFE_QUIET] = "The run is alive, but has written nothing for long.",
                                            [WATCH_LIFE_FINISHED] = "The run has finished.",
                                            [WATCH_LIFE_MISSED] = "The run has finished; an expectation does not hold.",
                                            [WATCH_LIFE_FAILED] = "The run has failed.",
                                            [WATCH_LIFE_STOPPED] = "The run was interrupted and has saved its state.",
                                            [WATCH_LIFE_KILLED] =
                                                "The run was killed: its process is gone, and it has not said why."};
    bool sure = signs->locked == 1;
    if (life == WATCH_LIFE_RUNNING && signs->known && !sure)
        return "The run writes; whether its process lives cannot be seen from this machine.";
    if (life == WATCH_LIFE_QUIET && !sure)
        return "The run has written nothing for long; whether its process lives cannot be seen from this machine.";
    return sentences[life];
}
