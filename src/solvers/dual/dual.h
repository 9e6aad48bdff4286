/* The dual solver: backward Euler with the materials' own moduli, for liquids and for liquids and elastic bodies together.
 * The equations stand in ispc/dual.isph. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_DUAL_H
#define PBMPM_SRC_SOLVERS_DUAL_DUAL_H

#include "world/world.h"

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result dual_prepare(World *world);

void dual_free(World *world);

/* What the kernels need to know of materials; and of solids alone. */
void dual_set_materials(World *world);
void dual_set_solids(World *world);

void dual_solve(World *world, const ContactFrame *contacts);

/* The same for another solver that does something in the guess, once liquids have pushed with the pressures that they start from. */
typedef void DualSketch(World *world, const ContactFrame *contacts);
void dual_solve_with(World *world, const ContactFrame *contacts, DualSketch *sketch);

/* c (2 mu + lambda) of an elastic material: the square of twice the Courant number of its pressure wave. */
double dual_stiffness_of(const pbmpm_material_def *def, const Substep *substep);

/* The share of an elastic material's stiffness that the iterations of a substep can hold, and the share that they are asked for. */
double dual_stiffness_share(const World *world, const pbmpm_material_def *def, const Substep *substep);
double dual_stiffness_cap(const World *world, const pbmpm_material_def *def, const Substep *substep);

/* Whether they hold all of the stiffness of the solids that share the world with sand or liquid. */
bool dual_holds_solids(const World *world, const Substep *substep);

/* How many iterations solids may count on in the next substep that count on so many in this one, where more are set; see solver.c. */
double dual_stiffened(const World *world, const Substep *substep, double iterations);

/* How many they may count on at first where iterations are raised. */
double dual_continued(const World *world, const Substep *substep, int before, int now);

/* The share of its last pressure that a liquid starts a substep from. */
double dual_carried_share(const World *world);

/* The longest relaxation that solids stay calm with in so many iterations. */
float dual_longest_relaxation(int iterations);

#endif
