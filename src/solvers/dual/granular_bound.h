/* The energy bound of sand in the dual solver.
 *
 * Sand stores no energy. So a body's stresses gain (dual_gains.h) no more than growth takes that crushed matter is asked for: sum_p m_p/4 tr S g, with S the multiplier
 * and g the growth, see next_mean() in ispc/granular.isph. Few iterations leave stresses that stop more than there is to stop, or that go on pushing what has left. Without a
 * bound a random scene with two iterations (194653 of tests/random_scenes.py) gained an eighth of its energy.
 * Bodies with other solids, or a liquid with a bulk modulus, are left out: these store energy, which is theirs to give back.
 *
 * A body that gains more keeps the share s of its stresses. Let u_1 be where all of them lead, u_0 where none do, both as walls allow, and d = u_1 - u_0. s q leads to
 * u_0 + s d, as long as the same walls are touched. What it moves is m d less the push of walls, which do no work on d; so q.d = m |d|^2, and the gain is
 *
 *     s q.(u_0 + s d) - m/2 |u_0 + s d - w|^2 = s^2 A/2 + s B - G,   A = m |d|^2,   G = m/2 |u_0 - w|^2,
 *
 * with the B that makes it the measured one for s = 1. s is where it is s times what growth takes. Walls act again on what is left, so momentum is booked as ever. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_GRANULAR_BOUND_H
#define PBMPM_SRC_SOLVERS_DUAL_GRANULAR_BOUND_H

#include "contact/contacts.h"
#include "world/world.h"

/* False without memory. */
bool granular_bound_prepare(World *world);
void granular_bound_free(World *world);

/* After the iterations; leaves the gains of what is left in dual_gains.h. */
void granular_bound_keep(World *world, const ContactFrame *contacts);

#endif
