/* The energy bound of sand in the dual solver.
 *
 * Sand stores no energy. So a body's stresses gain (dual_gains.h) no more than growth takes that crushed matter is asked for: sum_p m_p/4 tr S g, with S the multiplier
 * and g the growth, see next_mean() in ispc/granular.isph. Few iterations leave stresses that stop more than there is to stop, or that go on pushing what has left. Without a
 * bound a random scene with two iterations (194653 of tests/random_scenes.py) gained an eighth of its energy.
 *
 * A body that gains more keeps the share s of its stresses. Where nothing is touched, s q leads to u* + s q/m and gains s^2 A/2 + s B - G with A = |q|^2/m, B = q.w and
 * G = m/2 |u* - w|^2; s is where that is s times the growth's. B follows from what q gains now. Walls act again on what is left, so momentum is booked as ever. */
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
