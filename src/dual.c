#include "dual.h"

pbmpm_result dual_prepare(World *world)
{
    (void)world;
    return PBMPM_OK;
}

void dual_solve(World *world, const ContactFrame *contacts)
{
    (void)world;
    (void)contacts;
}

double dual_stiffness_share(const World *world, const pbmpm_material_def *def, double substep)
{
    (void)world;
    (void)def;
    (void)substep;
    return 1.0;
}
