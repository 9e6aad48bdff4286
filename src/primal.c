#include "primal.h"

pbmpm_result primal_prepare(World *world)
{
    (void)world;
    return PBMPM_OK;
}

void primal_solve(World *world, const ContactFrame *contacts)
{
    (void)world;
    (void)contacts;
}
