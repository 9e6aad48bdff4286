/* What follows from the length of a substep: built once per step, and for questions about a step that nobody takes. */
#ifndef PBMPM_SRC_BASE_SUBSTEP_H
#define PBMPM_SRC_BASE_SUBSTEP_H

/* [Hz] The rate that shares, growths and slips "per 1/60 s" are given for. */
static const double REFERENCE_RATE = 60.0;

typedef struct Substep {
    double dt;              /* [s] */
    double cells_per_metre; /* 1 / dx */
    double to_cells;        /* dt / dx: from m/s to cells per substep */
    double to_velocity;     /* and back */
    double reference_steps; /* the substep in steps of the reference rate */
} Substep;

Substep substep_of(double dt, double cell_size);

/* The share per substep that makes `share` per step of the reference rate, which is the most of a longer one. */
double per_reference_step(double share, const Substep *substep);

#endif
