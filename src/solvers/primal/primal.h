/* The primal solver: backward Euler with the materials' own moduli, for elastic bodies. The unknowns are the displacements u of the nodes,
 * in cells. A substep minimises
 *
 *     E(u) = sum_i m_i/2 |u_i - u*_i|^2 + sum_p m_p/4 phi_p(D_p),   D_p = 4 sum_i w_ip u_i (x_i - x_p)^T,
 *     dE/du_i = m_i (u_i - u*_i) + sum_p m_p w_ip T_p (x_i - x_p),   T = dphi/dD,
 *
 * u* the predictor and phi the energy of ispc/elastic.isph, over what contacts allow. Method: L-BFGS (D. Liu, J. Nocedal, "On the limited
 * memory BFGS method for large scale optimization", Math. Prog. 45, 1989) of projected displacements, body by body, on top of a multilevel
 * preconditioner. Steps are accepted by Armijo's rule, or by the slope where the difference of two energies is rounding (W. Hager,
 * H. Zhang, "A new conjugate gradient method with guaranteed descent", SIAM J. Optim. 16(1), 2005).
 *
 * Contacts: nodes may sink as far as the particles they carry have room (primal_gaps.c); friction is a part of the energy (contact_constraints.h). Rigid motions, which
 * a stiff body does nearly alone, have solvers of their own: the start (primal_start.c), the preconditioner (primal_rigid.c), what is missing at the end
 * (primal_momentum.c). What backward Euler takes from rotations and bounces is given back (primal_spin.c, primal_bounce.c).
 *
 * A solution that is cut short may have more energy than there was. For each body with the displacement g of gravity,
 *
 *     sum m/2 |u|^2 - m g.u + Psi(u)  <=  sum m/2 |u* - g|^2 + Psi(0) + work of moving surfaces
 *
 * holds for the exact solution of a convex energy. Where it does not hold, the search goes on; a body that gained little then
 * pays with its velocities, others start again from their rigid motion, as far as obstacles allow it, and are moved towards it, in the end their mean motion.
 *
 * Of bodies with liquid this judges the elastic energy alone: see primal_liquid.c for the rest. In the joint solver it judges all, and Psi has the energy that the liquid
 * has there, see joint.h, which falls by the work of its pressures: a block that water lifts gains no more than that. Where the elastic energy alone was judged, splashes
 * doubled theirs in each substep, and blocks at rest failed. Eddies pay for the gain that four searches leave, if they have as much:
 * liquid that starts again loses its motion.
 *
 * T is symmetric for small D only. Solids that liquid presses by p and that turn by w have the skew part p w, a couple in the sense of the turn. The liquid, with -p I,
 * has none against it: a jelly of eight cells below 18 of water spun up by 6 % in each substep of 1/60 s. But inner forces turn nothing. So solids among liquid have the
 * couple A taken from T, a dead stress with the energy -A : D. A is what D, where the solution begins, makes of the stress at D = 0, see couple_of(). The skew part of
 * T(D) itself would not do: there D has the stretch of its chord, w^2 / 2, which iterations take away. Stiff bodies were driven by that until they burst. To bodies
 * without liquid primal_spin.c gives back what such couples took. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_H
#define PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_H

#include "world/world.h"

/* The dilation of what stands for an incompressible liquid by itself: as stiff as N iterations can hold; sound travels N / 4 cells per substep. */
static inline float primal_stiffest(int iterations) { return 0.25f * (float)iterations * (float)iterations; }

/* Whether solids and liquid are solved together. */
bool primal_is_mixed(const World *world);

/* The dilation of liquids that are stiffer than what the iterations can hold; see primal_liquid.c. */
float primal_liquid_dilation(const World *world, const Substep *substep);

/* What the kernels need to know of materials. */
void primal_set_materials(World *world);

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result primal_prepare(World *world);
void primal_free(World *world);

/* Lists the nodes that follow others in the joint solver's parts, by its contacts: see primal_followers.h. Before a part: notes what they have themselves. */
pbmpm_result primal_list_followers(World *world);
void primal_note_followers(World *world);

/* The gradient of the energy where primal_sketch() or primal_solve() ended, per node. */
const float *primal_gradient(const World *world);

/* Half of the iterations, without impulses: what the joint solver begins with. Returns how many bodies gained energy: they are far from a solution. */
uint32_t primal_sketch(World *world, const ContactFrame *contacts);

/* Whether the body of a block gained energy in the last sketch. */
bool primal_sketch_gained(const World *world, int32_t block);

void primal_solve(World *world, const ContactFrame *contacts);

/* Before particles move: keeps what primal_calm() needs of them. */
void primal_before_going(World *world);

/* After particles have moved: gives back rotations and bounces, and takes from the velocities of liquids what they have gained. */
void primal_calm(World *world, const ContactFrame *contacts);

#endif
