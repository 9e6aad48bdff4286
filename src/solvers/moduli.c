#include "solvers/moduli.h"

#include <math.h>

#include "solvers/passes.h"
#include "solvers/plastic.h"
#include "solvers/viscosity.h"

double moduli_unit(const pbmpm_material_def *def, const Substep *substep)
{
    return 4.0 * substep->to_cells * substep->to_cells / (double)def->density;
}

static void set_liquid(World *world, uint32_t slot, float stiffest)
{
    const pbmpm_material_def *def = &world->materials.def[slot];
    KernelMaterial *material = &world->materials.kernel[slot];
    const double c = moduli_unit(def, &world->substep);
    const bool incompressible = def->bulk_modulus == 0.0f;
    material->dilation = incompressible ? stiffest : (float)fmin(c * (double)def->bulk_modulus, 1e30);
    if (world->settings.solver == PBMPM_SOLVER_CONVERGENT) material->dilation = fminf(material->dilation, stiffest);
    material->inverse_stiffness = incompressible ? 0.0f : 1.0f / material->dilation;
    material->pascal_per_multiplier = (float)fmin(1.0 / c, 1e30);
    material->viscous_share = (float)viscosity_share(world, def);
}

double moduli_sand_share(const pbmpm_material_def *def, const Substep *substep)
{
    static const double STIFFEST_SHEAR = 1e4; /* c mu: with more, floats hold the deviator too coarsely, see moduli.h */
    return fmin(1.0, STIFFEST_SHEAR / (moduli_unit(def, substep) * lame_of((double)def->young_modulus, (double)def->poisson_ratio).mu));
}

void moduli_set_solid(World *world, uint32_t slot, double share)
{
    const pbmpm_material_def *def = &world->materials.def[slot];
    KernelMaterial *material = &world->materials.kernel[slot];
    const Lame lame = lame_of((double)def->young_modulus, (double)def->poisson_ratio);
    const double unit = moduli_unit(def, &world->substep), c = unit * share;
    material->relaxation = def->relaxation;
    material->shear = (float)fmin(c * lame.mu, 1e30);
    material->dilation = (float)fmin(c * lame.lambda, 1e30);
    if (material->yields == K_SAND) material->pascal_per_multiplier = (float)fmin(1.0 / unit, 1e30);
    plastic_set(world, slot, 1.0 + world->def.dimension * lame.lambda / (2.0 * lame.mu));
}

void moduli_set(World *world, float stiffest)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (world->materials.generation[slot] == 0) continue;
        const pbmpm_material_def *def = &world->materials.def[slot];
        KernelMaterial *material = &world->materials.kernel[slot];
        material->relaxation = def->relaxation;
        if (material_flows(def) || material->yields == K_SAND) material->volume_feedback = solver_follows_grid(world, slot) ? solver_feedback_share(world, def) : 0.0f;
        if (material->kind == K_LIQUID)
            set_liquid(world, slot, stiffest);
        else
            moduli_set_solid(world, slot, 1.0);
    }
}
