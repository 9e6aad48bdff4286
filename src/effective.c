#include "effective.h"

#include <math.h>

#include "dual.h"
#include "paper.h"

/* The laws of the paper's solver: its N rounds remove the share w of a strain error each, which acts like the modulus
 * rho w N dx^2 / (4 dt^2) against a shape error and like a d-th of it against a volume error. */
static pbmpm_effective of_paper(const World *world, const pbmpm_material_def *def, double substep)
{
    const double cell = (double)world->def.cell_size / substep;
    const double rounds = world->settings.iterations;
    const double young = 0.25 * (double)def->density * (double)def->relaxation * rounds * cell * cell;
    const bool liquid = def->kind == PBMPM_LIQUID;
    const double viscosity = rounds * paper_viscous_share(world, def, substep) * cell * (double)world->def.cell_size / 8.0;
    return (pbmpm_effective){.bulk_modulus = (float)(young / world->def.dimension),
                             .young_modulus = liquid ? 0.0f : (float)young,
                             .kinematic_viscosity = liquid ? (float)viscosity : 0.0f};
}

/* The convergent solver is the dual where there is liquid or sand, see solver_prepare(). */
static bool by_dual(const World *world, const pbmpm_material_def *def)
{
    if (world->settings.solver != PBMPM_SOLVER_CONVERGENT) return world->settings.solver == PBMPM_SOLVER_DUAL;
    bool sand = def->kind == PBMPM_SAND;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        sand = sand || (world->particles.of_material[slot] > 0 && world->materials.def[slot].kind == PBMPM_SAND);
    return sand || solver_holds_liquid(world);
}

static pbmpm_effective of_material(const World *world, const pbmpm_material_def *def, double substep)
{
    if (def->kind == PBMPM_LIQUID)
        return (pbmpm_effective){.bulk_modulus = def->bulk_modulus, .kinematic_viscosity = def->kinematic_viscosity};
    const double share = by_dual(world, def) ? dual_stiffness_share(world, def, substep) : 1.0;
    const double young = share * (double)def->young_modulus, poisson = (double)def->poisson_ratio;
    const double shear = 0.5 * young / (1.0 + poisson), lambda = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
    return (pbmpm_effective){.bulk_modulus = (float)(lambda + 2.0 * shear / world->def.dimension), .young_modulus = (float)young};
}

/* The pressure wave's modulus: K of a liquid, K + 2 (d - 1) / d mu of an elastic body. */
static double wave_modulus(const World *world, const pbmpm_material_def *def, const pbmpm_effective *effective)
{
    const double bulk = (double)effective->bulk_modulus, young = (double)effective->young_modulus;
    if (def->kind == PBMPM_LIQUID) return bulk;
    if (world->settings.solver == PBMPM_SOLVER_PAPER) return young; /* it has no Poisson effect */
    const double d = world->def.dimension;
    return bulk + (d - 1.0) / d * young / (1.0 + (double)def->poisson_ratio);
}

pbmpm_effective effective_modulus(const World *world, const pbmpm_material_def *def, double substep)
{
    const bool paper = world->settings.solver == PBMPM_SOLVER_PAPER;
    pbmpm_effective effective = paper ? of_paper(world, def, substep) : of_material(world, def, substep);
    effective.size = sizeof effective;
    const double speed = sqrt(wave_modulus(world, def, &effective) / (double)def->density);
    effective.courant = (float)(speed * substep / (double)world->def.cell_size);
    return effective;
}
