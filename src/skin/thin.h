/* Thin and loose matter, of which F = L alone would leave little.
 *
 * A layer of single particles fills no more than 0.45, and F = 1/2 is nowhere. So its particles count more: s = max(1, c L / F(x_p)) times, at the level L.
 * A layer of particles a cell's half apart has the profile F(z) = s/2 g(z) with g = S W: g(0) = 29/32, g(1/4) = 105/128. So with c = g(0) / g(1/4) = 116/105 the
 * surface F = L is 1/4 from its middle, where it belongs. Inside matter and at flat surfaces, where F(x_p) is 0.74, s is 1; at corners, which the spline
 * rounds, it is larger. s is at most 4: a thread asks for 2.7.
 *
 * But matter that came loose, a jet that stretches or a cloud of drops, has F < c L too, and with all of s the surface encloses the air in it. So a share k of
 * s - 1 is taken, such that the surface encloses the volume that is there. With T the sum of what s adds, it is that of
 *     F + k T = L,   where   sum over points of [F + k T >= L] = sum of F,   both where T is not 0.
 * W adds up to 1 over the lattice, so the sum of F is the particles' volume. Corners and middles of the lattice's cubes are counted, by Simpson's rule: corners alone
 * give a layer too much that only just has one plane of them. k is found for a block with those around it, and changes linearly from one block's middle to
 * the next.
 *
 * A particle that has no more of F than it gives itself is spray: it is no part of the surface, and its volume does not count. */
#ifndef PBMPM_SRC_SKIN_THIN_H
#define PBMPM_SRC_SKIN_THIN_H

#include "skin/field.h"

/* Works out T and k where blocks are changed and what follows from it. Those whose T is not what it was are changed now, too; those whose k
 * is not are `told`. */
void thin_find(const FieldWork *work);
/* Writes 1 for each row of spray, else 0: rows without a block are spray, too. */
void thin_find_spray(const FieldWork *work, uint8_t *spray);

/* Writes G + k T of a block with this number. */
void thin_add(const FieldWork *work, const SkinBlock *block, int32_t b, float values[BLOCK_POINTS]);

#endif
