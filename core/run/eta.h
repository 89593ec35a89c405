/* eta.h - how long a run still takes, from how it went so far.
 *
 * Effort is CPU time, so that other programs on the machine do not look like a change of the run; what they cost comes
 * in by the wall time that a second of CPU time took so far. Effort per share of the run changes: levels grow, steps
 * get shorter. One guess is that it stays what it is, the other that it goes on changing as it did; the truth is
 * expected between them, with a tenth more on both sides. */
#ifndef ETA_H
#define ETA_H

struct eta {
    double first;            /* share of the run that was done at the start */
    double share, cpu, wall; /* the last note: of the run; seconds since the start */
    double pace;             /* CPU seconds per share, of about the last ten seconds; 0: none is known */
};

/* What is left [s of wall time]; all are infinite if nobody knows. */
struct eta_left {
    double likely, least, most;
};

void eta_begin(struct eta *eta, double share);

/* Notes where the run is, at clocks that count from the start. */
void eta_note(struct eta *eta, double share, double cpu, double wall);

struct eta_left eta_left(const struct eta *eta);

#endif
