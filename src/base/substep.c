#include "base/substep.h"

#include <math.h>

Substep substep_of(double dt, double cell_size)
{
    return (Substep){.dt = dt,
                     .cells_per_metre = 1.0 / cell_size,
                     .to_cells = dt / cell_size,
                     .to_velocity = cell_size / dt,
                     .reference_steps = REFERENCE_RATE * dt};
}

double per_reference_step(double share, const Substep *substep) { return 1.0 - pow(1.0 - share, fmin(1.0, substep->reference_steps)); }
