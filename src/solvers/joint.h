/* The joint solver: islands of solids and liquid, see islands.h.
 *
 * A few iterations of the primal solver do not find the pressure of a pool. A few of the dual hold little of what solids resist by shear. So each does what it can,
 * on one grid (a partitioned method: C. Felippa, K. Park, C. Farhat, "Partitioned analysis of coupled mechanical systems", Comput. Methods Appl. Mech. Eng. 190,
 * 2001):
 *
 *     sketch  the primal solves for solids, under the pressures p that liquids start the substep from, to v. A body that gained energy by it
 *             has no sketch: its v is where the push of p leads;
 *     dual    finds the pressures. It starts at v: its predictor is v less the push of p. Solids resist what strains them beside v;
 *     primal  solves again under the pressures found, from where they lead.
 *
 * In the primal's parts a liquid particle has the energy phi = y^2 / (2 k) with y = max(0, p - k (tr D - tr D0)). D0 is its D where the part begins, and k what it
 * resists with where solids shove it aside. Where it bears nothing, tr D0 counts as no more than what it lacks of its volume: else it would press while it grows. Liquid that no solid disturbs is in balance where it is. Where all rests, all parts agree: a bar that hangs into water
 * stretches at 60 Hz x 5 as the converged solution does.
 *
 * A body that falls into water pushes it away before they meet. They share nodes, so a gap of half a cell would stay: in 3D a cube of six cells displaced a quarter
 * more than its volume. At nodes that solids reach liquid counts as loose by what is missing there, see integrate_tensionless(). So its pressure closes gaps.
 *
 * Walls lead nodes in all parts (walls.h). What no solid is near stays where the dual takes it. Near solids nodes follow in the primal's parts, too: see
 * primal_followers.h. Where each part had its own law, liquid below a body flowed through the floor and pressed a quarter of what it should.
 * They slip: they have their motion along the wall themselves, else liquid below a body would go along with it, and never flow out.
 * Solids are as stiff as the primal holds among liquid, see joint_stiffness_share(). */
#ifndef PBMPM_SRC_SOLVERS_JOINT_H
#define PBMPM_SRC_SOLVERS_JOINT_H

#include "world/world.h"

/* The share of its stiffness that an elastic material among liquid gets. */
double joint_stiffness_share(const World *world, const pbmpm_material_def *def, const Substep *substep);

/* What the kernels need to know of materials while the dual works. */
void joint_set_materials(World *world);

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result joint_prepare(World *world);
void joint_free(World *world);

/* After the contacts of the dual's part: finds those of the primal's. */
pbmpm_result joint_find_contacts(World *world, const ContactFrame *contacts);

void joint_solve(World *world, const ContactFrame *contacts);

#endif
