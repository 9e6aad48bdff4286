#include "explicit.h"

pbmpm_result explicit_prepare(World *world)
{
    (void)world;
    return PBMPM_OK;
}

void explicit_solve(World *world, const ContactFrame *contacts)
{
    (void)world;
    (void)contacts;
}
