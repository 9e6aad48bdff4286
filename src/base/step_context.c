#include "base/step_context.h"

#include <math.h>

StepContext step_context(double substep_dt, double cell_size)
{
    return (StepContext){.substep_dt = substep_dt,
                         .cells_per_metre = 1.0 / cell_size,
                         .to_cells = substep_dt / cell_size,
                         .to_velocity = cell_size / substep_dt,
                         .reference_steps = REFERENCE_RATE * substep_dt};
}

double per_reference_step(double share, const StepContext *step) { return 1.0 - pow(1.0 - share, fmin(1.0, step->reference_steps)); }
