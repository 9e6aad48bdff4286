#include "solvers/plastic.h"

#include <math.h>

void plastic_set(World *world, uint32_t slot, double bulk_over_shear)
{
    const pbmpm_material_def *def = &world->materials.def[slot];
    KernelMaterial *material = &world->materials.kernel[slot];
    material->friction = (float)sin((double)def->friction_angle);
    material->bulk_over_shear = (float)bulk_over_shear;
    material->excess_kept = (float)exp(-(double)def->flow_rate * world->substep.dt);
}
